#include <perimorph/fracture/crack_opening.h>

#include "near_tip_bodies.h"
#include <gtest/gtest.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;

  // K(r) of the near-tip field is constant and the stress T does not open the
  // crack: only the error of the traces remains.
  TEST(CrackOpening, factors_of_the_exact_field_converge)
  {
    // about 1.3 times the largest errors measured
    const double opening[] = {4.6e-2, 4.7e-3, 1.1e-3};
    const double sliding[] = {0.18, 2.2e-2, 1.6e-3};
    for (const double angle : {0., 0.52})
      for (const double distortion : {0., 0.2})
        for (unsigned int level = 0; level < 3; ++level)
          {
            const unsigned int   n_cells = 20u << level;
            const double         h       = 2. / n_cells;
            Testing::NearTipCase field;
            field.angle = angle;
            field.tip   = dealii::Point<2>(0.3 * h, -0.4 * h);
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
                                                    1.,
                                                    field.constants());
            EXPECT_EQ(found.n_places, 16u);
            EXPECT_NEAR(found.K_I / field.K_I, 1., opening[level]);
            EXPECT_NEAR(found.K_II / field.K_II, 1., sliding[level]);
          }
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
                                            1.,
                                            field.constants());
    EXPECT_EQ(found.n_places, 0u);
    EXPECT_TRUE(std::isnan(found.K_I));
  }
} // namespace
