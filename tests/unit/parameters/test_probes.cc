#include <perimorph/parameters/lists.h>
#include <perimorph/parameters/probes.h>

#include <gtest/gtest.h>

using namespace Perimorph;
using namespace Perimorph::Parameters;

namespace
{
  class Probes : public testing::Test
  {
  protected:
    void
    expect_message(const std::string &message)
    {
      ASSERT_EQ(errors.size(), 1u);
      EXPECT_EQ(errors.messages()[0], "parameter 'P'\n  " + message);
    }

    Base::InputErrorCollector errors;
  };
} // namespace

TEST_F(Probes, point_with_component)
{
  const auto list = parse_probe_points("P",
                                       "tip: 4 0, y; foot: 0, -1.5, x",
                                       2,
                                       displacement_components(2),
                                       errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name, "tip");
  EXPECT_EQ(list[0].point, (std::vector<double>{4., 0.}));
  EXPECT_EQ(list[0].component, "y");
  EXPECT_EQ(list[1].point, (std::vector<double>{0., -1.5}));
}

TEST_F(Probes, point_without_component)
{
  const auto list = parse_probe_points("P", "corner: 25 25", 2, {}, errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].component, "");
}

TEST_F(Probes, stress_component_missing)
{
  parse_probe_points("P", "mid: 1 0 0", 3, stress_components(3), errors);
  expect_message("found 'mid: 1 0 0' without a component at its end; "
                 "allowed: NAME: x y z, COMPONENT with COMPONENT among xx, "
                 "yy, zz, xy, xz, yz");
}

TEST_F(Probes, point_of_wrong_dimension)
{
  parse_probe_points("P", "corner: 25", 2, {}, errors);
  expect_message("found '25' in 'corner: 25' with 1 number; allowed: x y (2 "
                 "numbers)");
}

TEST_F(Probes, name_that_is_no_word)
{
  parse_probe_points("P", "my tip: 4 0", 2, {}, errors);
  expect_message("found name 'my tip' in 'my tip: 4 0'; allowed: letters, "
                 "digits and '_', a letter first. The name becomes the name "
                 "of a result");
}

TEST_F(Probes, name_missing_or_twice)
{
  parse_probe_points("P", "4 0; a: 1 1; a: 2 2", 2, {}, errors);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors.messages()[0],
            "parameter 'P'\n  found '4 0' without a name; allowed: NAME: x "
            "y. Entries are separated by ';'");
  EXPECT_EQ(errors.messages()[1],
            "parameter 'P'\n  found 'a' twice; allowed: each name once");
}

TEST_F(Probes, line)
{
  const auto list =
    parse_probe_lines("P", "equator: 2.5 0 to 25 0, 101 points", 2, errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].from, (std::vector<double>{2.5, 0.}));
  EXPECT_EQ(list[0].to, (std::vector<double>{25., 0.}));
  EXPECT_EQ(list[0].n_points, 101u);
}

TEST_F(Probes, line_without_number_of_points)
{
  parse_probe_lines("P", "a: 0 0 to 1 0", 2, errors);
  expect_message("found 'a' without 'points'; allowed: NAME: x y to x y, N "
                 "points");
}

TEST_F(Probes, line_with_one_point)
{
  parse_probe_lines("P", "a: 0 0 to 1 0, 1 points", 2, errors);
  expect_message("found the number of points of 'a'; allowed: a whole number "
                 ">= 2");
}

TEST_F(Probes, line_with_numbers_behind_points)
{
  parse_probe_lines("P", "a: 0 0 to 1 0, 11 points 5", 2, errors);
  expect_message("found 2 numbers for 'points' in 'a: 0 0 to 1 0, 11 points "
                 "5'; allowed: NAME: x y to x y, N points");
}

TEST_F(Probes, line_of_wrong_dimension)
{
  parse_probe_lines("P", "a: 0 0 to 1 0 0, 11 points", 2, errors);
  expect_message("found 3 numbers for 'to' in 'a: 0 0 to 1 0 0, 11 points'; "
                 "allowed: NAME: x y to x y, N points");
}

TEST_F(Probes, circle)
{
  const auto list = parse_probe_circles(
    "P",
    "ring: center 0 1, radius 3.5, from 0 to 90, 91 points; "
    "full: radius 1, center (0, 0), 5 points",
    2,
    errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].center, (std::vector<double>{0., 1.}));
  EXPECT_EQ(list[0].radius, 3.5);
  EXPECT_EQ(list[0].to_degrees, 90.);
  EXPECT_EQ(list[0].n_points, 91u);
  EXPECT_EQ(list[1].to_degrees, 360.);
}

TEST_F(Probes, circle_with_a_slip)
{
  parse_probe_circles("P", "a: centre 0 0, radius 1, 5 points", 2, errors);
  expect_message("found 'centre' in 'a: centre 0 0, radius 1, 5 points'; "
                 "allowed: NAME: center x y, radius R, from DEGREES to "
                 "DEGREES, N points. Did you mean 'center'?");
}

TEST_F(Probes, circle_without_size)
{
  parse_probe_circles("P", "a: center 0 0, radius 0, 5 points", 2, errors);
  expect_message("found the radius of 'a'; allowed: a number > 0");
}

TEST_F(Probes, empty_entry)
{
  parse_probe_circles("P", "a:", 2, errors);
  EXPECT_EQ(errors.size(), 1u);
  EXPECT_TRUE(parse_probe_lines("P", "", 2, errors).empty());
  EXPECT_EQ(errors.size(), 1u);
}

TEST_F(Probes, nominal_stress)
{
  EXPECT_EQ(parse_nominal_stress("P", "10", errors).value, 10.);
  const auto nominal = parse_nominal_stress("P", "reaction of top", errors);
  EXPECT_FALSE(nominal.value);
  EXPECT_EQ(nominal.reaction_of, "top");
  EXPECT_FALSE(parse_nominal_stress("P", "", errors).value);
  EXPECT_TRUE(errors.empty());
  parse_nominal_stress("P", "0", errors);
  expect_message("found '0'; allowed: a number other than 0, or 'reaction of "
                 "NAME'");
}
