#include <perimorph/base/exceptions.h>
#include <perimorph/mesh/feature_distance.h>
#include <perimorph/mesh/region_map.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Mesh
{
  namespace
  {
    using Parameters::Feature;
    using Parameters::FeatureKind;

    template <int dim>
    DistributedMesh<dim>
    unit_body(const unsigned int n, const double distortion = 0.)
    {
      return DistributedMesh<dim>(
        Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(n, distortion)),
        MPI_COMM_WORLD);
    }

    /// Largest difference between the distance found and a formula.
    template <int dim, typename Formula>
    double
    distance_error(const DistributedMesh<dim> &mesh,
                   const Feature              &feature,
                   const Formula              &formula)
    {
      const FeatureDistance<dim> distance(feature, mesh);
      double                     worst = 0.;
      for (unsigned int n = 0; n < mesh.nodal().n_nodes(); ++n)
        {
          const auto &x       = mesh.nodal().nodes[n];
          const auto  closest = distance.closest_to_node(
            mesh.nodal(),
            n,
            [](const dealii::Point<dim> &) {
              return typename FeatureDistance<dim>::Range{0., 10.};
            });
          worst = std::max(worst, std::abs(closest.distance - formula(x)));
          worst =
            std::max(worst,
                     std::abs(closest.point.distance(x) - closest.distance));
        }
      return worst;
    }

    RegionParameters
    ball_in_the_middle(const double radius)
    {
      RegionParameters parameters;
      parameters.features       = {{FeatureKind::ball, "", {0.5, 0.5, radius}}};
      parameters.core_size      = {0., false, false};
      parameters.blending_width = {0.2, false, false};
      return parameters;
    }

    std::string
    message_of(const DistributedMesh<2> &mesh,
               const RegionParameters   &parameters)
    {
      try
        {
          make_region_map(mesh, parameters);
        }
      catch (const Base::InputError &error)
        {
          return error.what();
        }
      return "no error";
    }
  } // namespace

  TEST(FeatureDistance, agrees_with_formulas)
  {
    const auto plane = unit_body<2>(7, 0.2);
    using P          = dealii::Point<2>;
    EXPECT_LT(distance_error<2>(plane,
                                {FeatureKind::boundary, "x-", {}},
                                [](const P &x) { return x[0]; }),
              1e-14);
    EXPECT_LT(
      distance_error<2>(plane,
                        {FeatureKind::point, "", {0.3, 0.4}},
                        [](const P &x) { return x.distance(P(.3, .4)); }),
      1e-14);
    EXPECT_LT(
      distance_error<2>(plane,
                        {FeatureKind::plane, "", {0.3, 0., 2., 0.}},
                        [](const P &x) { return std::abs(x[0] - 0.3); }),
      1e-14);
    EXPECT_LT(
      distance_error<2>(plane,
                        {FeatureKind::segment, "", {-1., .5, 2., .5}},
                        [](const P &x) { return std::abs(x[1] - 0.5); }),
      1e-14);
    EXPECT_LT(
      distance_error<2>(plane,
                        {FeatureKind::box, "", {-1., -1., 0.5, 2.}},
                        [](const P &x) { return std::max(0., x[0] - 0.5); }),
      1e-14);
    EXPECT_LT(distance_error<2>(plane,
                                {FeatureKind::volume, "body", {}},
                                [](const P &) { return 0.; }),
              1e-14);
    const auto space = unit_body<3>(4, 0.2);
    EXPECT_LT(
      distance_error<3>(space,
                        {FeatureKind::boundary, "z+", {}},
                        [](const dealii::Point<3> &x) { return 1. - x[2]; }),
      1e-13);
    EXPECT_LT(distance_error<3>(space,
                                {FeatureKind::ball, "", {0., 0., 0., 0.5}},
                                [](const dealii::Point<3> &x) {
                                  return std::max(0., x.norm() - 0.5);
                                }),
              1e-14);
  }

  TEST(RegionMap, blends_from_one_to_zero)
  {
    const auto mesh = unit_body<2>(20);
    const auto map  = make_region_map(mesh, ball_in_the_middle(0.2));
    EXPECT_GT(map.n_core, 0u);
    EXPECT_GT(map.n_blending, 0u);
    EXPECT_EQ(map.n_core + map.n_blending + map.n_elements,
              mesh.nodal().n_nodes());
    for (unsigned int n = 0; n < mesh.nodal().n_nodes(); ++n)
      {
        const double r =
          mesh.nodal().nodes[n].distance(dealii::Point<2>(0.5, 0.5));
        const double s = (r - 0.2) / 0.2;
        const double expected =
          s < 1e-9 ? 1. : (s > 1. ? 0. : 1. - s * s * (3. - 2. * s));
        EXPECT_NEAR(map.alpha[n], expected, 1e-8);
        EXPECT_NEAR(map.horizon[n], 2. * mesh.nodal().spacing[n], 1e-15);
      }
  }

  TEST(RegionMap, sizes_in_horizons_follow_the_feature)
  {
    RegionParameters parameters;
    parameters.features          = {{FeatureKind::boundary, "x-", {}}};
    parameters.core_size         = {2., true, false};
    parameters.blending_function = BlendingFunction::splice;
    const auto mesh              = unit_body<2>(20);
    const auto map               = make_region_map(mesh, parameters);
    // Two horizons of two spacings of 0.05.
    for (unsigned int n = 0; n < mesh.nodal().n_nodes(); ++n)
      EXPECT_EQ(map.alpha[n], mesh.nodal().nodes[n][0] < 0.2001 ? 1. : 0.);
  }

  TEST(RegionMap, bad_regions_are_named)
  {
    const auto mesh       = unit_body<2>(6);
    auto       parameters = ball_in_the_middle(5.);
    EXPECT_NE(message_of(mesh, parameters).find("swallows"), std::string::npos);
    parameters                     = ball_in_the_middle(0.2);
    parameters.features[0].numbers = {9., 9., 0.1};
    EXPECT_NE(message_of(mesh, parameters).find("without any node"),
              std::string::npos);
    parameters.features.clear();
    EXPECT_NE(message_of(mesh, parameters).find("Peridynamics / around"),
              std::string::npos);
    parameters                = ball_in_the_middle(0.2);
    parameters.horizon_length = 0.1;
    EXPECT_NE(message_of(mesh, parameters).find("smaller than the spacing"),
              std::string::npos);
    parameters.features = {{FeatureKind::boundary, "y+-", {}}};
    EXPECT_NE(message_of(mesh, parameters).find("boundary 'y+-'"),
              std::string::npos);
  }

  TEST(DistributedMesh, keeps_names_and_counts_pieces)
  {
    auto       gmsh = Testing::as_gmsh_mesh(Testing::unit_mesh<2>(4));
    const auto body = DistributedMesh<2>(gmsh, MPI_COMM_WORLD);
    EXPECT_EQ(body.boundary("x+", "test").size(), 4u);
    EXPECT_EQ(body.boundary_nodes("x+", "test").size(), 5u);
    EXPECT_EQ(body.volume("body", "test").size(), 16u);
    EXPECT_EQ(body.nodal().boundary_faces.size(), 16u);
    unsigned int owned = body.nodal().owned_end - body.nodal().owned_begin;
    EXPECT_EQ(dealii::Utilities::MPI::sum(owned, MPI_COMM_WORLD), 25u);
    EXPECT_EQ(*std::max_element(body.pieces().begin(), body.pieces().end()),
              0u);

    // A second square beside it that does not touch.
    const unsigned int n = gmsh.points.size();
    for (unsigned int k = 0; k < n; ++k)
      gmsh.points.push_back(gmsh.points[k] + dealii::Point<2>(3., 0.));
    const unsigned int n_cells = gmsh.cells.size();
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        auto cell = gmsh.cells[c];
        for (auto &point : cell)
          point += n;
        gmsh.cells.push_back(cell);
      }
    const auto two = DistributedMesh<2>(gmsh, MPI_COMM_WORLD);
    EXPECT_EQ(*std::max_element(two.pieces().begin(), two.pieces().end()), 1u);
    EXPECT_THROW(two.boundary("x*", "test"), Base::InputError);
  }
} // namespace Perimorph::Mesh
