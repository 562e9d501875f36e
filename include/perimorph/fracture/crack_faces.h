#pragma once

#include <perimorph/fracture/crack_tips.h>
#include <perimorph/fracture/stress_points.h>

namespace Perimorph::Fracture
{
  /// Domain integrals around a crack that bends behind its tip: the near-tip
  /// fields jump on the straight line behind the tip, the body on the crack.
  /// Both are made to jump on the crack by continuing the fields beyond the
  /// line; what they and the energy then do on the faces is a sum over points
  /// there.

  /// True if the crack leaves the straight line behind its tip.
  bool
  is_bent(const CrackTip &tip);

  /// -1 between the crack and the straight line behind its tip, where the
  /// fields of modes I and II have the other sign when they are continued from
  /// ahead of the tip up to the crack; 1 elsewhere.
  double
  branch_sign(const CrackTip &tip, const dealii::Point<2> &point);

  /// Sets the signs of all points, and adds the points on both faces of the
  /// crack within a radius of the tip that lie in cells of this rank; the
  /// gradient there is that of a one-sided fit. Nothing for a straight crack.
  /// @param fit  see visible_fit()
  void
  add_face_points(const DeformedBody<2>    &body,
                  const DisplacementFit<2> &fit,
                  const CrackTip           &tip,
                  double                    radius,
                  StressPointSet<2>        &set);
} // namespace Perimorph::Fracture
