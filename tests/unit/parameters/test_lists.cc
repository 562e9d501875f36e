#include <perimorph/parameters/lists.h>

#include <gtest/gtest.h>

using namespace Perimorph;
using namespace Perimorph::Parameters;

namespace
{
  class Lists : public testing::Test
  {
  protected:
    void
    expect_message(const std::string &message)
    {
      ASSERT_EQ(errors.size(), 1u);
      EXPECT_EQ(errors.messages()[0], "parameter 'P'\n  " + message);
    }

    std::vector<NamedComponents>
    components(const std::string &text, const NameRule rule)
    {
      return parse_named_components("P",
                                    text,
                                    displacement_components(2),
                                    rule,
                                    errors);
    }

    Base::InputErrorCollector errors;
  };
} // namespace

TEST_F(Lists, named_components)
{
  const auto list = components("top: x = 0, y = if(t == 0, 1, 2*t);\n"
                               " lower  left: y = x > 0 ? 1 : 0;",
                               NameRule::required);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "top");
  ASSERT_EQ(list[0].components.size(), 2u);
  EXPECT_EQ(list[0].components[1].first, "y");
  EXPECT_EQ(list[0].components[1].second, "if(t == 0, 1, 2*t)");
  EXPECT_EQ(list[1].name, "lower left");
  EXPECT_EQ(list[1].components[0].second, "x > 0 ? 1 : 0");
}

TEST_F(Lists, empty_text_has_no_entries)
{
  EXPECT_TRUE(components("  ", NameRule::required).empty());
  EXPECT_TRUE(errors.empty());
}

TEST_F(Lists, body_force_with_and_without_volume)
{
  const auto list = components("y = t > 0 ? 1 : 2; volume core: x = 1",
                               NameRule::optional_volume);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "");
  EXPECT_EQ(list[0].components[0].second, "t > 0 ? 1 : 2");
  EXPECT_EQ(list[1].name, "core");
}

TEST_F(Lists, by_volume_entries_with_blanks_in_the_component)
{
  const auto list = parse_named_components(
    "P",
    "inclusion: Young's modulus = 10, Poisson's ratio = 0.2",
    {"Young's modulus", "Poisson's ratio"},
    NameRule::required,
    errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].components[0].first, "Young's modulus");
}

TEST_F(Lists, body_force_needs_the_word_volume)
{
  components("core: x = 1", NameRule::optional_volume);
  expect_message("found 'core: x = 1'; allowed: 'volume NAME: component = "
                 "expression', or no name for the whole body. Did you mean "
                 "'volume core: ...'?");
}

TEST_F(Lists, missing_name)
{
  components("x = 0", NameRule::required);
  expect_message("found 'x = 0' without a name; allowed: NAME: component = "
                 "expression, .... Entries are separated by ';'");
}

TEST_F(Lists, name_where_there_is_none)
{
  components("top: x = 0", NameRule::none);
  expect_message("found 'top: x = 0' with the name 'top'; allowed: component "
                 "= expression, ...");
}

TEST_F(Lists, component_of_three_dimensions_in_two)
{
  components("top: z = 0", NameRule::required);
  EXPECT_NE(errors.messages().at(0).find(
              "found component 'z' in 'top: z = 0'; allowed: x, y"),
            std::string::npos);
}

TEST_F(Lists, component_with_a_slip)
{
  parse_named_components("P",
                         "core: Youngs modulus = 1",
                         {"Young's modulus"},
                         NameRule::required,
                         errors);
  expect_message("found component 'Youngs modulus' in 'core: Youngs modulus = "
                 "1'; allowed: Young's modulus. Did you mean 'Young's "
                 "modulus'?");
}

TEST_F(Lists, component_without_value)
{
  components("top: x =", NameRule::required);
  expect_message("found nothing behind 'x =' in 'top: x ='; allowed: "
                 "component = expression, separated by ','");
}

TEST_F(Lists, component_twice)
{
  components("top: x = 0; top: x = 1", NameRule::required);
  expect_message("found component 'x' of 'top' twice; allowed: each component "
                 "once");
}

TEST_F(Lists, missing_equals_sign)
{
  components("top: x 0", NameRule::required);
  expect_message("found 'x 0' without '=' in 'top: x 0'; allowed: component "
                 "= expression, separated by ','");
}

TEST_F(Lists, unbalanced_parentheses)
{
  components("top: x = (1", NameRule::required);
  expect_message("found 'top: x = (1'; allowed: as many ')' as '(', in pairs");
}

TEST_F(Lists, named_values)
{
  const auto list = parse_named_values("P", "hole: 5*t; top: -1", errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "hole");
  EXPECT_EQ(list[0].expression, "5*t");
}

TEST_F(Lists, named_value_without_name)
{
  parse_named_values("P", "5", errors);
  expect_message("found '5'; allowed: NAME: value; NAME: value; ...");
}

TEST_F(Lists, names)
{
  EXPECT_EQ(parse_names("P", "left,  bottom", errors),
            (std::vector<std::string>{"left", "bottom"}));
  EXPECT_TRUE(errors.empty());
  parse_names("P", "left, left", errors);
  expect_message("found 'left' twice; allowed: each name once");
}

TEST_F(Lists, names_with_a_gap)
{
  parse_names("P", "left,, bottom", errors);
  expect_message("found an empty name in 'left,, bottom'; allowed: names "
                 "separated by ','");
}

TEST_F(Lists, point_entries)
{
  const auto list = parse_point_entries("P",
                                        "0 0: x = 0, y = 0; (1, -2.5): y = 0",
                                        2,
                                        displacement_components(2),
                                        errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1].coordinates, (std::vector<double>{1., -2.5}));
  EXPECT_EQ(list[0].components.size(), 2u);
}

TEST_F(Lists, point_with_wrong_count)
{
  parse_point_entries("P", "0 0: x = 0", 3, displacement_components(3), errors);
  expect_message("found '0 0' in '0 0: x = 0' with 2 numbers; allowed: x y z "
                 "(3 numbers)");
}

TEST_F(Lists, point_with_a_word)
{
  parse_point_entries("P",
                      "0 tip: x = 0",
                      2,
                      displacement_components(2),
                      errors);
  expect_message("found '0 tip' in '0 tip: x = 0', where 'tip' is not a "
                 "number; allowed: x y (numbers)");
}

TEST_F(Lists, named_numbers)
{
  const auto list = parse_named_numbers("P", "nr = 24, h = 1e-3", errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].first, "nr");
  EXPECT_EQ(list[1].second, 1e-3);
}

TEST_F(Lists, named_number_with_a_word)
{
  parse_named_numbers("P", "nr = many", errors);
  expect_message("found 'many' for 'nr'; allowed: a number");
}
