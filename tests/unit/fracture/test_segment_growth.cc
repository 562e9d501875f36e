#include <perimorph/fracture/segment_growth.h>

#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Fracture
{
  namespace
  {
    const double pi = std::acos(-1.);

    /// The tip of a crack from (0, 0.5) to (x, 0.5) in the unit square.
    CrackTip
    tip_at(const double x)
    {
      CrackTip tip{};
      tip.frame =
        tip_frame(dealii::Point<2>(x, .5), dealii::Tensor<1, 2>({1., 0.}));
      return tip;
    }
  } // namespace

  TEST(SegmentGrowth, direction_of_the_largest_hoop_stress)
  {
    EXPECT_EQ(hoop_angle(2., 0.), 0.);
    EXPECT_NEAR(hoop_angle(0., 1.), -std::acos(1. / 3.), 1e-14);
    EXPECT_NEAR(hoop_angle(1., 1.), -std::acos(0.6), 1e-14);
    EXPECT_EQ(hoop_angle(1., -.5), -hoop_angle(1., .5));
    const double t = hoop_angle(3., 1e-6);
    EXPECT_NEAR(3. * std::sin(t) + 1e-6 * (3. * std::cos(t) - 1.), 0., 1e-18);
    // closed
    EXPECT_NEAR(hoop_angle(-3., 1.), -80. / 180. * pi, 1e-15);
  }

  TEST(SegmentGrowth, fans_of_probes)
  {
    const auto usual = probe_angles(false), first = probe_angles(true);
    ASSERT_EQ(usual.size(), 5u);
    ASSERT_EQ(first.size(), 9u);
    EXPECT_NEAR(usual[0], -pi / 4., 1e-15);
    EXPECT_NEAR(usual[3], pi / 8., 1e-15);
    EXPECT_NEAR(first[8], 80. / 180. * pi, 1e-15);
    EXPECT_EQ(first[4], 0.);
  }

  TEST(SegmentGrowth, direction_is_the_top_of_the_parabola)
  {
    const auto          angles = probe_angles(false);
    std::vector<double> drops;
    for (const double a : angles)
      drops.push_back(2. - 3. * (a - .2) * (a - .2));
    EXPECT_NEAR(best_angle(angles, drops), .2, 1e-12);
    // A top outside of the fan, and no top at all.
    for (unsigned int k = 0; k < angles.size(); ++k)
      drops[k] = 2. - (angles[k] + 2.) * (angles[k] + 2.);
    EXPECT_EQ(best_angle(angles, drops), angles.front());
    for (unsigned int k = 0; k < angles.size(); ++k)
      drops[k] = angles[k] * angles[k] + angles[k];
    EXPECT_EQ(best_angle(angles, drops), angles.back());
  }

  TEST(SegmentGrowth, advance_starts_at_the_tip)
  {
    const auto facet = advance_facet(tip_at(.3), pi / 6., .1, 4);
    EXPECT_EQ(facet.corners[0], dealii::Point<2>(.3, .5));
    EXPECT_NEAR(facet.corners[1][0], .3 + .1 * std::sqrt(.75), 1e-15);
    EXPECT_NEAR(facet.corners[1][1], .55, 1e-15);
    EXPECT_EQ(facet.step, 4u);
  }

  TEST(SegmentGrowth, advance_goes_through_what_is_near)
  {
    const auto               mesh = Testing::unit_mesh<2>(20);
    const double             h    = .05;
    const Bonds::CrackSet<2> cracks(
      {{{{dealii::Point<2>(0., .5), dealii::Point<2>(.3, .5)}}, 0, 0},
       {{{dealii::Point<2>(.5, .3), dealii::Point<2>(.5, .7)}}, 1, 0}});
    // The other crack is 0.2 away, 0.1 + 2.2 h reach.
    EXPECT_NEAR(closing_length(mesh, cracks, tip_at(.3), 0., .1, h),
                .21,
                1e-12);
    EXPECT_EQ(closing_length(mesh, cracks, tip_at(.25), 0., .1, h), .1);
    EXPECT_EQ(closing_length(mesh, cracks, tip_at(.3), pi / 3., .1, h), .1);
    // The free edge.
    EXPECT_NEAR(closing_length(mesh, cracks, tip_at(.85), 0., .1, h),
                .16,
                1e-12);
  }
} // namespace Perimorph::Fracture
