#pragma once

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

  /// States of all nodes, the same on all ranks. A node between materials has
  /// the mean of its particles.
  /// @param families      of this rank, with global nodes
  /// @param displacement  of all nodes
  template <int dim>
  std::vector<ParticleState>
  particle_states(const Mesh::NodalMesh<dim>                          &mesh,
                  const Peridynamics::FamilySet<dim>                  &families,
                  const typename Fem::ElasticCells<dim>::MaterialList &laws,
                  const std::vector<dealii::Tensor<1, dim>> &displacement,
                  MPI_Comm                                   communicator);
} // namespace Perimorph::Coupling
