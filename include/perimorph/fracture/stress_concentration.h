#pragma once

#include <perimorph/fracture/nodal_stress.h>

#include <deal.II/base/mpi.h>

namespace Perimorph::Fracture
{
  /// The largest stress on a boundary, the same on every rank.
  template <int dim>
  struct StressConcentration
  {
    double             value  = 0.; ///< stress / nominal stress [-]
    double             stress = 0.; ///< principal stress at the node
    dealii::Point<dim> position;
    unsigned int       node = 0;
  };

  /// K_t = largest principal recovered stress over some nodes / nominal stress;
  /// for a negative nominal stress the smallest principal stress counts.
  ///
  /// Each rank works on its own nodes. Of nodes whose stresses are equal within
  /// 1e-8 the one with the smallest coordinates (x, then y, then z) is named,
  /// so that the answer does not depend on the number of ranks.
  /// @param boundary_nodes  all nodes of the boundary, the same on every rank
  /// @param boundary_name   for messages
  /// @throws Base::InputError  no nodes, or the nominal stress is zero
  template <int dim>
  StressConcentration<dim>
  stress_concentration(const NodalStress<dim>          &recovery,
                       const std::vector<unsigned int> &boundary_nodes,
                       const std::vector<dealii::Tensor<1, dim>> &displacement,
                       double             nominal_stress,
                       const std::string &boundary_name,
                       MPI_Comm           communicator);

  /// The same for stresses already at hand (those of nodes of other ranks are
  /// not read).
  /// @param stresses  one per entry of boundary_nodes
  template <int dim>
  StressConcentration<dim>
  stress_concentration(const Mesh::NodalMesh<dim>      &mesh,
                       const std::vector<unsigned int> &boundary_nodes,
                       const std::vector<Stress<dim>>  &stresses,
                       double                           nominal_stress,
                       const std::string               &boundary_name,
                       MPI_Comm                         communicator);
} // namespace Perimorph::Fracture
