#pragma once

#include <perimorph/materials/material.h>
#include <perimorph/materials/plane_state.h>

namespace Perimorph
{
  namespace Materials
  {
    /// Isotropic linear elasticity at small strain:
    /// P = lambda tr(e) I + 2 mu e with e = sym(H). In plane stress lambda
    /// is replaced by 2 lambda mu / (lambda + 2 mu).
    template <int dim>
    class LinearElastic : public Material<dim>
    {
    public:
      /// @param youngs_modulus  E > 0 [stress]
      /// @param poissons_ratio  -1 < nu < 0.5
      LinearElastic(double     youngs_modulus,
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
      PlaneState    state;
      LameConstants lame;
    };
  } // namespace Materials
} // namespace Perimorph
