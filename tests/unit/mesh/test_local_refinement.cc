#include <perimorph/base/exceptions.h>
#include <perimorph/mesh/boundary_curves.h>
#include <perimorph/mesh/distributed_mesh.h>
#include <perimorph/mesh/local_refinement.h>
#include <perimorph/mesh/refinement_rule.h>
#include <perimorph/mesh/spline_curve.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <cmath>
#include <numeric>
#include <set>

namespace Perimorph::Mesh
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;

    template <int dim>
    std::vector<unsigned int>
    cells_near(const GmshMesh<dim>      &mesh,
               const dealii::Point<dim> &place,
               const double              distance)
    {
      std::vector<unsigned int> cells;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int p : mesh.cells[c])
          if (mesh.points[p].distance(place) < distance)
            {
              cells.push_back(c);
              break;
            }
      return cells;
    }

    template <int dim>
    std::vector<unsigned int>
    all_cells(const GmshMesh<dim> &mesh)
    {
      std::vector<unsigned int> cells(mesh.cells.size());
      std::iota(cells.begin(), cells.end(), 0u);
      return cells;
    }

    template <int dim>
    dealii::Point<dim>
    middle()
    {
      dealii::Point<dim> point;
      for (int d = 0; d < dim; ++d)
        point[d] = 0.5;
      return point;
    }

    /// Area of a face: a parallelogram or nearly so.
    template <int dim>
    double
    measure(const NodalMesh<dim> &mesh, const BoundaryFace<dim> &face)
    {
      const auto corner = [&](const unsigned int v) {
        return mesh.nodes[face.nodes[v]];
      };
      if constexpr (dim == 2)
        return corner(0).distance(corner(1));
      else
        return 0.5 * dealii::cross_product_3d(corner(3) - corner(0),
                                              corner(2) - corner(1))
                       .norm();
    }

    /// A distorted block, two times finer around its middle and again around a
    /// corner: volume, surface and groups are those of the block, and the
    /// linear functions are continuous.
    template <int dim>
    void
    check_block()
    {
      auto coarse =
        Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(dim == 2 ? 6 : 4, 0.2));
      for (unsigned int c = 0; c < coarse.cells.size(); c += 2)
        coarse.volumes["every second"].push_back(c);
      LocalRefinement<dim> refinement(coarse, true);
      refinement.refine(cells_near(refinement.mesh(), middle<dim>(), 0.2));
      refinement.refine(cells_near(refinement.mesh(), middle<dim>(), 0.1));
      refinement.refine(
        cells_near(refinement.mesh(), dealii::Point<dim>(), 0.1));
      const auto fine = refinement.mesh();
      ASSERT_FALSE(fine.hanging.empty());
      EXPECT_TRUE(refinement.curves().empty());
      for (unsigned int p = 0; p < coarse.points.size(); ++p)
        EXPECT_EQ(fine.points[p].distance(coarse.points[p]), 0.);
      for (const auto &[point, parents] : fine.hanging)
        {
          dealii::Point<dim> mean;
          double             sum = 0.;
          for (const auto &[parent, weight] : parents)
            {
              EXPECT_EQ(fine.hanging.count(parent), 0u);
              mean += weight * fine.points[parent];
              sum += weight;
            }
          EXPECT_NEAR(sum, 1., 1e-15);
          EXPECT_NEAR(mean.distance(fine.points[point]), 0., 1e-15);
        }

      const DistributedMesh<dim> mesh(fine, MPI_COMM_WORLD);
      const auto                &nodal = mesh.nodal();
      EXPECT_NEAR(std::accumulate(nodal.volume.begin(), nodal.volume.end(), 0.),
                  1.,
                  1e-12);
      EXPECT_EQ(nodal.hanging.size(), fine.hanging.size());
      double surface = 0.;
      for (const auto &face : nodal.boundary_faces)
        surface += measure(nodal, face);
      EXPECT_NEAR(surface, 2. * dim, 1e-12);
      for (const auto &name : mesh.boundary_names())
        {
          double area = 0.;
          for (const unsigned int f : mesh.boundary(name, "test"))
            area += measure(nodal, nodal.boundary_faces[f]);
          EXPECT_NEAR(area, 1., 1e-12) << name;
        }
      EXPECT_EQ(mesh.volume("body", "test").size(), nodal.n_cells());
      const auto &pieces = mesh.pieces();
      EXPECT_EQ(*std::max_element(pieces.begin(), pieces.end()), 0u);

      // A group keeps its volume, too.
      const auto volume_of = [](const auto &some, const auto &cells) {
        double volume = 0.;
        for (const unsigned int c : cells)
          {
            typename NodalMesh<dim>::Cell cell = some.cells[c];
            NodalMesh<dim>                one;
            for (unsigned int v = 0; v < cell.size(); ++v)
              {
                one.nodes.push_back(some.points[cell[v]]);
                cell[v] = v;
              }
            one.cells.push_back(cell);
            one.compute_derived();
            volume += std::accumulate(one.volume.begin(), one.volume.end(), 0.);
          }
        return volume;
      };
      EXPECT_NEAR(volume_of(fine, fine.volumes.at("every second")),
                  volume_of(coarse, coarse.volumes.at("every second")),
                  dim == 2 ? 1e-12 : 1e-2); // 3D: faces are not flat
    }

    /// Largest distance of boundary points from a radius (without the height).
    template <int dim>
    double
    off_radius(const GmshMesh<dim> &mesh,
               const std::string   &boundary,
               const double         radius,
               const int            n_coordinates)
    {
      double worst = 0.;
      for (const auto &face : mesh.surfaces.at(boundary))
        for (const unsigned int p : face)
          {
            // On a straight side of a coarser face.
            if (mesh.hanging.count(p) > 0)
              continue;
            double square = 0.;
            for (int d = 0; d < n_coordinates; ++d)
              square += mesh.points[p][d] * mesh.points[p][d];
            worst = std::max(worst, std::abs(std::sqrt(square) - radius));
          }
      return worst;
    }

    /// A boundary "line" of one row of cells below a line of points.
    GmshMesh<2>
    below(const std::vector<dealii::Point<2>> &line)
    {
      GmshMesh<2>        mesh;
      const unsigned int n = line.size();
      for (const auto &point : line)
        mesh.points.push_back(point);
      for (const auto &point : line)
        mesh.points.emplace_back(point[0], point[1] - 1.);
      for (unsigned int k = 0; k + 1 < n; ++k)
        {
          mesh.cells.push_back({{n + k, n + k + 1, k, k + 1}});
          mesh.surfaces["line"].push_back({{k, k + 1}});
        }
      return mesh;
    }

    double
    farthest_from_chords(const std::vector<dealii::Point<2>> &line)
    {
      LocalRefinement<2> refinement(below(line), true);
      refinement.refine(all_cells(refinement.mesh()));
      const auto fine = refinement.mesh();
      double     away = 0.;
      for (const auto &face : fine.surfaces.at("line"))
        for (const unsigned int p : face)
          {
            double nearest = 1e9;
            for (unsigned int k = 0; k + 1 < line.size(); ++k)
              {
                const auto   along = line[k + 1] - line[k];
                const double s = std::clamp((fine.points[p] - line[k]) * along /
                                              along.norm_square(),
                                            0.,
                                            1.);
                nearest =
                  std::min(nearest,
                           fine.points[p].distance(line[k] + s * along));
              }
            away = std::max(away, nearest);
          }
      return away;
    }
  } // namespace

  TEST(LocalRefinement, keeps_volume_surface_and_groups_of_a_block)
  {
    check_block<2>();
    check_block<3>();
  }

  TEST(LocalRefinement, puts_new_points_on_circles_and_cylinders)
  {
    auto ring = Testing::as_gmsh_mesh(
      Testing::annulus_mesh<2>(16, 3, 1., 3.)); // x-: hole, x+: outside
    LocalRefinement<2> refinement(ring, true);
    ASSERT_EQ(refinement.curves().size(), 2u);
    EXPECT_NE(refinement.curves()[1].find("'x-' is a circle around"),
              std::string::npos)
      << refinement.curves()[1];
    for (int pass = 0; pass < 3; ++pass)
      refinement.refine(
        cells_near(refinement.mesh(), dealii::Point<2>(), 1.01));
    const auto fine = refinement.mesh();
    EXPECT_EQ(fine.surfaces.at("x-").size(), 128u);
    EXPECT_LT(off_radius(fine, "x-", 1., 2), 1e-14);
    EXPECT_LT(off_radius(fine, "x+", 3., 2), 1e-14);
    // Cells beside the hole are as good as in a mesh made that fine.
    const DistributedMesh<2> mesh(fine, MPI_COMM_WORLD);
    for (const unsigned int f : mesh.boundary("x-", "test"))
      {
        const auto &nodal = mesh.nodal();
        const auto &cell  = nodal.cells[nodal.boundary_faces[f].cell];
        double      area  = 0.; // by the diagonals
        const auto  a     = nodal.nodes[cell[3]] - nodal.nodes[cell[0]];
        const auto  b     = nodal.nodes[cell[2]] - nodal.nodes[cell[1]];
        area              = 0.5 * std::abs(a[0] * b[1] - a[1] * b[0]);
        EXPECT_NEAR(area, 2. * pi / 128. * 2. / 24., 0.3 * 2. * pi / 3072.);
      }

    auto pipe =
      Testing::as_gmsh_mesh(Testing::annulus_mesh<3>(16, 2, 1., 2., 2, 1.));
    LocalRefinement<3> of_pipe(pipe, true);
    ASSERT_EQ(of_pipe.curves().size(), 2u);
    EXPECT_NE(of_pipe.curves()[0].find("cylinder along z"), std::string::npos);
    of_pipe.refine(
      cells_near(of_pipe.mesh(), dealii::Point<3>(1., 0., 0.), 0.6));
    of_pipe.refine(
      cells_near(of_pipe.mesh(), dealii::Point<3>(1., 0., 0.), 0.3));
    const auto fine_pipe = of_pipe.mesh();
    EXPECT_FALSE(fine_pipe.hanging.empty());
    EXPECT_LT(off_radius(fine_pipe, "x-", 1., 2), 1e-14);
    EXPECT_LT(off_radius(fine_pipe, "x+", 2., 2), 1e-14);
  }

  TEST(LocalRefinement, puts_new_points_on_spheres)
  {
    dealii::Triangulation<3> shell;
    dealii::GridGenerator::hyper_shell(shell, dealii::Point<3>(), 1., 2., 6);
    shell.refine_global(1);
    GmshMesh<3>                          mesh;
    std::map<unsigned int, unsigned int> number;
    const auto add = [&](const unsigned int v, const dealii::Point<3> &point) {
      if (number.emplace(v, mesh.points.size()).second)
        mesh.points.push_back(point);
      return number.at(v);
    };
    for (const auto &cell : shell.active_cell_iterators())
      {
        mesh.cells.emplace_back();
        for (const unsigned int v : cell->vertex_indices())
          mesh.cells.back()[v] = add(cell->vertex_index(v), cell->vertex(v));
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            {
              auto &group =
                mesh
                  .surfaces[cell->face(f)->vertex(0).norm() < 1.5 ? "inside"
                                                                  : "outside"];
              group.emplace_back();
              for (unsigned int v = 0; v < 4; ++v)
                group.back()[v] = number.at(cell->face(f)->vertex_index(v));
            }
      }
    LocalRefinement<3> refinement(mesh, true);
    ASSERT_EQ(refinement.curves().size(), 2u);
    EXPECT_NE(refinement.curves()[0].find("'inside' is a sphere around"),
              std::string::npos);
    for (int pass = 0; pass < 2; ++pass)
      refinement.refine(
        cells_near(refinement.mesh(), dealii::Point<3>(1., 0., 0.), 0.4));
    const auto fine = refinement.mesh();
    EXPECT_GT(fine.surfaces.at("inside").size(), 24u);
    EXPECT_LT(off_radius(fine, "inside", 1., 3), 1e-14);
    EXPECT_LT(off_radius(fine, "outside", 2., 3), 1e-14);
    // As they are in the file, if that is asked for.
    LocalRefinement<3> straight(mesh, false);
    straight.refine(all_cells(straight.mesh()));
    EXPECT_GT(off_radius(straight.mesh(), "inside", 1., 3), 0.01);
  }

  TEST(LocalRefinement, follows_an_ellipse_with_fourth_order)
  {
    std::vector<double> errors;
    for (const unsigned int n : {24u, 48u, 96u})
      {
        std::vector<dealii::Point<2>> line;
        for (unsigned int k = 0; k <= n; ++k) // a half
          line.emplace_back(2. * std::cos(pi * (n - k) / n),
                            std::sin(pi * (n - k) / n));
        LocalRefinement<2> refinement(below(line), true);
        ASSERT_EQ(refinement.curves().size(), 1u);
        EXPECT_NE(refinement.curves()[0].find("smooth line"),
                  std::string::npos);
        refinement.refine(all_cells(refinement.mesh()));
        const auto fine = refinement.mesh();
        errors.push_back(0.);
        for (const auto &face : fine.surfaces.at("line"))
          for (const unsigned int p : face)
            errors.back() = std::max(
              errors.back(),
              std::abs(std::hypot(0.5 * fine.points[p][0], fine.points[p][1]) -
                       1.));
      }
    EXPECT_LT(errors[2], 1e-5);
    EXPECT_GT(std::log2(errors[1] / errors[2]), 3.5);
  }

  TEST(LocalRefinement, keeps_kinks_and_chamfers)
  {
    const auto points = [](const std::vector<std::pair<double, double>> &list) {
      std::vector<dealii::Point<2>> line;
      for (const auto &[x, y] : list)
        line.emplace_back(x, y);
      return line;
    };
    // Two straight parts that meet at 20 degrees; a chamfer; a step.
    EXPECT_LT(
      farthest_from_chords(
        points({{-3, 0}, {-2, 0}, {-1, 0}, {0, 0}, {1, .3}, {2, .6}, {3, .9}})),
      1e-14);
    EXPECT_LT(
      farthest_from_chords(points({{0, 0}, {1, 0}, {2, -.8}, {2.1, -2}})),
      1e-14);
    const LocalRefinement<2> chamfer(
      below(points({{0, 0}, {1, 0}, {2, -.8}, {2.1, -2}})),
      true);
    EXPECT_EQ(chamfer.unknown_curves(), std::vector<std::string>{"line"});
  }

  TEST(SplineCurve, is_exact_for_a_circle_to_fourth_order_and_periodic)
  {
    std::vector<double> errors;
    for (const unsigned int n : {16u, 32u})
      {
        std::vector<dealii::Point<2>> points;
        for (unsigned int k = 0; k < n; ++k)
          points.emplace_back(std::cos(2. * pi * k / n),
                              std::sin(2. * pi * k / n));
        const SplineCurve curve(points, true);
        errors.push_back(0.);
        for (unsigned int k = 0; k < 200; ++k)
          {
            const double           angle = 2. * pi * k / 200.;
            const dealii::Point<2> outside(1.3 * std::cos(angle),
                                           1.3 * std::sin(angle));
            const auto foot = curve.push_forward(curve.pull_back(outside));
            errors.back() =
              std::max(errors.back(),
                       foot.distance(
                         dealii::Point<2>(std::cos(angle), std::sin(angle))));
          }
      }
    EXPECT_LT(errors[1], 1e-4);
    EXPECT_GT(std::log2(errors[0] / errors[1]), 2.5);
  }

  namespace
  {
    /// Cells around a ball in the middle halved down to a spacing, hanging
    /// nodes kept out of the families.
    template <int dim>
    void
    check_rule(const double grading)
    {
      LocalRefinement<dim> refinement(
        Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(dim == 2 ? 8 : 6, 0.1)),
        true);
      RegionParameters region;
      region.features = {
        {Parameters::FeatureKind::ball, "", std::vector<double>(dim + 1, 0.5)}};
      region.features[0].numbers[dim] = 0.05;
      region.core_size                = {0.05, false, false};
      region.blending_width           = {0.05, false, false};
      region.horizon_ratio            = 1.5;
      RefinementParameters rule;
      rule.spacing  = 0.05;
      rule.distance = {0., false, false};
      rule.grading  = grading;
      auto mesh     = std::make_unique<DistributedMesh<dim>>(refinement.mesh(),
                                                         MPI_COMM_WORLD);
      for (auto large = too_large_cells(*mesh, region, rule); !large.empty();
           large      = too_large_cells(*mesh, region, rule))
        {
               refinement.refine(large);
               mesh = std::make_unique<DistributedMesh<dim>>(refinement.mesh(),
                                                        MPI_COMM_WORLD);
        }
      auto map = make_region_map(*mesh, region);
      for (auto near = cells_that_disturb_families(mesh->nodal(), map);
           !near.empty();
           near = cells_that_disturb_families(mesh->nodal(), map))
        {
          refinement.refine(near);
          mesh = std::make_unique<DistributedMesh<dim>>(refinement.mesh(),
                                                        MPI_COMM_WORLD);
          map  = make_region_map(*mesh, region);
        }
      const auto &nodal = mesh->nodal();
      ASSERT_GT(map.n_core, 0u);
      EXPECT_FALSE(nodal.hanging.empty());
      double largest = 0.;
      for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
        {
          largest = std::max(largest, nodal.spacing[n]);
          if (map.alpha[n] == 0.)
            continue;
          EXPECT_LE(nodal.spacing[n], 0.055);
          for (const auto &hanging : nodal.hanging)
            EXPECT_GT(nodal.nodes[n].distance(nodal.nodes[hanging.first]),
                      map.horizon[n]);
        }
      // The corners are as they were, or as fine as they may be.
      if (grading > 10.)
        {
          EXPECT_GT(largest, 0.1);
        }
      for (unsigned int c = 0; c < nodal.n_cells(); ++c)
        {
          double edges = 0.;
          for (unsigned int v = 0; v < nodal.nodes_per_cell; ++v)
            for (int d = 0; d < dim; ++d)
              edges += nodal.nodes[nodal.cells[c][v]].distance(
                nodal.nodes[nodal.cells[c][v ^ (1u << d)]]);
          const double away =
            nodal.cell_centroid[c].distance(middle<dim>()) - 0.15;
          EXPECT_LE(edges / (dim * nodal.nodes_per_cell),
                    1.00001 * (rule.spacing + grading * std::max(0., away)));
        }
    }
  } // namespace

  TEST(RefinementRule, refines_the_region_and_keeps_hanging_nodes_away)
  {
    check_rule<2>(1000.);
    check_rule<3>(1000.);
    check_rule<2>(0.2);
    check_rule<3>(0.2);
  }
} // namespace Perimorph::Mesh
