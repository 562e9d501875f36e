#include <perimorph/bonds/broken_bonds.h>

#include <gtest/gtest.h>

namespace Perimorph::Bonds
{
  TEST(BrokenBonds, are_without_direction)
  {
    BrokenBonds broken;
    EXPECT_TRUE(broken.empty());
    EXPECT_TRUE(broken.add(7, 3, 1));
    EXPECT_TRUE(broken.contains(3, 7));
    EXPECT_TRUE(broken.contains(7, 3));
    EXPECT_FALSE(broken.contains(3, 8));
    EXPECT_EQ(broken.list()[0].nodes[0], 3u);
    EXPECT_EQ(broken.list()[0].nodes[1], 7u);
  }

  TEST(BrokenBonds, break_once)
  {
    BrokenBonds broken;
    broken.add(7, 3, 1);
    broken.add(3, 5, 2);
    EXPECT_FALSE(broken.add(3, 7, 3));
    EXPECT_EQ(broken.size(), 2u);
    EXPECT_EQ(broken.list()[0].event, 1u);
    EXPECT_EQ(broken.count(3), 2u);
    EXPECT_EQ(broken.count(7), 1u);
    EXPECT_EQ(broken.count(4), 0u);
  }

  TEST(BrokenBonds, lose_teeth_before_they_break)
  {
    BrokenBonds broken(3);
    EXPECT_EQ(broken.share_left(3, 7), 1.);
    EXPECT_TRUE(broken.add(7, 3, 1));
    EXPECT_TRUE(broken.add(3, 7, 2));
    EXPECT_FALSE(broken.contains(3, 7));
    EXPECT_EQ(broken.teeth_lost(7, 3), 2u);
    EXPECT_NEAR(broken.share_left(3, 7), 1. / 3., 1e-15);
    EXPECT_EQ(broken.size(), 0u);
    EXPECT_FALSE(broken.empty());
    EXPECT_TRUE(broken.add(3, 7, 4));
    EXPECT_TRUE(broken.contains(3, 7));
    EXPECT_EQ(broken.size(), 1u);
    EXPECT_EQ(broken.count(7), 1u);
    EXPECT_FALSE(broken.add(3, 7, 5));
    EXPECT_EQ(broken.share_left(3, 7), 0.);
  }
} // namespace Perimorph::Bonds
