#pragma once

#include <perimorph/materials/material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace Perimorph::Fracture
{
  /// Local axes at a crack tip or at a point of a crack front: the crack lies
  /// behind the origin, along -axes[0].
  template <int dim>
  struct TipFrame
  {
    dealii::Point<dim> origin;
    /// Direction of growth, normal of the crack, in 3D tangent of the front:
    /// orthonormal and right-handed.
    std::array<dealii::Tensor<1, dim>, dim> axes;
    /// Of the front in space [1 / length]: 1 / radius for a penny crack.
    double curvature = 0.;
  };

  /// Axes for a direction in 2D; the normal is the direction turned left.
  TipFrame<2>
  tip_frame(const dealii::Point<2>     &origin,
            const dealii::Tensor<1, 2> &direction);

  /// Isotropic elastic constants of the plane normal to a crack front.
  struct NearTipConstants
  {
    double shear_modulus; ///< mu [stress]
    double kolosov;       ///< kappa: (3 - nu) / (1 + nu) in plane stress, else
                          ///< 3 - 4 nu

    /// E' = 8 mu / (kappa + 1): E in plane stress, else E / (1 - nu^2).
    double
    plane_modulus() const
    {
      return 8. * shear_modulus / (kolosov + 1.);
    }
  };

  /// From the tangent of an isotropic law at rest; in 3D those of plane strain
  /// along the front.
  /// @throws Base::InputError  the law is not isotropic
  template <int dim>
  NearTipConstants
  near_tip_constants(const Materials::Material<dim> &material);

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

    void
    change_sign()
    {
      displacement *= -1.;
      gradient *= -1.;
      stress *= -1.;
    }
  };

  /// A near-tip field of linear elasticity in global components. Not finite at
  /// the tip; a point on the crack belongs to the side that its coordinate
  /// along the normal has the sign of.
  ///
  /// Modes I and II by complex potentials with phi = omega = (K_I - i K_II)
  /// sqrt(z / (2 pi)): 2 mu (u + i v) = kappa phi(z) - omega(conj z) -
  /// (z - conj z) conj(phi'(z)) (Muskhelishvili). Point force: Flamant's
  /// radial stress -cos(theta) / (pi r), for the T-stress.
  template <int dim>
  NearTipState<dim>
  near_tip_state(NearTipField              field,
                 const NearTipConstants   &constants,
                 const TipFrame<dim>      &frame,
                 const dealii::Point<dim> &point);
} // namespace Perimorph::Fracture
