#include <perimorph/materials/finite_strain.h>
#include <perimorph/materials/hencky.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  TEST(Hencky, simple_shear_has_the_exact_stress)
  {
    // e_xy = 2 asinh(gamma/2) / sqrt(4 + gamma^2), e_xx = gamma / 2 e_xy,
    // J = 1, stress 2 mu e; numbers at E = 1200, nu = 0.2 (mu = 500)
    struct Reference
    {
      double gamma, stress_xx, stress_xy;
    };
    const Hencky<2> plane(1200., 0.2, PlaneState::plane_strain);
    const Hencky<3> solid(1200., 0.2, PlaneState::three_dimensional);
    for (const Reference &reference :
         {Reference{0.1845, 8.462108042, 91.73016848},
          Reference{1.845, 559.7296822, 606.753043},
          Reference{7.38, 1946.438887, 527.4902132}})
      {
        const auto H2   = simple_shear<2>(reference.gamma);
        const auto P2   = plane.first_piola_kirchhoff(H2);
        const auto tau2 = P2 * transpose(deformation_gradient(H2));
        const auto H3   = simple_shear<3>(reference.gamma);
        const auto tau3 =
          solid.first_piola_kirchhoff(H3) * transpose(deformation_gradient(H3));
        for (const auto &pair :
             {std::make_pair(tau2[0][0], reference.stress_xx),
              std::make_pair(tau2[0][1], reference.stress_xy),
              std::make_pair(tau2[1][0], reference.stress_xy),
              std::make_pair(tau2[1][1], -reference.stress_xx),
              std::make_pair(tau3[0][0], reference.stress_xx),
              std::make_pair(tau3[0][1], reference.stress_xy),
              std::make_pair(tau3[1][1], -reference.stress_xx),
              std::make_pair(tau3[2][2], 0.)})
          EXPECT_NEAR(pair.first, pair.second, 1e-9 * 2000.);
        EXPECT_NEAR(plane.out_of_plane_stress(H2), 0., 1e-10);
      }
  }

  TEST(Hencky, equal_stretches_in_plane_strain_have_the_exact_stress)
  {
    // P = E / ((1 + nu)(1 - 2 nu)) ln(s) / s; numbers at E = 1.2e6, nu = 0.2
    const Hencky<2> law(1.2e6, 0.2, PlaneState::plane_strain);
    for (const auto &[stretch, nominal] : {std::make_pair(0.5, -2310490.602),
                                           std::make_pair(1.3, 336364.4416),
                                           std::make_pair(2.8, 612868.7007)})
      {
        const auto P = law.first_piola_kirchhoff(equal_stretches<2>(stretch));
        EXPECT_NEAR(P[0][0] / nominal, 1., 1e-9);
        EXPECT_NEAR(P[1][1] / nominal, 1., 1e-9);
        EXPECT_NEAR(P[0][1], 0., 1e-6);
      }
  }

  TEST(Hencky, keeps_its_digits_at_stretches_of_a_twentieth_and_twenty)
  {
    // F = R(0.3) diag(s1, s2) R(0.7)^T in the plane
    const double         c1 = std::cos(0.3), s1 = std::sin(0.3);
    const double         c2 = std::cos(0.7), s2 = std::sin(0.7);
    const double         stretch[2]  = {20., 0.05};
    const double         left[2][2]  = {{c1, -s1}, {s1, c1}};
    const double         right[2][2] = {{c2, -s2}, {s2, c2}};
    dealii::Tensor<2, 2> H;
    dealii::Tensor<2, 3> H3;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        {
          for (int a = 0; a < 2; ++a)
            H[i][j] += left[i][a] * stretch[a] * right[j][a];
          H[i][j] -= i == j ? 1. : 0.;
          H3[i][j] = H[i][j];
        }
    // stresses in principal directions: P_aa = tau_a / s_a
    // = 2 mu ln(s_a) / s_a, because J = 1
    const double         mu = 0.5;
    const Hencky<2>      plane(1.2, 0.2, PlaneState::plane_strain);
    const Hencky<3>      solid(1.2, 0.2, PlaneState::three_dimensional);
    dealii::Tensor<2, 2> wanted;
    for (int a = 0; a < 2; ++a)
      {
        const double nominal = 2. * mu * std::log(stretch[a]) / stretch[a];
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            wanted[i][j] += nominal * left[i][a] * right[j][a];
      }
    const auto P  = plane.first_piola_kirchhoff(H);
    const auto P3 = solid.first_piola_kirchhoff(H3);
    // cond(F) = 400 times the round-off of F, relative to P of 60
    EXPECT_LT((P - wanted).norm(), 1e-11 * wanted.norm());
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        EXPECT_NEAR(P3[i][j], wanted[i][j], 1e-11 * wanted.norm());
  }
} // namespace Perimorph::Materials
