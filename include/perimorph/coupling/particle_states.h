#pragma once

#include <perimorph/base/csr.h>
#include <perimorph/fem/elastic_cells.h>
#include <perimorph/peridynamics/family_set.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace Perimorph::Coupling
{
  /// Deformation of one particle at small strain, the third direction of a 2D
  /// model included.
  struct ParticleState
  {
    bool                          exists = false; ///< has a family
    dealii::SymmetricTensor<2, 3> strain;
    dealii::SymmetricTensor<2, 3> stress;
    dealii::Tensor<2, 3>          rotation; ///< (H - H^T) / 2
  };

  struct ParticleStates
  {
    /// Laws of the cells at each node, in rising order: a particle each.
    Base::Csr<unsigned int>    laws;
    std::vector<ParticleState> particles; ///< in this order
    /// A node between laws has the mean of its particles.
    std::vector<ParticleState> nodes;

    /// Null if no cell at the node has this law.
    const ParticleState *
    find(unsigned int node, unsigned int law) const;
  };

  /// States of all particles, the same on all ranks.
  /// @param families      of this rank, with global nodes
  /// @param displacement  of all nodes
  template <int dim>
  ParticleStates
  particle_states(const Mesh::NodalMesh<dim>                          &mesh,
                  const Peridynamics::FamilySet<dim>                  &families,
                  const typename Fem::ElasticCells<dim>::MaterialList &laws,
                  const std::vector<dealii::Tensor<1, dim>> &displacement,
                  MPI_Comm                                   communicator);
} // namespace Perimorph::Coupling
