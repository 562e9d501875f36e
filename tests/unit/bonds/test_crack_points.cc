#include <perimorph/bonds/crack_damage.h>
#include <perimorph/bonds/crack_points.h>
#include <perimorph/bonds/crack_traces.h>

#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Bonds
{
  namespace
  {
    using Point2 = dealii::Point<2>;
    using Point3 = dealii::Point<3>;

    template <int dim>
    double
    measure(const std::vector<CrackPoint<dim>> &points)
    {
      double sum = 0.;
      for (const auto &point : points)
        sum += point.measure;
      return sum;
    }
  } // namespace

  TEST(CrackPoints, cover_what_lies_in_the_body_once)
  {
    for (const double distortion : {0., .2})
      {
        const auto mesh = Testing::unit_mesh<2>(12, distortion);
        // Oblique, beyond both edges; along a line of nodes.
        EXPECT_NEAR(
          measure(crack_points(
            mesh,
            CrackSet<2>({{{{Point2(-1., .3), Point2(2., .6)}}, 0, 0}}))),
          std::sqrt(1.01),
          1e-12);
        EXPECT_NEAR(
          measure(crack_points(
            mesh,
            CrackSet<2>({{{{Point2(.1, .5), Point2(.77, .5)}}, 0, 0}}))),
          .67,
          1e-12);
      }
    const auto cube = Testing::unit_mesh<3>(6);
    for (const double z : {.5, .45})
      EXPECT_NEAR(
        measure(crack_points(
          cube,
          CrackSet<3>(
            {{{{Point3(-.5, .2, z), Point3(.7, .2, z), Point3(.7, .8, z)}},
              0,
              0}}))),
        // the triangle without its corner at x < 0
        .36 - .5 * .5 * .25,
        1e-12);
  }

  TEST(CrackTraces, are_exact_for_linear_fields_and_see_one_side)
  {
    const auto           mesh = Testing::unit_mesh<2>(12, .2);
    const CrackSet<2>    cracks({{{{Point2(.2, .43), Point2(.8, .58)}}, 0, 0}});
    const CrackTraces<2> traces(mesh, cracks);
    const auto           normal = cracks.facets()[0].normal();
    for (const double s : {.1, .5, .93})
      for (const double side : {-1., 1.})
        {
          const Point2 x     = Point2(.2 + .6 * s, .43 + .15 * s);
          const auto   trace = traces.at(x, side * normal);
          ASSERT_FALSE(trace.empty());
          double               sum = 0.;
          dealii::Tensor<1, 2> moment;
          for (unsigned int k = 0; k < trace.nodes.size(); ++k)
            {
              const auto &node = mesh.nodes[trace.nodes[k]];
              sum += trace.weights[k];
              moment += trace.weights[k] * (node - x);
              EXPECT_FALSE(cracks.crosses(x + 1e-7 * side * normal, node));
            }
          EXPECT_NEAR(sum, 1., 1e-12);
          EXPECT_LT(moment.norm(), 1e-13);
        }
  }

  TEST(CrackDamage, of_a_particle_beside_a_long_crack)
  {
    // Half a spacing above a long straight crack, horizon 2 h: of 12
    // neighbours the three in the next row and one two rows below are hidden.
    const auto        mesh = Testing::unit_mesh<2>(20);
    const double      h    = .05;
    const CrackSet<2> cracks({{{{Point2(-1., .525), Point2(2., .525)}}, 0, 0}});
    std::size_t       n_hidden;
    const auto        damage =
      crack_damage(mesh,
                   std::vector<double>(mesh.n_nodes(), 1.),
                   std::vector<double>(mesh.n_nodes(), 2. * h),
                   cracks,
                   n_hidden);
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (mesh.nodes[n].distance(Point2(.5, .55)) < 1e-9)
        EXPECT_NEAR(damage[n], 4. / 12., 1e-12);
      else if (mesh.nodes[n].distance(Point2(.5, .65)) < 1e-9)
        EXPECT_EQ(damage[n], 0.);
    EXPECT_GT(n_hidden, 0u);
  }
} // namespace Perimorph::Bonds
