#pragma once

#include <perimorph/fracture/stress_points.h>

namespace Perimorph::Fracture
{
  /// Adds points with the divergence of the stress in all cells of this rank;
  /// without a divergence none.
  ///
  /// A node has the mass of its shape function, whoever carries the energy and
  /// on which side of a crack the cell may lie. In cells that no crack touches
  /// the divergence is interpolated; in others each node has its own, on its
  /// own side, for all of its share of the cell. So the sum over the nodes
  /// beside a crack is the force that its stress-free face leaves for them:
  /// waves that stay there do not change the integral.
  /// @param fit  for the gradients of nodes of cells that a crack touches
  template <int dim>
  void
  add_force_points(const DeformedBody<dim>    &body,
                   const Bonds::CrackSet<dim> &cracks,
                   const DisplacementFit<dim> &fit,
                   const std::vector<bool>    &region,
                   StressPointSet<dim>        &set);
} // namespace Perimorph::Fracture
