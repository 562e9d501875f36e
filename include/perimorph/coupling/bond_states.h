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

  /// Order of nodes and bonds by place: their numbers depend on the number of
  /// ranks.
  template <int dim>
  struct OrderByPlace
  {
    const std::vector<dealii::Point<dim>> &places; ///< of nodes

    bool
    operator()(const unsigned int a, const unsigned int b) const
    {
      for (int d = 0; d < dim; ++d)
        if (places[a][d] != places[b][d])
          return places[a][d] < places[b][d];
      return a < b;
    }

    /// Of bonds whose ends are in order.
    bool
    operator()(const std::array<unsigned int, 2> &a,
               const std::array<unsigned int, 2> &b) const
    {
      return a[0] == b[0] ? (*this)(a[1], b[1]) : (*this)(a[0], b[0]);
    }
  };

  /// Nodes whose whole families are peridynamic: nothing else holds there what
  /// their bonds let go. The same on all ranks.
  /// @param pairs  bonds of this rank: two nodes each
  std::vector<bool>
  nodes_in_core(const std::vector<double>                      &alpha,
                const std::vector<std::array<unsigned int, 2>> &pairs,
                MPI_Comm                                        communicator);
} // namespace Perimorph::Coupling
