#include <perimorph/solvers/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace Perimorph::Solvers
{
  namespace
  {
    /// Newton's method on x^2 = 2, optionally with a frozen derivative.
    NewtonRecord
    solve_square_root(const double start, const double derivative = 0.)
    {
      double x = start;
      return newton(
        {1e-12, 8},
        [&]() {
          return ResidualNorms{std::abs(x * x - 2.), 1.};
        },
        [&]() {
          x -= (x * x - 2.) / (derivative == 0. ? 2. * x : derivative);
          return 3u;
        },
        [](unsigned int, double, unsigned int) {});
    }
  } // namespace

  TEST(Newton, converges_quadratically)
  {
    const auto record = solve_square_root(1.5);
    ASSERT_TRUE(record.converged);
    const auto &r = record.residuals;
    ASSERT_GE(r.size(), 4u);
    EXPECT_GT(std::log(r[2] / r[1]) / std::log(r[1] / r[0]), 1.8);
    EXPECT_EQ(record.linear_iterations, 3 * (r.size() - 1));
  }

  TEST(Newton, says_why_it_failed)
  {
    auto record = solve_square_root(1.5, 100.);
    EXPECT_FALSE(record.converged);
    EXPECT_NE(record.reason.find("iterations"), std::string::npos);
    EXPECT_EQ(record.residuals.size(), 9u);
    record = solve_square_root(std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(record.converged);
    EXPECT_NE(record.reason.find("not finite"), std::string::npos);
  }

  TEST(Newton, zero_problem_needs_no_iteration)
  {
    const auto record = newton(
      {1e-9, 5},
      []() {
        return ResidualNorms{0., 0.};
      },
      []() { return 1u; },
      [](unsigned int, double, unsigned int) {});
    EXPECT_TRUE(record.converged);
    EXPECT_EQ(record.residuals.size(), 1u);
  }
} // namespace Perimorph::Solvers
