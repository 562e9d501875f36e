#include <perimorph/base/exceptions.h>
#include <perimorph/solvers/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace Perimorph::Solvers
{
  namespace
  {
    /// Newton's method for one number: the equation f(x) = 0 with a derivative.
    struct OneNumber
    {
      double                        x;
      std::function<double(double)> f, derivative;
      NewtonParameters              parameters = {1e-12, 8};
      std::vector<NewtonIteration>  iterations = {};

      NewtonRecord
      solve()
      {
        double        base = x, step = 0.;
        NewtonActions actions;
        actions.evaluate = [&](unsigned int) {
          ResidualNorms norms;
          norms.residual = std::abs(f(x));
          norms.scale    = 1.;
          return norms;
        };
        actions.solve = [&]() {
          base = x;
          step = -f(x) / derivative(x);
          return 3u;
        };
        actions.move   = [&](const double part) { x = base + part * step; };
        actions.slope  = [&]() { return -step * f(x); };
        actions.report = [&](const NewtonIteration &iteration) {
          iterations.push_back(iteration);
        };
        return newton(parameters, actions);
      }
    };

    /// x^2 = 2, optionally with a frozen derivative.
    NewtonRecord
    solve_square_root(const double start, const double frozen = 0.)
    {
      return OneNumber{
        start,
        [](const double x) { return x * x - 2.; },
        [=](const double x) { return frozen == 0. ? 2. * x : frozen; }}
        .solve();
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
    const auto record =
      OneNumber{0., [](double) { return 0.; }, [](double) { return 1.; }}
        .solve();
    EXPECT_TRUE(record.converged);
    EXPECT_EQ(record.residuals.size(), 1u);
  }

  TEST(Newton, steps_are_shortened_where_there_is_no_answer)
  {
    // log x = 0 from x = 3: a full step leads to x = 3 - 3 log 3 < 0.
    OneNumber  problem{3.,
                      [](const double x) {
                        if (x <= 0.)
                          throw Base::InadmissibleState("J is not positive");
                        return std::log(x);
                      },
                      [](const double x) { return 1. / x; }};
    const auto record = problem.solve();
    ASSERT_TRUE(record.converged) << record.reason;
    EXPECT_EQ(problem.iterations[1].step_length, 0.5);
    EXPECT_NEAR(problem.x, 1., 1e-12);
  }

  TEST(Newton, inadmissible_states_without_end_are_a_failure_with_a_reason)
  {
    OneNumber  problem{1.,
                      [](const double x) {
                        if (x != 1.)
                          throw Base::InadmissibleState("J is not positive");
                        return 1.;
                      },
                      [](double) { return 1.; }};
    const auto record = problem.solve();
    EXPECT_FALSE(record.converged);
    EXPECT_EQ(record.reason, "J is not positive");
  }

  TEST(Newton, energy_line_search_tames_overshooting)
  {
    // atan x = 0 from x = 3 diverges with full steps.
    OneNumber problem{3.,
                      [](const double x) { return std::atan(x); },
                      [](const double x) { return 1. / (1. + x * x); }};
    EXPECT_FALSE(OneNumber(problem).solve().converged);
    problem.parameters.maximum_iterations = 20;
    problem.parameters.line_search        = LineSearch::energy;
    EXPECT_TRUE(problem.solve().converged);
  }

  TEST(Newton, stagnation_is_noticed)
  {
    OneNumber problem{1.,
                      [](const double x) { return 2. + std::sin(x); },
                      [](double) { return 1.; }};
    problem.parameters.maximum_iterations = 100;
    const auto record                     = problem.solve();
    EXPECT_FALSE(record.converged);
    EXPECT_LT(record.residuals.size(), 40u);
    EXPECT_NE(record.reason.find("no longer falls"), std::string::npos);
  }
} // namespace Perimorph::Solvers
