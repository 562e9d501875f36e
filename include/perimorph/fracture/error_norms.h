#pragma once

#include <perimorph/fracture/nodal_stress.h>

#include <deal.II/base/mpi.h>

namespace Perimorph::Fracture
{
  /// Size of a difference of displacements relative to a reference [-].
  struct ErrorNorms
  {
    double l2      = 0.; ///< sqrt(sum V_i |e_i|^2 / sum V_i |u_i|^2)
    double energy  = 0.; ///< sqrt(int W(e) / int W(u))
    double maximum = 0.; ///< max |e_i| / max |u_i|
  };

  /// Norms of error against reference, the same on every rank. W is the energy
  /// of the full finite-element mesh with the tangents at rest, whoever carries
  /// it in the run. A reference of size zero gives infinity (0 if the error is
  /// zero as well).
  ///
  /// Each rank sums over the nodes and cells it owns.
  template <int dim>
  ErrorNorms
  error_norms(const Mesh::NodalMesh<dim>                &mesh,
              const MaterialList<dim>                   &materials,
              const std::vector<dealii::Tensor<1, dim>> &error,
              const std::vector<dealii::Tensor<1, dim>> &reference,
              MPI_Comm                                   communicator);
} // namespace Perimorph::Fracture
