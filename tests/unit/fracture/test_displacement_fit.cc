#include <perimorph/fracture/displacement_fit.h>

#include "exact_fields.h"
#include <gtest/gtest.h>
#include <harness/test_meshes.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;

  template <int dim>
  void
  expect_quadratic_fields_are_exact(const Mesh::NodalMesh<dim> &mesh)
  {
    const DisplacementFit<dim> fit(mesh);
    const auto                 displacement =
      Testing::nodal_values<dim>(mesh, [](const auto &x) {
        return Testing::quadratic_field<dim>(x, false);
      });
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        const auto result = fit.fit(mesh.nodes[n],
                                    mesh.spacing[n],
                                    fit.any_material,
                                    displacement);
        EXPECT_TRUE(result.quadratic) << mesh.nodes[n];
        EXPECT_LT((result.displacement - displacement[n]).norm(), 1e-10);
        EXPECT_LT(
          (result.gradient - Testing::quadratic_gradient<dim>(mesh.nodes[n]))
            .norm(),
          1e-10)
          << mesh.nodes[n];
      }
  }

  TEST(DisplacementFit, reproduces_quadratic_fields_up_to_the_boundary)
  {
    expect_quadratic_fields_are_exact<2>(Testing::unit_mesh<2>(8, 0.2));
    expect_quadratic_fields_are_exact<3>(Testing::unit_mesh<3>(6, 0.2));
  }

  TEST(DisplacementFit, reproduces_quadratic_fields_on_graded_meshes)
  {
    expect_quadratic_fields_are_exact<2>(Testing::unit_mesh<2>(12, 0., 10.));
    expect_quadratic_fields_are_exact<3>(Testing::unit_mesh<3>(6, 0., 4.));
  }

  TEST(DisplacementFit, reproduces_quadratic_fields_between_nodes)
  {
    const auto               mesh = Testing::unit_mesh<2>(8, 0.2);
    const DisplacementFit<2> fit(mesh);
    const auto displacement = Testing::nodal_values<2>(mesh, [](const auto &x) {
      return Testing::quadratic_field<2>(x, false);
    });
    for (const auto &point : {dealii::Point<2>(0.123, 0.456),
                              dealii::Point<2>(0.99, 0.01),
                              dealii::Point<2>(1., 0.4321)})
      {
        const auto result =
          fit.fit(point, fit.length_at(point), fit.any_material, displacement);
        EXPECT_LT(
          (result.displacement - Testing::quadratic_field<2>(point, false))
            .norm(),
          1e-10);
        EXPECT_LT(
          (result.gradient - Testing::quadratic_gradient<2>(point)).norm(),
          1e-10);
      }
  }

  /// Compares an eighth (a quarter) of a block that has mirror planes with the
  /// whole block: the neighbourhoods are then the same.
  template <int dim>
  void
  expect_mirrors_replace_the_other_half(const unsigned int n_cells)
  {
    dealii::Point<dim>            lower, upper;
    std::array<unsigned int, dim> n_part, n_whole;
    for (int d = 0; d < dim; ++d)
      {
        upper[d]   = 1.;
        n_part[d]  = n_cells;
        n_whole[d] = 2 * n_cells;
      }
    const auto part = Testing::structured_mesh<dim>(n_part, lower, upper);
    for (int d = 0; d < dim; ++d)
      lower[d] = -1.;
    const auto whole = Testing::structured_mesh<dim>(n_whole, lower, upper);

    // odd in its own coordinate, even in the others
    const Testing::VectorField<dim> field = [](const auto &x) {
      dealii::Tensor<1, dim> u;
      for (int i = 0; i < dim; ++i)
        {
          u[i] = std::sin(x[i]) + x[i] * x[i] * x[i];
          for (int a = 0; a < dim; ++a)
            if (a != i)
              u[i] *= 1. + (1. + i) * x[a] * x[a];
        }
      return u;
    };
    const auto part_values  = Testing::nodal_values<dim>(part, field);
    const auto whole_values = Testing::nodal_values<dim>(whole, field);
    const DisplacementFit<dim> with_mirrors(part,
                                            Testing::coordinate_planes<dim>());
    const DisplacementFit<dim> without(whole);

    for (unsigned int n = 0; n < part.n_nodes(); ++n)
      {
        const auto a = with_mirrors.fit(part.nodes[n],
                                        1. / n_cells,
                                        with_mirrors.any_material,
                                        part_values);
        const auto b = without.fit(part.nodes[n],
                                   1. / n_cells,
                                   without.any_material,
                                   whole_values);
        EXPECT_EQ(a.n_nodes, b.n_nodes) << part.nodes[n];
        EXPECT_LT((a.gradient - b.gradient).norm(), 1e-10) << part.nodes[n];
        EXPECT_LT((a.displacement - b.displacement).norm(), 1e-10);
      }
  }

  TEST(DisplacementFit, mirrored_nodes_replace_the_other_half)
  {
    expect_mirrors_replace_the_other_half<2>(6);
    expect_mirrors_replace_the_other_half<3>(4);
  }

  TEST(DisplacementFit, mirrors_only_beside_held_nodes)
  {
    // The axis y = 0 is held for x > 0.5 and a free crack face before.
    const auto     mesh = Testing::unit_mesh<2>(10);
    MirrorPlane<2> plane;
    plane.normal[1] = 1.;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (mesh.nodes[n][1] < 1e-9 && mesh.nodes[n][0] > 0.5 - 1e-9)
        plane.nodes.push_back(n);
    const DisplacementFit<2> fit(mesh, {plane});
    const auto               values =
      Testing::nodal_values<2>(mesh, [](const dealii::Point<2> &) {
        dealii::Tensor<1, 2> opening;
        opening[1] = 1.;
        return opening;
      });
    const dealii::Point<2> face(0.1, 0.), ligament(0.9, 0.);
    EXPECT_LT(fit.fit(face, 0.1, -1, values).gradient.norm(), 1e-10);
    EXPECT_GT(fit.fit(ligament, 0.1, -1, values).gradient.norm(), 1.);
  }

  TEST(DisplacementFit, keeps_the_kink_at_an_interface)
  {
    auto mesh = Testing::unit_mesh<2>(8);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      mesh.cell_material[c] = mesh.cell_centroid[c][0] < 0.5 ? 0 : 1;
    const DisplacementFit<2> fit(mesh);
    const auto values = Testing::nodal_values<2>(mesh, [](const auto &x) {
      dealii::Tensor<1, 2> u;
      u[0] = x[0] < 0.5 ? x[0] : 0.5 + 3. * (x[0] - 0.5);
      return u;
    });
    const dealii::Point<2> point(0.5, 0.4);
    EXPECT_NEAR(fit.fit(point, 0.125, 0, values).gradient[0][0], 1., 1e-10);
    EXPECT_NEAR(fit.fit(point, 0.125, 1, values).gradient[0][0], 3., 1e-10);
    const double both =
      fit.fit(point, 0.125, fit.any_material, values).gradient[0][0];
    EXPECT_NEAR(both, 2., 1e-10);
  }

  TEST(DisplacementFit, respects_visibility)
  {
    const auto         mesh = Testing::unit_mesh<2>(8);
    DisplacementFit<2> fit(mesh);
    fit.set_visibility([&](const auto &point, const unsigned int node) {
      return (point[0] < 0.49) == (mesh.nodes[node][0] < 0.49);
    });
    const auto values = Testing::nodal_values<2>(mesh, [](const auto &x) {
      dealii::Tensor<1, 2> u;
      u[1] = x[0] < 0.49 ? 0. : 1.;
      return u;
    });
    for (const double x : {0.4, 0.48, 0.5, 0.6})
      EXPECT_LT(
        fit.fit(dealii::Point<2>(x, 0.5), 0.125, -1, values).gradient.norm(),
        1e-10);
    fit.set_visibility({});
    EXPECT_GT(
      fit.fit(dealii::Point<2>(0.48, 0.5), 0.125, -1, values).gradient.norm(),
      1.);
  }

  TEST(DisplacementFit, becomes_linear_where_the_nodes_allow_no_more)
  {
    // one layer of cells: no curvature across
    const auto               mesh = Testing::structured_mesh<2>({{10, 1}},
                                                  dealii::Point<2>(),
                                                  dealii::Point<2>(1., 0.1));
    const DisplacementFit<2> fit(mesh);
    const auto values = Testing::nodal_values<2>(mesh, [](const auto &x) {
      dealii::Tensor<1, 2> u;
      u[0] = 2. * x[0] + 3. * x[1];
      return u;
    });
    const auto result = fit.fit(dealii::Point<2>(0.5, 0.), 0.1, -1, values);
    EXPECT_FALSE(result.quadratic);
    EXPECT_NEAR(result.gradient[0][0], 2., 1e-10);
    EXPECT_NEAR(result.gradient[0][1], 3., 1e-10);
  }

  TEST(DisplacementFit, says_when_nothing_can_be_fitted)
  {
    const auto         mesh = Testing::unit_mesh<2>(4);
    DisplacementFit<2> fit(mesh);
    fit.set_visibility(
      [](const auto &, const unsigned int n) { return n < 2; });
    const auto result =
      fit.fit(mesh.nodes[0],
              mesh.spacing[0],
              fit.any_material,
              std::vector<dealii::Tensor<1, 2>>(mesh.n_nodes()));
    EXPECT_EQ(result.n_nodes, 0u);
    EXPECT_EQ(result.gradient.norm(), 0.);
  }
} // namespace
