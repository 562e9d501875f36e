#include <perimorph/materials/prototype_microelastic.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  namespace
  {
    /// A uniaxial test with free lateral contraction: E = 200e3.
    struct Reference
    {
      double stretch, lateral_3d, stress_3d, lateral_2d, stress_2d;
    };

    // homogenised bond-based solid, horizon -> 0, by adaptive quadrature and a
    // root search for the lateral stretch, outside of this program
    const Reference references[] = {
      {1.01, 0.997497793, 2010.667728, 0.9966666912, 2006.629844},
      {1.1, 0.9748009579, 21026.68071, 0.966690188, 20631.6593},
      {1.2, 0.9492927065, 43942.43138, 0.9335130603, 42401.00611},
      {1.3, 0.9235932004, 68529.62406, 0.9005806896, 65146.84069}};

    /// P by definition: the mean over n_angles directions on half a circle.
    dealii::Tensor<2, 2>
    mean_stress(const dealii::Tensor<2, 2> &F, const int n_angles)
    {
      dealii::Tensor<2, 2> P;
      for (int k = 0; k < n_angles; ++k)
        {
          dealii::Tensor<1, 2> n;
          n[0]         = std::cos(M_PI * (k + 0.123) / n_angles);
          n[1]         = std::sin(M_PI * (k + 0.123) / n_angles);
          const auto y = F * n;
          P += (1. - 1. / y.norm()) / n_angles * outer_product(y, n);
        }
      return P;
    }

    /// Sheared and turned F with the two principal stretches.
    dealii::Tensor<2, 2>
    with_stretches(const double first, const double second)
    {
      dealii::Tensor<2, 2> left, right;
      left[0][0] = left[1][1] = std::cos(0.3);
      left[1][0]              = std::sin(0.3);
      left[0][1]              = -std::sin(0.3);
      right[0][0] = right[1][1] = std::cos(1.1);
      right[1][0]               = std::sin(1.1);
      right[0][1]               = -std::sin(1.1);
      left[0][0] *= first;
      left[1][0] *= first;
      left[0][1] *= second;
      left[1][1] *= second;
      return left * transpose(right);
    }
  } // namespace

  TEST(PrototypeMicroelastic, uniaxial_tension_has_the_homogenised_stress)
  {
    const double                   E = 200e3;
    const PrototypeMicroelastic<2> plane(E, PlaneState::plane_stress);
    const PrototypeMicroelastic<3> solid(E, PlaneState::three_dimensional);
    for (const Reference &reference : references)
      {
        dealii::Tensor<2, 2> H2;
        H2[0][0]      = reference.stretch - 1.;
        H2[1][1]      = reference.lateral_2d - 1.;
        const auto P2 = plane.first_piola_kirchhoff(H2);
        EXPECT_NEAR(P2[0][0] / reference.stress_2d, 1., 1e-8);
        EXPECT_NEAR(P2[1][1], 0., 1e-9 * E);
        dealii::Tensor<2, 3> H3;
        H3[0][0]      = reference.stretch - 1.;
        H3[1][1]      = reference.lateral_3d - 1.;
        H3[2][2]      = H3[1][1];
        const auto P3 = solid.first_piola_kirchhoff(H3);
        EXPECT_NEAR(P3[0][0] / reference.stress_3d, 1., 1e-8);
        EXPECT_NEAR(P3[1][1], 0., 1e-9 * E);
      }
  }

  TEST(PrototypeMicroelastic, directions_are_enough_in_the_plane)
  {
    // A = 3 E in plane stress; 3000 directions are exact to round-off
    const PrototypeMicroelastic<2> law(1., PlaneState::plane_stress);
    for (const auto &[first, second] : {std::make_pair(2., 0.5),
                                        std::make_pair(0.5, 0.6),
                                        std::make_pair(1.9, 2.)})
      {
        const auto F = with_stretches(first, second);
        auto       H = F;
        H[0][0] -= 1.;
        H[1][1] -= 1.;
        EXPECT_LT(
          (law.first_piola_kirchhoff(H) - 3. * mean_stress(F, 3000)).norm(),
          1e-12);
      }
  }

  TEST(PrototypeMicroelastic, directions_are_enough_in_space)
  {
    // The same stretches about each axis: the product rule is most and least
    // accurate along its pole, so the difference is its error.
    const PrototypeMicroelastic<3> law(1., PlaneState::three_dimensional);
    for (const auto &stretches : {std::array<double, 3>{{0.7, 0.7, 1.6}},
                                  std::array<double, 3>{{0.7, 1.6, 1.6}}})
      {
        dealii::Tensor<2, 3> H;
        for (int a = 0; a < 3; ++a)
          H[a][a] = stretches[a] - 1.;
        const auto P = law.first_piola_kirchhoff(H);
        // <(1 - 1/|F n|) n_p^2> over the sphere with the pole p apart, by
        // Simpson's rule in z with 20000 intervals
        const int    pole  = stretches[0] == stretches[1] ? 2 : 0;
        const double polar = stretches[pole], other = stretches[1 - pole / 2];
        const int    n      = 20000;
        double       mean_p = 0., mean_o = 0.;
        for (int k = 0; k <= n; ++k)
          {
            const double z      = static_cast<double>(k) / n;
            const double weight = (k == 0 || k == n ? 1.
                                   : k % 2          ? 4.
                                                    : 2.) /
                                  (3. * n);
            const double length =
              std::sqrt(polar * polar * z * z + other * other * (1. - z * z));
            mean_p += weight * (1. - 1. / length) * z * z;
            mean_o += weight * (1. - 1. / length) * 0.5 * (1. - z * z);
          }
        for (int a = 0; a < 3; ++a)
          EXPECT_NEAR(P[a][a],
                      6. * stretches[a] * (a == pole ? mean_p : mean_o),
                      1e-10);
      }
  }
} // namespace Perimorph::Materials
