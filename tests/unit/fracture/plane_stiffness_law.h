#pragma once

#include <perimorph/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Perimorph::Testing
{
  /// Stiffness (11, 22, 12) of an orthotropic plane whose first axis is turned
  /// by an angle from x; shear modulus G_12, plane stress.
  inline dealii::SymmetricTensor<2, 3>
  orthotropic_stiffness(const double E_1,
                        const double E_2,
                        const double shear_modulus,
                        const double poissons_ratio,
                        const double angle)
  {
    dealii::SymmetricTensor<2, 3> compliance;
    compliance[0][0] = 1. / E_1;
    compliance[1][1] = 1. / E_2;
    compliance[0][1] = -poissons_ratio / E_1;
    compliance[2][2] = 1. / shear_modulus;
    // stresses in the axes of the material
    const double         c = std::cos(angle), s = std::sin(angle);
    dealii::Tensor<2, 3> turn;
    turn[0] = dealii::Tensor<1, 3>({c * c, s * s, 2. * c * s});
    turn[1] = dealii::Tensor<1, 3>({s * s, c * c, -2. * c * s});
    turn[2] = dealii::Tensor<1, 3>({-c * s, c * s, c * c - s * s});
    return invert(
      symmetrize(transpose(turn) * dealii::Tensor<2, 3>(compliance) * turn));
  }

  /// Graphite-epoxy of Hattori et al. (2017), section 6.1, over its E_2.
  inline dealii::SymmetricTensor<2, 3>
  graphite_epoxy(const double fibre_angle)
  {
    return orthotropic_stiffness(144.8 / 11.7,
                                 1.,
                                 9.66 / 11.7,
                                 0.21,
                                 fibre_angle);
  }

  /// Linear elasticity by a stiffness matrix.
  class PlaneStiffnessLaw : public Materials::Material<2>
  {
  public:
    explicit PlaneStiffnessLaw(const dealii::SymmetricTensor<2, 3> &stiffness)
    {
      const auto place = [](const int i, const int j) {
        return i == j ? i : 2;
      };
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          for (int k = 0; k < 2; ++k)
            for (int l = 0; l < 2; ++l)
              A[i][j][k][l] = stiffness[place(i, j)][place(k, l)];
    }

    std::string
    name() const override
    {
      return "plane stiffness";
    }

    bool
    is_linear() const override
    {
      return true;
    }

    double
    energy_density(const dealii::Tensor<2, 2> &H) const override
    {
      return 0.5 * dealii::scalar_product(H, first_piola_kirchhoff(H));
    }

    dealii::Tensor<2, 2>
    first_piola_kirchhoff(const dealii::Tensor<2, 2> &H) const override
    {
      return dealii::double_contract<2, 0, 3, 1>(A, H);
    }

    dealii::Tensor<4, 2>
    tangent(const dealii::Tensor<2, 2> &) const override
    {
      return A;
    }

    double
    out_of_plane_stress(const dealii::Tensor<2, 2> &) const override
    {
      return 0.;
    }

    double
    out_of_plane_stretch(const dealii::Tensor<2, 2> &) const override
    {
      return 1.;
    }

    double
    shear_modulus() const override
    {
      return A[0][1][0][1];
    }

  private:
    dealii::Tensor<4, 2> A;
  };
} // namespace Perimorph::Testing
