#include <perimorph/fracture/crack_tips.h>

#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Point2 = dealii::Point<2>;
  using Point3 = dealii::Point<3>;

  Bonds::CrackFacet<2>
  segment(const Point2      &begin,
          const Point2      &end,
          const unsigned int crack = 0,
          const unsigned int step  = 0)
  {
    Bonds::CrackFacet<2> facet;
    facet.corners = {{begin, end}};
    facet.crack   = crack;
    facet.step    = step;
    return facet;
  }

  Mesh::NodalMesh<2>
  square()
  {
    return Testing::unit_mesh<2>(10, 0.2);
  }

  TEST(CrackTips, both_ends_of_a_polyline_point_outwards)
  {
    const Bonds::CrackSet<2> cracks(
      {segment(Point2(0.3, 0.5), Point2(0.5, 0.5)),
       segment(Point2(0.5, 0.5), Point2(0.6, 0.6))});
    const auto tips = find_tips(square(), cracks);
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(tips[0].frame.origin, Point2(0.3, 0.5));
    EXPECT_NEAR(tips[0].frame.axes[0][0], -1., 1e-14);
    EXPECT_NEAR(tips[0].frame.axes[1][1], -1., 1e-14);
    EXPECT_EQ(tips[1].frame.origin, Point2(0.6, 0.6));
    EXPECT_NEAR(tips[1].frame.axes[0][0], std::sqrt(0.5), 1e-14);
    EXPECT_NEAR(tips[1].frame.axes[0][1], std::sqrt(0.5), 1e-14);
    EXPECT_EQ(tips[1].facet, 1u);
    for (const auto &tip : tips)
      EXPECT_NEAR(tip.crack_length, 0.5 * (0.2 + std::sqrt(0.02)), 1e-14);
    // the boundary, and the other end
    EXPECT_NEAR(tips[0].free_distance, 0.3, 1e-14);
    EXPECT_NEAR(tips[1].free_distance, std::sqrt(0.1), 1e-14);
    // up to the kink
    EXPECT_NEAR(tips[0].straight_distance, 0.2, 1e-14);
    EXPECT_NEAR(tips[1].straight_distance, std::sqrt(0.02), 1e-14);
    const std::vector<Point2> path = {Point2(0.6, 0.6),
                                      Point2(0.5, 0.5),
                                      Point2(0.3, 0.5)};
    EXPECT_EQ(tips[1].path, path);
  }

  TEST(CrackTips, path_ends_where_the_crack_comes_back)
  {
    // away from the tip, then back past it
    const Bonds::CrackSet<2> hook(
      {segment(Point2(0.5, 0.5), Point2(0.3, 0.5)),
       segment(Point2(0.3, 0.5), Point2(0.3, 0.6)),
       segment(Point2(0.3, 0.6), Point2(0.6, 0.6))});
    const auto                tips = find_tips(square(), hook);
    const auto               &tip  = tips[0];
    const std::vector<Point2> path = {Point2(0.5, 0.5),
                                      Point2(0.3, 0.5),
                                      Point2(0.3, 0.6)};
    EXPECT_EQ(tip.frame.origin, Point2(0.5, 0.5));
    EXPECT_EQ(tip.path, path);
    EXPECT_NEAR(tip.free_distance, 0.1, 1e-14);
  }

  TEST(CrackTips, ends_at_or_beyond_the_boundary_or_on_a_crack_are_none)
  {
    const Bonds::CrackSet<2> cracks(
      {segment(Point2(0., 0.52), Point2(0.4, 0.52), 0),   // edge crack
       segment(Point2(1.2, 0.3), Point2(0.7, 0.3), 1),    // sticks out
       segment(Point2(0.2, 0.52), Point2(0.2, 0.8), 2)}); // T
    const auto tips = find_tips(square(), cracks);
    ASSERT_EQ(tips.size(), 3u);
    EXPECT_EQ(tips[0].frame.origin, Point2(0.4, 0.52));
    EXPECT_NEAR(tips[0].crack_length, 0.4, 1e-14);
    EXPECT_NEAR(tips[0].free_distance, 0.2, 1e-14); // the branch
    EXPECT_EQ(tips[1].frame.origin, Point2(0.7, 0.3));
    EXPECT_NEAR(tips[1].free_distance, 0.3, 1e-14); // the boundaries
    EXPECT_EQ(tips[2].frame.origin, Point2(0.2, 0.8));
    EXPECT_EQ(tips[2].crack, 2u);
  }

  // An advance of the first tip appends a facet behind that of the second.
  TEST(CrackTips, advances_do_not_change_the_order)
  {
    std::vector<Bonds::CrackFacet<2>> facets = {
      segment(Point2(0.4, 0.5), Point2(0.6, 0.5))};
    facets.push_back(segment(Point2(0.4, 0.5), Point2(0.35, 0.5), 0, 1));
    facets.push_back(segment(Point2(0.35, 0.5), Point2(0.3, 0.501), 0, 2));
    const auto tips = find_tips(square(), Bonds::CrackSet<2>(facets));
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(tips[0].frame.origin, Point2(0.3, 0.501));
    EXPECT_EQ(tips[0].facet, 2u);
    EXPECT_EQ(tips[1].frame.origin, Point2(0.6, 0.5));
    EXPECT_EQ(tips[0].root, (std::array<unsigned int, 2>{{0, 0}}));
    EXPECT_EQ(tips[1].root, (std::array<unsigned int, 2>{{0, 1}}));
    // small turns count as straight
    EXPECT_NEAR(tips[0].straight_distance, 0.3, 1e-14);
  }

  /// Fan of triangles around a center, corners beyond the mesh allowed.
  std::vector<Bonds::CrackFacet<3>>
  fan(const Point3 &center, const std::vector<Point3> &corners)
  {
    std::vector<Bonds::CrackFacet<3>> facets(corners.size());
    for (unsigned int k = 0; k < corners.size(); ++k)
      facets[k].corners = {
        {center, corners[k], corners[(k + 1) % corners.size()]}};
    return facets;
  }

  TEST(CrackTips, closed_front_of_a_penny_crack)
  {
    const unsigned int  n  = 24;
    const double        pi = std::acos(-1.);
    const Point3        center(0.5, 0.5, 0.45);
    std::vector<Point3> corners;
    for (unsigned int k = 0; k < n; ++k)
      corners.emplace_back(0.5 + 0.3 * std::cos(2. * pi * k / n),
                           0.5 + 0.3 * std::sin(2. * pi * k / n),
                           0.45);
    const auto fronts = find_fronts(Testing::unit_mesh<3>(5),
                                    Bonds::CrackSet<3>(fan(center, corners)));
    ASSERT_EQ(fronts.size(), 1u);
    const auto &front = fronts[0];
    EXPECT_TRUE(front.closed);
    EXPECT_EQ(front.vertices.size(), n);
    EXPECT_NEAR(front.length(), 2. * n * 0.3 * std::sin(pi / n), 1e-12);
    // measured from the middles of the edges
    EXPECT_NEAR(front.free_distance,
                0.5 - 0.3 * std::pow(std::cos(pi / n), 2),
                1e-9);
    for (const double s : front.stations(7))
      {
        const auto place  = front.at(s);
        const auto radial = place.frame.origin - center;
        EXPECT_GT(place.frame.axes[0] * radial, 0.9999 * radial.norm());
        EXPECT_NEAR(place.frame.axes[1][2], 1., 1e-14);
        EXPECT_NEAR(
          (cross_product_3d(place.frame.axes[0], place.frame.axes[1]) -
           place.frame.axes[2])
            .norm(),
          0.,
          1e-14);
        EXPECT_NEAR(place.frame.curvature, 1. / 0.3, 0.01 / 0.3);
        EXPECT_NEAR(front.nearest(place.frame.origin).arc_length, s, 1e-9);
      }
  }

  TEST(CrackTips, open_front_of_a_crack_from_a_surface)
  {
    // x from outside to 0.4, z through the whole body
    const auto fronts =
      find_fronts(Testing::unit_mesh<3>(5),
                  Bonds::CrackSet<3>(fan(Point3(0.1, 0.5, 0.5),
                                         {Point3(-0.1, 0.5, -0.1),
                                          Point3(-0.1, 0.5, 1.1),
                                          Point3(0.4, 0.5, 1.1),
                                          Point3(0.4, 0.5, -0.1)})));
    ASSERT_EQ(fronts.size(), 1u);
    EXPECT_FALSE(fronts[0].closed);
    EXPECT_EQ(fronts[0].vertices.size(), 2u);
    const auto place = fronts[0].at(0.6);
    EXPECT_NEAR(place.frame.axes[0][0], 1., 1e-14);
    EXPECT_EQ(place.frame.curvature, 0.);
    EXPECT_NEAR(place.frame.origin[0], 0.4, 1e-14);
  }
} // namespace
