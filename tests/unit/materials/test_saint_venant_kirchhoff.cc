#include <perimorph/base/exceptions.h>
#include <perimorph/materials/saint_venant_kirchhoff.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  TEST(SaintVenantKirchhoff, uniaxial_stress_is_a_cubic)
  {
    // P = E s (s^2 - 1) / 2 at S22 = 0: E22 = -nu E11
    const double         E = 200., nu = 0.3, stretch = 1.3;
    const double         strain  = 0.5 * (stretch * stretch - 1.);
    const double         lateral = std::sqrt(1. - 2. * nu * strain);
    dealii::Tensor<2, 2> H;
    H[0][0]        = stretch - 1.;
    H[1][1]        = lateral - 1.;
    const auto law = SaintVenantKirchhoff<2>(E, nu, PlaneState::plane_stress);
    const auto P   = law.first_piola_kirchhoff(H);
    EXPECT_NEAR(P[0][0], E * stretch * strain, 1e-11);
    EXPECT_NEAR(P[1][1], 0., 1e-11);
    EXPECT_NEAR(law.out_of_plane_stretch(H), lateral, 1e-14);
  }

  TEST(SaintVenantKirchhoff, plane_stress_ends_where_the_thickness_vanishes)
  {
    const SaintVenantKirchhoff<2> law(1., 0.3, PlaneState::plane_stress);
    const auto                    H = simple_shear<2>(7.);
    EXPECT_THROW(law.energy_density(H), Base::InadmissibleState);
    EXPECT_THROW(law.first_piola_kirchhoff(H), Base::InadmissibleState);
    EXPECT_THROW(law.tangent(H), Base::InadmissibleState);
    EXPECT_THROW(law.out_of_plane_stretch(H), Base::InadmissibleState);
    // trace(E) = gamma^2 / 2 reaches 0.5 (1 - nu) / nu at gamma = 1.5275
    EXPECT_NO_THROW(law.tangent(simple_shear<2>(1.527)));
    EXPECT_THROW(law.tangent(simple_shear<2>(1.528)), Base::InadmissibleState);
  }
} // namespace Perimorph::Materials
