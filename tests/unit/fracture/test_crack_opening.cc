#include <perimorph/fracture/crack_opening.h>

#include "near_tip_bodies.h"
#include <gtest/gtest.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;

  /// K(r) of the near-tip field is constant and the stress T does not open the
  /// crack: only the error of the traces remains. Tolerances for 20, 40 and 80
  /// cells: about 1.3 times the largest errors measured.
  void
  expect_convergence(Testing::NearTipCase         field,
                     const std::array<double, 3> &opening,
                     const std::array<double, 3> &sliding)
  {
    for (const double angle : {0., 0.52})
      for (const double distortion : {0., 0.2})
        for (unsigned int level = 0; level < 3; ++level)
          {
            const unsigned int n_cells = 20u << level;
            const double       h       = 2. / n_cells;
            field.angle                = angle;
            field.tip                  = dealii::Point<2>(0.3 * h, -0.4 * h);
            const auto mesh =
              Testing::structured_mesh<2>({{n_cells, n_cells}},
                                          dealii::Point<2>(-1., -1.),
                                          dealii::Point<2>(1., 1.),
                                          distortion);
            std::vector<dealii::Tensor<1, 2>> displacement;
            for (const auto &x : mesh.nodes)
              displacement.push_back(field.at(x).displacement);
            const auto cracks = field.crack();
            const auto found  = factors_from_opening(*visible_fit(mesh, cracks),
                                                    displacement,
                                                    field.frame(),
                                                    0.15,
                                                    field.constants());
            EXPECT_EQ(found.n_places, 16u);
            EXPECT_LT(std::abs(found.K_I / field.K_I - 1.), opening[level])
              << "level " << level;
            EXPECT_LT(std::abs(found.K_II / field.K_II - 1.), sliding[level])
              << "level " << level;
          }
  }

  TEST(CrackOpening, factors_of_the_exact_field_converge)
  {
    expect_convergence({},
                       {{4.6e-2, 4.7e-3, 1.1e-3}},
                       {{0.18, 2.2e-2, 1.6e-3}});
  }

  TEST(CrackOpening, factors_converge_in_an_anisotropic_body)
  {
    Testing::NearTipCase field;
    field.stiffness = Testing::graphite_epoxy(0.9);
    expect_convergence(field,
                       {{5.6e-2, 6.1e-3, 1.4e-3}},
                       {{0.14, 2.5e-2, 7.7e-3}});
  }

  TEST(CrackOpening, nearest_place_under_refinement)
  {
    EXPECT_EQ(nearest_place(2., 0.01, false), 0.3);
    EXPECT_EQ(nearest_place(2., 1., true), 0.3);
    for (const double horizon : {0.2, 0.05})
      EXPECT_NEAR(nearest_place(2., horizon, true) /
                    nearest_place(2., horizon / 4., true),
                  2.,
                  1e-14);
  }

  TEST(CrackOpening, no_nodes_no_number)
  {
    Testing::NearTipCase                    field;
    const auto                              mesh = Testing::unit_mesh<2>(4);
    DisplacementFit<2>                      fit(mesh);
    const std::vector<dealii::Tensor<1, 2>> displacement(mesh.n_nodes());
    fit.set_visibility(
      [](const dealii::Point<2> &, const unsigned int) { return false; });
    const auto found = factors_from_opening(fit,
                                            displacement,
                                            field.frame(),
                                            0.15,
                                            field.constants());
    EXPECT_EQ(found.n_places, 0u);
    EXPECT_TRUE(std::isnan(found.K_I));
  }
} // namespace
