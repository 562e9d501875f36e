#pragma once

#include <perimorph/damage/breaking_rule.h>

namespace Perimorph::Damage
{
  // Criteria of stress in material axes, axis 1 along the fibres. Strengths are
  // those of tension, so compression along or across the fibres counts as
  // nothing; shear counts always. All directions across the fibres have the
  // strength Y and all shear along them S (transverse isotropy): across them
  // the principal stresses s_2, s_3 of the plane of axes 2 and 3 are taken.
  // Both indices grow with the square of the stress and are 1 at failure.

  /// s_1^2 / X^2 + (s_2^2 + s_3^2) / Y^2 - s_1 (s_2 + s_3) / X^2
  ///   - (2 / Y^2 - 1 / X^2) s_2 s_3 + (t_12^2 + t_13^2) / S^2,
  /// Hill's criterion for Z = Y; in plane stress that of Tsai and Hill. Source:
  /// Hattori et al. (2017), Eq. (26).
  /// @param stress  global components
  /// @param axes    material axes in rows
  double
  tsai_hill_index(const dealii::SymmetricTensor<2, 3> &stress,
                  const dealii::Tensor<2, 3>          &axes,
                  const Strengths                     &strengths);

  /// Square of the largest of s_1 / X, s_2 / Y, s_3 / Y and
  /// sqrt(t_12^2 + t_13^2) / S.
  double
  maximum_stress_index(const dealii::SymmetricTensor<2, 3> &stress,
                       const dealii::Tensor<2, 3>          &axes,
                       const Strengths                     &strengths);

  /// Normal of the plane on which a material fails: along the fibres where
  /// s_1 / X is the largest of s_1 / X, s_2 / Y, s_3 / Y and
  /// sqrt(t_12^2 + t_13^2) / S; else across them, in the direction of the
  /// larger tension or of the shear. A unit vector in global components.
  dealii::Tensor<1, 3>
  failure_plane_normal(const dealii::SymmetricTensor<2, 3> &stress,
                       const dealii::Tensor<2, 3>          &axes,
                       const Strengths                     &strengths);

  /// Rule of a criterion with uses_strengths(): 1 / sqrt(index) of the stress
  /// of the bond. Bonds that do not extend never break.
  std::unique_ptr<BreakingRule>
  make_strength_rule(Criterion criterion);
} // namespace Perimorph::Damage
