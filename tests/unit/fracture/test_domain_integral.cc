#include <perimorph/fracture/domain_integral.h>

#include "near_tip_bodies.h"
#include <gtest/gtest.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;
  using Testing::NearTipCase;

  /// Exact states on a polar grid that fills the annulus, with the exact
  /// gradient of q.
  StressPointSet<2>
  polar_points(const NearTipCase &body, const Annulus &annulus)
  {
    const double       pi       = std::acos(-1.);
    const unsigned int n_rings  = 40;
    const unsigned int n_angles = 400;
    const double       width    = (annulus.outer - annulus.inner) / n_rings;
    const double       turn     = 2. * pi / n_angles;
    const auto         frame    = body.frame();
    StressPointSet<2>  set;
    for (unsigned int k = 0; k < n_rings; ++k)
      for (unsigned int m = 0; m < n_angles; ++m)
        {
          const double r     = annulus.inner + (k + 0.5) * width;
          const double theta = -pi + (m + 0.5) * turn;
          const auto   radial =
            std::cos(theta) * frame.axes[0] + std::sin(theta) * frame.axes[1];
          StressPoint<2> point        = {};
          point.x                     = body.tip + r * radial;
          point.volume                = r * width * turn;
          const auto state            = body.at(point.x);
          point.displacement_gradient = state.gradient;
          point.first_piola_kirchhoff = state.stress;
          point.energy_density = body.law()->energy_density(state.gradient);
          point.q_gradient     = -radial / (annulus.outer - annulus.inner);
          set.points.push_back(point);
        }
    return set;
  }

  FractureQuantities
  exact_quantities(const NearTipCase &body, const Annulus &annulus)
  {
    const auto frame = body.frame();
    return fracture_quantities<2>(
      polar_points(body, annulus),
      frame.axes[0],
      [&](const dealii::Point<2> &) { return frame; },
      1.,
      body.constants(),
      MPI_COMM_SELF);
  }

  // J = (K_I^2 + K_II^2) / E' (Irwin).
  TEST(DomainIntegral, recovers_the_factors_of_the_exact_field)
  {
    for (const auto state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      for (const double angle : {0., 0.6, 2.5, -1.9})
        {
          NearTipCase body;
          body.K_I         = 1.3;
          body.K_II        = -0.7;
          body.angle       = angle;
          body.tip         = dealii::Point<2>(0.4, -3.);
          body.state       = state;
          const auto found = exact_quantities(body, {0.3, 0.8});
          EXPECT_NEAR(found.K_I, 1.3, 1e-5);
          EXPECT_NEAR(found.K_II, -0.7, 1e-5);
          EXPECT_EQ(found.K_III, 0.);
          EXPECT_NEAR(found.T_stress, 0.4, 1e-4);
          EXPECT_NEAR(found.J, body.exact_J(), 1e-4);
        }
  }

  TEST(DomainIntegral, recovers_the_factors_in_anisotropic_bodies)
  {
    for (const double fibre : {0., 0.5, 1.2, 2.4})
      for (const double angle : {0., 0.6, -1.9})
        {
          NearTipCase body;
          body.K_I         = 1.3;
          body.K_II        = -0.7;
          body.angle       = angle;
          body.tip         = dealii::Point<2>(0.4, -3.);
          body.stiffness   = Testing::graphite_epoxy(fibre);
          const auto found = exact_quantities(body, {0.3, 0.8});
          EXPECT_NEAR(found.K_I, 1.3, 1e-4);
          EXPECT_NEAR(found.K_II, -0.7, 1e-4);
          EXPECT_NEAR(found.T_stress, 0.4, 5e-4);
          EXPECT_NEAR(found.J, body.exact_J(), 1e-4);
        }
  }

  TEST(DomainIntegral, without_near_tip_fields_only_J)
  {
    NearTipCase body;
    const auto  frame = body.frame();
    const auto  found = fracture_quantities<2>(
      polar_points(body, {0.3, 0.8}),
      frame.axes[0],
      [&](const dealii::Point<2> &) { return frame; },
      1.,
      std::nullopt,
      MPI_COMM_SELF);
    EXPECT_FALSE(found.has_factors);
    EXPECT_NEAR(found.J, body.exact_J(), 1e-4);
  }

  TEST(DomainIntegral, does_not_depend_on_the_annulus)
  {
    NearTipCase body;
    const auto  first  = exact_quantities(body, {0.3, 0.8});
    const auto  second = exact_quantities(body, {0.02, 5.});
    EXPECT_NEAR(first.J, second.J, 1e-4 * first.J);
    EXPECT_NEAR(first.K_II, second.K_II, 1e-4);
  }

  TEST(DomainIntegral, weight_is_a_linear_ramp)
  {
    const Annulus annulus = {2., 4.};
    EXPECT_EQ(annulus.weight(0.), 1.);
    EXPECT_EQ(annulus.weight(2.), 1.);
    EXPECT_EQ(annulus.weight(3.5), 0.25);
    EXPECT_EQ(annulus.weight(7.), 0.);
  }

  TEST(DomainIntegral, default_annuli_keep_away_from_boundary_and_horizon)
  {
    // those of numerics.md, Q4, where there is room
    const auto free = default_annuli(1., 3., 0.1, 0.05);
    ASSERT_EQ(free.size(), 2u);
    EXPECT_NEAR(free[0].inner, 0.3, 1e-14);
    EXPECT_NEAR(free[0].outer, 0.8, 1e-14);
    EXPECT_NEAR(free[1].inner, 0.5, 1e-14);
    EXPECT_NEAR(free[1].outer, 1., 1e-14);

    const auto near_boundary = default_annuli(1., 0.4, 0.1, 0.05);
    ASSERT_EQ(near_boundary.size(), 2u);
    EXPECT_NEAR(near_boundary[1].outer, 0.36, 1e-14);

    const auto wide_horizon = default_annuli(1., 3., 0.45, 0.05);
    EXPECT_NEAR(wide_horizon[0].inner, 0.5, 1e-14);

    EXPECT_TRUE(default_annuli(1., 0.2, 0.1, 0.05).empty());
  }
} // namespace
