#include <perimorph/fracture/crack_quantities.h>
#include <perimorph/fracture/crack_slits.h>

#include "near_tip_bodies.h"
#include <gtest/gtest.h>

#include <algorithm>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Point2 = dealii::Point<2>;

  /// Square of half width 1, its middle at the origin, turned by an angle, with
  /// a slit from its left side to the middle.
  struct SlitSquare
  {
    Mesh::NodalMesh<2> mesh;
    std::vector<bool>  above; ///< per node

    /// @param pinned  place along the slit of a node that is not double
    SlitSquare(const unsigned int n_cells,
               const double       angle,
               const double       pinned = 2.)
    {
      mesh = Testing::structured_mesh<2>({{n_cells, n_cells}},
                                         Point2(-1., -1.),
                                         Point2(1., 1.),
                                         0.);
      const unsigned int        n_nodes = mesh.n_nodes();
      std::vector<unsigned int> upper(n_nodes);
      for (unsigned int n = 0; n < n_nodes; ++n)
        {
          upper[n] = n;
          if (std::abs(mesh.nodes[n][1]) < 1e-9 && mesh.nodes[n][0] < -1e-9 &&
              std::abs(mesh.nodes[n][0] - pinned) > 1e-9)
            {
              upper[n] = mesh.nodes.size();
              mesh.nodes.push_back(Point2(mesh.nodes[n]));
            }
        }
      const auto face = [&](const unsigned int c, const unsigned int first) {
        const auto &cell = mesh.cells[c];
        const auto  a = cell[first], b = cell[first + 1];
        if (std::abs(mesh.nodes[a][1]) < 1e-9 &&
            std::abs(mesh.nodes[b][1]) < 1e-9 && mesh.cell_centroid[c][0] < 0.)
          mesh.boundary_faces.push_back({c, 2 + first / 2, 0, {{a, b}}});
      };
      above.assign(mesh.n_nodes(), false);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const bool is_above = mesh.cell_centroid[c][1] > 0.;
          if (is_above)
            for (unsigned int &node : mesh.cells[c])
              {
                node        = upper[node];
                above[node] = true;
              }
          face(c, is_above ? 0 : 2);
        }
      for (auto &face : mesh.boundary_faces)
        if (mesh.cell_centroid[face.cell][1] > 0.)
          for (unsigned int &node : face.nodes)
            if (node < n_nodes)
              node = upper[node];
      const double c = std::cos(angle), s = std::sin(angle);
      for (auto &x : mesh.nodes)
        x = Point2(c * x[0] - s * x[1], s * x[0] + c * x[1]);
      mesh.owned_end = mesh.n_nodes();
      mesh.compute_derived();
    }
  };

  Testing::NearTipCase
  near_tip(const double angle)
  {
    Testing::NearTipCase field;
    field.angle = angle;
    return field;
  }

  /// The exact field, on the slit that of the side of the node.
  std::vector<dealii::Tensor<1, 2>>
  displacement_of(const Testing::NearTipCase &field, const SlitSquare &square)
  {
    std::vector<dealii::Tensor<1, 2>> displacement;
    for (unsigned int n = 0; n < square.mesh.n_nodes(); ++n)
      displacement.push_back(
        field
          .at(square.mesh.nodes[n] +
              (square.above[n] ? 1e-12 : -1e-12) * field.frame().axes[1])
          .displacement);
    return displacement;
  }

  TEST(CrackSlits, faces_of_the_slit_are_no_surface)
  {
    for (const double angle : {0., 0.52})
      {
        const SlitSquare square(20, angle);
        const auto       cracks = near_tip(angle).crack();
        const auto       on     = faces_on_cracks(square.mesh, cracks);
        EXPECT_EQ(std::count(on.begin(), on.end(), true), 20);
        EXPECT_EQ(outer_surface(square.mesh, cracks).size(), 80u);
        EXPECT_TRUE(find_tips(square.mesh, cracks).empty());
        const auto tips = find_tips(square.mesh, cracks, true);
        ASSERT_EQ(tips.size(), 1u);
        EXPECT_NEAR(tips[0].frame.origin.norm(), 0., 1e-14);
        EXPECT_NEAR(tips[0].free_distance, 1., 1e-12);
      }
  }

  TEST(CrackSlits, sides_are_connected_at_the_tip)
  {
    const auto cracks = near_tip(0.52).crack();
    const auto places = [&](const SlitSquare &square) {
      std::vector<double> list;
      for (const unsigned int n : nodes_of_both_sides(square.mesh, cracks))
        list.push_back(
          std::round(10. * square.mesh.nodes[n].distance(Point2())));
      std::sort(list.begin(), list.end());
      return list;
    };
    EXPECT_EQ(places(SlitSquare(20, 0.52)), std::vector<double>({0.}));
    EXPECT_EQ(places(SlitSquare(20, 0.52, -0.4)),
              std::vector<double>({0., 4.}));
    EXPECT_EQ(places(SlitSquare(20, 0.52, -1.)),
              std::vector<double>({0., 10.}));
  }

  TEST(CrackSlits, nodes_are_seen_from_their_own_side)
  {
    const SlitSquare square(20, 0.);
    const auto       cracks = near_tip(0.).crack();
    const auto       places = view_points(square.mesh, cracks);
    for (unsigned int n = 0; n < square.mesh.n_nodes(); ++n)
      {
        const auto  &x    = square.mesh.nodes[n];
        const Point2 move = Point2(places[n] - x);
        if (std::abs(x[1]) > 1e-9 || x[0] > 1e-9)
          EXPECT_EQ(move, Point2()) << x;
        else if (x[0] < -1e-9)
          EXPECT_GT((square.above[n] ? 1. : -1.) * move[1], 5e-5) << x;
        else // the tip, seen by both sides
          EXPECT_NEAR(move[0], 1e-4, 1e-9) << x;
      }
  }

  // Slit at z = 1/2, x < 1/2 through a cube.
  TEST(CrackSlits, front_of_a_slit_in_space)
  {
    using Point3                      = dealii::Point<3>;
    auto                      mesh    = Testing::unit_mesh<3>(4);
    const unsigned int        n_nodes = mesh.n_nodes();
    std::vector<unsigned int> upper(n_nodes);
    for (unsigned int n = 0; n < n_nodes; ++n)
      {
        upper[n] = n;
        if (std::abs(mesh.nodes[n][2] - 0.5) < 1e-9 && mesh.nodes[n][0] < 0.49)
          {
            upper[n] = mesh.nodes.size();
            mesh.nodes.push_back(Point3(mesh.nodes[n]));
          }
      }
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto &x = mesh.cell_centroid[c];
        if (x[2] > 0.5)
          for (unsigned int &node : mesh.cells[c])
            node = upper[node];
        if (x[0] < 0.5 && std::abs(x[2] - 0.5) < 0.2)
          {
            const unsigned int    first = x[2] > 0.5 ? 0 : 4;
            Mesh::BoundaryFace<3> face{c, first == 0 ? 4u : 5u, 0, {}};
            for (unsigned int v = 0; v < 4; ++v)
              face.nodes[v] = mesh.cells[c][first + v];
            mesh.boundary_faces.push_back(face);
          }
      }
    mesh.owned_end = mesh.n_nodes();
    mesh.compute_derived();
    const std::array<Point3, 4> corners = {{Point3(0., 0., 0.5),
                                            Point3(0.5, 0., 0.5),
                                            Point3(0.5, 1., 0.5),
                                            Point3(0., 1., 0.5)}};
    const Bonds::CrackSet<3>    cracks(
      {{{{corners[0], corners[1], corners[2]}}, 0, 0},
          {{{corners[0], corners[2], corners[3]}}, 0, 0}});
    const auto on = faces_on_cracks(mesh, cracks);
    EXPECT_EQ(std::count(on.begin(), on.end(), true), 16);
    EXPECT_EQ(nodes_of_both_sides(mesh, cracks).size(), 5u);
    EXPECT_TRUE(find_fronts(mesh, cracks).empty());
    const auto fronts = find_fronts(mesh, cracks, true);
    ASSERT_EQ(fronts.size(), 1u);
    EXPECT_NEAR(fronts[0].length(), 1., 1e-14);
    EXPECT_NEAR(fronts[0].at(0.3).frame.axes[0][0], 1., 1e-14);
    const auto places = view_points(mesh, cracks);
    for (unsigned int n = n_nodes; n < mesh.n_nodes(); ++n)
      EXPECT_GT(places[n][2], 0.5 + 1e-5);
    for (unsigned int n = 0; n < n_nodes; ++n)
      if (upper[n] != n)
        {
          EXPECT_LT(places[n][2], 0.5 - 1e-5);
        }
  }

  // Beside the tip the faces are connected around it.
  TEST(CrackSlits, fits_take_nodes_of_one_face)
  {
    for (const double angle : {0., 0.52})
      {
        const SlitSquare square(20, angle);
        const auto       field  = near_tip(angle);
        const auto       cracks = field.crack();
        const auto       fit    = visible_fit(square.mesh, cracks, {}, true);
        // one on the upper face, zero on the lower one
        std::vector<dealii::Tensor<1, 2>> values(square.mesh.n_nodes());
        const auto                       &axes = field.frame().axes;
        for (unsigned int n = 0; n < square.mesh.n_nodes(); ++n)
          if (square.above[n] && square.mesh.nodes[n] * axes[0] < -1e-9)
            values[n][0] = 1.;
        for (const double r : {0.31, 0.4, 0.62})
          for (const double side : {-1., 1.})
            {
              const auto result =
                fit->fit(Point2(-r * axes[0] + side * 1e-7 * axes[1]),
                         0.1,
                         0,
                         values);
              EXPECT_GE(result.n_nodes, 6u);
              EXPECT_NEAR(result.displacement[0], side > 0. ? 1. : 0., 1e-12);
            }
        // at the nodes of the faces, who say where they are themselves
        for (unsigned int n = 0; n < square.mesh.n_nodes(); ++n)
          {
            const auto &x = square.mesh.nodes[n];
            if (std::abs(x * axes[1]) < 1e-9 && x * axes[0] < -0.3)
              {
                EXPECT_NEAR(fit->fit(x, 0.1, 0, values, n).displacement[0],
                            square.above[n] ? 1. : 0.,
                            1e-12)
                  << x;
              }
          }
      }
  }

  TEST(CrackSlits, factors_of_the_exact_field)
  {
    const auto materials =
      Testing::unit_material<2>(Testing::near_tip_poissons_ratio,
                                near_tip(0.).state);
    for (const double angle : {0., 0.52})
      {
        const SlitSquare                 square(80, angle);
        const auto                       field  = near_tip(angle);
        const auto                       cracks = field.crack();
        const std::vector<double>        none(square.mesh.n_nodes(), 0.);
        const Peridynamics::FamilySet<2> families;
        const auto           displacement = displacement_of(field, square);
        const CrackedBody<2> body{{square.mesh, materials, displacement},
                                  cracks,
                                  none,
                                  none,
                                  &families,
                                  {},
                                  true};
        const auto           tips = tip_quantities(body,
                                         find_tips(square.mesh, cracks, true),
                                         {},
                                         MPI_COMM_SELF);
        ASSERT_EQ(tips.size(), 1u);
        ASSERT_EQ(tips[0].values.size(), 2u);
        for (const auto &value : tips[0].values)
          {
            EXPECT_NEAR(value.K_I, field.K_I, 3e-3);
            EXPECT_NEAR(value.K_II, field.K_II, 3e-3);
            EXPECT_NEAR(value.T_stress, field.T, 3e-3);
          }
        EXPECT_EQ(tips[0].opening.n_places, 16u);
        EXPECT_NEAR(tips[0].opening.K_I, field.K_I, 5e-3);
        EXPECT_NEAR(tips[0].opening.K_II, field.K_II, 5e-3);
      }
  }
} // namespace
