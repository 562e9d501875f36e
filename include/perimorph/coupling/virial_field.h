#pragma once

#include <perimorph/mesh/nodal_mesh.h>
#include <perimorph/mesh/region_map.h>
#include <perimorph/peridynamics/virial_stress.h>

#include <deal.II/base/mpi.h>

namespace Perimorph::Coupling
{
  /// Peridynamic (virial) stress of Li et al. in the ball of each particle,
  /// radius = horizon, with the part of every bond inside it. Right where the
  /// ball is in the body and no element carries a part of it; smaller near
  /// surfaces and in the blending band.
  /// @param pairs  all pairs of this rank; every pair on one rank
  /// @return first Piola-Kirchhoff stress of every node, complete on all ranks;
  ///         zero at nodes without particle
  /// Source: Li, Li, Lai, Liu (2022), eq. (28).
  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  nodal_virial_stress(const Mesh::NodalMesh<dim>                      &mesh,
                      const Mesh::RegionMap                           &region,
                      const std::vector<Peridynamics::PairForce<dim>> &pairs,
                      MPI_Comm communicator);
} // namespace Perimorph::Coupling
