#include <perimorph/fracture/near_tip_constants.h>
#include <perimorph/materials/linear_elastic.h>

#include "plane_stiffness_law.h"
#include <gtest/gtest.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;
  using Testing::PlaneStiffnessLaw;

  const double degree = std::acos(-1.) / 180.;

  TipFrame<2>
  turned(const double angle)
  {
    return tip_frame(dealii::Point<2>(),
                     dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
  }

  struct LotheCase
  {
    double E_1, E_2, shear_modulus, poissons_ratio; ///< [MPa]
    double fibre;            ///< from the crack [degrees]
    double L_11, L_12, L_22; ///< of the inverse [1e-6 / MPa]
  };

  // Roots of Lekhnitskii's polynomial by numpy, Hattori et al. (2017), Eq.
  // (33); graphite-epoxy and HTA/6376 of sections 6.1 and 6.2.
  TEST(NearTipConstants, barnett_lothe_tensor_of_composites)
  {
    const LotheCase cases[] = {
      {144.8e3, 11.7e3, 9.66e3, .21, 0., 32.10068917, 0., 112.9290582},
      {144.8e3,
       11.7e3,
       9.66e3,
       .21,
       30.,
       52.30778143,
       -34.99971048,
       92.72196597},
      {144.8e3, 11.7e3, 9.66e3, .21, 45., 72.5148737, -40.41418453, 72.5148737},
      {144.8e3,
       11.7e3,
       9.66e3,
       .21,
       60.,
       92.72196597,
       -34.99971048,
       52.30778143},
      {144.8e3, 11.7e3, 9.66e3, .21, 90., 112.9290582, 0., 32.10068917},
      {136e3, 8.75e3, 5.5e3, .3, 0., 41.60241798, 0., 164.0151633},
      {136e3, 8.75e3, 5.5e3, .3, 30., 72.20560431, -53.0062736, 133.411977},
      {136e3, 8.75e3, 5.5e3, .3, 45., 102.8087906, -61.20637266, 102.8087906},
      {136e3, 8.75e3, 5.5e3, .3, 60., 133.411977, -53.0062736, 72.20560431},
      {136e3, 8.75e3, 5.5e3, .3, 90., 164.0151633, 0., 41.60241798},
      {200e3,
       200e3 * (1. + 1e-7),
       200e3 / 2.6,
       .3,
       0.,
       9.999999875,
       0.,
       9.999999375},
    };
    // the crack turned, and the fibres with it: the same numbers
    for (const double crack : {0., 20. * degree, -2.})
      for (const auto &known : cases)
        {
          const PlaneStiffnessLaw law(
            Testing::orthotropic_stiffness(known.E_1,
                                           known.E_2,
                                           known.shear_modulus,
                                           known.poissons_ratio,
                                           crack + known.fibre * degree));
          EXPECT_FALSE(is_isotropic(law));
          const auto found = inverse_barnett_lothe_tensor(
            *near_tip_constants(law, turned(crack)));
          // the table has ten digits
          const double tolerance = 1e-9 * (known.L_11 + known.L_22);
          EXPECT_NEAR(1e6 * found[0][0], known.L_11, tolerance);
          EXPECT_NEAR(1e6 * found[0][1], known.L_12, tolerance);
          EXPECT_NEAR(1e6 * found[1][1], known.L_22, tolerance);
        }
  }

  // The sum and the product of double roots keep all digits.
  TEST(NearTipConstants, nearly_isotropic_laws_lose_no_digits)
  {
    const double modulus = 2.6, nu = 0.3;
    for (const double difference : {0., 1e-15, 1e-12, 1e-9, 1e-6, 1e-4})
      for (const double angle : {0., 0.4})
        {
          const auto found = inverse_barnett_lothe_tensor(anisotropic_constants(
            invert(Testing::orthotropic_stiffness(modulus,
                                                  modulus * (1. + difference),
                                                  0.5 * modulus / (1. + nu),
                                                  nu,
                                                  angle))));
          const double expected  = 2. / modulus;
          const double tolerance = (1e-14 + difference) * expected;
          EXPECT_NEAR(found[0][0], expected, tolerance);
          EXPECT_NEAR(found[1][1], expected, tolerance);
          EXPECT_NEAR(found[0][1], 0., tolerance);
        }
  }

  TEST(NearTipConstants, of_isotropic_laws_do_not_depend_on_the_axes)
  {
    for (const auto state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      {
        const Materials::LinearElastic<2> law(2.6, 0.3, state);
        ASSERT_TRUE(is_isotropic(law));
        const double modulus =
          state == PlaneState::plane_stress ? 2.6 : 2.6 / 0.91;
        for (const double angle : {0., 0.7})
          {
            const auto constants = *near_tip_constants(law, turned(angle));
            ASSERT_TRUE(std::holds_alternative<IsotropicConstants>(constants));
            EXPECT_NEAR(axial_compliance(constants), 1. / modulus, 1e-15);
            const auto tensor = inverse_barnett_lothe_tensor(constants);
            EXPECT_NEAR(tensor[0][0], 2. / modulus, 1e-15);
            EXPECT_EQ(tensor[0][1], 0.);
            // the reduced compliances of plane strain are those of the tangent
            const auto other =
              anisotropic_constants(plane_compliance(law, turned(angle)));
            EXPECT_NEAR(axial_compliance(other), 1. / modulus, 1e-15);
            EXPECT_LT((inverse_barnett_lothe_tensor(other) - tensor).norm(),
                      1e-14);
          }
      }
  }
} // namespace
