#include <perimorph/fracture/nodal_stress.h>

#include "exact_fields.h"
#include <gtest/gtest.h>
#include <harness/test_meshes.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Materials::PlaneState;

  TEST(Stress, principal_and_von_mises_in_two_dimensions)
  {
    // Mohr's circle: center 3, radius 5; with szz = 1 the equivalent stress is
    // sqrt((6^2 + ... )/2) of the principal stresses 8, 1, -2.
    Stress<2> stress;
    stress.in_plane[0][0] = 6.;
    stress.in_plane[0][1] = 4.;
    stress.out_of_plane   = 1.;
    const auto principal  = principal_stresses(stress);
    EXPECT_NEAR(principal[0], 8., 1e-12);
    EXPECT_NEAR(principal[1], 1., 1e-12);
    EXPECT_NEAR(principal[2], -2., 1e-12);
    EXPECT_NEAR(von_mises_stress(stress),
                std::sqrt(0.5 * (7. * 7. + 3. * 3. + 10. * 10.)),
                1e-12);
  }

  TEST(Stress, principal_and_von_mises_in_three_dimensions)
  {
    Stress<3> stress;
    stress.in_plane[0][1] = 2.;
    stress.in_plane[2][2] = -5.;
    const auto principal  = principal_stresses(stress);
    EXPECT_NEAR(principal[0], 2., 1e-12);
    EXPECT_NEAR(principal[1], -2., 1e-12);
    EXPECT_NEAR(principal[2], -5., 1e-12);
    EXPECT_NEAR(von_mises_stress(stress),
                std::sqrt(0.5 * (4. * 4. + 3. * 3. + 7. * 7.)),
                1e-12);
  }

  TEST(Stress, hoop_component_turns_with_the_point)
  {
    Stress<2> stress;
    stress.in_plane[0][0] = 3.;
    stress.in_plane[1][1] = 7.;
    stress.in_plane[0][1] = 1.;
    const dealii::Point<2> center(1., 2.);
    EXPECT_NEAR(hoop_stress(stress, dealii::Point<2>(4., 2.), center),
                7.,
                1e-12);
    EXPECT_NEAR(hoop_stress(stress, dealii::Point<2>(1., 5.), center),
                3.,
                1e-12);
    EXPECT_NEAR(hoop_stress(stress, dealii::Point<2>(2., 3.), center),
                5. - 1.,
                1e-12);
  }

  TEST(NodalStress, plane_strain_has_a_stress_out_of_the_plane)
  {
    const auto materials =
      Testing::unit_material<2>(0.25, PlaneState::plane_strain);
    dealii::Tensor<2, 2> gradient;
    gradient[0][0]    = 0.01;
    gradient[0][1]    = 0.02;
    const auto stress = stress_of_gradient(*materials[0], gradient);
    // lambda = mu = 0.4 for E = 1, nu = 1/4
    EXPECT_NEAR(stress.in_plane[0][0], 0.4 * 0.01 + 0.8 * 0.01, 1e-14);
    EXPECT_NEAR(stress.in_plane[0][1], 0.4 * 0.02, 1e-14);
    EXPECT_NEAR(stress.out_of_plane, 0.4 * 0.01, 1e-14);
  }

  template <int dim>
  void
  expect_exact_stress_of_quadratic_fields(const PlaneState state)
  {
    const auto mesh      = Testing::unit_mesh<dim>(6, 0.2);
    const auto materials = Testing::unit_material<dim>(0.3, state);
    const DisplacementFit<dim> fit(mesh);
    const NodalStress<dim>     recovery(fit, materials);
    const auto                 displacement =
      Testing::nodal_values<dim>(mesh, [](const auto &x) {
        return Testing::quadratic_field<dim>(x, false);
      });
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        const auto stress = recovery.at_node(n, displacement);
        const auto exact =
          stress_of_gradient(*materials[0],
                             Testing::quadratic_gradient<dim>(mesh.nodes[n]));
        EXPECT_LT((stress.in_plane - exact.in_plane).norm(), 1e-9);
        EXPECT_NEAR(stress.out_of_plane, exact.out_of_plane, 1e-9);
      }
  }

  TEST(NodalStress, is_exact_for_quadratic_fields)
  {
    expect_exact_stress_of_quadratic_fields<2>(PlaneState::plane_strain);
    expect_exact_stress_of_quadratic_fields<3>(PlaneState::three_dimensional);
  }

  TEST(NodalStress, is_continuous_across_an_interface_in_series)
  {
    // Two halves in uniaxial tension, E = 1 and 10, nu = 0: the strain jumps by
    // a factor of ten, the stress does not.
    auto mesh = Testing::unit_mesh<2>(8);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      mesh.cell_material[c] = mesh.cell_centroid[c][0] < 0.5 ? 0 : 1;
    MaterialList<2> materials;
    for (const double modulus : {1., 10.})
      materials.push_back(std::make_unique<Materials::LinearElastic<2>>(
        modulus,
        0.,
        PlaneState::plane_stress));
    const DisplacementFit<2> fit(mesh);
    const NodalStress<2>     recovery(fit, materials);
    const auto values = Testing::nodal_values<2>(mesh, [](const auto &x) {
      dealii::Tensor<1, 2> u;
      u[0] = x[0] < 0.5 ? x[0] : 0.5 + 0.1 * (x[0] - 0.5);
      return u;
    });
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      EXPECT_NEAR(recovery.at_node(n, values).in_plane[0][0], 1., 1e-10);
    EXPECT_NEAR(
      recovery.at_point(dealii::Point<2>(0.52, 0.3), 1, values).in_plane[0][0],
      1.,
      1e-10);
  }

  TEST(NodalStress, average_of_element_stress_is_exact_for_linear_fields)
  {
    const auto mesh = Testing::unit_mesh<3>(3, 0.2);
    const auto materials =
      Testing::unit_material<3>(0.3, PlaneState::three_dimensional);
    dealii::Tensor<2, 3> gradient;
    gradient[0][0]    = 0.1;
    gradient[1][2]    = 0.3;
    gradient[2][0]    = -0.2;
    const auto values = Testing::nodal_values<3>(mesh, [&](const auto &x) {
      return gradient * dealii::Tensor<1, 3>(x);
    });
    const std::vector<unsigned int> nodes = {0, 21, 0, 63};
    const auto                      stresses =
      average_element_stress(mesh, materials, nodes, values);
    const auto exact = stress_of_gradient(*materials[0], gradient);
    for (const auto &stress : stresses)
      EXPECT_LT((stress.in_plane - exact.in_plane).norm(), 1e-12);
  }
} // namespace
