#include <perimorph/bonds/crack_set.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace Perimorph::Bonds
{
  namespace
  {
    using Point2 = dealii::Point<2>;
    using Point3 = dealii::Point<3>;

    CrackSet<2>
    polyline(const std::vector<Point2> &points)
    {
      std::vector<CrackFacet<2>> facets;
      for (unsigned int k = 0; k + 1 < points.size(); ++k)
        facets.push_back({{{points[k], points[k + 1]}}, 0, 0});
      return CrackSet<2>(facets);
    }
  } // namespace

  TEST(CrackSet, cuts_what_crosses_and_nothing_else)
  {
    const auto crack = polyline({Point2(0., 0.5), Point2(0.5, 0.5)});
    EXPECT_TRUE(crack.crosses(Point2(0.2, 0.4), Point2(0.3, 0.6)));
    EXPECT_FALSE(crack.crosses(Point2(0.6, 0.4), Point2(0.6, 0.6)));
    EXPECT_FALSE(crack.crosses(Point2(0.2, 0.4), Point2(0.4, 0.4)));
    EXPECT_FALSE(CrackSet<2>().crosses(Point2(0., 0.), Point2(1., 1.)));
    EXPECT_NEAR(crack.distance(Point2(0.8, 0.9)), 0.5, 1e-15);
  }

  TEST(CrackSet, crack_through_a_row_of_nodes_puts_each_node_on_one_side)
  {
    // Nodes on the crack keep their bonds to one side and lose all to the
    // other, whatever the order of the ends; bonds along it stay.
    const auto   crack = polyline({Point2(-1., 0.3), Point2(1., 0.3)});
    const Point2 node(0.1, 0.3);
    for (const double x : {-0.2, 0.1, 0.37})
      {
        const Point2 above(x, 0.4), below(x, 0.2);
        EXPECT_NE(crack.crosses(node, above), crack.crosses(node, below));
        EXPECT_EQ(crack.crosses(node, above), crack.crosses(above, node));
        EXPECT_EQ(crack.crosses(node, above),
                  crack.crosses(node, Point2(0.1, 0.4)));
        EXPECT_TRUE(crack.crosses(above, below));
      }
    EXPECT_FALSE(crack.crosses(node, Point2(0.2, 0.3)));
  }

  TEST(CrackSet, bonds_through_a_joint_are_cut_once_and_for_all)
  {
    // A bond exactly through the joint of two segments, straight or kinked.
    for (const double kink : {0., 0.25, -0.125})
      {
        const auto crack =
          polyline({Point2(-1., kink), Point2(0.5, 0.75), Point2(2., kink)});
        for (const double dx : {0., 0.0625, 0.25, -0.5})
          EXPECT_TRUE(
            crack.crosses(Point2(0.5 - dx, 3.75), Point2(0.5 + dx, -2.25)));
      }
  }

  TEST(CrackSet, nearly_degenerate_positions_are_consistent)
  {
    // Points within round-off of the line: sides from exact arithmetic never
    // contradict each other (a point is on the same side for both its bonds).
    const auto crack =
      polyline({Point2(-10., -10. / 3.), Point2(20., 20. / 3.)});
    const Point2 above(1., 5.), below(5., -1.);
    std::mt19937 engine(3);
    for (int k = 0; k < 2000; ++k)
      {
        const double x = engine() / 4294967296. * 5.;
        double       y = x / 3.;
        for (unsigned int ulp = engine() % 4; ulp > 0; --ulp)
          y = std::nextafter(y, (engine() & 1u) ? 10. : -10.);
        const Point2 node(x, y);
        EXPECT_NE(crack.crosses(node, above), crack.crosses(node, below));
      }
  }

  TEST(CrackSet, triangles)
  {
    // A square of two triangles in the plane z = 0.25; bonds through the
    // diagonal and along the plane.
    const std::array<Point3, 4> c = {{Point3(0., 0., 0.25),
                                      Point3(1., 0., 0.25),
                                      Point3(1., 1., 0.25),
                                      Point3(0., 1., 0.25)}};
    const CrackSet<3>           crack(
      {{{{c[0], c[1], c[2]}}, 0, 0}, {{{c[0], c[2], c[3]}}, 0, 0}});
    EXPECT_TRUE(crack.crosses(Point3(0.5, 0.5, 0.), Point3(0.5, 0.5, 1.)));
    EXPECT_TRUE(crack.crosses(Point3(0.2, 0.7, 0.), Point3(0.3, 0.6, 0.5)));
    EXPECT_FALSE(crack.crosses(Point3(1.5, 0.5, 0.), Point3(1.5, 0.5, 1.)));
    EXPECT_FALSE(crack.crosses(Point3(0.1, 0.5, 0.25), Point3(0.7, 0.5, 0.25)));
    const Point3 node(0.25, 0.5, 0.25);
    EXPECT_NE(crack.crosses(node, Point3(0.3, 0.5, 0.)),
              crack.crosses(node, Point3(0.3, 0.5, 1.)));
    EXPECT_NEAR(crack.distance(Point3(2., 0.5, 1.25)), std::sqrt(2.), 1e-15);
    EXPECT_NEAR(crack.facets()[0].measure(), 0.5, 1e-15);
  }
} // namespace Perimorph::Bonds
