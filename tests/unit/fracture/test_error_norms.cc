#include <perimorph/fracture/error_norms.h>

#include "exact_fields.h"
#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <limits>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;

  /// The norms of a test field, every rank working on its part.
  template <int dim>
  ErrorNorms
  norms(const Testing::VectorField<dim> &error,
        const Testing::VectorField<dim> &reference,
        const PlaneState                 state)
  {
    auto               mesh = Testing::unit_mesh<dim>(4, 0.2);
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    mesh.rank        = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    mesh.owned_begin = mesh.n_nodes() * mesh.rank / n_ranks;
    mesh.owned_end   = mesh.n_nodes() * (mesh.rank + 1) / n_ranks;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      mesh.cell_owner[c] = c % n_ranks;
    return error_norms(mesh,
                       Testing::unit_material<dim>(0.25, state),
                       Testing::nodal_values<dim>(mesh, error),
                       Testing::nodal_values<dim>(mesh, reference),
                       MPI_COMM_WORLD);
  }

  TEST(ErrorNorms, of_a_scaled_field_are_the_scale)
  {
    const Testing::VectorField<3> field = [](const auto &x) {
      return Testing::quadratic_field<3>(x, false);
    };
    const auto result = norms<3>([&](const auto &x) { return 0.01 * field(x); },
                                 field,
                                 PlaneState::three_dimensional);
    EXPECT_NEAR(result.l2, 0.01, 1e-12);
    EXPECT_NEAR(result.energy, 0.01, 1e-12);
    EXPECT_NEAR(result.maximum, 0.01, 1e-12);
  }

  TEST(ErrorNorms, of_known_fields)
  {
    // Plane strain, E = 1, nu = 1/4: lambda = mu = 0.4. Error: simple shear
    // u_x = y / 10, W = mu / 200 = 0.002. Reference: u_x = x, W = lambda / 2 +
    // mu = 0.6. Translations by 2 and 1 change the other two norms only.
    const auto result = norms<2>(
      [](const auto &x) {
        dealii::Tensor<1, 2> u;
        u[0] = 0.1 * x[1];
        return u;
      },
      [](const auto &x) {
        dealii::Tensor<1, 2> u;
        u[0] = x[0];
        return u;
      },
      PlaneState::plane_strain);
    EXPECT_NEAR(result.energy, std::sqrt(0.002 / 0.6), 1e-12);
    EXPECT_NEAR(result.maximum, 0.1, 1e-12);
  }

  TEST(ErrorNorms, l2_is_weighted_with_the_volume)
  {
    // error 1 on the right third of a strip whose cells are 1 and 2 long
    Mesh::NodalMesh<2> mesh;
    for (const double y : {0., 1.})
      for (const double x : {0., 1., 3.})
        mesh.nodes.emplace_back(x, y);
    mesh.cells         = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
    mesh.cell_material = {0, 0};
    mesh.cell_owner    = {0, 0};
    mesh.owned_end     = 6;
    mesh.compute_derived();
    std::vector<dealii::Tensor<1, 2>> error(6), reference(6);
    for (unsigned int n = 0; n < 6; ++n)
      reference[n][1] = 1.;
    error[2][0] = error[5][0] = 1.;
    const auto result =
      error_norms(mesh,
                  Testing::unit_material<2>(0.25, PlaneState::plane_stress),
                  error,
                  reference,
                  MPI_COMM_SELF);
    EXPECT_NEAR(result.l2, std::sqrt(1. / 3.), 1e-12);
    EXPECT_NEAR(result.maximum, 1., 1e-12);
  }

  TEST(ErrorNorms, of_a_reference_of_size_zero)
  {
    const Testing::VectorField<2> zero = [](const auto &) {
      return dealii::Tensor<1, 2>();
    };
    const Testing::VectorField<2> field = [](const auto &x) {
      return Testing::quadratic_field<2>(x, false);
    };
    const auto infinite = norms<2>(field, zero, PlaneState::plane_strain);
    EXPECT_EQ(infinite.l2, std::numeric_limits<double>::infinity());
    EXPECT_EQ(infinite.energy, std::numeric_limits<double>::infinity());
    EXPECT_EQ(infinite.maximum, std::numeric_limits<double>::infinity());
    EXPECT_EQ(norms<2>(zero, zero, PlaneState::plane_strain).l2, 0.);
  }
} // namespace
