#include <deal.II/base/mpi.h>

#include "near_tip_plate.h"
#include <gtest/gtest.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Testing::Plate;
  using Testing::Source;

  /// Largest of the relative errors of J, K_I and K_II.
  double
  largest_error(const Plate &plate, const FractureQuantities &found)
  {
    return std::max({std::abs(found.J / plate.field.exact_J() - 1.),
                     std::abs(found.K_I / plate.field.K_I - 1.),
                     std::abs(found.K_II / plate.field.K_II - 1.)});
  }

  /// Tolerances for 20, 40 and 80 cells: about 1.3 times the largest error
  /// measured.
  void
  expect_convergence(const Source                 source,
                     const std::array<double, 3> &tolerance,
                     const Testing::NearTipCase  &body = {})
  {
    for (const double angle : {0., 0.52})
      for (const double distortion : {0., 0.2})
        for (unsigned int level = 0; level < 3; ++level)
          {
            const Plate plate(20u << level, angle, distortion, 1., "", body);
            const auto  set = plate.points(source);
            EXPECT_EQ(set.n_without_stress, 0u);
            for (const Annulus annulus : {Annulus{0.3, 0.8}, Annulus{0.4, 0.9}})
              EXPECT_LT(largest_error(plate, plate.quantities(set, annulus)),
                        tolerance[level])
                << "angle " << angle << ", distortion " << distortion
                << ", level " << level << ", inner " << annulus.inner;
          }
  }

  TEST(StressPoints, cells_converge_to_the_exact_factors)
  {
    expect_convergence(Source::cells, {{4e-3, 1e-3, 2.5e-4}});
  }

  TEST(StressPoints, families_converge_to_the_exact_factors)
  {
    expect_convergence(Source::families, {{1.8e-2, 2e-3, 7.5e-4}});
  }

  TEST(StressPoints, families_and_elements_converge_to_the_exact_factors)
  {
    expect_convergence(Source::families_and_elements, {{2.2e-2, 6.3e-3, 2e-3}});
  }

  Testing::NearTipCase
  anisotropic_body()
  {
    Testing::NearTipCase body;
    body.stiffness = Testing::graphite_epoxy(0.9);
    return body;
  }

  TEST(StressPoints, cells_converge_in_an_anisotropic_body)
  {
    expect_convergence(Source::cells,
                       {{8.3e-3, 8.6e-4, 2.8e-4}},
                       anisotropic_body());
  }

  TEST(StressPoints, families_converge_in_an_anisotropic_body)
  {
    expect_convergence(Source::families,
                       {{4.9e-2, 4.2e-3, 1.2e-3}},
                       anisotropic_body());
  }

  // Each part of the body once: the shares of all points add up to its area.
  TEST(StressPoints, shares_add_up_to_the_area)
  {
    const Plate             plate(20, 0.52, 0.2);
    const DeformedBody<2>   body = {plate.mesh,
                                    plate.materials,
                                    plate.displacement};
    const std::vector<bool> everywhere(plate.mesh.n_nodes(), true);
    StressPointSet<2>       set;
    add_cell_points(body,
                    plate.cracks,
                    *visible_fit(plate.mesh, plate.cracks),
                    everywhere,
                    set);
    double area = 0.;
    for (const auto &point : set.points)
      area += point.volume;
    EXPECT_NEAR(area, 4., 1e-12);
    // some cells are touched, by a crack of one unit not more than all rows
    EXPECT_GT(set.points.size(), 4 * plate.mesh.n_cells() + 12 * 10);
    EXPECT_LT(set.points.size(), 4 * plate.mesh.n_cells() + 12 * 40);
  }

  // q linear: every operator gives its gradient.
  TEST(StressPoints, differentiate_linear_weights_exactly)
  {
    const Plate          plate(20, 0.52, 0.2);
    dealii::Tensor<1, 2> slope({0.3, -0.7});
    std::vector<double>  q;
    for (const auto &x : plate.mesh.nodes)
      q.push_back(1. + slope * x);
    for (const auto source : {Source::cells, Source::families_and_elements})
      {
        auto set = plate.points(source);
        set.set_weight(q);
        ASSERT_GT(set.points.size(), 500u);
        for (const auto &point : set.points)
          EXPECT_LT((point.q_gradient - slope).norm(), 1e-12);
      }
  }

  TEST(StressPoints, finite_strain_under_a_small_load_is_linear)
  {
    const double factor = 1e-5;
    for (const auto source : {Source::cells, Source::families_and_elements})
      {
        const Plate linear(20, 0.52, 0.2);
        const auto  expected =
          linear.quantities(linear.points(source), {0.3, 0.8});
        for (const auto law : {"hencky", "neo-hookean"})
          {
            const Plate finite(20, 0.52, 0.2, factor, law);
            const auto  found =
              finite.quantities(finite.points(source), {0.3, 0.8});
            EXPECT_NEAR(found.J / (factor * factor), expected.J, 2e-4);
            EXPECT_NEAR(found.K_I / factor, expected.K_I, 2e-4);
            EXPECT_NEAR(found.K_II / factor, expected.K_II, 2e-4);
          }
      }
  }

  TEST(StressPoints, ranks_add_up_their_cells)
  {
    Plate      plate(20, 0.52, 0.2);
    const auto expected =
      plate.quantities(plate.points(Source::cells), {0.3, 0.8});
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    plate.mesh.rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    for (unsigned int c = 0; c < plate.mesh.n_cells(); ++c)
      plate.mesh.cell_owner[c] = c % n_ranks;
    const auto found =
      plate.quantities(plate.points(Source::cells), {0.3, 0.8}, MPI_COMM_WORLD);
    EXPECT_NEAR(found.J, expected.J, 1e-12);
    EXPECT_NEAR(found.K_I, expected.K_I, 1e-12);
    EXPECT_NEAR(found.T_stress, expected.T_stress, 1e-12);
  }
} // namespace
