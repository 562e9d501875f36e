#include <perimorph/base/name_help.h>

#include <gtest/gtest.h>

using namespace Perimorph::Base;

namespace
{
  const std::vector<std::string> groups = {"hole", "crack", "right", "left"};
}

TEST(NearestName, finds_slips_of_the_keyboard)
{
  EXPECT_EQ(nearest_name("crak", groups), "crack");
  EXPECT_EQ(nearest_name("rihgt", groups), "right");
  EXPECT_EQ(nearest_name("leftt", groups), "left");
}

TEST(NearestName, ignores_upper_and_lower_case)
{
  EXPECT_EQ(nearest_name("HOLE", groups), "hole");
  EXPECT_EQ(nearest_name("hole", {"Hole"}), "Hole");
}

TEST(NearestName, prefers_the_smallest_distance)
{
  EXPECT_EQ(nearest_name("tops", {"stop", "top", "tap"}), "top");
}

TEST(NearestName, is_silent_when_nothing_is_close)
{
  EXPECT_FALSE(nearest_name("inclusion", groups));
  EXPECT_FALSE(nearest_name("hole", {}));
  EXPECT_FALSE(nearest_name("a", {"b", "c"}));
  EXPECT_FALSE(nearest_name("", {"x", "y"}));
}

TEST(JoinNames, separates_by_commas)
{
  EXPECT_EQ(join_names(groups), "hole, crack, right, left");
  EXPECT_EQ(join_names({}), "none");
}

TEST(DidYouMean, gives_the_nearest_name_and_the_list)
{
  EXPECT_EQ(did_you_mean("crak", groups),
            "; did you mean 'crack'? It has: hole, crack, right, left");
  EXPECT_EQ(did_you_mean("inclusion", groups),
            "; it has: hole, crack, right, left");
}
