#pragma once

#include <perimorph/fracture/near_tip_constants.h>

namespace Perimorph::Fracture
{
  /// Fields that leave the faces of a straight crack free of traction.
  enum class NearTipField
  {
    opening,     ///< mode I, K_I = 1
    sliding,     ///< mode II, K_II = 1
    tearing,     ///< mode III, K_III = 1; zero in 2D
    point_force, ///< unit force per thickness on the tip along axes[0]
  };

  /// Displacement, its gradient H[i][j] = du_i / dX_j, and stress.
  template <int dim>
  struct NearTipState
  {
    dealii::Tensor<1, dim> displacement;
    dealii::Tensor<2, dim> gradient;
    dealii::Tensor<2, dim> stress;
  };

  /// A near-tip field of linear elasticity in global components. Not finite at
  /// the tip; a point on the crack belongs to the side that its coordinate
  /// along the normal has the sign of.
  ///
  /// Isotropic modes I and II by complex potentials with phi = omega = (K_I - i
  /// K_II) sqrt(z / (2 pi)): 2 mu (u + i v) = kappa phi(z) - omega(conj z) - (z
  /// - conj z) conj(phi'(z)) (Muskhelishvili). Point force: Flamant's radial
  /// stress -cos(theta) / (pi r), for the T-stress. Anisotropic (2D): see
  /// lekhnitskii_state().
  template <int dim>
  NearTipState<dim>
  near_tip_state(NearTipField              field,
                 const NearTipConstants   &constants,
                 const TipFrame<dim>      &frame,
                 const dealii::Point<dim> &point);
} // namespace Perimorph::Fracture
