#pragma once

#include <perimorph/fracture/stress_points.h>
#include <perimorph/fracture/williams_field.h>

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

  /// Replaces the divergence at a tip by what the body around does: a
  /// translation and the displacements of modes I and II, least squares over
  /// the points from one to two reaches away; all of it at the tip, nothing
  /// from two reaches on, linearly in between.
  ///
  /// The two nodes on both sides of a tip swing against each other at a
  /// frequency at which no wave carries that away. Their inertia is multiplied
  /// by the steepest slopes of the near-tip fields, which depend on where
  /// between the nodes the tip is, so that K would swing by several percent.
  /// What is replaced by its like (the fields above) stays as it is.
  /// @param reach  radius in which nodes feel the tip itself
  void
  smooth_towards_tip(const TipFrame<2>      &tip,
                     const NearTipConstants &constants,
                     double                  reach,
                     MPI_Comm                communicator,
                     StressPointSet<2>      &set);
} // namespace Perimorph::Fracture
