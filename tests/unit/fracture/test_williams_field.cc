#include <perimorph/fracture/williams_field.h>
#include <perimorph/materials/linear_elastic.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;

  const double pi = std::acos(-1.);

  template <int dim>
  TipFrame<dim>
  turned_frame()
  {
    if constexpr (dim == 2)
      return tip_frame(dealii::Point<2>(0.3, -0.2),
                       dealii::Tensor<1, 2>({std::cos(0.7), std::sin(0.7)}));
    else
      {
        TipFrame<3> frame;
        frame.origin  = dealii::Point<3>(0.3, -0.2, 0.1);
        frame.axes[0] = dealii::Tensor<1, 3>({2. / 3., 2. / 3., 1. / 3.});
        frame.axes[1] = dealii::Tensor<1, 3>({-2. / 3., 1. / 3., 2. / 3.});
        frame.axes[2] = cross_product_3d(frame.axes[0], frame.axes[1]);
        return frame;
      }
  }

  template <int dim>
  void
  expect_solution_of_elasticity(const NearTipField field,
                                const PlaneState   state)
  {
    const Materials::LinearElastic<dim> law(2.6, 0.3, state);
    const auto                          constants = isotropic_constants(law);
    const auto                          frame     = turned_frame<dim>();
    const auto                          at = [&](const dealii::Point<dim> &x) {
      return near_tip_state(field, constants, frame, x);
    };
    const double step = 1e-5;
    for (const double angle : {-3., -1.2, 0.4, 2.2, 3.1})
      {
        const auto x = frame.origin + 0.8 * std::cos(angle) * frame.axes[0] +
                       0.8 * std::sin(angle) * frame.axes[1];
        const auto here   = at(x);
        const auto stress = law.first_piola_kirchhoff(here.gradient);
        dealii::Tensor<1, dim> divergence;
        for (int j = 0; j < dim; ++j)
          {
            dealii::Point<dim> after = x, before = x;
            after[j] += step;
            before[j] -= step;
            const auto next = at(after), last = at(before);
            for (int i = 0; i < dim; ++i)
              {
                EXPECT_NEAR(here.gradient[i][j],
                            (next.displacement[i] - last.displacement[i]) /
                              (2. * step),
                            1e-8);
                EXPECT_NEAR(here.stress[i][j], stress[i][j], 1e-13);
                divergence[i] +=
                  (next.stress[i][j] - last.stress[i][j]) / (2. * step);
              }
          }
        EXPECT_LT(divergence.norm(), 1e-8);
      }
    // no traction on the faces
    for (const double side : {-1., 1.})
      {
        const auto x =
          frame.origin - 0.5 * frame.axes[0] + side * 1e-12 * frame.axes[1];
        EXPECT_LT((at(x).stress * frame.axes[1]).norm(), 1e-10);
      }
  }

  TEST(WilliamsField, solves_elasticity)
  {
    for (const auto field : {NearTipField::opening,
                             NearTipField::sliding,
                             NearTipField::point_force})
      {
        expect_solution_of_elasticity<2>(field, PlaneState::plane_stress);
        expect_solution_of_elasticity<2>(field, PlaneState::plane_strain);
        expect_solution_of_elasticity<3>(field, PlaneState::three_dimensional);
      }
    expect_solution_of_elasticity<3>(NearTipField::tearing,
                                     PlaneState::three_dimensional);
  }

  // Definition: (s_12, s_22, s_23) = (K_II, K_I, K_III) / sqrt(2 pi r) ahead.
  TEST(WilliamsField, has_unit_stress_intensity_ahead_of_the_tip)
  {
    const IsotropicConstants constants = {1., 1.8};
    const auto               frame     = turned_frame<3>();
    const auto               ahead     = frame.origin + 0.25 * frame.axes[0];
    const double             expected  = 1. / std::sqrt(2. * pi * 0.25);
    const NearTipField       fields[]  = {NearTipField::sliding,
                                          NearTipField::opening,
                                          NearTipField::tearing};
    for (int mode = 0; mode < 3; ++mode)
      {
        const auto traction =
          near_tip_state(fields[mode], constants, frame, ahead).stress *
          frame.axes[1];
        for (int a = 0; a < 3; ++a)
          EXPECT_NEAR(traction * frame.axes[a],
                      a == mode ? expected : 0.,
                      1e-14);
      }
  }

  TEST(WilliamsField, point_force_is_balanced_by_the_stress_around)
  {
    const auto           frame = turned_frame<2>();
    const int            n     = 200;
    dealii::Tensor<1, 2> force;
    for (int k = 0; k < n; ++k)
      {
        const double angle = -pi + 2. * pi * (k + 0.5) / n;
        const auto   normal =
          std::cos(angle) * frame.axes[0] + std::sin(angle) * frame.axes[1];
        force += 2. * pi * 0.3 / n *
                 (near_tip_state(NearTipField::point_force,
                                 IsotropicConstants{1., 2.},
                                 frame,
                                 frame.origin + 0.3 * normal)
                    .stress *
                  normal);
      }
    EXPECT_LT((force + frame.axes[0]).norm(), 1e-12);
  }

  TEST(WilliamsField, constants_of_plane_stress_and_plane_strain)
  {
    const auto constants = [](const PlaneState state) {
      return isotropic_constants(Materials::LinearElastic<2>(2.6, 0.3, state));
    };
    EXPECT_NEAR(constants(PlaneState::plane_stress).kolosov, 2.7 / 1.3, 1e-14);
    EXPECT_NEAR(constants(PlaneState::plane_strain).kolosov, 1.8, 1e-14);
    EXPECT_NEAR(constants(PlaneState::plane_stress).plane_modulus(),
                2.6,
                1e-14);
    EXPECT_NEAR(constants(PlaneState::plane_strain).plane_modulus(),
                2.6 / 0.91,
                1e-14);
  }
} // namespace
