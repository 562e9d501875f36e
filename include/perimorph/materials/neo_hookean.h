#pragma once

#include <perimorph/materials/finite_strain.h>
#include <perimorph/materials/material.h>
#include <perimorph/materials/plane_state.h>

namespace Perimorph
{
  namespace Materials
  {
    /// Compressible neo-Hookean solid: I1 = tr(F F^T),
    /// W = mu/2 (I1 - 3 - 2 ln J) + lambda/2 (ln J)^2,
    /// P = mu (F - F^-T) + lambda ln J F^-T, with the three-dimensional lambda.
    /// All of them keep their digits at small strain.
    ///
    /// In plane stress the thickness stretch s = F33 solves
    /// mu (s^2 - 1) + lambda ln(s det F) = 0 (tau_33 = 0) by Newton's method in
    /// ln s, and the tangent is condensed. For nu < 0 a strongly compressed
    /// plane has no such thickness: Base::InadmissibleState.
    template <int dim>
    class NeoHookean : public Material<dim>
    {
    public:
      /// @param youngs_modulus  E > 0 [stress]
      /// @param poissons_ratio  -1 < nu < 0.5
      NeoHookean(double     youngs_modulus,
                 double     poissons_ratio,
                 PlaneState state);

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
      /// Volume ratio in three dimensions and thickness stretch.
      struct Volume
      {
        VolumeRatio in_plane;      ///< det F in the directions of the model
        double      log_thickness; ///< ln s
        double      log_J;         ///< ln(s det F)
      };

      PlaneState state;
      double     lame_lambda; ///< three-dimensional
      double     lame_mu;

      /// @throws Base::InadmissibleState
      Volume
      volume(const dealii::Tensor<2, dim> &H) const;
    };
  } // namespace Materials
} // namespace Perimorph
