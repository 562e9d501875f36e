#pragma once

#include <perimorph/bonds/crack_traces.h>

#include <functional>
#include <map>

namespace Perimorph::Coupling
{
  /// A vector per node, of few nodes.
  template <int dim>
  using NodeVectors = std::map<unsigned int, dealii::Tensor<1, dim>>;

  /// What facets change in the consistency target of the nodes, the volume
  /// integral of the gradient of the shape function: cracks are free surfaces,
  ///
  ///   - int over the crack of (phi+_j - phi-_j) n
  ///   + int over crossed faces of the surface of (phi_j - N_j) n_surface
  ///
  /// with one-sided traces phi, integrated by the midpoint rule to the true end
  /// of the crack, pieces outside of the body left out. Points without a trace
  /// on either side are skipped. Since every trace is exact for linear fields,
  /// the changes add up to zero and have no moment.
  ///
  /// @param first_facet  facets from this index on
  /// @param counts       only what is in the cells for which this is true
  /// Source: numerics-cracks.md, C3.
  template <int dim>
  NodeVectors<dim>
  crack_target(const Mesh::NodalMesh<dim>              &mesh,
               const Bonds::CrackSet<dim>              &cracks,
               const Bonds::CrackTraces<dim>           &traces,
               unsigned int                             first_facet = 0,
               const std::function<bool(unsigned int)> &counts      = {});
} // namespace Perimorph::Coupling
