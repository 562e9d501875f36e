#include <perimorph/parameters/features.h>

#include <gtest/gtest.h>

using namespace Perimorph;
using namespace Perimorph::Parameters;

namespace
{
  class Features : public testing::Test
  {
  protected:
    void
    expect_message(const std::string &text, const std::string &message)
    {
      EXPECT_TRUE(parse_features("P", text, 2, errors).empty());
      ASSERT_EQ(errors.size(), 1u);
      EXPECT_EQ(errors.messages()[0], "parameter 'P'\n  " + message);
    }

    Base::InputErrorCollector errors;
  };
} // namespace

TEST_F(Features, of_all_kinds)
{
  const auto list = parse_features("P",
                                   "hole; lower left; volume core; boundary "
                                   "box; point 1 2; segment 0 0 1 1; plane 0 0 "
                                   "1 0; box 0 0 1 2; ball (0, 0) 1.5;",
                                   2,
                                   errors);
  EXPECT_TRUE(errors.empty());
  ASSERT_EQ(list.size(), 9u);
  EXPECT_EQ(list[0].kind, FeatureKind::boundary);
  EXPECT_EQ(list[1].name, "lower left");
  EXPECT_EQ(list[2].kind, FeatureKind::volume);
  EXPECT_EQ(list[2].name, "core");
  EXPECT_EQ(list[3].kind, FeatureKind::boundary);
  EXPECT_EQ(list[3].name, "box");
  EXPECT_EQ(list[4].kind, FeatureKind::point);
  EXPECT_EQ(list[7].numbers, (std::vector<double>{0., 0., 1., 2.}));
  EXPECT_EQ(list[8].kind, FeatureKind::ball);
  EXPECT_EQ(list[8].numbers, (std::vector<double>{0., 0., 1.5}));
}

TEST_F(Features, in_three_dimensions)
{
  EXPECT_EQ(parse_features("P", "plane 0 0 0 0 0 1", 3, errors).size(), 1u);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(feature_word(FeatureKind::plane), "plane");
}

TEST_F(Features, with_wrong_count)
{
  expect_message("ball 0 0 0 1",
                 "found 'ball 0 0 0 1' with 4 numbers; allowed: ball cx cy "
                 "radius");
}

TEST_F(Features, without_numbers)
{
  expect_message("ball",
                 "found 'ball' with 0 numbers; allowed: ball cx cy radius. A "
                 "boundary of this name is written 'boundary ball'");
}

TEST_F(Features, with_a_slip_in_the_shape)
{
  expect_message("bal 0 0 1",
                 "found 'bal 0 0 1', where 'bal' is no shape; did you mean "
                 "'ball'? It has: point, segment, plane, triangle, box, ball");
}

TEST_F(Features, with_a_word_among_the_numbers)
{
  expect_message("point 0 a",
                 "found 'point 0 a', where 'a' is not a number; allowed: "
                 "point x y");
}

TEST_F(Features, that_are_degenerate)
{
  parse_features("P",
                 "ball 0 0 0; plane 1 1 0 0; segment 1 1 1 1; box 0 0 1 0",
                 2,
                 errors);
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_EQ(errors.messages()[0],
            "parameter 'P'\n  found 'ball 0 0 0'; allowed: a radius > 0");
}

TEST(ParseLength, reads_lengths_and_horizons)
{
  Base::InputErrorCollector errors;
  const Length              length = parse_length("P", "0.5", true, errors);
  EXPECT_EQ(length.value, 0.5);
  EXPECT_FALSE(length.in_horizons);
  const Length horizons = parse_length("P", "2  horizons", false, errors);
  EXPECT_EQ(horizons.value, 2.);
  EXPECT_TRUE(horizons.in_horizons);
  EXPECT_TRUE(parse_length("P", "1 horizon", false, errors).in_horizons);
  EXPECT_TRUE(parse_length("P", "automatic", true, errors).automatic);
  EXPECT_TRUE(errors.empty());
}

TEST(ParseLength, refuses_other_words)
{
  Base::InputErrorCollector errors;
  parse_length("P", "automatic", false, errors);
  parse_length("P", "-1", true, errors);
  parse_length("P", "2 spacings", true, errors);
  parse_length("P", "", true, errors);
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_EQ(errors.messages()[0],
            "parameter 'P'\n  found 'automatic'; allowed: a length >= 0, or a "
            "number of horizons like '2 horizons'");
  EXPECT_EQ(errors.messages()[3],
            "parameter 'P'\n  found nothing; allowed: a length >= 0, or a "
            "number of horizons like '2 horizons', or automatic");
}
