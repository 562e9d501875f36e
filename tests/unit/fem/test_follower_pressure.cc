#include <perimorph/fem/elastic_cells.h>
#include <perimorph/fem/follower_pressure.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/expressions.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Fem
{
  namespace
  {
    template <int dim>
    struct PressedBody
    {
      Mesh::DistributedMesh<dim>             mesh;
      std::unique_ptr<NodePartition<dim>>    partition;
      std::unique_ptr<FollowerPressure<dim>> pressure;

      explicit PressedBody(const std::string &value)
        : mesh(Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(4, 0.2)),
               MPI_COMM_WORLD)
      {
        std::vector<unsigned int> needed;
        add_cell_nodes(mesh.nodal(), needed);
        partition = std::make_unique<NodePartition<dim>>(mesh.nodal(),
                                                         needed,
                                                         MPI_COMM_WORLD);
        std::vector<SurfaceLoad<dim>> loads;
        for (const auto &name : mesh.boundary_names())
          loads.push_back({name, {}, Testing::expression(value), true});
        pressure =
          std::make_unique<FollowerPressure<dim>>(mesh, *partition, loads);
        pressure->set_time(2.);
      }

      template <typename Function>
      Vector
      field(const Function &function) const
      {
        Vector u;
        partition->initialize(u);
        for (unsigned int n = 0; n < partition->n_owned(); ++n)
          {
            const dealii::Tensor<1, dim> value =
              function(partition->position(n));
            for (int d = 0; d < dim; ++d)
              u.local_element(dim * n + d) = value[d];
          }
        u.update_ghost_values();
        return u;
      }

      Vector
      forces(const Vector &u) const
      {
        Vector result;
        partition->initialize(result);
        pressure->add_residual(u, result);
        result.compress(dealii::VectorOperation::add);
        return result;
      }
    };

    template <int dim>
    dealii::Tensor<1, dim>
    wave(const dealii::Point<dim> &x)
    {
      dealii::Tensor<1, dim> u;
      for (int d = 0; d < dim; ++d)
        u[d] = 0.2 * std::sin(2. * x[0] + 3. * x[dim - 1] + d);
      return u;
    }
  } // namespace

  template <typename Dimension>
  class FollowerPressureIn : public ::testing::Test
  {};
  using Dimensions = ::testing::Types<std::integral_constant<int, 2>,
                                      std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(FollowerPressureIn, Dimensions);

  TYPED_TEST(FollowerPressureIn, all_around_is_in_balance_however_deformed)
  {
    constexpr int          dim = TypeParam::value;
    const PressedBody<dim> body("3*t");
    const auto             u       = body.field(wave<dim>);
    const auto             f       = body.forces(u);
    double                 largest = f.linfty_norm();
    for (int d = 0; d < dim; ++d)
      {
        double sum = 0.;
        for (unsigned int n = 0; n < body.partition->n_owned(); ++n)
          sum += f.local_element(dim * n + d);
        EXPECT_LT(std::abs(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD)),
                  1e-12 * largest);
      }
    double moment = 0.;
    for (unsigned int n = 0; n < body.partition->n_owned(); ++n)
      {
        const auto x = body.partition->position(n);
        moment +=
          (x[0] + u.local_element(dim * n)) * f.local_element(dim * n + 1) -
          (x[1] + u.local_element(dim * n + 1)) * f.local_element(dim * n);
      }
    EXPECT_LT(std::abs(dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD)),
              1e-12 * largest);
  }

  TYPED_TEST(FollowerPressureIn, grows_with_the_area_of_the_surface)
  {
    constexpr int          dim = TypeParam::value;
    const PressedBody<dim> body("3*t");
    const auto             rest = body.forces(
      body.field([](const auto &) { return dealii::Tensor<1, dim>(); }));
    auto twice = body.forces(
      body.field([](const auto &x) { return dealii::Tensor<1, dim>(x); }));
    twice.add(-std::pow(2., dim - 1), rest);
    EXPECT_GT(rest.linfty_norm(), 0.01);
    EXPECT_LT(twice.linfty_norm(), 1e-13);
  }

  TYPED_TEST(FollowerPressureIn, tangent_is_the_derivative_of_the_force)
  {
    constexpr int          dim = TypeParam::value;
    const PressedBody<dim> body("t*(1 + x)");
    const auto             u         = body.field(wave<dim>);
    const auto             direction = body.field([](const auto &x) {
      dealii::Tensor<1, dim> v;
      for (int d = 0; d < dim; ++d)
        v[d] = std::cos(5. * x[d] + d);
      return v;
    });
    const double           step      = 1e-5;
    Vector                 plus(u), minus(u);
    plus.zero_out_ghost_values();
    minus.zero_out_ghost_values();
    plus.add(step, direction);
    minus.add(-step, direction);
    plus.update_ghost_values();
    minus.update_ghost_values();
    auto difference = body.forces(plus);
    difference -= body.forces(minus);
    difference /= 2. * step;
    Vector product;
    body.partition->initialize(product);
    body.pressure->add_tangent_product(u, direction, product);
    product.compress(dealii::VectorOperation::add);
    difference -= product;
    EXPECT_LT(difference.linfty_norm(), 1e-9 * product.linfty_norm());
    EXPECT_FALSE(body.pressure->is_symmetric());
  }
} // namespace Perimorph::Fem
