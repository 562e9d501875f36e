#include <perimorph/mesh/cell_geometry.h>

#include <gtest/gtest.h>
#include <harness/test_meshes.h>

namespace Perimorph::Mesh
{
  namespace
  {
    template <int dim>
    void
    expect_exact_sums()
    {
      const auto mesh  = Testing::unit_mesh<dim>(4, 0.25);
      double     total = 0.;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const CellGeometry<dim> geometry(mesh.corners(c));
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            {
              total += geometry.jxw[q];
              // Shape functions sum to one and reproduce the position.
              double                 sum = 0.;
              dealii::Point<dim>     point;
              dealii::Tensor<1, dim> gradient_sum;
              dealii::Tensor<2, dim> unit;
              for (unsigned int v = 0; v < geometry.n_nodes; ++v)
                {
                  sum += geometry.shape_value(q, v);
                  point +=
                    geometry.shape_value(q, v) * mesh.nodes[mesh.cells[c][v]];
                  gradient_sum += geometry.gradients[q][v];
                  unit += outer_product(
                    dealii::Tensor<1, dim>(mesh.nodes[mesh.cells[c][v]]),
                    geometry.gradients[q][v]);
                }
              EXPECT_NEAR(sum, 1., 1e-14);
              EXPECT_NEAR(point.distance(geometry.points[q]), 0., 1e-14);
              EXPECT_NEAR(gradient_sum.norm(), 0., 1e-12);
              for (int d = 0; d < dim; ++d)
                unit[d][d] -= 1.;
              EXPECT_NEAR(unit.norm(), 0., 1e-12);
            }
        }
      EXPECT_NEAR(total, 1., 1e-13);
      double volume = 0.;
      for (const double v : mesh.volume)
        volume += v;
      EXPECT_NEAR(volume, 1., 1e-13);
    }
  } // namespace

  TEST(CellGeometry, quadrature_is_exact_on_distorted_cells)
  {
    expect_exact_sums<2>();
    expect_exact_sums<3>();
  }

  TEST(CellGeometry, inverse_map_finds_the_unit_point)
  {
    const auto mesh = Testing::unit_mesh<3>(3, 0.3);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const dealii::Point<3> expected(0.2, 0.7, 0.9);
        const auto             values = shape_values<3>(expected);
        dealii::Point<3>       image, found;
        for (unsigned int v = 0; v < 8; ++v)
          image += values[v] * mesh.nodes[mesh.cells[c][v]];
        ASSERT_TRUE(map_to_unit_cell<3>(mesh.corners(c), image, found));
        EXPECT_NEAR(found.distance(expected), 0., 1e-11);
      }
  }

  TEST(CellGeometry, inverted_cells_are_seen)
  {
    using P = dealii::Point<2>;
    EXPECT_NEAR(
      smallest_relative_jacobian<2>({{P(0, 0), P(2, 0), P(0, 1), P(2, 1)}}),
      1.,
      1e-12);
    EXPECT_LT(
      smallest_relative_jacobian<2>({{P(0, 0), P(1, 0), P(0, 1), P(0.2, 0.2)}}),
      0.);
    EXPECT_LT(
      smallest_relative_jacobian<2>({{P(1, 0), P(0, 0), P(1, 1), P(0, 1)}}),
      0.);
  }
} // namespace Perimorph::Mesh
