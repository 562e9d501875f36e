#include <perimorph/coupling/bond_strengths.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Nodes in a row: 0 in law 0, 1 in both, 2 in law 1; fibres along x and
    /// along y. Tension along x as given, per particle.
    struct Row
    {
      Row()
      {
        materials.material_of_law = {0, 1};
        materials.names           = {"rest", "other"};
        materials.axes.resize(2);
        for (int d = 0; d < 3; ++d)
          materials.axes[0][d][d] = 1.;
        materials.axes[1][0][1] = 1.;
        materials.axes[1][1][0] = -1.;
        materials.axes[1][2][2] = 1.;
        table.materials         = {{100., 10., 10.}, {50., 5., 5.}};

        for (const auto &list :
             std::vector<std::vector<unsigned int>>{{0}, {0, 1}, {1}})
          {
            for (const unsigned int law : list)
              states.laws.entries.push_back(law);
            states.laws.close_row();
          }
        states.particles.resize(4);
        for (unsigned int p = 0; p < 4; ++p)
          set(p, std::array<double, 4>{{40., 10., 2., 4.}}[p]);
      }

      void
      set(const unsigned int particle, const double tension)
      {
        states.particles[particle].exists       = true;
        states.particles[particle].stress       = 0.;
        states.particles[particle].stress[0][0] = tension;
      }

      double
      factor(const unsigned int i, const unsigned int j) const
      {
        return load(i, j, {{1., 0.}}).load_factor;
      }

      StrengthLoad
      load(const unsigned int           i,
           const unsigned int           j,
           const std::array<double, 2> &direction) const
      {
        Damage::BondState bond;
        bond.length       = 1.;
        bond.extension    = 1.;
        bond.direction[0] = direction[0];
        bond.direction[1] = direction[1];
        return load_factor_by_strength<2>(
          {{i, j}},
          states,
          materials,
          table,
          *Damage::make_breaking_rule<2>(Damage::Criterion::maximum_stress,
                                         {},
                                         Materials::PlaneState::plane_stress,
                                         Damage::FamilyShape::cells),
          bond);
      }

      BodyMaterials<2> materials;
      StrengthTable    table;
      ParticleStates   states;
    };
  } // namespace

  TEST(BondStrengths, stress_is_the_mean_in_the_material_of_the_bond)
  {
    const Row row;
    // Along the fibres of the first, across those of the second.
    EXPECT_NEAR(row.factor(0, 1), 100. / 25., 1e-14);
    EXPECT_NEAR(row.factor(1, 0), 100. / 25., 1e-14);
    EXPECT_NEAR(row.factor(1, 2), 5. / 3., 1e-14);
  }

  TEST(BondStrengths, interfaces_have_their_own_in_the_axes_of_both_sides)
  {
    Row row;
    row.table.interfaces[{{0, 1}}] = {200., 1., 1.};
    EXPECT_NEAR(row.factor(0, 1), 1. / 25., 1e-14);
    EXPECT_NEAR(row.factor(1, 2), 1. / 3., 1e-14);
    // Another pair does not matter.
    row.table.interfaces.clear();
    row.table.interfaces[{{1, 2}}] = {1., 1., 1.};
    EXPECT_NEAR(row.factor(0, 1), 100. / 25., 1e-14);
  }

  TEST(BondStrengths, planes_open_where_the_material_fails)
  {
    Row row;
    row.set(2, 0.);
    for (const std::array<double, 2> direction :
         {std::array<double, 2>{{1., 0.}}, {{0.6, 0.8}}})
      {
        // Across the fibres of the second, along which x is the normal.
        const auto load = row.load(1, 2, direction);
        EXPECT_NEAR(load.load_factor, 5. / 2., 1e-14);
        EXPECT_NEAR(std::abs(load.normal[0]), 1., 1e-14);
      }
    // No plane along a bond can cut it.
    EXPECT_TRUE(std::isinf(row.load(1, 2, {{0., 1.}}).load_factor));

    // Nor does it hide the failure in another material, in either order.
    for (const bool first_fails_alone : {true, false})
      {
        Row both;
        both.states.laws = {};
        for (unsigned int n = 0; n < 2; ++n)
          {
            both.states.laws.entries.push_back(0);
            both.states.laws.entries.push_back(1);
            both.states.laws.close_row();
          }
        // Along y: across the fibres of one, along those of the other.
        for (unsigned int p = 0; p < 4; ++p)
          {
            both.set(p, 0.);
            both.states.particles[p].stress[1][1] = p % 2 == 0 ? 20. : 0.;
            both.states.particles[p].stress[0][0] = p % 2 == 1 ? 20. : 0.;
          }
        if (!first_fails_alone)
          {
            std::swap(both.materials.axes[0], both.materials.axes[1]);
            std::swap(both.table.materials[0], both.table.materials[1]);
            std::swap(both.states.particles[0], both.states.particles[1]);
            std::swap(both.states.particles[2], both.states.particles[3]);
          }
        // The second has 5 across its fibres, the plane of which is along y.
        EXPECT_NEAR(both.load(0, 1, {{0., 1.}}).load_factor, 0.5, 1e-14);
      }

    row.table.opens_planes = false;
    EXPECT_NEAR(row.load(1, 2, {{0., 1.}}).load_factor, 5. / 2., 1e-14);
    EXPECT_EQ(row.load(1, 2, {{1., 0.}}).normal.norm(), 0.);

    row.table.opens_planes         = true;
    row.table.interfaces[{{0, 1}}] = {200., 1., 1.};
    EXPECT_EQ(row.load(1, 2, {{1., 0.}}).normal.norm(), 0.);
  }

  TEST(BondStrengths, axes_that_vary_in_a_material_make_no_interface)
  {
    Row row;
    row.materials.material_of_law  = {0, 0};
    row.table.interfaces[{{0, 1}}] = {1., 1., 1.};
    EXPECT_NEAR(row.factor(0, 1), 100. / 25., 1e-14);
    EXPECT_NEAR(row.factor(1, 2), 10. / 3., 1e-14);
  }

  TEST(BondStrengths, a_lost_particle_leaves_the_stress_to_the_other)
  {
    Row row;
    row.states.particles[1].exists = false;
    EXPECT_NEAR(row.factor(0, 1), 100. / 40., 1e-14);
    row.states.particles[0].exists = false;
    EXPECT_TRUE(std::isinf(row.factor(0, 1)));
  }
} // namespace Perimorph::Coupling
