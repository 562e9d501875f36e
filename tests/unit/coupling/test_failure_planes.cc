#include <perimorph/coupling/failure_planes.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Nodes (i, j) of a lattice of spacing 1, number 11 j + i; horizon 3.
    struct Lattice
    {
      Lattice()
        : horizon(121, 3.)
      {
        for (unsigned int j = 0; j < 11; ++j)
          for (unsigned int i = 0; i < 11; ++i)
            nodes.emplace_back(double(i), double(j));
      }

      static OverloadedBond
      bond(
        const std::array<unsigned int, 2> &first,
        const std::array<unsigned int, 2> &second,
        const double                       load_factor,
        const dealii::Tensor<1, 3> &normal = dealii::Tensor<1, 3>({0., 1., 0.}))
      {
        return {{{11 * first[1] + first[0], 11 * second[1] + second[0]}},
                load_factor,
                normal};
      }

      std::vector<dealii::Point<2>> nodes;
      std::vector<double>           horizon;
    };
  } // namespace

  TEST(FailurePlanes, a_disc_cuts_what_crosses_it)
  {
    const FailurePlane<2> line{{2., 0.5}, dealii::Point<2>(0., 1.), 1.5};
    EXPECT_TRUE(line.cuts({2., 0.}, {2., 1.}));
    EXPECT_TRUE(line.cuts({2., 1.}, {1., 0.}));
    EXPECT_TRUE(line.cuts({0., 0.}, {3., 1.}));  // at 1.5
    EXPECT_FALSE(line.cuts({0., 0.}, {0., 1.})); // beside it
    EXPECT_FALSE(line.cuts({1., 1.}, {3., 1.})); // above
    EXPECT_FALSE(line.cuts({1., 0.}, {2., 0.}));
    // Nodes on it are above.
    EXPECT_TRUE(line.cuts({2., 0.5}, {2., 0.}));
    EXPECT_FALSE(line.cuts({2., 0.5}, {2., 1.}));
    EXPECT_FALSE(line.cuts({1., 0.5}, {2., 0.5}));

    const FailurePlane<3> disc{{0., 0., 0.5}, dealii::Point<3>(0., 0., 1.), 1.};
    EXPECT_TRUE(disc.cuts({0.5, 0.5, 0.}, {0.5, 0.5, 1.}));
    EXPECT_FALSE(disc.cuts({0.8, 0.8, 0.}, {0.8, 0.8, 1.}));
  }

  TEST(FailurePlanes, open_through_the_middle_over_one_horizon)
  {
    const Lattice    lattice;
    FailurePlanes<2> planes;
    planes.open({Lattice::bond({{5, 5}}, {{5, 6}}, 0.9)},
                lattice.nodes,
                lattice.horizon);
    ASSERT_EQ(planes.open_planes().size(), 1u);
    EXPECT_NEAR(planes.open_planes()[0].center.distance({5., 5.5}), 0., 1e-14);
    EXPECT_NEAR(planes.open_planes()[0].radius, 1.5, 1e-14);
    EXPECT_TRUE(planes.cut({4., 5.}, {4., 6.}));
    EXPECT_FALSE(planes.cut({3., 5.}, {3., 6.}));
    EXPECT_TRUE(planes.is_near({3., 5.}, 1.));
    EXPECT_FALSE(planes.is_near({9., 5.}, 1.));
    planes.keep();
    EXPECT_TRUE(planes.open_planes().empty());
    EXPECT_FALSE(planes.cut({5., 5.}, {5., 6.}));
    ASSERT_EQ(planes.places().size(), 1u);
  }

  TEST(FailurePlanes, go_on_from_places_within_a_horizon)
  {
    const Lattice                     lattice;
    const std::vector<OverloadedBond> bonds = {
      Lattice::bond({{5, 5}}, {{5, 6}}, 0.9)};
    for (const auto &[place, height] :
         {std::make_pair(dealii::Point<2>(3., 5.25), 5.25),
          std::make_pair(dealii::Point<2>(0., 5.25), 5.5),  // too far
          std::make_pair(dealii::Point<2>(5., 6.25), 5.5)}) // does not cross
      {
        FailurePlanes<2> planes;
        planes.add_tip(place);
        planes.open(bonds, lattice.nodes, lattice.horizon);
        ASSERT_EQ(planes.open_planes().size(), 1u);
        EXPECT_NEAR(planes.open_planes()[0].center.distance({5., height}),
                    0.,
                    1e-14);
      }
  }

  TEST(FailurePlanes, the_most_overloaded_bonds_relieve_the_others)
  {
    const Lattice               lattice;
    std::vector<OverloadedBond> bonds = {
      Lattice::bond({{5, 5}}, {{5, 6}}, 0.5),
      Lattice::bond({{5, 5}}, {{5, 6}}, 0.5),  // in the family of the other end
      Lattice::bond({{4, 5}}, {{4, 6}}, 0.6),  // cut by the first
      Lattice::bond({{2, 5}}, {{3, 7}}, 0.7),  // waits
      Lattice::bond({{5, 7}}, {{5, 8}}, 0.75), // waits
      Lattice::bond({{5, 0}}, {{5, 1}}, 0.8),
      Lattice::bond({{8, 2}},
                    {{8, 3}},
                    0.9,
                    dealii::Tensor<1, 3>())}; // breaks alone
    FailurePlanes<2> planes;
    planes.open(bonds, lattice.nodes, lattice.horizon);
    const auto center = [&](const unsigned int k) {
      return planes.open_planes()[k].center;
    };
    ASSERT_EQ(planes.open_planes().size(), 2u);
    EXPECT_NEAR(center(0).distance({5., 5.5}), 0., 1e-14);
    EXPECT_NEAR(center(1).distance({5., 0.5}), 0., 1e-14);

    // In any order, and with nodes numbered by any rank.
    std::reverse(bonds.begin(), bonds.end());
    for (auto &bond : bonds)
      std::swap(bond.nodes[0], bond.nodes[1]);
    FailurePlanes<2> same;
    same.open(bonds, lattice.nodes, lattice.horizon);
    ASSERT_EQ(same.open_planes().size(), 2u);
    for (unsigned int k = 0; k < 2; ++k)
      EXPECT_EQ(same.open_planes()[k].center, center(k));

    // Then it goes on.
    planes.keep();
    planes.open({Lattice::bond({{2, 5}}, {{3, 7}}, 0.7)},
                lattice.nodes,
                lattice.horizon);
    ASSERT_EQ(planes.open_planes().size(), 1u);
    EXPECT_NEAR(center(0).distance({2.25, 5.5}), 0., 1e-14);
  }

  TEST(FailurePlanes, no_crack_begins_ahead_of_another)
  {
    const Lattice    lattice;
    FailurePlanes<2> planes;
    planes.open({Lattice::bond({{5, 5}}, {{5, 6}}, 0.9)},
                lattice.nodes,
                lattice.horizon);
    planes.keep();
    const auto n_opened = [&](const unsigned int i, const unsigned int j) {
      planes.open({Lattice::bond({{i, j}}, {{i, j + 1}}, 0.5)},
                  lattice.nodes,
                  lattice.horizon);
      return planes.open_planes().size();
    };
    EXPECT_EQ(n_opened(8, 6), 0u);  // ahead, out of line
    EXPECT_EQ(n_opened(10, 6), 1u); // far ahead
    EXPECT_EQ(n_opened(5, 7), 1u);  // beside: the plane has not relieved it

    // A tip only says where cracks go on.
    FailurePlanes<2> other;
    other.add_tip({5., 5.5});
    other.open({Lattice::bond({{8, 6}}, {{8, 7}}, 0.5)},
               lattice.nodes,
               lattice.horizon);
    EXPECT_EQ(other.open_planes().size(), 1u);
  }
} // namespace Perimorph::Coupling
