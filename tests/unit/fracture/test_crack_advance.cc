#include <perimorph/fracture/crack_advance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace Perimorph::Fracture
{
  namespace
  {
    using Point = dealii::Point<2>;

    constexpr double spacing = .01, horizon = .03;

    CrackTip
    tip_at(const Point &origin, const Point &direction)
    {
      CrackTip tip;
      tip.frame        = tip_frame(origin, direction);
      tip.crack_length = .5;
      return tip;
    }

    /// Middles of bonds as a crack breaks them: some in each spacing along a
    /// line, within 0.4 horizons beside it.
    void
    add_band(const Point              &from,
             const double              angle,
             const double              length,
             std::vector<BrokenPlace> &places)
    {
      std::mt19937                           random(7);
      std::uniform_real_distribution<double> side(-.4 * horizon, .4 * horizon);
      const Point along(std::cos(angle), std::sin(angle));
      const Point across(-along[1], along[0]);
      const int   n = std::lround(10. * length / spacing);
      for (int k = 0; k <= n; ++k)
        places.push_back(
          {from + length * k / n * along + side(random) * across, horizon});
    }

    TEST(CrackAdvances, follows_a_band_around_a_kink)
    {
      std::vector<BrokenPlace> places;
      add_band({0., 0.}, 0., .3, places);
      add_band({.3, 0.}, 1.2, .4, places);
      const auto advances =
        crack_advances({tip_at({0., 0.}, {1., 0.})}, places);
      // Straight, it would be 0.58. Ways may cut the kink and wind in the band.
      EXPECT_NEAR(advances[0], .7, .02);
    }

    TEST(CrackAdvances, counts_the_longest_branch)
    {
      std::vector<BrokenPlace> places;
      add_band({0., 0.}, 0., .2, places);
      add_band({.2, 0.}, .5, .1, places);
      add_band({.2, 0.}, -.5, .2, places);
      EXPECT_NEAR(crack_advances({tip_at({0., 0.}, {1., 0.})}, places)[0],
                  .4,
                  .012);
    }

    TEST(CrackAdvances, gives_bonds_to_the_tip_with_the_shortest_way)
    {
      std::vector<BrokenPlace> places;
      add_band({0., 0.}, 0., .3, places);
      add_band({1., 0.}, M_PI, .2, places);
      // beside the crack behind a tip, and away from both
      add_band({-.2, .5 * horizon}, 0., .1, places);
      add_band({.5, .5}, 0., .3, places);
      const auto advances = crack_advances(
        {tip_at({0., 0.}, {1., 0.}), tip_at({1., 0.}, {-1., 0.})},
        places);
      EXPECT_NEAR(advances[0], .3, .008);
      EXPECT_NEAR(advances[1], .2, .008);
    }

    TEST(CrackAdvances, are_zero_without_broken_bonds)
    {
      EXPECT_EQ(crack_advances({tip_at({0., 0.}, {1., 0.})}, {}),
                std::vector<double>{0.});
    }

    TEST(AdvanceHistory, gives_the_speed_of_the_last_rows)
    {
      AdvanceHistory history;
      // A crack that starts at t = 30 and runs with the speed 2; one that
      // rests.
      for (int t = 0; t <= 50; ++t)
        history.add(t, {std::max(0., 2. * (t - 30)), .25});
      EXPECT_EQ(history.rows.size(), AdvanceHistory::n_times);
      EXPECT_NEAR(history.speed(0), 2., 1e-12);
      EXPECT_NEAR(history.speed(1), 0., 1e-12);
      history.add(50., {40., 99.});
      EXPECT_EQ(history.rows.size(), AdvanceHistory::n_times);
      EXPECT_EQ(history.rows.back()[2], 99.);
    }

    TEST(AdvanceHistory, is_near_the_speed_of_a_band_that_grows)
    {
      // 1.5 spacings per output, as of a crack at 1500 m/s with a spacing of
      // 1 mm and outputs every microsecond.
      const double   speed = 1.5 * spacing;
      AdvanceHistory history;
      for (int t = 1; t <= 30; ++t)
        {
          std::vector<BrokenPlace> places;
          add_band({0., 0.}, .3, speed * t, places);
          history.add(t, crack_advances({tip_at({0., 0.}, {1., 0.})}, places));
        }
      EXPECT_NEAR(history.speed(0), speed, .05 * speed);
    }
  } // namespace
} // namespace Perimorph::Fracture
