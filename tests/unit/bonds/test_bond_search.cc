#include <perimorph/bonds/bond_search.h>

#include "test_meshes.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace Perimorph;

namespace
{
  template <int dim>
  std::vector<double>
  horizons(const Mesh::NodalMesh<dim> &mesh, const double ratio)
  {
    std::vector<double> horizon(mesh.spacing);
    for (double &delta : horizon)
      delta *= ratio;
    return horizon;
  }

  /// Every pair of nodes, the definition taken literally.
  template <int dim>
  std::set<std::array<unsigned int, 2>>
  pairs_by_brute_force(const Mesh::NodalMesh<dim> &mesh,
                       const std::vector<double>  &alpha,
                       const std::vector<double>  &horizon)
  {
    std::set<std::array<unsigned int, 2>> pairs;
    for (unsigned int i = 0; i < mesh.n_nodes(); ++i)
      for (unsigned int j = i + 1; j < mesh.n_nodes(); ++j)
        {
          const double length = mesh.nodes[i].distance(mesh.nodes[j]);
          const double reach  = std::max(horizon[i] + 0.5 * mesh.spacing[i],
                                        horizon[j] + 0.5 * mesh.spacing[j]);
          if (alpha[i] + alpha[j] > 0. && length < reach * (1. - 1e-9))
            pairs.insert(std::array<unsigned int, 2>{{i, j}});
        }
    return pairs;
  }

  /// 1 on the left, falling to 0 in the middle.
  template <int dim>
  std::vector<double>
  left_half(const Mesh::NodalMesh<dim> &mesh)
  {
    std::vector<double> alpha;
    for (const auto &node : mesh.nodes)
      alpha.push_back(std::min(1., std::max(0., 2. - 4. * node[0])));
    return alpha;
  }
} // namespace

TEST(BondSearch, family_sizes_on_uniform_lattices)
{
  // Neighbours nearer than delta + h / 2, counted by hand: 2D reach 2, 2.5,
  // 3.5 (2 itself has beta 0), 3D reach 2.
  const auto family_size = [](const auto &mesh, const double ratio) {
    const std::vector<double> alpha(mesh.n_nodes(), 1.);
    const auto                pairs =
      Bonds::find_bond_pairs(mesh, alpha, horizons(mesh, ratio));
    const unsigned int middle = mesh.n_nodes() / 2;
    return std::count_if(
      pairs.nodes.begin(),
      pairs.nodes.end(),
      [&](const auto &pair) { return pair[0] == middle || pair[1] == middle; });
  };
  const auto square = Testing::unit_mesh<2>(10);
  EXPECT_EQ(family_size(square, 1.5), 8);
  EXPECT_EQ(family_size(square, 2.), 20);
  EXPECT_EQ(family_size(square, 3.), 36);
  EXPECT_EQ(family_size(Testing::unit_mesh<3>(6), 1.5), 26);
}

TEST(BondSearch, equals_brute_force_on_graded_perturbed_mesh)
{
  const auto mesh    = Testing::unit_mesh<2>(12, 0.2, 5.);
  const auto alpha   = left_half(mesh);
  const auto horizon = horizons(mesh, 2.);
  const auto pairs   = Bonds::find_bond_pairs(mesh, alpha, horizon);

  EXPECT_EQ(std::set<decltype(pairs.nodes)::value_type>(pairs.nodes.begin(),
                                                        pairs.nodes.end()),
            pairs_by_brute_force(mesh, alpha, horizon));
  EXPECT_TRUE(std::is_sorted(pairs.nodes.begin(), pairs.nodes.end()));
  EXPECT_EQ(std::adjacent_find(pairs.nodes.begin(), pairs.nodes.end()),
            pairs.nodes.end());
}

TEST(BondSearch, volume_factor_belongs_to_its_end)
{
  const auto mesh    = Testing::unit_mesh<3>(5, 0.2, 3.);
  const auto horizon = horizons(mesh, 1.5);
  const auto pairs   = Bonds::find_bond_pairs(mesh, left_half(mesh), horizon);

  bool differ = false;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      for (unsigned int end = 0; end < 2; ++end)
        {
          const unsigned int node   = pairs.nodes[p][end];
          const double       h      = mesh.spacing[node];
          const double       length = mesh.nodes[pairs.nodes[p][0]].distance(
            mesh.nodes[pairs.nodes[p][1]]);
          const double expected = (1.5 * h + 0.5 * h - length) / h;
          EXPECT_NEAR(pairs.beta[p][end],
                      std::min(1., std::max(0., expected)),
                      1e-9);
        }
      EXPECT_GT(std::max(pairs.beta[p][0], pairs.beta[p][1]), 0.);
      differ = differ || std::abs(pairs.beta[p][0] - pairs.beta[p][1]) > 0.1;
    }
  EXPECT_TRUE(differ);
}

TEST(BondSearch, no_weight_no_bonds)
{
  const auto mesh = Testing::unit_mesh<2>(6);
  EXPECT_EQ(Bonds::find_bond_pairs(mesh,
                                   std::vector<double>(mesh.n_nodes(), 0.),
                                   horizons(mesh, 2.))
              .size(),
            0u);
}

TEST(BondSearch, ranks_together_own_every_bond_once)
{
  auto                      mesh = Testing::unit_mesh<2>(12, 0.2);
  const std::vector<double> alpha(mesh.n_nodes(), 1.);
  const auto                horizon = horizons(mesh, 2.);
  const auto                all = Bonds::find_bond_pairs(mesh, alpha, horizon);

  // Three ranks: thirds of the rows of cells, node ranges to match.
  for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
    mesh.cell_owner[cell] = cell / 48;
  const std::array<unsigned int, 4> first_node{{0, 65, 117, 169}};

  std::size_t                           n_owned = 0;
  std::set<std::array<unsigned int, 2>> owned;
  for (mesh.rank = 0; mesh.rank < 3; ++mesh.rank)
    {
      mesh.owned_begin = first_node[mesh.rank];
      mesh.owned_end   = first_node[mesh.rank + 1];
      const auto mine =
        Bonds::find_bond_pairs(mesh,
                               alpha,
                               horizon,
                               Bonds::BondSelection::of_this_rank);
      EXPECT_LT(mine.size(), all.size());

      // Nothing that crosses the rows of this rank may be missing.
      const std::set<std::array<unsigned int, 2>> found(mine.nodes.begin(),
                                                        mine.nodes.end());
      const double                                lower = mesh.rank / 3. + 0.02;
      const double upper = (mesh.rank + 1) / 3. - 0.02;
      for (const auto &pair : all.nodes)
        {
          const double y0 = mesh.nodes[pair[0]][1];
          const double y1 = mesh.nodes[pair[1]][1];
          if ((std::min(y0, y1) < upper && std::max(y0, y1) > lower) ||
              mesh.owns_node(pair[0]))
            {
              EXPECT_EQ(found.count(pair), 1u);
            }
        }
      for (std::size_t p = 0; p < mine.size(); ++p)
        if (mine.owned[p])
          {
            ++n_owned;
            owned.insert(mine.nodes[p]);
          }
    }
  EXPECT_EQ(n_owned, all.size());
  EXPECT_EQ(owned.size(), all.size());
}
