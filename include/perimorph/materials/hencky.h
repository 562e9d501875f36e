#pragma once

#include <perimorph/materials/material.h>
#include <perimorph/materials/plane_state.h>

namespace Perimorph
{
  namespace Materials
  {
    /// Hencky's law, quadratic in the logarithmic strain e = 1/2 ln(F F^T):
    /// W = lambda/2 (tr e)^2 + mu e:e, tau = lambda tr(e) I + 2 mu e,
    /// P = tau F^-T. Plane stress with lambda -> 2 lambda mu / (lambda + 2 mu)
    /// is exact: tau_33 = 0 at F33 = exp(-nu / (1 - nu) tr e).
    ///
    /// Errors are round-off for small strain (|H| = 1e-12) as for large. In 3D
    /// two small stretches beside a large one (ratio r) lose digits like r^2.
    /// Source: doc/theory; derivative in principal directions of F F^T.
    template <int dim>
    class Hencky : public Material<dim>
    {
    public:
      /// @param youngs_modulus  E > 0 [stress]
      /// @param poissons_ratio  -1 < nu < 0.5
      Hencky(double youngs_modulus, double poissons_ratio, PlaneState state);

      std::string
      name() const override;
      bool
      is_linear() const override;
      double
      energy_density(const dealii::Tensor<2, dim> &H) const override;
      dealii::Tensor<2, dim>
      first_piola_kirchhoff(const dealii::Tensor<2, dim> &H) const override;
      dealii::Tensor<4, dim>
      tangent(const dealii::Tensor<2, dim> &H) const override;
      double
      out_of_plane_stress(const dealii::Tensor<2, dim> &H) const override;
      double
      out_of_plane_stretch(const dealii::Tensor<2, dim> &H) const override;
      double
      shear_modulus() const override;

    private:
      PlaneState    state;
      LameConstants lame;
    };
  } // namespace Materials
} // namespace Perimorph
