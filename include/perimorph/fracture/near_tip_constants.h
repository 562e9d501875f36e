#pragma once

#include <perimorph/fracture/tip_frame.h>
#include <perimorph/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

#include <complex>
#include <optional>
#include <variant>

namespace Perimorph::Fracture
{
  /// Isotropic elastic constants of the plane normal to a crack front.
  struct IsotropicConstants
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

  /// Plane anisotropic elasticity in the axes of a crack tip
  /// (S. G. Lekhnitskii, Anisotropic Plates, 1968).
  struct AnisotropicConstants
  {
    /// Strains (11, 22, 2 * 12) by stresses (11, 22, 12) [1 / stress]; in plane
    /// strain the reduced compliances.
    dealii::SymmetricTensor<2, 3> compliance;
    /// Sum and product of the two roots with positive imaginary part of
    /// S11 m^4 - 2 S16 m^3 + (2 S12 + S66) m^2 - 2 S26 m + S22 = 0. They keep
    /// all digits where the roots are nearly equal, the roots only half.
    std::complex<double> root_sum, root_product;

    std::array<std::complex<double>, 2>
    roots() const;
  };

  using NearTipConstants =
    std::variant<IsotropicConstants, AnisotropicConstants>;

  /// @param compliance  as in AnisotropicConstants, positive definite
  AnisotropicConstants
  anisotropic_constants(const dealii::SymmetricTensor<2, 3> &compliance);

  /// From the tangent of an isotropic law at rest; in 3D those of plane strain
  /// along the front.
  template <int dim>
  IsotropicConstants
  isotropic_constants(const Materials::Material<dim> &material);

  /// True if no component of the tangent at rest differs from that of an
  /// isotropic law by more than 1e-9 of the largest: the relative error of
  /// factors that are computed as if it were isotropic.
  template <int dim>
  bool
  is_isotropic(const Materials::Material<dim> &material);

  /// Compliance of a plane law at rest in the axes of a tip, as in
  /// AnisotropicConstants.
  dealii::SymmetricTensor<2, 3>
  plane_compliance(const Materials::Material<2> &material,
                   const TipFrame<2>            &frame);

  /// Constants for the near-tip fields in the axes of a tip, from the tangent
  /// at rest. None for anisotropic laws in space: there only J exists.
  template <int dim>
  std::optional<NearTipConstants>
  near_tip_constants(const Materials::Material<dim> &material,
                     const TipFrame<dim>            &frame);

  /// L^-1 [1 / stress], symmetric, components along axes[0] and axes[1], with L
  /// the tensor of D. M. Barnett and J. Lothe, Phys. Norv. 7 (1973) 13: with K
  /// = (K_II, K_I) the faces open by sqrt(8 r / pi) L^-1 K at the distance r
  /// and J = 1/2 K . L^-1 K. Isotropic: 2 / E' times the unit tensor.
  dealii::SymmetricTensor<2, 2>
  inverse_barnett_lothe_tensor(const NearTipConstants &constants);

  /// Strain along the crack by a stress along it [1 / stress]: S11, 1 / E'.
  double
  axial_compliance(const NearTipConstants &constants);
} // namespace Perimorph::Fracture
