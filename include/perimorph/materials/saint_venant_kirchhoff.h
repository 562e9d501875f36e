#pragma once

#include <perimorph/materials/material.h>
#include <perimorph/materials/plane_state.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Perimorph
{
  namespace Materials
  {
    /// Saint Venant-Kirchhoff, linear elasticity between the Green-Lagrange
    /// strain E = 1/2 (F^T F - I) and S = lambda tr(E) I + 2 mu E, P = F S.
    /// Plane stress with lambda -> 2 lambda mu / (lambda + 2 mu) is exact: S33
    /// = 0 at E33 = -nu / (1 - nu) tr E.
    ///
    /// Softens in compression (P falls below the stretch 1/sqrt(3)). In plane
    /// stress no thickness is free of stress once E33 <= -1/2; there all
    /// functions throw Base::InadmissibleState.
    template <int dim>
    class SaintVenantKirchhoff : public Material<dim>
    {
    public:
      /// @param youngs_modulus  E > 0 [stress]
      /// @param poissons_ratio  -1 < nu < 0.5
      SaintVenantKirchhoff(double     youngs_modulus,
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

      /// Green-Lagrange strain.
      /// @throws Base::InadmissibleState
      dealii::SymmetricTensor<2, dim>
      admissible_strain(const dealii::Tensor<2, dim> &H) const;
    };
  } // namespace Materials
} // namespace Perimorph
