#include <perimorph/solvers/load_stepping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace Perimorph::Solvers
{
  namespace
  {
    struct Walk
    {
      std::vector<double> tried, reached;
      double              end = 0.;
    };

    /// Increments longer than `longest` fail, and so does everything beyond
    /// `limit`.
    Walk
    walk(LoadStepping &stepping,
         const double  from,
         const double  to,
         const double  longest,
         const double  limit = 1e9)
    {
      Walk   result;
      double time = from;
      result.end  = stepping.advance(
        from,
        to,
        [&](const double target) {
          result.tried.push_back(target);
          if (std::abs(target - time) > longest || target > limit)
            return false;
          time = target;
          return true;
        },
        [](double, double) {},
        [&](const double t) { result.reached.push_back(t); });
      return result;
    }
  } // namespace

  TEST(LoadStepping, an_easy_step_is_one_increment)
  {
    LoadStepping stepping({10});
    const auto   result = walk(stepping, 0., 1., 10.);
    EXPECT_EQ(result.end, 1.);
    EXPECT_EQ(result.tried, std::vector<double>{1.});
    EXPECT_EQ(stepping.n_cuts(), 0u);
  }

  TEST(LoadStepping, cuts_until_it_converges_and_grows_again)
  {
    LoadStepping stepping({10});
    const auto   result = walk(stepping, 0., 1., 0.3);
    EXPECT_EQ(result.end, 1.);
    EXPECT_EQ(result.tried[1], 0.5);
    EXPECT_EQ(result.tried[2], 0.25);
    EXPECT_EQ(result.tried[3], 0.75); // twice the increment that converged
    // The next step starts with what worked, and grows.
    const auto next = walk(stepping, 1., 2., 10.);
    EXPECT_EQ(next.end, 2.);
    EXPECT_LT(next.tried.size(), 4u);
    EXPECT_EQ(walk(stepping, 2., 3., 10.).tried.size(), 1u);
  }

  TEST(LoadStepping, gives_up_near_a_limit_point)
  {
    LoadStepping stepping({6});
    const auto   result = walk(stepping, 0., 1., 10., 0.7);
    EXPECT_LE(result.end, 0.7);
    EXPECT_GT(result.end, 0.7 - 1. / 32.);
    EXPECT_EQ(result.reached.back(), result.end);
  }

  TEST(LoadStepping, goes_down_as_well)
  {
    LoadStepping stepping({10});
    EXPECT_EQ(walk(stepping, 1., 0., 0.3).end, 0.);
  }
} // namespace Perimorph::Solvers
