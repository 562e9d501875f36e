#include <perimorph/solvers/inexact_newton.h>

#include <gtest/gtest.h>

namespace Perimorph::Solvers
{
  TEST(ForcingTerm, linear_problem_is_solved_at_once)
  {
    ForcingTerm forcing(1e-12, true);
    EXPECT_DOUBLE_EQ(forcing.next(2., 2e-9), 1e-12);
  }

  TEST(ForcingTerm, follows_the_residual_down_to_the_goal)
  {
    ForcingTerm forcing(1e-12, false);
    EXPECT_DOUBLE_EQ(forcing.next(1., 1e-9), 1e-2);
    EXPECT_DOUBLE_EQ(forcing.next(1e-2, 1e-9), 0.9e-4);
    // 0.9e-8 would go further than a tenth of the goal.
    EXPECT_DOUBLE_EQ(forcing.next(1e-6, 1e-9), 1e-4);
    // A residual that grows does not make the solve useless.
    EXPECT_DOUBLE_EQ(forcing.next(1., 1e-9), 0.1);
  }

  TEST(PreconditionerAge, is_kept_until_its_iterations_cost_a_new_one)
  {
    PreconditionerAge age(10.);
    EXPECT_FALSE(age.still_pays());
    age.renew();
    age.count(20, 1e-4);
    EXPECT_TRUE(age.still_pays());
    // Five per digit are as expected, however many digits.
    age.count(50, 1e-10);
    EXPECT_TRUE(age.still_pays());
    age.count(26, 1e-4);
    EXPECT_TRUE(age.still_pays());
    age.count(24, 1e-4);
    EXPECT_FALSE(age.still_pays());
    age.renew();
    EXPECT_TRUE(age.still_pays());
    age.expire();
    EXPECT_FALSE(age.still_pays());
  }
} // namespace Perimorph::Solvers
