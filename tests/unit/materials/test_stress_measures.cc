#include <perimorph/materials/material_factory.h>
#include <perimorph/materials/stress_measures.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  TEST(StressMeasures, of_simple_shear_are_those_of_hencky)
  {
    // gamma = 1.845, E = 1200, nu = 0.2: see test_hencky.cc
    const auto law =
      make_material<2>("hencky", 1200., 0.2, PlaneState::plane_strain);
    const auto measures = stress_measures(*law, simple_shear<2>(1.845));
    EXPECT_NEAR(measures.strain[0][0], 0.5597296822, 1e-9);
    EXPECT_NEAR(measures.strain[1][1], -0.5597296822, 1e-9);
    EXPECT_NEAR(measures.strain[0][1], 0.606753043, 1e-9);
    EXPECT_NEAR(measures.strain[2][2], 0., 1e-14);
    EXPECT_NEAR(measures.cauchy[0][1], 606.753043, 1e-6);
    EXPECT_NEAR((measures.cauchy - measures.kirchhoff).norm(), 0., 1e-9);
    EXPECT_EQ(measures.deformation_gradient[0][1], 1.845);
    EXPECT_EQ(measures.deformation_gradient[2][2], 1.);
  }

  TEST(StressMeasures, of_equal_stretches_have_the_volume_of_the_plane)
  {
    // E = 1.2e6, nu = 0.2, stretch 0.5: tau, sigma = tau / s^2, P = tau / s
    const auto law =
      make_material<2>("hencky", 1.2e6, 0.2, PlaneState::plane_strain);
    const auto measures = stress_measures(*law, equal_stretches<2>(0.5));
    EXPECT_NEAR(measures.kirchhoff[0][0], -1155245.301, 1e-3);
    EXPECT_NEAR(measures.cauchy[0][0], -4620981.204, 1e-3);
    EXPECT_NEAR(measures.first_piola_kirchhoff[0][0], -2310490.602, 1e-3);
    // tau_33 = lambda tr(e) with lambda = E / 3.6
    EXPECT_NEAR(measures.kirchhoff[2][2],
                1.2e6 / 3.6 * 2. * std::log(0.5),
                1e-6);
  }

  TEST(StressMeasures, plane_stress_has_the_thickness_in_volume_and_strain)
  {
    for (const std::string &name : law_names())
      if (name != "linear elastic")
        {
          SCOPED_TRACE(name);
          const auto law =
            make_material<2>(name, 2., 1. / 3., PlaneState::plane_stress);
          const auto   H         = random_gradient<2>(3, 0.3);
          const auto   measures  = stress_measures(*law, H);
          const double thickness = law->out_of_plane_stretch(H);
          EXPECT_EQ(measures.cauchy[2][2], 0.);
          EXPECT_NEAR(measures.strain[2][2], std::log(thickness), 1e-14);
          const double J = determinant(measures.deformation_gradient);
          EXPECT_NEAR(trace(measures.strain), std::log(J), 1e-14);
          EXPECT_NEAR((measures.cauchy * J - measures.kirchhoff).norm(),
                      0.,
                      1e-14);
        }
  }

  TEST(StressMeasures, of_small_strain_are_one_stress)
  {
    const auto law =
      make_material<2>("linear elastic", 2., 0.25, PlaneState::plane_stress);
    const auto H        = random_gradient<2>(1, 0.1);
    const auto measures = stress_measures(*law, H);
    EXPECT_EQ(measures.cauchy, measures.kirchhoff);
    const auto P = law->first_piola_kirchhoff(H);
    EXPECT_EQ(measures.cauchy[0][1], P[0][1]);
    EXPECT_EQ(measures.first_piola_kirchhoff[1][1], P[1][1]);
    EXPECT_EQ(measures.strain[0][1], 0.5 * (H[0][1] + H[1][0]));
    EXPECT_NEAR(measures.strain[2][2], -trace(H) / 3., 1e-15);
    EXPECT_NEAR(measures.deformation_gradient[2][2], 1. - trace(H) / 3., 1e-15);
  }
} // namespace Perimorph::Materials
