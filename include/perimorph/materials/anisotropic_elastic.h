#pragma once

#include <perimorph/materials/anisotropic_stiffness.h>
#include <perimorph/materials/material.h>

namespace Perimorph::Materials
{
  /// Linear elasticity of any symmetry at small strain: P = C e with
  /// e = sym(H).
  template <int dim>
  class AnisotropicElastic : public Material<dim>
  {
  public:
    /// @param name       one of anisotropic_law_names()
    /// @param stiffness  in global axes, positive definite
    AnisotropicElastic(const std::string          &name,
                       const LinearStiffness<dim> &stiffness);

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
    /// mean_shear_modulus() of the stiffness.
    double
    shear_modulus() const override;

  private:
    std::string            law;
    LinearStiffness<dim>   linear;
    dealii::Tensor<4, dim> full;
  };

  /// Harmonic mean over all deviatoric stresses s of the plane or of space, as
  /// many of each direction: 1 / (2 mu) = mean of s S s / (s s), S the
  /// compliance (Reuss). The softest directions weigh most; independent of the
  /// axes, and the shear modulus of an isotropic stiffness.
  /// @return  [stress]
  template <int dim>
  double
  mean_shear_modulus(const dealii::SymmetricTensor<4, dim> &stiffness);
} // namespace Perimorph::Materials
