#include <perimorph/damage/breaking_rule.h>
#include <perimorph/damage/thresholds.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Perimorph::Damage
{
  namespace
  {
    using Materials::PlaneState;

    constexpr double G_c = 0.37;

    BondState
    bond()
    {
      BondState state;
      state.length         = 0.4;
      state.extension      = 0.03;
      state.energy         = 2e-3;
      state.volume_product = 5e-4;
      state.horizon        = 0.6;
      state.horizon_ratio  = 2.;
      state.youngs_modulus = 2.3;
      return state;
    }

    std::unique_ptr<BreakingRule>
    rule(const Criterion criterion, const double calibration = 0.)
    {
      Limits limits;
      limits.fracture_energy = G_c;
      limits.calibration     = calibration;
      return make_breaking_rule<2>(criterion,
                                   limits,
                                   Materials::PlaneState::plane_stress,
                                   FamilyShape::ball);
    }
  } // namespace

  TEST(BreakingRule, stretch_at_its_limit)
  {
    auto         state = bond();
    const double s_c =
      critical_stretch(G_c, 2.3, 0.6, Materials::PlaneState::plane_stress);
    state.extension       = s_c * state.length;
    const auto stretching = rule(Criterion::critical_stretch);
    EXPECT_NEAR(stretching->load_factor(state), 1., 1e-14);
    state.extension *= 0.5;
    EXPECT_NEAR(stretching->load_factor(state), 2., 1e-14);
    // A calibration of 4 halves the load.
    EXPECT_NEAR(rule(Criterion::critical_stretch, 4.)->load_factor(state),
                1.,
                1e-14);
  }

  TEST(BreakingRule, stretch_that_is_given)
  {
    Limits limits;
    limits.stretch   = 0.02;
    const auto rule  = make_breaking_rule<3>(Criterion::critical_stretch,
                                            limits,
                                            PlaneState::three_dimensional,
                                            FamilyShape::cells);
    auto       state = bond();
    state.extension  = 0.01 * state.length;
    EXPECT_NEAR(rule->load_factor(state), 2., 1e-14);
    state.extension = -0.03 * state.length;
    EXPECT_TRUE(std::isinf(rule->load_factor(state)));
  }

  TEST(BreakingRule, energy_at_its_limit)
  {
    auto       state  = bond();
    const auto energy = rule(Criterion::critical_energy);
    state.energy =
      critical_energy_density<2>(G_c, 0.6) / 1.75 * state.volume_product;
    EXPECT_NEAR(energy->load_factor(state), 1., 1e-14);
    // Energies grow with the square of the loads.
    state.energy /= 9.;
    EXPECT_NEAR(energy->load_factor(state), 3., 1e-14);
    EXPECT_NEAR(rule(Criterion::critical_energy, 1.75 * 9.)->load_factor(state),
                1.,
                1e-14);
    // Another horizon ratio has another calibration.
    state.horizon_ratio = 3.;
    EXPECT_NEAR(energy->load_factor(state), 3. * std::sqrt(1.75 / 1.26), 1e-13);
  }

  TEST(BreakingRule, bonds_that_do_not_extend_never_break)
  {
    auto state      = bond();
    state.extension = -0.03;
    for (const auto criterion :
         {Criterion::critical_stretch, Criterion::critical_energy})
      EXPECT_TRUE(std::isinf(rule(criterion)->load_factor(state)));
    state        = bond();
    state.energy = -1e-3;
    EXPECT_TRUE(
      std::isinf(rule(Criterion::critical_energy)->load_factor(state)));
  }
} // namespace Perimorph::Damage
