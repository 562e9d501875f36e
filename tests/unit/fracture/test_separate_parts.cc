#include <perimorph/fracture/probes.h>

#include "exact_fields.h"
#include <gtest/gtest.h>
#include <harness/test_meshes.h>

// Fits beside gaps and slits: nothing of the other side may enter.
namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;

  using Values = std::vector<dealii::Tensor<1, 2>>;

  /// Unit squares with 0.1 wide cells, the second beside the first.
  Mesh::NodalMesh<2>
  two_squares(const double gap)
  {
    auto               mesh    = Testing::unit_mesh<2>(10);
    const auto         second  = mesh;
    const unsigned int n_first = mesh.n_nodes();
    for (const auto &node : second.nodes)
      mesh.nodes.push_back(node + dealii::Point<2>(1. + gap, 0.));
    for (auto cell : second.cells)
      {
        for (unsigned int &node : cell)
          node += n_first;
        mesh.cells.push_back(cell);
      }
    mesh.cell_material.resize(mesh.n_cells(), 0);
    mesh.cell_owner.resize(mesh.n_cells(), 0);
    mesh.owned_end = mesh.n_nodes();
    mesh.compute_derived();
    return mesh;
  }

  /// Unit square whose nodes on y = 0.5, x < 0.5 are double: a slit, its end at
  /// the middle.
  Mesh::NodalMesh<2>
  slit_square()
  {
    auto                      mesh    = Testing::unit_mesh<2>(10);
    const unsigned int        n_nodes = mesh.n_nodes();
    std::vector<unsigned int> upper(n_nodes);
    for (unsigned int n = 0; n < n_nodes; ++n)
      {
        upper[n] = n;
        if (std::abs(mesh.nodes[n][1] - 0.5) < 1e-9 && mesh.nodes[n][0] < 0.49)
          {
            upper[n] = mesh.nodes.size();
            mesh.nodes.push_back(dealii::Point<2>(mesh.nodes[n]));
          }
      }
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.cell_centroid[c][1] > 0.5)
        for (unsigned int &node : mesh.cells[c])
          node = upper[node];
    mesh.owned_end = mesh.n_nodes();
    mesh.compute_derived();
    return mesh;
  }

  /// Another linear displacement on either side of the slit, opened by twice
  /// the jump.
  dealii::Tensor<2, 2>
  gradient_beside_slit(const bool above)
  {
    dealii::Tensor<2, 2> gradient;
    gradient[0][0] = above ? 0.1 : -0.3;
    gradient[1][0] = above ? 0.2 : 0.1;
    gradient[1][1] = above ? -0.2 : 0.4;
    return gradient;
  }

  /// Cells know their side, nodes in one place do not.
  std::vector<bool>
  nodes_above(const Mesh::NodalMesh<2> &mesh)
  {
    std::vector<bool> above(mesh.n_nodes(), false);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.cell_centroid[c][1] > 0.5)
        for (const unsigned int node : mesh.cells[c])
          above[node] = true;
    return above;
  }

  Values
  displacement_beside_slit(const Mesh::NodalMesh<2> &mesh, const double jump)
  {
    const auto above = nodes_above(mesh);
    Values     values(mesh.n_nodes());
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        values[n] = gradient_beside_slit(above[n]) * mesh.nodes[n];
        values[n][1] += above[n] ? jump : -jump;
      }
    return values;
  }

  void
  expect_stress_free_squares(std::vector<MirrorPlane<2>> planes)
  {
    const auto mesh = two_squares(0.02);
    const auto materials =
      Testing::unit_material<2>(0.3, PlaneState::plane_stress);
    const DisplacementFit<2> fit(mesh, std::move(planes));
    const NodalStress<2>     recovery(fit, materials);
    const PointProbe<2>      probe(recovery);
    const Values values = Testing::nodal_values<2>(mesh, [](const auto &x) {
      dealii::Tensor<1, 2> u;
      u[0] = x[0] > 1.01 ? 0.05 : 0.;
      return u;
    });
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      EXPECT_LT(recovery.at_node(n, values).in_plane.norm(), 1e-12)
        << mesh.nodes[n];
    // The last but one lies in the gap, nearer to the second square.
    for (const double x : {0.97, 1., 1.002, 1.018, 1.02, 1.04})
      EXPECT_LT(
        probe.stress_at(dealii::Point<2>(x, 0.03), values).in_plane.norm(),
        1e-12)
        << x;
  }

  TEST(SeparateParts, a_rigid_motion_of_one_gives_no_stress)
  {
    expect_stress_free_squares({});
  }

  TEST(SeparateParts, mirrored_copies_stay_on_their_side)
  {
    MirrorPlane<2> plane;
    plane.normal[1] = 1.;
    expect_stress_free_squares({plane});
  }

  TEST(SeparateParts, lips_of_a_slit_see_their_own_side)
  {
    const auto mesh  = slit_square();
    const auto above = nodes_above(mesh);
    const auto materials =
      Testing::unit_material<2>(0.3, PlaneState::plane_stress);
    const DisplacementFit<2> fit(mesh);
    const NodalStress<2>     recovery(fit, materials);
    const PointProbe<2>      probe(recovery);
    const auto expect_side = [&](const Stress<2> &stress, const bool upper) {
      const auto exact =
        stress_of_gradient(*materials[0], gradient_beside_slit(upper));
      EXPECT_LT((stress.in_plane - exact.in_plane).norm(), 1e-10);
    };

    ASSERT_EQ(mesh.n_nodes(), 11u * 11u + 5u);
    for (const double jump : {1., -1.})
      {
        const auto values = displacement_beside_slit(mesh, jump);
        // The radius of 0.26 must not reach the end of the slit.
        for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
          if (mesh.nodes[n][0] < 0.21)
            expect_side(recovery.at_node(n, values), above[n]);
        for (const double x : {0., 0.1, 0.13, 0.2})
          {
            for (const double distance : {1e-4, 0.01, 0.06})
              for (const bool upper : {false, true})
                expect_side(
                  probe.stress_at(
                    dealii::Point<2>(x, 0.5 + (upper ? distance : -distance)),
                    values),
                  upper);
            // On the slit the cell decides, the lower one has the lower number.
            expect_side(probe.stress_at(dealii::Point<2>(x, 0.5), values),
                        false);
          }
      }
  }

  TEST(SeparateParts, the_seed_chooses_between_nodes_in_one_place)
  {
    const auto               mesh   = slit_square();
    const auto               above  = nodes_above(mesh);
    const auto               values = displacement_beside_slit(mesh, 1.);
    const dealii::Point<2>   point(0.1, 0.5);
    const DisplacementFit<2> fit(mesh);
    unsigned int             n_seeds = 0;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (mesh.nodes[n].distance(point) < 1e-9)
        {
          const auto result = fit.fit(point, 0.1, fit.any_material, values, n);
          EXPECT_LT((result.gradient - gradient_beside_slit(above[n])).norm(),
                    1e-10);
          EXPECT_LT((result.displacement - values[n]).norm(), 1e-10);
          ++n_seeds;
        }
    EXPECT_EQ(n_seeds, 2u);
  }

  TEST(SeparateParts, another_material_between_separates)
  {
    // A soft layer, one cell thick, takes all of the displacement.
    auto mesh = Testing::unit_mesh<2>(10);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      mesh.cell_material[c] = std::abs(mesh.cell_centroid[c][0] - 0.45) < 0.01;
    const DisplacementFit<2> fit(mesh);
    const Values values = Testing::nodal_values<2>(mesh, [](const auto &x) {
      dealii::Tensor<1, 2> u;
      u[0] = x[0] < 0.45 ? 0. : 0.1;
      return u;
    });
    for (const double x : {0.3, 0.38, 0.4, 0.5, 0.52, 0.6})
      EXPECT_LT(
        fit.fit(dealii::Point<2>(x, 0.3), 0.1, 0, values).gradient.norm(),
        1e-10)
        << x;
    EXPECT_NEAR(
      fit.fit(dealii::Point<2>(0.42, 0.3), 0.1, 1, values).gradient[0][0],
      1.,
      1e-10);
  }

  TEST(SeparateParts, all_nodes_of_a_whole_body_count)
  {
    const auto               mesh = Testing::unit_mesh<3>(8, 0.2);
    const DisplacementFit<3> fit(mesh);
    const std::vector<dealii::Tensor<1, 3>> values(mesh.n_nodes());
    for (const auto &point : {dealii::Point<3>(0.5, 0.5, 0.5),
                              dealii::Point<3>(0.41, 0.33, 0.57),
                              dealii::Point<3>(0., 0.44, 1.)})
      {
        const double length   = fit.length_at(point);
        unsigned int n_within = 0;
        for (const auto &node : mesh.nodes)
          n_within += node.distance(point) <= 2.6 * length;
        const auto result = fit.fit(point, length, fit.any_material, values);
        EXPECT_GE(result.n_nodes, n_within); // more: a larger radius
      }
  }
} // namespace
