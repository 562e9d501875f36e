#include <perimorph/parameters/expression.h>

#include <deal.II/base/point.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace Perimorph;
using namespace Perimorph::Parameters;

namespace
{
  class Expressions : public testing::Test
  {
  protected:
    Expression
    make(const std::string &text)
    {
      return Expression("P", text, constants, errors);
    }

    void
    expect_message(const std::string &text, const std::string &message)
    {
      testing::internal::CaptureStderr();
      make(text);
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
      ASSERT_EQ(errors.size(), 1u);
      EXPECT_EQ(errors.messages()[0], "parameter 'P'\n  " + message);
    }

    Base::InputErrorCollector errors;
    const Constants           constants = {{"S", 10.}, {"width", 2.5}};
    const dealii::Point<2>    point{0.5, 2.};
  };
} // namespace

TEST_F(Expressions, use_coordinates_time_constants_and_functions)
{
  EXPECT_DOUBLE_EQ(make("S*x + y*t").value(point, 3.), 11.);
  EXPECT_DOUBLE_EQ(make("1.5e1 + width").value(point, 0.), 17.5);
  EXPECT_DOUBLE_EQ(make("cos(pi*x)").value(dealii::Point<2>(1., 0.), 0.), -1.);
  EXPECT_DOUBLE_EQ(make("z^2").value(dealii::Point<3>(0., 0., 3.), 0.), 9.);
  EXPECT_DOUBLE_EQ(make("if(x > 0, 1, 2)").value(point, 0.), 1.);
  EXPECT_DOUBLE_EQ(make("x <= 0 ? 1 : 2").value(point, 0.), 2.);
  EXPECT_TRUE(errors.empty());
}

TEST_F(Expressions, know_what_they_depend_on)
{
  EXPECT_TRUE(make("2*t").depends_on_time());
  EXPECT_FALSE(make("sqrt(2)*x").depends_on_time());
  EXPECT_TRUE(make("sqrt(2)*x").depends_on_space());
  EXPECT_FALSE(make("exp(1e-3)").depends_on_space());
  EXPECT_EQ(Expression().value(point, 1.), 0.);
}

TEST_F(Expressions, share_the_parser_when_copied)
{
  const Expression original = make("x*t");
  const Expression copy     = original;
  EXPECT_EQ(copy.value(point, 2.), 1.);
  EXPECT_EQ(copy.text(), "x*t");
}

TEST_F(Expressions, name_the_nearest_name)
{
  expect_message("widht*x",
                 "found the unknown name 'widht' in 'widht*x'; allowed: x, y, "
                 "z, t, S, pi, width, and functions such as sin, exp, sqrt, "
                 "min, if. Did you mean 'width'?");
}

TEST_F(Expressions, point_to_the_constants)
{
  expect_message("amplitude",
                 "found the unknown name 'amplitude' in 'amplitude'; allowed: "
                 "x, y, z, t, S, pi, width, and functions such as sin, exp, "
                 "sqrt, min, if. Other names are set in 'Expressions / "
                 "constants'");
}

TEST_F(Expressions, give_the_words_of_the_parser)
{
  expect_message("x+",
                 "found 'x+' (Unexpected end of expression at position 3); "
                 "allowed: one expression in x, y, z, t, S, pi, width. Powers "
                 "are written x^2, products 2*x");
}

TEST_F(Expressions, refuse_other_grammar)
{
  for (const std::string text : {"x = 3", "x, y", "2x", "x**2", "(x", "x ) ("})
    {
      const std::size_t n_before = errors.size();
      make(text);
      EXPECT_EQ(errors.size(), n_before + 1) << text;
    }
}

TEST_F(Expressions, refuse_nothing)
{
  expect_message(" ", "found nothing; allowed: a number or an expression");
}

TEST_F(Expressions, check_that_values_are_finite)
{
  const Expression expression = make("1/(x - 0.5)");
  EXPECT_TRUE(expression.check_finite(dealii::Point<2>(1., 0.), 0., errors));
  EXPECT_FALSE(expression.check_finite(point, 0., errors));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors.messages()[0],
            "parameter 'P'\n  found '1/(x - 0.5)' = infinite at (0.5, 2), t = "
            "0; allowed: a finite value everywhere in the body");
  EXPECT_FALSE(make("sqrt(-x)").check_finite(point, 0., errors));
}

TEST_F(Expressions, constants_are_named_numbers)
{
  EXPECT_EQ(parse_constants("P", "a = 2.5, S = 10", errors),
            (Constants{{"a", 2.5}, {"S", 10.}}));
  EXPECT_TRUE(errors.empty());
}

TEST_F(Expressions, constants_keep_off_known_names)
{
  parse_constants("P", "t = 1, pi = 3, sin = 1, 2a = 1", errors);
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_NE(errors.messages()[0].find("found name 't'; allowed: names that "
                                      "expressions do not know already"),
            std::string::npos);
}
