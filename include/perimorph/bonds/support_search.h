#pragma once

#include <perimorph/base/csr.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Bonds
{
  /// A particle before its family is known: a node seen from one material.
  struct ParticleSeed
  {
    unsigned int node;
    unsigned int material;
  };

  /// Particles of all nodes with a positive weight that are close enough to
  /// this rank to matter: owned ones and those whose horizon can reach a cell
  /// in the horizon of an owned one.
  template <int dim>
  std::vector<ParticleSeed>
  relevant_particles(const Mesh::NodalMesh<dim> &mesh,
                     const std::vector<double>  &weight,
                     const std::vector<double>  &horizon);

  /// Cells of the particle's material at its node, in rising order.
  template <int dim>
  void
  find_adjacent_cells(const Mesh::NodalMesh<dim> &mesh,
                      const ParticleSeed         &particle,
                      std::vector<unsigned int>  &cells);

  /// Cells of the particle's material that its gradient averages over: those
  /// with their centroid within the horizon, connected to the particle through
  /// such cells, and the cells at the node (numerics-explicit.md, section 2).
  template <int dim>
  Base::Csr<unsigned int>
  find_supports(const Mesh::NodalMesh<dim>      &mesh,
                const std::vector<ParticleSeed> &particles,
                const std::vector<double>       &horizon);

  /// Relative slack in "within the horizon", so that lattice neighbours at
  /// exactly m spacings count whatever the round-off.
  constexpr double horizon_slack = 1e-10;
} // namespace Perimorph::Bonds
