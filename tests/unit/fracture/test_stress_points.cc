#include <perimorph/fracture/stress_points.h>
#include <perimorph/materials/material_factory.h>

#include <deal.II/base/mpi.h>

#include "near_tip_bodies.h"
#include <gtest/gtest.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Testing::NearTipCase;

  enum class Source
  {
    cells,                ///< full law everywhere, one-sided fits at the crack
    families,             ///< alpha = 1
    families_and_elements ///< families beside the crack, blended
  };

  /// A plate of 2 by 2 whose nodes move by the exact field times a factor.
  struct Plate
  {
    NearTipCase                       field;
    double                            h;
    Mesh::NodalMesh<2>                mesh;
    MaterialList<2>                   materials;
    std::vector<dealii::Tensor<1, 2>> displacement;
    Bonds::CrackSet<2>                cracks;

    Plate(const unsigned int n_cells,
          const double       angle,
          const double       distortion,
          const double       factor = 1.,
          const std::string &law    = "linear elastic")
      : h(2. / n_cells)
    {
      field.angle = angle;
      // between the nodes along the crack or somewhere in a cell
      field.tip = dealii::Point<2>(0.25 * h, (angle == 0. ? -0.5 : -0.1) * h);
      mesh      = Testing::structured_mesh<2>({{n_cells, n_cells}},
                                         dealii::Point<2>(-1., -1.),
                                         dealii::Point<2>(1., 1.),
                                         distortion);
      materials.push_back(
        Materials::make_material<2>(law,
                                    1.,
                                    Testing::near_tip_poissons_ratio,
                                    field.state));
      for (const auto &x : mesh.nodes)
        displacement.push_back(factor * field.at(x).displacement);
      cracks = field.crack();
    }

    StressPointSet<2>
    points(const Source source) const
    {
      const DeformedBody<2> body   = {mesh, materials, displacement};
      const auto            region = nodes_within<2>(mesh, {field.tip}, 0.9);
      StressPointSet<2>     set;
      if (source == Source::cells)
        {
          add_cell_points(body,
                          cracks,
                          *visible_fit(mesh, cracks),
                          region,
                          set);
          return set;
        }
      std::vector<double> alpha(mesh.n_nodes(), 1.);
      if (source == Source::families_and_elements)
        for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
          {
            const double distance =
              std::abs((mesh.nodes[n] - field.tip) * field.frame().axes[1]);
            alpha[n] = std::clamp(2.5 - distance / (4. * h), 0., 1.);
          }
      const auto families =
        Testing::cut_families(mesh, alpha, 2., cracks, *materials[0]);
      add_element_points(body, alpha, region, set);
      add_family_points(body, families, region, set);
      return set;
    }

    FractureQuantities
    quantities(StressPointSet<2> set,
               const Annulus    &annulus,
               const MPI_Comm    communicator = MPI_COMM_SELF) const
    {
      return fracture_quantities(set,
                                 mesh,
                                 field.frame(),
                                 annulus,
                                 field.constants(),
                                 communicator);
    }

    double
    exact_J() const
    {
      return (field.K_I * field.K_I + field.K_II * field.K_II) /
             field.constants().plane_modulus();
    }
  };

  /// Largest of the relative errors of J, K_I and K_II.
  double
  largest_error(const Plate &plate, const FractureQuantities &found)
  {
    return std::max({std::abs(found.J / plate.exact_J() - 1.),
                     std::abs(found.K_I / plate.field.K_I - 1.),
                     std::abs(found.K_II / plate.field.K_II - 1.)});
  }

  /// Tolerances for 20, 40 and 80 cells: about 1.3 times the largest error
  /// measured.
  void
  expect_convergence(const Source                 source,
                     const std::array<double, 3> &tolerance)
  {
    for (const double angle : {0., 0.52})
      for (const double distortion : {0., 0.2})
        for (unsigned int level = 0; level < 3; ++level)
          {
            const Plate plate(20u << level, angle, distortion);
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
