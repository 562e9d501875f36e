#include <perimorph/base/exceptions.h>
#include <perimorph/materials/neo_hookean.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  TEST(NeoHookean, uniaxial_plane_stress_is_the_uniaxial_solid)
  {
    // lateral stretch s of uniaxial tension at the stretch t solves
    // mu (s^2 - 1) + lambda ln(t s^2) = 0 on both sides; by bisection
    const double E = 3., nu = 0.4;
    const double mu     = E / (2. * (1. + nu));
    const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
    const auto   law    = NeoHookean<2>(E, nu, PlaneState::plane_stress);
    for (const double tension : {0.3, 0.9, 1.5, 4.})
      {
        double low = 0.01, high = 10.;
        for (int i = 0; i < 200; ++i)
          {
            const double s = 0.5 * (low + high);
            const bool   too_large =
              mu * (s * s - 1.) + lambda * std::log(tension * s * s) > 0.;
            (too_large ? high : low) = s;
          }
        dealii::Tensor<2, 2> H;
        H[0][0]      = tension - 1.;
        H[1][1]      = low - 1.;
        const auto P = law.first_piola_kirchhoff(H);
        EXPECT_NEAR(P[1][1], 0., 1e-13);
        EXPECT_NEAR(law.out_of_plane_stretch(H), low, 1e-13);
        EXPECT_NEAR(P[0][0],
                    mu * (tension - 1. / tension) +
                      lambda * std::log(tension * low * low) / tension,
                    1e-13);
      }
  }

  TEST(NeoHookean, thickness_is_found_from_a_point_to_a_sheet)
  {
    for (const double nu : {0., 0.3, 0.499})
      {
        const NeoHookean<2> law(1., nu, PlaneState::plane_stress);
        const double        mu     = 0.5 / (1. + nu);
        const double        lambda = nu / ((1. + nu) * (1. - 2. * nu));
        for (const double stretch : {1e-4, 0.05, 0.999999, 1., 20., 1e4})
          {
            const double s =
              law.out_of_plane_stretch(equal_stretches<2>(stretch));
            EXPECT_NEAR(mu * (s * s - 1.) +
                          lambda * std::log(stretch * stretch * s),
                        0.,
                        1e-12 * (mu * s * s + lambda * 20.));
          }
      }
  }

  TEST(NeoHookean, says_when_no_thickness_is_free_of_stress)
  {
    const NeoHookean<2> law(1., -0.3, PlaneState::plane_stress);
    try
      {
        law.first_piola_kirchhoff(equal_stretches<2>(0.2));
        FAIL() << "nothing thrown";
      }
    catch (const Base::InadmissibleState &error)
      {
        const std::string message = error.what();
        EXPECT_EQ(message.find("the law 'neo-hookean': the plane-stress "
                               "iteration for the thickness failed at "
                               "det F = 0.04 with lambda / mu = -0.375"),
                  0u)
          << message;
      }
  }
} // namespace Perimorph::Materials
