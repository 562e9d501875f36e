#include <perimorph/base/exceptions.h>
#include <perimorph/peridynamics/bond_based.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace Perimorph;
using namespace Perimorph::Peridynamics;
using Materials::PlaneState;

namespace
{
  template <int dim>
  struct Bond
  {
    const double           k = 3.7;
    dealii::Tensor<1, dim> xi;
    dealii::Tensor<1, dim> eta;

    Bond()
    {
      for (int d = 0; d < dim; ++d)
        {
          xi[d]  = 0.3 - 0.2 * d;
          eta[d] = 0.11 * (d + 1) - 0.07 * d * d;
        }
    }
  };

  /// Central difference of a function of the relative displacement.
  template <int dim, typename Function>
  auto
  difference(const Function               &function,
             const dealii::Tensor<1, dim> &eta,
             const int                     axis)
  {
    const double step    = 1e-5;
    auto         forward = eta, backward = eta;
    forward[axis] += step;
    backward[axis] -= step;
    return (function(forward) - function(backward)) / (2. * step);
  }

  template <int dim>
  void
  check_derivatives()
  {
    const Bond<dim> bond;
    const auto      energy = [&](const dealii::Tensor<1, dim> &eta) {
      return bond_energy(bond.k, bond.xi, eta);
    };
    const auto force = [&](const dealii::Tensor<1, dim> &eta) {
      return bond_force(bond.k, bond.xi, eta);
    };
    const auto tangent = bond_tangent(bond.k, bond.xi, bond.eta);
    for (int d = 0; d < dim; ++d)
      {
        EXPECT_NEAR(force(bond.eta)[d], difference(energy, bond.eta, d), 1e-9);
        const dealii::Tensor<1, dim> column = difference(force, bond.eta, d);
        for (int e = 0; e < dim; ++e)
          EXPECT_NEAR(tangent[e][d], column[e], 1e-8);
      }
  }

  template <int dim>
  void
  check_small_strain_limit()
  {
    const Bond<dim> bond;
    const auto      at_rest = bond_tangent(bond.k, bond.xi, {});
    EXPECT_LT((at_rest - small_bond_tangent(bond.k, bond.xi)).norm(), 1e-14);
    EXPECT_LT((small_bond_force(bond.k, bond.xi, bond.eta) -
               small_bond_tangent(bond.k, bond.xi) * bond.eta)
                .norm(),
              1e-14);
    EXPECT_NEAR(small_bond_energy(bond.k, bond.xi, bond.eta),
                0.5 * bond.eta * small_bond_force(bond.k, bond.xi, bond.eta),
                1e-14);
    // At strain 1e-9 the difference of lengths would keep 7 digits.
    const dealii::Tensor<1, dim> tiny  = 1e-9 * bond.eta;
    const auto                   exact = bond_force(bond.k, bond.xi, tiny);
    EXPECT_LT((exact - small_bond_force(bond.k, bond.xi, tiny)).norm(),
              1e-8 * exact.norm());
    EXPECT_NEAR(bond_energy(bond.k, bond.xi, tiny) /
                  small_bond_energy(bond.k, bond.xi, tiny),
                1.,
                1e-8);
  }
} // namespace

TEST(BondBased, force_is_gradient_and_tangent_its_derivative)
{
  check_derivatives<2>();
  check_derivatives<3>();
}

TEST(BondBased, small_strain_kernels_are_the_limit)
{
  check_small_strain_limit<2>();
  check_small_strain_limit<3>();
}

TEST(BondBased, rotation_costs_no_energy)
{
  const Bond<2>        bond;
  dealii::Tensor<2, 2> rotation;
  rotation[0][0] = rotation[1][1] = std::cos(1.2);
  rotation[1][0]                  = std::sin(1.2);
  rotation[0][1]                  = -rotation[1][0];
  const dealii::Tensor<1, 2> eta  = rotation * bond.xi - bond.xi;
  EXPECT_LT(bond_energy(bond.k, bond.xi, eta), 1e-28);
  EXPECT_LT(bond_force(bond.k, bond.xi, eta).norm(), 1e-14);
}

TEST(BondBased, micromodulus_gives_the_stiffness_of_the_continuum)
{
  // C_xyxy = c / 2 int |xi| e_x^2 e_y^2 over the horizon: in 2D
  // c delta^3 pi / 24, in 3D c delta^4 pi / 30; it must be the shear modulus.
  const double E = 5., delta = 0.7, pi = std::acos(-1.);
  for (const auto state : {PlaneState::plane_stress, PlaneState::plane_strain})
    EXPECT_NEAR(micromodulus(E, delta, state) * pi * std::pow(delta, 3) / 24.,
                E / (2. + 2. * allowed_poissons_ratio(state)),
                1e-14);
  EXPECT_NEAR(micromodulus(E, delta, PlaneState::three_dimensional) * pi *
                std::pow(delta, 4) / 30.,
              E / 2.5,
              1e-14);
}

TEST(BondBased, calibration_factors)
{
  // How much too stiff the continuum value is: c / 2 sum beta |xi| by hand,
  // c = 24 mu / (pi m^3), against C_abab = 8 mu.
  const double pi = std::acos(-1.), root2 = std::sqrt(2.),
               root5 = std::sqrt(5.);
  const double sum_1 = 4. + 4. * root2 * (2. - root2);
  const double sum_2 =
    4. + 4. * root2 + 4. * 2. * 0.5 + 8. * root5 * (2.5 - root5);
  EXPECT_NEAR(1. / calibration_factor<2>(1.5), 1.5 / pi / 3.375 * sum_1, 1e-14);
  EXPECT_NEAR(1. / calibration_factor<2>(2.), 1.5 / pi / 8. * sum_2, 1e-14);
  // numerics.md, section 8, item 9, says 1.05, 1.10, 1.03.
  EXPECT_NEAR(1. / calibration_factor<2>(1.5), 1.05, 0.016);
  EXPECT_NEAR(1. / calibration_factor<2>(2.), 1.10, 0.01);
  EXPECT_NEAR(1. / calibration_factor<2>(3.), 1.03, 0.01);
  // 3D, m 1.5: 6 axes, 12 and 8 diagonals; c = 30 mu / (pi m^4), 15 mu.
  const double root3 = std::sqrt(3.);
  const double sum_3 =
    6. + 12. * root2 * (2. - root2) + 8. * root3 * (2. - root3);
  EXPECT_NEAR(1. / calibration_factor<3>(1.5),
              1. / pi / std::pow(1.5, 4) * sum_3,
              1e-14);
  // Towards the continuum.
  EXPECT_NEAR(calibration_factor<2>(40.), 1., 1e-3);
  EXPECT_NEAR(calibration_factor<3>(20.), 1., 5e-3);
}

TEST(BondBased, no_calibration_of_an_empty_family)
{
  try
    {
      calibration_factor<2>(0.5);
      FAIL();
    }
  catch (const Base::InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("allowed: more than 1"),
                std::string::npos);
    }
}

TEST(BondBased, pair_stiffness_on_a_uniform_grid)
{
  // numerics.md, section 3, with equal ends.
  const BondEnd end{0.6, 2., 0.5, 0.1};
  EXPECT_NEAR(pair_stiffness(end, end, 0.25),
              2. * 0.6 * 0.5 * 0.1 * 0.1 / 0.25,
              1e-15);
  // A bond seen by one family only has half of the stiffness.
  BondEnd blind = end;
  blind.beta    = 0.;
  EXPECT_NEAR(pair_stiffness(end, blind, 0.25),
              0.5 * pair_stiffness(end, end, 0.25),
              1e-15);
}
