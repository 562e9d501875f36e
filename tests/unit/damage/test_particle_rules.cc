#include <perimorph/damage/particle_rules.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Perimorph::Damage
{
  namespace
  {
    const double pi = std::acos(-1.);

    dealii::SymmetricTensor<2, 3>
    diagonal(const double a, const double b, const double c)
    {
      dealii::SymmetricTensor<2, 3> tensor;
      tensor[0][0] = a;
      tensor[1][1] = b;
      tensor[2][2] = c;
      return tensor;
    }

    /// Bond along the first axis in a field of uniform strain.
    BondState
    bond_in(const dealii::SymmetricTensor<2, 3> &strain)
    {
      BondState state;
      state.strain             = strain;
      state.direction[0]       = 1.;
      state.relative           = strain * state.direction;
      state.largest_dilatation = trace(strain);
      return state;
    }

    double
    factor(const Criterion  criterion,
           const Limits    &limits,
           const BondState &state)
    {
      return make_particle_rule(criterion, limits)->load_factor(state);
    }
  } // namespace

  TEST(ParticleRules,
       equivalent_strain_of_incompressible_stretch_is_the_stretch)
  {
    EXPECT_NEAR(equivalent_strain(diagonal(0.3, -0.15, -0.15)), 0.3, 1e-15);
    // Any dilatation on top does not count.
    EXPECT_NEAR(equivalent_strain(diagonal(0.5, 0.05, 0.05)), 0.3, 1e-15);
    // Pure shear: 2 / sqrt(3) times its tensor component.
    dealii::SymmetricTensor<2, 3> shear;
    shear[0][1] = 0.3;
    EXPECT_NEAR(equivalent_strain(shear), 0.6 / std::sqrt(3.), 1e-15);
  }

  TEST(ParticleRules, bond_strain_is_that_of_the_deviator)
  {
    auto strain      = diagonal(0.3, 0.1, -0.1);
    strain[0][1]     = 0.04;
    const auto state = bond_in(strain);
    // (0.3 - 0.1, 0.04)
    EXPECT_NEAR(deviatoric_bond_strain(state), std::hypot(0.2, 0.04), 1e-15);
    Limits limits;
    limits.bond_strain = 0.5;
    EXPECT_NEAR(factor(Criterion::bond_strain, limits, state),
                0.5 / std::hypot(0.2, 0.04),
                1e-14);
    // Not where both ends are compressed.
    auto compressed               = bond_in(diagonal(-0.3, -0.1, 0.1));
    compressed.largest_dilatation = -0.3;
    EXPECT_TRUE(std::isinf(factor(Criterion::bond_strain, limits, compressed)));
  }

  TEST(ParticleRules, volume_grows_to_its_limit)
  {
    Limits limits;
    limits.volumetric_strain = 0.6;
    const auto state         = bond_in(diagonal(0.3, 0.1, -0.1));
    EXPECT_NEAR(factor(Criterion::volumetric_strain, limits, state), 2., 1e-14);
    EXPECT_TRUE(std::isinf(factor(Criterion::volumetric_strain,
                                  limits,
                                  bond_in(diagonal(-0.3, 0.1, 0.1)))));
  }

  TEST(ParticleRules, tension_and_shear_of_mohr_coulomb)
  {
    Limits limits;
    limits.tensile_strength = 3.;
    EXPECT_NEAR(mohr_coulomb_load_factor(diagonal(1.5, -9., 0.), limits),
                2.,
                1e-14);
    EXPECT_TRUE(
      std::isinf(mohr_coulomb_load_factor(diagonal(-1., -9., -2.), limits)));
    // Uniaxial compression fails at 2 C cos phi / (1 - sin phi).
    limits.cohesion       = 2.;
    limits.friction_angle = 30.;
    const double strength = 4. * std::cos(pi / 6.) / (1. - 0.5);
    EXPECT_NEAR(mohr_coulomb_load_factor(diagonal(0., -strength, 0.), limits),
                1.,
                1e-12);
    // Uniaxial tension at 2 C cos phi / (1 + sin phi) = 2.309, below f_t.
    EXPECT_NEAR(mohr_coulomb_load_factor(diagonal(1., 0., 0.), limits),
                4. * std::cos(pi / 6.) / 1.5,
                1e-12);
    // Pressure from all sides never does.
    EXPECT_TRUE(
      std::isinf(mohr_coulomb_load_factor(diagonal(-1., -1., -1.), limits)));
    // Without friction: Tresca.
    limits.friction_angle   = 0.;
    limits.tensile_strength = 100.;
    EXPECT_NEAR(mohr_coulomb_load_factor(diagonal(1., -1., 0.), limits),
                2.,
                1e-14);
  }
} // namespace Perimorph::Damage
