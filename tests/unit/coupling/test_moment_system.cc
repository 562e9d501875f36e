#include <perimorph/coupling/moment_system.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace Perimorph;

namespace
{
  /// Box with corners moved by a part of its sides.
  template <int dim>
  typename Mesh::CellGeometry<dim>::Corners
  moved_box(const dealii::Tensor<1, dim> &sides,
            const double                  part,
            std::mt19937                 &random)
  {
    std::uniform_real_distribution<double>    move(-part, part);
    typename Mesh::CellGeometry<dim>::Corners corners;
    for (unsigned int v = 0; v < corners.size(); ++v)
      for (int d = 0; d < dim; ++d)
        corners[v][d] = sides[d] * (10. + ((v >> d) & 1u) + move(random));
    return corners;
  }

  /// Random tensors at the Gauss points, their moments, and what the system
  /// makes of these: difference to the shortest tensors with these moments, by
  /// a rank-revealing decomposition of the equations themselves.
  template <int dim>
  double
  error_of(const typename Mesh::CellGeometry<dim>::Corners &corners,
           std::mt19937                                    &random,
           Coupling::MomentSystem<dim>                     &system)
  {
    using System                     = Coupling::MomentSystem<dim>;
    using Tensor                     = Coupling::FullySymmetricTensor<dim>;
    constexpr unsigned int        n3 = System::n3, n4 = System::n4;
    const auto                   &table = Coupling::symmetric_indices<dim>;
    const Mesh::CellGeometry<dim> geometry(corners);

    Eigen::MatrixXd A =
      Eigen::MatrixXd::Zero(System::n_nodes * n3, System::n_points * n4);
    const auto root = [&](const unsigned int q, const unsigned int c) {
      return std::sqrt(geometry.jxw[q] * Tensor::multiplicity(c));
    };
    for (unsigned int l = 0; l < System::n_nodes; ++l)
      for (unsigned int q = 0; q < System::n_points; ++q)
        for (unsigned int t = 0; t < n3; ++t)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const auto        &abc = table.triples[t];
              const unsigned int c =
                Tensor::component(abc[0], abc[1], abc[2], d);
              A(l * n3 + t, q * n4 + c) +=
                geometry.gradients[q][l][d] * geometry.jxw[q] / root(q, c);
            }
    std::uniform_real_distribution<double> value(-1., 1.);
    Eigen::VectorXd                        y(A.cols());
    for (double &component : y)
      component = value(random);
    const Eigen::VectorXd    T = A * y;
    typename System::Moments moments;
    for (unsigned int l = 0; l < System::n_nodes; ++l)
      for (unsigned int t = 0; t < n3; ++t)
        moments[l][t] = T[l * n3 + t];
    const Eigen::VectorXd expected =
      A.completeOrthogonalDecomposition().solve(T);

    typename System::PointTensors tensors;
    system.solve(corners, geometry, moments, tensors);
    double error = 0.;
    for (unsigned int q = 0; q < System::n_points; ++q)
      for (unsigned int c = 0; c < n4; ++c)
        error = std::max(error,
                         std::abs(root(q, c) * tensors[q].components[c] -
                                  expected[q * n4 + c]));
    return error / expected.norm();
  }

  template <int dim>
  void
  check_cells(const unsigned int expected_rank)
  {
    std::mt19937                random(7);
    Coupling::MomentSystem<dim> system;
    for (const double longest : {1., 3., 30.})
      for (const double part : {0., 0.1, 0.25})
        for (unsigned int repeat = 0; repeat < 3; ++repeat)
          {
            dealii::Tensor<1, dim> sides;
            for (int d = 0; d < dim; ++d)
              sides[d] = 1e-3 * (d == 0 ? longest : 1.);
            EXPECT_LT(error_of<dim>(moved_box<dim>(sides, part, random),
                                    random,
                                    system),
                      1e-12)
              << "sides 1:" << longest << ", corners moved by " << part;
            EXPECT_EQ(system.rank, expected_rank);
            EXPECT_LT(system.residual, 1e-13 * system.moment);
          }
  }

  TEST(MomentSystem, shortest_solution_in_2d)
  {
    check_cells<2>(9);
  }

  TEST(MomentSystem, shortest_solution_in_3d)
  {
    check_cells<3>(55);
  }

  /// The known null fields are too small to see: pseudo-inverse.
  TEST(MomentSystem, nearly_degenerate_cell)
  {
    std::mt19937              random(7);
    Coupling::MomentSystem<2> system;
    dealii::Tensor<1, 2>      sides;
    sides[0] = 1e7;
    sides[1] = 1.;
    const auto error =
      error_of<2>(moved_box<2>(sides, 0., random), random, system);
    EXPECT_TRUE(std::isfinite(error));
    EXPECT_LT(system.rank, 9u);
  }
} // namespace
