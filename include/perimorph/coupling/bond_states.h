#pragma once

#include <perimorph/coupling/bond_set.h>
#include <perimorph/coupling/bond_strengths.h>
#include <perimorph/damage/breaking_rule.h>
#include <perimorph/mesh/region_map.h>

namespace Perimorph::Coupling
{
  /// What criteria see of a bond but for its energy, its teeth and particles.
  /// @param eta  displacement of the second node relative to the first
  template <int dim>
  Damage::BondState
  bond_state(const Mesh::NodalMesh<dim>      &mesh,
             const Mesh::RegionMap           &region,
             const std::vector<BondMaterial> &materials,
             unsigned int                     first,
             unsigned int                     second,
             const dealii::Tensor<1, dim>    &eta);

  /// Adds the means of the two ends; of the other one where one has lost its
  /// family.
  template <int dim>
  void
  see_particles(const ParticleState          &first,
                const ParticleState          &second,
                const dealii::Tensor<1, dim> &xi,
                const dealii::Tensor<1, dim> &eta,
                Damage::BondState            &bond);

  /// Nodes whose whole families are peridynamic: nothing else holds there what
  /// their bonds let go. The same on all ranks.
  /// @param pairs  bonds of this rank: two nodes each
  std::vector<bool>
  nodes_in_core(const std::vector<double>                      &alpha,
                const std::vector<std::array<unsigned int, 2>> &pairs,
                MPI_Comm                                        communicator);
} // namespace Perimorph::Coupling
