#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/stress_concentration.h>

#include "exact_fields.h"
#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <numeric>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;

  /// Gives each rank a contiguous part of the nodes.
  template <int dim>
  void
  distribute(Mesh::NodalMesh<dim> &mesh)
  {
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    mesh.rank        = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    mesh.owned_begin = mesh.n_nodes() * mesh.rank / n_ranks;
    mesh.owned_end   = mesh.n_nodes() * (mesh.rank + 1) / n_ranks;
  }

  /// Error of K_t in per cent, fitted or as mean of the element stresses, for
  /// the exact nodal displacements of the Kirsch plate.
  double
  kirsch_error(const unsigned int n_around,
               const bool         quarter,
               const bool         mirrors,
               const bool         fitted)
  {
    auto mesh = Testing::kirsch_mesh(n_around, quarter);
    distribute(mesh);
    const auto materials =
      Testing::unit_material<2>(Testing::kirsch_poissons_ratio,
                                PlaneState::plane_stress);
    const DisplacementFit<2> fit(mesh,
                                 mirrors ? Testing::coordinate_planes<2>()
                                         : std::vector<MirrorPlane<2>>());
    const NodalStress<2>     recovery(fit, materials);
    const auto               displacement =
      Testing::nodal_values<2>(mesh, Testing::kirsch_displacement);
    const auto hole = Testing::nodes_at_radius(mesh, 1.);
    const auto result =
      fitted ? stress_concentration(recovery,
                                    hole,
                                    displacement,
                                    1.,
                                    "hole",
                                    MPI_COMM_WORLD)
             : stress_concentration(
                 mesh,
                 hole,
                 average_element_stress(mesh, materials, hole, displacement),
                 1.,
                 "hole",
                 MPI_COMM_WORLD);
    if (fitted)
      {
        EXPECT_NEAR(std::abs(result.position[0]), 1., 1e-9);
        EXPECT_NEAR(result.position[1], 0., 1e-9);
      }
    return 100. * (result.value / 3. - 1.);
  }

  // The exact value is 3. The numbers are those of this fit, measured; with the
  // displacements of bilinear elements on the same meshes it gives -4.8, -1.4,
  // -0.4, the numbers of numerics.md, section 6.
  TEST(StressConcentration, kirsch_plate_converges)
  {
    EXPECT_NEAR(kirsch_error(32, false, false, true), -2.45, 0.02);
    EXPECT_NEAR(kirsch_error(64, false, false, true), -0.84, 0.02);
    EXPECT_NEAR(kirsch_error(128, false, false, true), -0.25, 0.02);
  }

  TEST(StressConcentration, quarter_plate_needs_mirrored_nodes)
  {
    EXPECT_NEAR(kirsch_error(32, true, true, true), -2.40, 0.02);
    EXPECT_NEAR(kirsch_error(64, true, true, true), -0.80, 0.02);
    EXPECT_GT(kirsch_error(64, true, false, true), 2.);
  }

  TEST(StressConcentration, mean_of_element_stresses_is_first_order)
  {
    EXPECT_NEAR(kirsch_error(32, false, false, false), -10.24, 0.02);
    EXPECT_NEAR(kirsch_error(64, false, false, false), -5.43, 0.02);
    EXPECT_NEAR(kirsch_error(128, false, false, false), -2.80, 0.02);
  }

  /// Towards the corners of the plate the cells are longer across the hole edge
  /// than along it: with a small radius only one layer of nodes lies behind the
  /// edge, and the quadratic terms hang on the curvature of the hole.
  TEST(StressConcentration, fit_reaches_a_second_layer_of_nodes)
  {
    const auto mesh = Testing::kirsch_mesh(64, false);
    const auto materials =
      Testing::unit_material<2>(Testing::kirsch_poissons_ratio,
                                PlaneState::plane_stress);
    const DisplacementFit<2> fit(mesh, {}, 2.2);
    const NodalStress<2>     recovery(fit, materials);
    const auto               displacement =
      Testing::nodal_values<2>(mesh, Testing::kirsch_displacement);
    double largest_error = 0.;
    for (const unsigned int node : Testing::nodes_at_radius(mesh, 1.))
      {
        const auto  &x     = mesh.nodes[node];
        const double exact = 1. + 2. * (x[0] * x[0] - x[1] * x[1]);
        largest_error      = std::max(
          largest_error,
          std::abs(hoop_stress(recovery.at_node(node, displacement), x, {}) -
                   exact));
      }
    EXPECT_LT(largest_error, 0.02); // 0.12 without the bound
  }

  /// Two nodes with equal stresses, up to round-off.
  TEST(StressConcentration, names_the_same_node_for_any_number_of_ranks)
  {
    auto mesh = Testing::unit_mesh<2>(5);
    distribute(mesh);
    std::vector<unsigned int> nodes(mesh.n_nodes());
    std::iota(nodes.begin(), nodes.end(), 0u);
    std::vector<Stress<2>> stresses(mesh.n_nodes());
    stresses[7].in_plane[0][0]  = 2. * (1. + 1e-12); // at (0.2, 0.2)
    stresses[30].in_plane[1][1] = 2.;                // at (0, 1)
    stresses[20].in_plane[1][1] = 1.9;
    const auto result =
      stress_concentration(mesh, nodes, stresses, 4., "edge", MPI_COMM_WORLD);
    EXPECT_EQ(result.node, 30u);
    EXPECT_NEAR(result.value, 0.5, 1e-9);
    EXPECT_NEAR(result.stress, 2., 1e-9);
    EXPECT_NEAR(result.position[0], 0., 1e-12);
    EXPECT_NEAR(result.position[1], 1., 1e-12);
  }

  TEST(StressConcentration, takes_the_smallest_stress_under_compression)
  {
    auto mesh = Testing::unit_mesh<2>(2);
    distribute(mesh);
    std::vector<unsigned int> nodes(mesh.n_nodes());
    std::iota(nodes.begin(), nodes.end(), 0u);
    std::vector<Stress<2>> stresses(mesh.n_nodes());
    stresses[4].in_plane[0][0] = -6.;
    stresses[5].in_plane[0][0] = 8.;
    const auto result =
      stress_concentration(mesh, nodes, stresses, -2., "edge", MPI_COMM_WORLD);
    EXPECT_NEAR(result.value, 3., 1e-12);
    EXPECT_NEAR(result.stress, -6., 1e-12);
  }

  TEST(StressConcentration, refuses_a_nominal_stress_of_zero)
  {
    auto mesh = Testing::unit_mesh<2>(2);
    distribute(mesh);
    try
      {
        stress_concentration(mesh,
                             {0u},
                             std::vector<Stress<2>>(1),
                             0.,
                             "hole",
                             MPI_COMM_WORLD);
        FAIL() << "no exception";
      }
    catch (const Base::InputError &error)
      {
        const std::string message = error.what();
        EXPECT_NE(message.find("'hole'"), std::string::npos) << message;
        EXPECT_NE(message.find("other than 0"), std::string::npos) << message;
      }
  }
} // namespace
