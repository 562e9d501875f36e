#include <perimorph/damage/strength_rules.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Perimorph::Damage
{
  namespace
  {
    const Strengths hta = {1670., 60., 70.};

    /// Axis 1 at this angle from x, about z.
    dealii::Tensor<2, 3>
    fibres(const double degrees)
    {
      const double         t = degrees * std::acos(-1.) / 180.;
      dealii::Tensor<2, 3> axes;
      axes[0][0] = axes[1][1] = std::cos(t);
      axes[0][1]              = std::sin(t);
      axes[1][0]              = -std::sin(t);
      axes[2][2]              = 1.;
      return axes;
    }

    dealii::SymmetricTensor<2, 3>
    stress(const int i, const int j, const double value)
    {
      dealii::SymmetricTensor<2, 3> tensor;
      tensor[i][j] = value;
      return tensor;
    }

    BondState
    bond(const double degrees, const double extension = 1e-3)
    {
      BondState state;
      state.extension = extension;
      state.stress    = stress(0, 0, 1.);
      state.axes      = fibres(degrees);
      state.strengths = hta;
      return state;
    }
  } // namespace

  TEST(StrengthRules, off_axis_tension_of_a_ply)
  {
    // reference/tsai_hill_HTA6376.csv: angle, Tsai-Hill, maximum stress.
    const double table[][3] = {{0., 1670., 1670.},
                               {5., 724.5394877, 806.2278676},
                               {25., 160.1477031, 182.7570205},
                               {30., 133.9168407, 161.6580754},
                               {45., 91.11079228, 120.},
                               {60., 71.70891488, 80.},
                               {90., 60., 60.}};
    for (const auto &[angle, tsai_hill, maximum] : table)
      {
        EXPECT_NEAR(
          make_strength_rule(Criterion::tsai_hill)->load_factor(bond(angle)) /
            tsai_hill,
          1.,
          1e-9);
        EXPECT_NEAR(make_strength_rule(Criterion::maximum_stress)
                        ->load_factor(bond(angle)) /
                      maximum,
                    1.,
                    1e-9);
        // The other side of the fibres.
        EXPECT_NEAR(
          make_strength_rule(Criterion::tsai_hill)->load_factor(bond(-angle)) /
            tsai_hill,
          1.,
          1e-9);
      }
  }

  TEST(StrengthRules, biaxial_tension_helps_along_the_fibres)
  {
    auto both  = stress(0, 0, 1000.);
    both[1][1] = 40.;
    EXPECT_NEAR(tsai_hill_index(both, fibres(0.), hta),
                (1000. * 1000. - 1000. * 40.) / (1670. * 1670.) +
                  40. * 40. / 3600.,
                1e-14);
    EXPECT_NEAR(maximum_stress_index(both, fibres(0.), hta),
                40. * 40. / 3600.,
                1e-14);
  }

  TEST(StrengthRules, compression_does_not_count)
  {
    for (const auto index : {tsai_hill_index, maximum_stress_index})
      {
        EXPECT_EQ(index(stress(0, 0, -5000.), fibres(0.), hta), 0.);
        EXPECT_EQ(index(stress(1, 1, -500.), fibres(0.), hta), 0.);
        auto sheared  = stress(0, 1, 70.);
        sheared[1][1] = -500.;
        EXPECT_NEAR(index(sheared, fibres(0.), hta), 1., 1e-14);
      }
    for (const auto criterion :
         {Criterion::tsai_hill, Criterion::maximum_stress})
      {
        EXPECT_TRUE(std::isinf(
          make_strength_rule(criterion)->load_factor(bond(45., -1e-3))));
        auto nothing   = bond(0.);
        nothing.stress = stress(0, 0, -1.);
        EXPECT_TRUE(
          std::isinf(make_strength_rule(criterion)->load_factor(nothing)));
      }
  }

  TEST(StrengthRules, all_directions_across_the_fibres_are_alike)
  {
    // Turned about the fibres (x) by any angle.
    auto tensor  = stress(0, 0, 300.);
    tensor[1][1] = 50.;
    tensor[2][2] = 20.;
    tensor[1][2] = 10.;
    tensor[0][1] = 30.;
    tensor[0][2] = -20.;
    for (const auto index : {tsai_hill_index, maximum_stress_index})
      {
        const double value = index(tensor, fibres(0.), hta);
        for (const double t : {0.4, 1.3, 2.9})
          {
            dealii::Tensor<2, 3> axes;
            axes[0][0] = 1.;
            axes[1][1] = axes[2][2] = std::cos(t);
            axes[1][2]              = std::sin(t);
            axes[2][1]              = -std::sin(t);
            EXPECT_NEAR(index(tensor, axes, hta), value, 1e-13);
          }
        // Shear across the fibres is tension in one direction.
        EXPECT_GT(index(stress(1, 2, 60.), fibres(0.), hta), 0.99);
      }
  }

  TEST(StrengthRules, planes_of_failure_follow_the_fibres)
  {
    const auto is_along = [](const dealii::Tensor<1, 3> &normal,
                             const dealii::Tensor<1, 3> &expected) {
      EXPECT_NEAR(normal.norm(), 1., 1e-14);
      EXPECT_NEAR(std::abs(normal * expected), 1., 1e-12);
    };
    for (const double angle : {0., 30., 60., 90., -45.})
      {
        const auto axes = fibres(angle);
        const auto row  = [&](const unsigned int a) {
          return dealii::Tensor<1, 3>({axes[a][0], axes[a][1], axes[a][2]});
        };
        const auto global = [&](const dealii::SymmetricTensor<2, 3> &local) {
          return symmetrize(transpose(axes) * dealii::Tensor<2, 3>(local) *
                            axes);
        };
        // Fibres fail, they are torn apart, they slide.
        auto local  = stress(0, 0, 1600.);
        local[1][1] = 10.;
        is_along(failure_plane_normal(global(local), axes, hta), row(0));
        local[0][0] = 200.;
        is_along(failure_plane_normal(global(local), axes, hta), row(1));
        is_along(failure_plane_normal(global(stress(0, 1, 20.)), axes, hta),
                 row(1));
        is_along(failure_plane_normal(global(stress(0, 2, -20.)), axes, hta),
                 row(2));
        // The larger principal tension across the fibres.
        auto across  = stress(1, 2, 8.);
        across[1][1] = 12.;
        is_along(failure_plane_normal(global(across), axes, hta),
                 (2. * row(1) + row(2)) / std::sqrt(5.));
      }
  }
} // namespace Perimorph::Damage
