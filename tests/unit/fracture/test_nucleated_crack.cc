#include <perimorph/fracture/nucleated_crack.h>

#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Fracture
{
  namespace
  {
    using Point = dealii::Point<2>;

    constexpr double h = .02, horizon = .04;

    /// Middles of bonds along a line: every quarter of the spacing, in turn on
    /// it and up to half a spacing to both sides.
    std::vector<BrokenPlace>
    band(const std::vector<Point> &corners)
    {
      const double             sides[] = {0., .5, -.5, .2, -.3};
      std::vector<BrokenPlace> places;
      unsigned int             number = 0;
      for (std::size_t k = 1; k < corners.size(); ++k)
        {
          const auto   along  = corners[k] - corners[k - 1];
          const double length = along.norm();
          const int    n      = std::lround(length / (.25 * h));
          for (int i = 0; i <= n; ++i)
            {
              const double side = sides[number++ % 5] * h / length;
              places.push_back({corners[k - 1] + double(i) / n * along +
                                  Point(-side * along[1], side * along[0]),
                                horizon});
            }
        }
      return places;
    }

    double
    distance_to(const std::vector<Point> &line, const Point &point)
    {
      double smallest = 1e300;
      for (std::size_t k = 1; k < line.size(); ++k)
        {
          const auto   along = line[k] - line[k - 1];
          const double s =
            std::clamp((point - line[k - 1]) * along / along.norm_square(),
                       0.,
                       1.);
          smallest =
            std::min(smallest, point.distance(line[k - 1] + s * along));
        }
      return smallest;
    }

    /// The line in one direction: the end with the smaller x first.
    std::vector<Point>
    from_left(std::vector<Point> line)
    {
      if (line.back()[0] < line.front()[0])
        std::reverse(line.begin(), line.end());
      return line;
    }
  } // namespace

  TEST(NucleatedCrack, groups_do_not_depend_on_the_order)
  {
    auto       places = band({{.1, .1}, {.3, .1}});
    const auto second = band({{.1, .2}, {.2, .3}});
    places.insert(places.end(), second.begin(), second.end());
    const auto groups = group_places(places);
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].size() + groups[1].size(), places.size());
    std::reverse(places.begin(), places.end());
    const auto again = group_places(places);
    ASSERT_EQ(again.size(), 2u);
    for (unsigned int g = 0; g < 2; ++g)
      {
        const auto line = line_through(groups[g]);
        EXPECT_EQ(line, line_through(again[g]));
      }
  }

  TEST(NucleatedCrack, straight_and_inclined_bands)
  {
    for (const double angle : {0., .3, 1.2, 2.})
      {
        const Point a(.5, .5);
        const Point b    = a + .3 * Point(std::cos(angle), std::sin(angle));
        const auto  line = line_through(group_places(band({a, b}))[0]);
        ASSERT_EQ(line.size(), 9u); // .3 over .04, rounded, and one
        for (const auto &point : line)
          EXPECT_LT(distance_to({a, b}, point), .25 * h) << angle;
        EXPECT_NEAR(length_of_line(line), .3, .5 * h) << angle;
        const double first = std::min(line.front().distance(a),
                                      line.back().distance(a)),
                     last  = std::min(line.front().distance(b),
                                     line.back().distance(b));
        EXPECT_LT(std::max(first, last), .5 * h) << angle;
      }
  }

  TEST(NucleatedCrack, band_that_bends)
  {
    const std::vector<Point> corners = {{.2, .2}, {.5, .2}, {.7, .35}};
    const auto line = from_left(line_through(group_places(band(corners))[0]));
    for (const auto &point : line)
      EXPECT_LT(distance_to(corners, point), .5 * h);
    // The corner is cut by no more than the smoothing.
    EXPECT_LT(distance_to(line, corners[1]), .5 * horizon);
    EXPECT_LT(line.front().distance(corners[0]), .5 * h);
    EXPECT_LT(line.back().distance(corners[2]), .5 * h);
  }

  TEST(NucleatedCrack, side_branch_does_not_count)
  {
    auto       places = band({{.2, .5}, {.6, .5}});
    const auto branch = band({{.4, .5}, {.45, .55}});
    places.insert(places.end(), branch.begin(), branch.end());
    const auto line = from_left(line_through(group_places(places)[0]));
    EXPECT_LT(line.front().distance({.2, .5}), .5 * h);
    EXPECT_LT(line.back().distance({.6, .5}), .5 * h);
    for (const auto &point : line)
      EXPECT_LT(std::abs(point[1] - .5), horizon);
  }

  TEST(NucleatedCrack, one_place_has_no_line)
  {
    EXPECT_TRUE(
      line_through({{{.5, .5}, horizon}, {{.5, .5}, horizon}}).empty());
  }

  TEST(NucleatedCrack, ends_move_along_the_line)
  {
    const std::vector<Point> line = {{0., 0.}, {1., 0.}, {1., 1.}};
    EXPECT_EQ(with_end_moved(line, .5).back(), Point(1., 1.5));
    EXPECT_EQ(with_end_moved(line, -.25).back(), Point(1., .75));
    const auto shorter = with_end_moved(line, -1.5);
    ASSERT_EQ(shorter.size(), 2u);
    EXPECT_NEAR(shorter.back().distance({.5, 0.}), 0., 1e-15);
    // Something is left.
    EXPECT_NEAR(length_of_line(with_end_moved(line, -5.)), .1, 1e-14);
    NucleatedCrack crack{line, {{true, true}}, horizon, {}};
    EXPECT_NEAR(length_of_line(with_tips_moved(crack, .5)), 3., 1e-15);
    EXPECT_EQ(with_tips_moved(crack, .5).front(), Point(-.5, 0.));
    crack.is_free[0] = false;
    EXPECT_EQ(with_tips_moved(crack, -.25).front(), line.front());
    EXPECT_EQ(with_tips_moved(crack, -.25).back(), Point(1., .75));
  }

  TEST(NucleatedCrack, moves_that_keep_the_energy)
  {
    const auto best = [](const auto &energy) {
      double found = 1e300, move = 0.;
      EXPECT_LE(try_moves(
                  [&](const double x) {
                    const double value = energy(x);
                    if (std::abs(value) < std::abs(found))
                      {
                        found = value;
                        move  = x;
                      }
                    return value;
                  },
                  1e-4),
                8u);
      return std::make_pair(move, found);
    };
    for (const double root : {-1.3, -.2, 0., .7})
      {
        const auto [move, value] =
          best([&](const double x) { return .1 * (std::exp(root - x) - 1.); });
        EXPECT_LT(std::abs(value), 1e-4) << root;
        EXPECT_NEAR(move, root, 2e-3);
      }
    // Columns of bonds: the nearer one of two steps.
    const auto steps = [](const double x) {
      return -.03 * std::floor(4. * x) - .04;
    };
    EXPECT_NEAR(best(steps).second, -.01, 1e-14);
    // No zero in reach: the end of it.
    EXPECT_EQ(best([](const double x) { return -x - 2.; }).first, -1.5);
  }

  TEST(NucleatedCrack, both_ends_inside_of_the_body)
  {
    const auto mesh = Testing::unit_mesh<2>(50);
    const auto found =
      find_nucleated_cracks(mesh, {}, band({{.3, .4}, {.6, .5}}));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].is_free[0] && found[0].is_free[1]);
    EXPECT_FALSE(found[0].crack);
    EXPECT_NEAR(found[0].horizon, horizon, 1e-15);
  }

  TEST(NucleatedCrack, continues_a_crack_from_its_tip)
  {
    const auto               mesh = Testing::unit_mesh<2>(50);
    const Bonds::CrackSet<2> cracks(
      {{{{Point(-.1, .3), Point(.2, .3)}}, 0, 0},
       {{{Point(.9, .9), Point(.5, .41)}}, 1, 0}});
    // Begins a horizon ahead of the tip, in either direction.
    for (const bool reverse : {false, true})
      {
        std::vector<Point> corners = {{.52, .4}, {.75, .3}};
        if (reverse)
          std::reverse(corners.begin(), corners.end());
        const auto found = find_nucleated_cracks(mesh, cracks, band(corners));
        ASSERT_EQ(found.size(), 1u);
        ASSERT_TRUE(found[0].crack);
        EXPECT_EQ(*found[0].crack, 1u);
        EXPECT_EQ(found[0].line.front(), Point(.5, .41));
        EXPECT_LT(found[0].line.back().distance({.75, .3}), .5 * h);
        EXPECT_FALSE(found[0].is_free[0]);
        EXPECT_TRUE(found[0].is_free[1]);
      }
  }

  TEST(NucleatedCrack, starts_at_the_surface)
  {
    const auto mesh = Testing::unit_mesh<2>(50);
    const auto found =
      find_nucleated_cracks(mesh, {}, band({{.98, .5}, {.7, .6}}));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_FALSE(found[0].is_free[0]);
    EXPECT_TRUE(found[0].is_free[1]);
    EXPECT_NEAR(found[0].line.front()[0], 1., 1e-14);
    // On along the line, not straight to the side.
    EXPECT_NEAR(found[0].line.front()[1], .5 - .02 * .1 / .28, .25 * h);
    EXPECT_LT(found[0].line.back().distance({.7, .6}), .5 * h);
    EXPECT_FALSE(found[0].crack);
  }

  TEST(NucleatedCrack, bonds_along_the_surface_are_no_crack)
  {
    const auto mesh   = Testing::unit_mesh<2>(50);
    auto       places = band({{.99, .3}, {.99, .7}});
    EXPECT_TRUE(find_nucleated_cracks(mesh, {}, places).empty());
    const auto crack = band({{.98, .5}, {.7, .5}});
    places.insert(places.end(), crack.begin(), crack.end());
    const auto found = find_nucleated_cracks(mesh, {}, places);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_FALSE(found[0].is_free[0]);
    EXPECT_LT(found[0].line.front().distance({1., .5}), .5 * h);
    for (const auto &point : found[0].line)
      EXPECT_NEAR(point[1], .5, .5 * h);
  }

  TEST(NucleatedCrack, small_group_takes_a_tip_with_one_end_only)
  {
    const auto               mesh = Testing::unit_mesh<2>(50);
    const Bonds::CrackSet<2> cracks(std::vector<Bonds::CrackFacet<2>>{
      {{{Point(-.1, .5), Point(.5, .5)}}, 0, 0}});
    const auto               found =
      find_nucleated_cracks(mesh, cracks, band({{.5, .5}, {.54, .5}}));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].line.front(), Point(.5, .5));
    EXPECT_TRUE(found[0].is_free[1]);
    EXPECT_NEAR(found[0].line.back()[0], .54, .5 * h);
  }
} // namespace Perimorph::Fracture
