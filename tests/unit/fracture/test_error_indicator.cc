#include <perimorph/fracture/error_indicator.h>
#include <perimorph/materials/linear_elastic.h>

#include <gtest/gtest.h>
#include <harness/test_meshes.h>

namespace Perimorph::Fracture
{
  namespace
  {
    template <int dim>
    ErrorIndicator
    indicator_of(const Mesh::NodalMesh<dim> &mesh,
                 const double                slope,
                 const double                curvature,
                 const std::vector<double>  &alpha)
    {
      MaterialList<dim> materials;
      materials.push_back(std::make_unique<Materials::LinearElastic<dim>>(
        2.,
        0.,
        dim == 2 ? Materials::PlaneState::plane_stress
                 : Materials::PlaneState::three_dimensional));
      const DisplacementFit<dim>          fit(mesh);
      std::vector<dealii::Tensor<1, dim>> displacement(mesh.n_nodes());
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        {
          const double x     = mesh.nodes[n][0];
          displacement[n][0] = slope * x + curvature * x * x;
        }
      return estimate_error(fit, materials, alpha, displacement);
    }

    /// u_x = x^2 on cells of length h: the strain is off by 2 x minus its mean,
    /// E times the square of which gives E h^2 / 3 per volume.
    template <int dim>
    void
    check_quadratic_field()
    {
      const unsigned int  n    = dim == 2 ? 8 : 5;
      const auto          mesh = Testing::unit_mesh<dim>(n);
      std::vector<double> alpha(mesh.n_nodes(), 0.);
      const auto          linear = indicator_of(mesh, 1., 0., alpha);
      EXPECT_LT(linear.relative_error(), 1e-12);
      EXPECT_NEAR(linear.energy, 2., 1e-12);

      const double h = 1. / n, volume = std::pow(h, dim);
      const auto   quadratic = indicator_of(mesh, 0., 1., alpha);
      for (const double square : quadratic.squares)
        EXPECT_NEAR(square, 2. * h * h / 3. * volume, 1e-6 * volume);
      // E times the integral of 4 x^2.
      EXPECT_NEAR(quadratic.relative_error(),
                  std::sqrt(h * h / 3. / (4. / 3.)),
                  1e-6);

      // Cells with peridynamics do not count.
      alpha[mesh.cells[0][0]] = 0.5;
      EXPECT_EQ(indicator_of(mesh, 0., 1., alpha).squares[0], 0.);
    }
  } // namespace

  TEST(ErrorIndicator, is_exact_for_quadratic_fields)
  {
    check_quadratic_field<2>();
    check_quadratic_field<3>();
  }

  TEST(ErrorIndicator, chooses_the_fewest_cells_and_all_that_are_alike)
  {
    ErrorIndicator indicator;
    indicator.squares = {1., 4., 0., 2., 2. * (1. + 1e-9), 1.};
    EXPECT_EQ(cells_with_most_error(indicator, 0.3),
              std::vector<unsigned int>{1});
    EXPECT_EQ(cells_with_most_error(indicator, 0.5),
              (std::vector<unsigned int>{1, 3, 4}));
    EXPECT_EQ(cells_with_most_error(indicator, 1.).size(), 5u);
    EXPECT_TRUE(cells_with_most_error(indicator, 0.).empty());
    indicator.squares.assign(3, 0.);
    EXPECT_TRUE(cells_with_most_error(indicator, 0.5).empty());
  }
} // namespace Perimorph::Fracture
