#include <perimorph/damage/saw_tooth.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Perimorph::Damage
{
  // The law of Hashim (2021), Eq. (6.1), at the mean share of each tooth.
  TEST(SawTooth, follows_the_tanh_law)
  {
    const double   start = 0.75, beta = 3.;
    const SawTooth teeth(6, start, beta);
    for (unsigned int l = 0; l < 6; ++l)
      {
        const double s = teeth.stretch(l);
        const double T =
          0.5 * (1. - std::tanh(beta * (start + 1. - 2. * s) / (start - 1.)));
        EXPECT_NEAR(T, 1. - (l + 0.5) / 6., 1e-14);
        EXPECT_GT(s, start);
        EXPECT_LT(s, 1.);
      }
    // Flat and steep laws stay between s_min and s_cr.
    EXPECT_EQ(SawTooth(6, 0.75, 0.1).stretch(0), 0.75);
    EXPECT_EQ(SawTooth(6, 0.75, 0.1).stretch(5), 1.);
    EXPECT_NEAR(SawTooth(6, 0.75, 1e6).stretch(5), 0.875, 1e-5);
  }

  namespace
  {
    constexpr double G_c = 0.37;

    BondState
    bond()
    {
      BondState state;
      state.length         = 0.4;
      state.energy         = 1.;
      state.volume_product = 1.;
      state.horizon        = 0.6;
      state.horizon_ratio  = 3.;
      state.youngs_modulus = 2.3;
      state.extension      = 0.4 * critical_stretch_of_lattice<2>(
                                G_c,
                                2.3,
                                0.6,
                                3.,
                                Materials::PlaneState::plane_stress);
      return state;
    }
  } // namespace

  TEST(SawTooth, one_tooth_breaks_at_the_critical_stretch)
  {
    EXPECT_NEAR(SawTooth(1).stretch(0), 1., 1e-14);
  }

  TEST(SawTooth, all_teeth_take_the_energy_of_the_bond)
  {
    // 1/2 (f_l - f_{l+1}) k s_l^2, in units of k s_c^2 / 2.
    for (const unsigned int n : {2, 6, 20})
      {
        const SawTooth teeth(n);
        double         energy = 0.;
        for (unsigned int l = 0; l < n; ++l)
          energy += teeth.stretch(l) * teeth.stretch(l) / n;
        EXPECT_NEAR(energy, 1., 1e-14);
      }
  }

  TEST(SawTooth, teeth_follow_a_line)
  {
    // Force f s between s_0, f = 1, and 4 s_0, f = 0: 3 f s + s = 4 s_0 at the
    // middle of each tooth.
    const SawTooth teeth(6);
    const auto     place = [&](const unsigned int l) {
      const double f = 1. - (l + 0.5) / 6.;
      return (3. * f + 1.) * teeth.stretch(l);
    };
    for (unsigned int l = 1; l < 6; ++l)
      {
        EXPECT_NEAR(place(l), place(0), 1e-13);
        EXPECT_GT(teeth.stretch(l), teeth.stretch(l - 1));
      }
    // Many teeth: the area below the line, s_c^2 = 4 s_0^2.
    EXPECT_NEAR(SawTooth(100000).stretch(0), 0.5, 1e-5);
  }

  TEST(SawTooth, rule_of_bonds)
  {
    const auto load = [](const Limits      &limits,
                         const unsigned int n_teeth,
                         const BondState   &state) {
      return make_saw_tooth_rule<2>(limits,
                                    n_teeth,
                                    Materials::PlaneState::plane_stress)
        ->load_factor(state);
    };
    auto   state = bond();
    Limits limits;
    limits.fracture_energy = G_c;
    EXPECT_NEAR(load(limits, 1, state), 1., 1e-13);
    limits.calibration = 4.;
    EXPECT_NEAR(load(limits, 1, state), 0.5, 1e-13);
    limits.calibration = 0.;
    state.teeth_lost   = 4;
    EXPECT_NEAR(load(limits, 6, state), SawTooth(6).stretch(4), 1e-13);
    limits.stretch = 3. * state.extension / state.length;
    EXPECT_NEAR(load(limits, 6, state), 3. * SawTooth(6).stretch(4), 1e-13);
    state.extension *= -1.;
    EXPECT_TRUE(std::isinf(load(limits, 6, state)));
  }
} // namespace Perimorph::Damage
