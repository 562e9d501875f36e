#include <perimorph/fracture/lekhnitskii_field.h>
#include <perimorph/materials/linear_elastic.h>

#include "plane_stiffness_law.h"
#include <gtest/gtest.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Testing::PlaneStiffnessLaw;

  const double pi = std::acos(-1.);

  constexpr NearTipField fields[] = {NearTipField::opening,
                                     NearTipField::sliding,
                                     NearTipField::point_force};

  TipFrame<2>
  turned_frame()
  {
    return tip_frame(dealii::Point<2>(0.3, -0.2),
                     dealii::Tensor<1, 2>({std::cos(0.7), std::sin(0.7)}));
  }

  const double fibre_angles[] = {0., 0.3, 0.7, 1.5, 2.6};

  TEST(LekhnitskiiField, solves_elasticity)
  {
    const auto   frame = turned_frame();
    const double step  = 1e-5;
    for (const double fibre : fibre_angles)
      for (const auto field : fields)
        {
          const auto law = PlaneStiffnessLaw(Testing::graphite_epoxy(fibre));
          const auto constants = *near_tip_constants(law, frame);
          ASSERT_TRUE(std::holds_alternative<AnisotropicConstants>(constants));
          const auto at = [&](const dealii::Point<2> &x) {
            return near_tip_state(field, constants, frame, x);
          };
          for (const double angle : {-3., -1.2, 0.4, 2.2, 3.1})
            {
              const auto x = frame.origin +
                             0.8 * std::cos(angle) * frame.axes[0] +
                             0.8 * std::sin(angle) * frame.axes[1];
              const auto here = at(x);
              EXPECT_LT(
                (here.stress - law.first_piola_kirchhoff(here.gradient)).norm(),
                1e-13);
              dealii::Tensor<1, 2> divergence;
              for (int j = 0; j < 2; ++j)
                {
                  dealii::Point<2> after = x, before = x;
                  after[j] += step;
                  before[j] -= step;
                  const auto next = at(after), last = at(before);
                  for (int i = 0; i < 2; ++i)
                    {
                      EXPECT_NEAR(
                        here.gradient[i][j],
                        (next.displacement[i] - last.displacement[i]) /
                          (2. * step),
                        1e-8);
                      divergence[i] +=
                        (next.stress[i][j] - last.stress[i][j]) / (2. * step);
                    }
                }
              EXPECT_LT(divergence.norm(), 1e-8);
            }
          // no traction on the faces
          for (const double side : {-1., 1.})
            {
              const auto x = frame.origin - 0.5 * frame.axes[0] +
                             side * 1e-13 * frame.axes[1];
              EXPECT_LT((at(x).stress * frame.axes[1]).norm(), 1e-11);
            }
        }
  }

  // Definition of K ahead of the tip; behind it the faces open by
  // sqrt(8 r / pi) L^-1 K.
  TEST(LekhnitskiiField, has_unit_factors_and_opens_by_the_barnett_lothe_tensor)
  {
    for (const double fibre : fibre_angles)
      {
        const auto frame = turned_frame();
        const auto constants =
          *near_tip_constants(PlaneStiffnessLaw(Testing::graphite_epoxy(fibre)),
                              frame);
        const auto L_inverse = inverse_barnett_lothe_tensor(constants);
        for (int mode = 0; mode < 2; ++mode)
          {
            const auto field =
              mode == 0 ? NearTipField::sliding : NearTipField::opening;
            const double r = 0.25;
            const auto   traction =
              near_tip_state(field,
                             constants,
                             frame,
                             frame.origin + r * frame.axes[0])
                .stress *
              frame.axes[1];
            // exactly on the crack: the sign of zero says which side
            const TipFrame<2> at_origin =
              tip_frame(dealii::Point<2>(), dealii::Tensor<1, 2>({1., 0.}));
            const auto face = [&](const double y) {
              return near_tip_state(field,
                                    constants,
                                    at_origin,
                                    dealii::Point<2>(-r, y))
                .displacement;
            };
            const auto opening = face(1e-16) - face(-1e-16);
            for (int a = 0; a < 2; ++a)
              {
                EXPECT_NEAR(traction * frame.axes[a],
                            a == mode ? 1. / std::sqrt(2. * pi * r) : 0.,
                            1e-14);
                EXPECT_NEAR(opening[a],
                            std::sqrt(8. * r / pi) * L_inverse[a][mode],
                            1e-13);
              }
          }
      }
  }

  TEST(LekhnitskiiField, point_force_is_balanced_by_the_stress_around)
  {
    const auto frame = turned_frame();
    const auto constants =
      *near_tip_constants(PlaneStiffnessLaw(Testing::graphite_epoxy(0.3)),
                          frame);
    const int            n = 400;
    dealii::Tensor<1, 2> force;
    for (int k = 0; k < n; ++k)
      {
        const double angle = -pi + 2. * pi * (k + 0.5) / n;
        const auto   normal =
          std::cos(angle) * frame.axes[0] + std::sin(angle) * frame.axes[1];
        force += 2. * pi * 0.3 / n *
                 (near_tip_state(NearTipField::point_force,
                                 constants,
                                 frame,
                                 frame.origin + 0.3 * normal)
                    .stress *
                  normal);
      }
    EXPECT_LT((force + frame.axes[0]).norm(), 1e-12);
  }

  // Equal roots give the field of Muskhelishvili; nearly equal ones differ from
  // it as the constants do, down to round-off.
  TEST(LekhnitskiiField, isotropic_limit)
  {
    const double modulus = 2.6, nu = 0.3;
    const auto   frame =
      tip_frame(dealii::Point<2>(), dealii::Tensor<1, 2>({1., 0.}));
    const Materials::LinearElastic<2> law(modulus,
                                          nu,
                                          Materials::PlaneState::plane_stress);
    const auto                        isotropic = isotropic_constants(law);
    double                            round_off = 0.;
    for (const double difference : {0., 1e-15, 1e-13, 1e-11, 1e-8, 1e-5})
      {
        const auto constants = anisotropic_constants(
          invert(Testing::orthotropic_stiffness(modulus,
                                                modulus * (1. + difference),
                                                0.5 * modulus / (1. + nu),
                                                nu,
                                                0.2)));
        for (const auto field : fields)
          for (const double angle : {-3.1, -1.2, 0., 0.4, 2.2})
            {
              const double x = 0.5 * std::cos(angle), y = 0.5 * std::sin(angle);
              const auto   exact =
                near_tip_state(field, isotropic, frame, dealii::Point<2>(x, y));
              const auto   found = lekhnitskii_state(field, constants, x, y);
              const double tolerance = 1e-14 + 3. * difference;
              EXPECT_LT((found.stress - exact.stress).norm(), tolerance);
              EXPECT_LT((found.gradient - exact.gradient).norm(), tolerance);
              if (difference == 0.)
                round_off =
                  std::max(round_off, (found.stress - exact.stress).norm());
              // the displacement of a point force up to a rigid motion
              if (field != NearTipField::point_force)
                {
                  EXPECT_LT((found.displacement - exact.displacement).norm(),
                            tolerance);
                }
            }
      }
    EXPECT_LT(round_off, 5e-15);
  }
} // namespace
