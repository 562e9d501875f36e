#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/probes.h>

#include "exact_fields.h"
#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <cstdio>
#include <fstream>
#include <random>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;

  template <int dim>
  struct ProbedMesh
  {
    explicit ProbedMesh(Mesh::NodalMesh<dim> some_mesh)
      : mesh(std::move(some_mesh))
      , materials(Testing::unit_material<dim>(
          0.3,
          dim == 2 ? PlaneState::plane_strain : PlaneState::three_dimensional))
      , fit(mesh)
      , recovery(fit, materials)
      , probe(recovery)
    {}

    Mesh::NodalMesh<dim> mesh;
    MaterialList<dim>    materials;
    DisplacementFit<dim> fit;
    NodalStress<dim>     recovery;
    PointProbe<dim>      probe;
  };

  template <int dim>
  void
  expect_linear_displacements_are_exact(const unsigned int n_cells)
  {
    const ProbedMesh<dim>  setup(Testing::unit_mesh<dim>(n_cells, 0.2));
    dealii::Tensor<2, dim> gradient;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        gradient[a][b] = 0.1 + 0.2 * a - 0.3 * b;
    const auto values =
      Testing::nodal_values<dim>(setup.mesh, [&](const auto &x) {
        return gradient * dealii::Tensor<1, dim>(x);
      });
    std::mt19937                           random(1);
    std::uniform_real_distribution<double> coordinate(0., 1.);
    for (unsigned int k = 0; k < 200; ++k)
      {
        dealii::Point<dim> point;
        for (int d = 0; d < dim; ++d)
          point[d] = coordinate(random);
        const auto place = setup.probe.locate(point);
        for (int d = 0; d < dim; ++d)
          {
            EXPECT_GT(place.unit_point[d], -1e-5);
            EXPECT_LT(place.unit_point[d], 1. + 1e-5);
          }
        EXPECT_LT((setup.probe.displacement_at(point, values) -
                   gradient * dealii::Tensor<1, dim>(point))
                    .norm(),
                  1e-12);
      }
  }

  TEST(PointProbe, interpolates_linear_fields_on_distorted_meshes)
  {
    expect_linear_displacements_are_exact<2>(6);
    expect_linear_displacements_are_exact<3>(4);
  }

  TEST(PointProbe, takes_nodes_corners_and_faces_as_inside)
  {
    const ProbedMesh<2> setup(Testing::unit_mesh<2>(5, 0.2));
    const auto values = Testing::nodal_values<2>(setup.mesh, [](const auto &x) {
      return Testing::quadratic_field<2>(x, false);
    });
    for (unsigned int n = 0; n < setup.mesh.n_nodes(); ++n)
      EXPECT_LT(
        (setup.probe.displacement_at(setup.mesh.nodes[n], values) - values[n])
          .norm(),
        1e-12);
  }

  TEST(PointProbe, extrapolates_beside_a_curved_boundary)
  {
    // The straight edges of a ring with 24 cells around leave out the arcs of
    // the outer circle, sagitta 4 (1 - cos 7.5 deg) = 0.034.
    const ProbedMesh<2>  setup(Testing::annulus_mesh<2>(24, 4, 1., 4.));
    dealii::Tensor<2, 2> gradient;
    gradient[0][1] = 1.;
    gradient[1][1] = 2.;
    const auto values =
      Testing::nodal_values<2>(setup.mesh, [&](const auto &x) {
        return gradient * dealii::Tensor<1, 2>(x);
      });
    for (const auto &point :
         circle_points(dealii::Point<2>(), 4., 0., 360., 73))
      {
        EXPECT_LT((setup.probe.displacement_at(point, values) -
                   gradient * dealii::Tensor<1, 2>(point))
                    .norm(),
                  1e-12);
        const auto exact = stress_of_gradient(*setup.materials[0], gradient);
        EXPECT_LT(
          (setup.probe.stress_at(point, values).in_plane - exact.in_plane)
            .norm(),
          1e-10);
      }
  }

  TEST(PointProbe, refuses_points_in_a_hole)
  {
    const ProbedMesh<2> setup(Testing::annulus_mesh<2>(24, 4, 1., 4.));
    try
      {
        setup.probe.locate(dealii::Point<2>(0.25, 0.));
        FAIL() << "no exception";
      }
    catch (const Base::InputError &error)
      {
        EXPECT_STREQ(error.what(),
                     "Error: point (0.25 0)\n"
                     "  found outside the mesh; allowed: points of the body; "
                     "the nearest node (1 0) is 0.75 away");
      }
  }

  TEST(PointProbe, uses_the_material_of_the_cell)
  {
    auto mesh = Testing::unit_mesh<2>(8);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      mesh.cell_material[c] = mesh.cell_centroid[c][0] < 0.5 ? 0 : 1;
    MaterialList<2> materials;
    for (const double modulus : {1., 10.})
      materials.push_back(std::make_unique<Materials::LinearElastic<2>>(
        modulus,
        0.,
        PlaneState::plane_stress));
    const DisplacementFit<2> fit(mesh);
    const NodalStress<2>     recovery(fit, materials);
    const PointProbe<2>      probe(recovery);
    const auto values = Testing::nodal_values<2>(mesh, [](const auto &x) {
      dealii::Tensor<1, 2> u;
      u[1] = 0.1 * x[1];
      return u;
    });
    EXPECT_NEAR(
      probe.stress_at(dealii::Point<2>(0.49, 0.3), values).in_plane[1][1],
      0.1,
      1e-10);
    EXPECT_NEAR(
      probe.stress_at(dealii::Point<2>(0.51, 0.3), values).in_plane[1][1],
      1.,
      1e-10);
  }

  TEST(PointProbe, table_has_all_columns)
  {
    const ProbedMesh<3>  setup(Testing::unit_mesh<3>(4));
    dealii::Tensor<2, 3> gradient;
    gradient[0][0] = 0.1;
    gradient[1][1] = 0.3;
    gradient[1][2] = 0.2;
    gradient[0][2] = 0.4;
    gradient[0][1] = -0.2;
    const auto values =
      Testing::nodal_values<3>(setup.mesh, [&](const auto &x) {
        return gradient * dealii::Tensor<1, 3>(x);
      });
    const dealii::Point<3> point(0.4, 0.3, 0.7);
    const auto             table =
      setup.probe.evaluate({point}, values, dealii::Point<3>(0.4, 0., 0.));
    ASSERT_EQ(table.columns, probe_columns<3>());
    ASSERT_EQ(table.rows.size(), 1u);
    ASSERT_EQ(table.rows[0].size(), table.columns.size());
    const auto stress = stress_of_gradient(*setup.materials[0], gradient);
    const auto value  = [&](const char *name) { return table.column(name)[0]; };
    EXPECT_NEAR(value("z"), 0.7, 1e-14);
    EXPECT_NEAR(value("ux"), 0.1 * 0.4 + 0.4 * 0.7 - 0.2 * 0.3, 1e-12);
    EXPECT_NEAR(value("uz"), 0., 1e-12);
    EXPECT_NEAR(value("syy"), stress.in_plane[1][1], 1e-10);
    EXPECT_NEAR(value("szz"), stress.in_plane[2][2], 1e-10);
    EXPECT_NEAR(value("sxy"), stress.in_plane[0][1], 1e-10);
    EXPECT_NEAR(value("sxz"), stress.in_plane[0][2], 1e-10);
    EXPECT_NEAR(value("syz"), stress.in_plane[1][2], 1e-10);
    EXPECT_NEAR(value("stt"), stress.in_plane[0][0], 1e-10);
    EXPECT_NEAR(value("mises"), von_mises_stress(stress), 1e-10);
    EXPECT_NEAR(value("principal_max"), principal_stresses(stress)[0], 1e-10);
  }

  TEST(ProbePoints, of_lines_and_circles)
  {
    const auto line =
      line_points(dealii::Point<2>(2.5, 0.), dealii::Point<2>(25., 5.), 11);
    ASSERT_EQ(line.size(), 11u);
    EXPECT_NEAR(line[0][0], 2.5, 1e-14);
    EXPECT_NEAR(line[5][0], 13.75, 1e-12);
    EXPECT_NEAR(line[10][1], 5., 1e-14);

    const auto circle =
      circle_points(dealii::Point<3>(1., 2., 3.), 2., 0., 90., 3);
    ASSERT_EQ(circle.size(), 3u);
    EXPECT_LT(circle[0].distance(dealii::Point<3>(3., 2., 3.)), 1e-12);
    EXPECT_LT(circle[1].distance(
                dealii::Point<3>(1. + std::sqrt(2.), 2. + std::sqrt(2.), 3.)),
              1e-12);
    EXPECT_LT(circle[2].distance(dealii::Point<3>(1., 4., 3.)), 1e-12);
  }

  TEST(ProbeTable, is_written_by_rank_0)
  {
    ProbeTable table;
    table.columns = {"x", "y", "ux"};
    table.rows    = {{0., 1., 0.1}, {0.5, 1., 1e-20}};
    write_probe(table, testing::TempDir(), "fracture_test", MPI_COMM_WORLD);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    const std::string filename =
      testing::TempDir() + "/probe_fracture_test.csv";
    std::ifstream     file(filename);
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), "x,y,ux\n0,1,0.1\n0.5,1,1e-20\n");
    std::remove(filename.c_str());
    EXPECT_THROW(write_probe(table, "no/such/folder", "ring", MPI_COMM_SELF),
                 Base::InputError);
  }
} // namespace
