#include <perimorph/bonds/bond_search.h>
#include <perimorph/damage/thresholds.h>
#include <perimorph/peridynamics/bond_based.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace Perimorph::Damage
{
  namespace
  {
    using Materials::PlaneState;

    constexpr double G_c = 0.37, E = 2.3;
    const double     pi = std::acos(-1.);

    /// Sum over the lattice points around a node, spacing 1.
    template <int dim>
    double
    lattice_sum(const double                                          radius,
                const std::function<double(double x, double length)> &term)
    {
      const int reach   = static_cast<int>(radius);
      const int z_reach = dim == 3 ? reach : 0;
      double    sum     = 0.;
      for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
          for (int z = -z_reach; z <= z_reach; ++z)
            {
              const double length = std::sqrt(x * x + y * y + z * z);
              if (length > 0. && length <= radius)
                sum += term(x, length);
            }
      return sum;
    }
  } // namespace

  TEST(Thresholds, stretch_of_the_continuum)
  {
    // numerics.md, section 3; bulk modulus 2 E / 3 for Poisson's ratio 1/4.
    const double delta = 0.6;
    EXPECT_NEAR(critical_stretch(G_c, E, delta, PlaneState::plane_stress),
                std::sqrt(4. * pi * G_c / (9. * E * delta)),
                1e-14);
    EXPECT_NEAR(critical_stretch(G_c, E, delta, PlaneState::plane_strain),
                std::sqrt(5. * pi * G_c / (12. * E * delta)),
                1e-14);
    EXPECT_NEAR(critical_stretch(G_c, E, delta, PlaneState::three_dimensional),
                std::sqrt(5. * G_c / (9. * (2. / 3. * E) * delta)),
                1e-14);
  }

  TEST(Thresholds, stretch_of_a_lattice_in_2D)
  {
    // G_disc / G_cont of numerics-damage.md, section 3, for calibrated bonds.
    const std::vector<std::pair<double, double>> table = {{2., 1.108},
                                                          {3., 1.036},
                                                          {4., 1.020}};
    for (const auto &[m, expected] : table)
      {
        const double c =
          Peridynamics::micromodulus(E, m, PlaneState::plane_stress) *
          Peridynamics::calibration_factor<2>(m);
        const double moment =
          lattice_sum<2>(m + 0.5, [&, m = m](const double, const double r) {
            return c * Bonds::volume_factor(m, 1., r) * r * r;
          });
        const double of_node = critical_stretch_of_node<2>(G_c, moment);
        const double of_continuum =
          critical_stretch(G_c, E, m, PlaneState::plane_stress);
        EXPECT_NEAR(std::pow(of_continuum / of_node, 2), expected, 6e-4)
          << "m " << m;
        // The same lattice in other units.
        EXPECT_NEAR(critical_stretch_of_lattice<2>(5. * G_c,
                                                   E,
                                                   5. * m,
                                                   m,
                                                   PlaneState::plane_stress),
                    of_node,
                    1e-13);
      }
  }

  TEST(Thresholds, stretch_of_a_fine_lattice_in_3D)
  {
    const double m = 12.;
    const double c =
      Peridynamics::micromodulus(E, m, PlaneState::three_dimensional);
    const double moment =
      lattice_sum<3>(m + 0.5, [&](const double, const double r) {
        return c * Bonds::volume_factor(m, 1., r) * r * r;
      });
    EXPECT_NEAR(critical_stretch_of_node<3>(G_c, moment) /
                  critical_stretch(G_c, E, m, PlaneState::three_dimensional),
                1.,
                5e-3);
  }

  TEST(Thresholds, energy_of_a_plane_crack)
  {
    // Pairs across a lattice plane: x of them per row and bond of height x > 0.
    for (const double m : {40., 41.3})
      EXPECT_NEAR(critical_energy_density<2>(G_c, m) *
                    lattice_sum<2>(m,
                                   [](const double x, const double) {
                                     return std::max(x, 0.);
                                   }),
                  G_c,
                  0.01 * G_c);
    EXPECT_NEAR(critical_energy_density<3>(G_c, 15.) *
                  lattice_sum<3>(15.,
                                 [](const double x, const double) {
                                   return std::max(x, 0.);
                                 }),
                G_c,
                0.02 * G_c);
  }

  TEST(Thresholds, energy_of_a_coarse_lattice)
  {
    // w_0 of the lattice, pi G_c / sum |xi|, is 5 % (m = 2) and 4 % (m = 3)
    // lower (numerics-damage.md, section 3).
    const auto ratio = [](const double m) {
      return pi * G_c /
             lattice_sum<2>(m, [](const double, const double r) { return r; }) /
             critical_energy_density<2>(G_c, m);
    };
    EXPECT_NEAR(ratio(2.), 0.95, 0.01);
    EXPECT_NEAR(ratio(3.), 0.96, 0.01);
  }

  TEST(Thresholds, trapping_between_and_beyond_the_measurements)
  {
    EXPECT_DOUBLE_EQ(lattice_trapping(2., FamilyShape::ball), 1.75);
    EXPECT_DOUBLE_EQ(lattice_trapping(3., FamilyShape::ball), 1.26);
    EXPECT_NEAR(lattice_trapping(2.5, FamilyShape::ball), 1.505, 1e-12);
    EXPECT_DOUBLE_EQ(lattice_trapping(1.5, FamilyShape::ball), 1.75);
    EXPECT_DOUBLE_EQ(lattice_trapping(4., FamilyShape::cells), 2.);
    EXPECT_NEAR(lattice_trapping(2.5, FamilyShape::cells), 2.52, 1e-12);
  }
} // namespace Perimorph::Damage
