#include <perimorph/bonds/bond_search.h>
#include <perimorph/bonds/segment_search.h>
#include <perimorph/bonds/segment_walk.h>

#include "test_meshes.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace Perimorph;

namespace
{
  /// What the pieces of a segment are good for: length and change of the shape
  /// functions per cell.
  template <int dim>
  using Sums = std::map<unsigned int, std::array<double, 1 + (1u << dim)>>;

  template <int dim>
  Sums<dim>
  sums_of(const std::vector<Bonds::SegmentPiece<dim>> &pieces,
          const double                                 sign,
          Sums<dim>                                    sums = {})
  {
    for (const auto &piece : pieces)
      {
        auto &sum = sums[piece.cell];
        sum[0] += sign * piece.share * piece.length;
        for (unsigned int v = 0; v < (1u << dim); ++v)
          sum[1 + v] +=
            sign * piece.share * (piece.shape_end[v] - piece.shape_begin[v]);
      }
    return sums;
  }

  /// Cuts all bonds both ways.
  /// @return share of the bonds that can be walked
  template <int dim>
  double
  compare(const Mesh::NodalMesh<dim> &mesh, const double ratio)
  {
    std::vector<double> horizon(mesh.spacing);
    for (double &delta : horizon)
      delta *= ratio;
    const auto pairs =
      Bonds::find_bond_pairs(mesh,
                             std::vector<double>(mesh.n_nodes(), 1.),
                             horizon);
    Bonds::SegmentWalk<dim>               walk(mesh);
    Bonds::SegmentSearch<dim>             search(mesh);
    std::vector<Bonds::SegmentPiece<dim>> walked, found;
    std::size_t                           n_walked = 0;
    double                                largest  = 0.;
    for (const auto &[i, j] : pairs.nodes)
      if (walk.cut(i, j, walked))
        {
          ++n_walked;
          EXPECT_TRUE(search.cut(i, j, found));
          for (const auto &entry :
               sums_of<dim>(found, -1., sums_of<dim>(walked, 1.)))
            for (const double difference : entry.second)
              largest = std::max(largest, std::abs(difference));
        }
    // The search has slivers of up to 1e-8 where a bond is nearly tangent to a
    // face at its end; a wrong cell leaves 1e-3 to 1.
    EXPECT_LT(largest, 1e-7);
    return double(n_walked) / pairs.size();
  }
} // namespace

TEST(SegmentWalk, equals_the_search_on_perturbed_meshes)
{
  EXPECT_GT(compare(Testing::unit_mesh<2>(12, 0.2), 3.), 0.9);
  EXPECT_GT(compare(Testing::unit_mesh<2>(16, 0.2, 20.), 3.), 0.9);
  EXPECT_GT(compare(Testing::unit_mesh<3>(5, 0.2), 2.), 0.7);
}

TEST(SegmentWalk, equals_the_search_where_it_gets_through)
{
  // Bonds along faces and through corners are left to the search.
  EXPECT_GT(compare(Testing::unit_mesh<2>(8), 3.), 0.5);
  EXPECT_GT(compare(Testing::unit_mesh<3>(4), 2.), 0.3);
  EXPECT_GT(compare(Testing::annulus_mesh<2>(32, 8, 1., 2.), 3.), 0.5);
  for (const double noise : {1e-13, 1e-9, 1e-6, 1e-4})
    {
      compare(Testing::unit_mesh<2>(8, noise), 3.);
      compare(Testing::unit_mesh<3>(4, noise), 2.);
    }
}

TEST(SegmentWalk, stays_in_the_body)
{
  // 16 rows of 4 nodes, 22.5 degrees apart, the first of each on the hole.
  const auto            mesh = Testing::annulus_mesh<2>(16, 3, 1., 2.);
  Bonds::SegmentWalk<2> walk(mesh);
  std::vector<Bonds::SegmentPiece<2>> pieces;
  EXPECT_FALSE(walk.cut(0, 16, pieces)); // across the hole
  ASSERT_TRUE(walk.cut(0, 4, pieces));   // an edge of the hole
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_DOUBLE_EQ(pieces[0].share, 1.);
}
