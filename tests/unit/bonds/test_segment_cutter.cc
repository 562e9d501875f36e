#include <perimorph/bonds/bond_search.h>
#include <perimorph/bonds/segment_cutter.h>

#include "test_meshes.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace Perimorph;

namespace
{
  template <int dim>
  Bonds::BondPairs
  all_bonds(const Mesh::NodalMesh<dim> &mesh, const double ratio)
  {
    std::vector<double> horizon(mesh.spacing);
    for (double &delta : horizon)
      delta *= ratio;
    return Bonds::find_bond_pairs(mesh,
                                  std::vector<double>(mesh.n_nodes(), 1.),
                                  horizon);
  }

  /// Cuts all bonds of a convex body and checks what makes the patch test
  /// exact: lengths add up, pieces lie on the segment, and the change of each
  /// shape function along the pieces adds up to its change from end to end.
  template <int dim>
  void
  check_all_bonds(const Mesh::NodalMesh<dim> &mesh, const double ratio)
  {
    const auto                            pairs = all_bonds(mesh, ratio);
    Bonds::SegmentCutter<dim>             cutter(mesh);
    std::vector<Bonds::SegmentPiece<dim>> pieces;
    std::vector<double>                   change(mesh.n_nodes(), 0.);

    double       length_error = 0., point_error = 0., change_error = 0.;
    unsigned int n_refused = 0;
    for (const auto &pair : pairs.nodes)
      {
        const auto  &begin  = mesh.nodes[pair[0]];
        const auto  &end    = mesh.nodes[pair[1]];
        const double length = begin.distance(end);
        n_refused += !cutter.cut(pair[0], pair[1], pieces);

        double sum = 0.;
        change[pair[0]] += 1.;
        change[pair[1]] -= 1.;
        for (const auto &piece : pieces)
          {
            sum += piece.share * piece.length;
            const auto        &cell = mesh.cells[piece.cell];
            dealii::Point<dim> from, to;
            for (unsigned int v = 0; v < cell.size(); ++v)
              {
                from += piece.shape_begin[v] * mesh.nodes[cell[v]];
                to += piece.shape_end[v] * mesh.nodes[cell[v]];
                change[cell[v]] +=
                  piece.share * (piece.shape_end[v] - piece.shape_begin[v]);
              }
            const auto expected = (piece.length / length) * (end - begin);
            point_error =
              std::max({point_error,
                        (to - from - expected).norm() / length,
                        begin.distance(from) + from.distance(end) - length});
          }
        length_error = std::max(length_error, std::abs(sum / length - 1.));
        for (const auto &piece : pieces)
          for (const unsigned int node : mesh.cells[piece.cell])
            {
              change_error = std::max(change_error, std::abs(change[node]));
              change[node] = 0.;
            }
      }
    EXPECT_GT(pairs.size(), 0u);
    EXPECT_EQ(n_refused, 0u);
    EXPECT_LT(length_error, 1e-8);
    EXPECT_LT(point_error, 1e-10);
    // Round-off; a wrong cell or a lost crossing leaves 1e-3 to 1.
    EXPECT_LT(change_error, 1e-10);
  }
} // namespace

TEST(SegmentCutter, pieces_add_up_on_uniform_meshes)
{
  // Bonds along edges, faces and diagonals.
  check_all_bonds(Testing::unit_mesh<2>(8), 3.);
  check_all_bonds(Testing::unit_mesh<3>(4), 2.);
}

TEST(SegmentCutter, pieces_add_up_on_perturbed_quadrilaterals)
{
  check_all_bonds(Testing::unit_mesh<2>(12, 0.2), 3.);
  check_all_bonds(Testing::unit_mesh<2>(12, 0.35), 2.);
}

TEST(SegmentCutter, pieces_add_up_on_perturbed_hexahedra)
{
  check_all_bonds(Testing::unit_mesh<3>(4, 0.2), 2.);
  check_all_bonds(Testing::unit_mesh<3>(4, 0.3), 1.5);
}

TEST(SegmentCutter, pieces_add_up_on_graded_meshes)
{
  check_all_bonds(Testing::unit_mesh<2>(16, 0.2, 20.), 3.);
  check_all_bonds(Testing::unit_mesh<3>(5, 0.2, 8.), 2.);
}

TEST(SegmentCutter, pieces_add_up_on_nearly_uniform_meshes)
{
  // Nodes off their straight lines by the last digits of a mesh file.
  for (const double noise : {1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5})
    {
      check_all_bonds(Testing::unit_mesh<2>(8, noise), 3.);
      check_all_bonds(Testing::unit_mesh<3>(4, noise), 2.);
    }
}

TEST(SegmentCutter, pieces_add_up_far_from_the_origin)
{
  const dealii::Point<2> lower(1000., -2000.);
  const dealii::Point<2> upper(1000.8, -1999.2);
  check_all_bonds(Testing::structured_mesh<2>({{8, 8}}, lower, upper), 3.);
  check_all_bonds(Testing::structured_mesh<2>({{8, 8}}, lower, upper, 0.2), 3.);
}

TEST(SegmentCutter, bond_along_an_edge_is_shared)
{
  const auto                          mesh = Testing::unit_mesh<2>(4);
  Bonds::SegmentCutter<2>             cutter(mesh);
  std::vector<Bonds::SegmentPiece<2>> pieces;

  // Nodes (1, 2) to (3, 2) of 5 x 5: two edges, each between two cells.
  ASSERT_TRUE(cutter.cut(11, 13, pieces));
  ASSERT_EQ(pieces.size(), 4u);
  for (const auto &piece : pieces)
    {
      EXPECT_DOUBLE_EQ(piece.share, 0.5);
      EXPECT_NEAR(piece.length, 0.25, 1e-14);
    }

  // On the surface of the body there is one cell.
  ASSERT_TRUE(cutter.cut(0, 2, pieces));
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_DOUBLE_EQ(pieces[0].share, 1.);
}

TEST(SegmentCutter, bond_along_an_edge_between_four_hexahedra)
{
  const auto                          mesh = Testing::unit_mesh<3>(2);
  Bonds::SegmentCutter<3>             cutter(mesh);
  std::vector<Bonds::SegmentPiece<3>> pieces;

  // Centre line along z, (1, 1, 0) to (1, 1, 2) of 3 x 3 x 3 nodes.
  ASSERT_TRUE(cutter.cut(4, 22, pieces));
  ASSERT_EQ(pieces.size(), 8u);
  for (const auto &piece : pieces)
    EXPECT_DOUBLE_EQ(piece.share, 0.25);
}

TEST(SegmentCutter, refuses_bonds_across_a_hole)
{
  // 16 rows of 4 nodes, 22.5 degrees apart, the first of each on the hole.
  const auto              mesh = Testing::annulus_mesh<2>(16, 3, 1., 2.);
  Bonds::SegmentCutter<2> cutter(mesh);
  std::vector<Bonds::SegmentPiece<2>> pieces;

  const unsigned int inner_0 = 0, inner_1 = 4, inner_4 = 16, outer_1 = 7;
  EXPECT_FALSE(cutter.cut(inner_0, inner_4, pieces));
  EXPECT_FALSE(cutter.cut(inner_0, 2 * inner_1, pieces));
  EXPECT_TRUE(cutter.cut(inner_0, inner_1, pieces)); // an edge of the hole
  EXPECT_TRUE(cutter.cut(inner_0, outer_1, pieces));

  const auto              pipe = Testing::annulus_mesh<3>(16, 3, 1., 2., 2);
  Bonds::SegmentCutter<3> pipe_cutter(pipe);
  std::vector<Bonds::SegmentPiece<3>> pipe_pieces;
  EXPECT_FALSE(pipe_cutter.cut(inner_0, 64 + 2 * inner_1, pipe_pieces));
  EXPECT_TRUE(pipe_cutter.cut(inner_0, 64 + outer_1, pipe_pieces));
}
