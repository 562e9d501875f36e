#include <perimorph/materials/linear_elastic.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  namespace
  {
    template <int dim>
    void
    expect_derivatives_match_everywhere(const LinearElastic<dim> &law)
    {
      for (const auto &H : states_of_deformation<dim>(7.))
        expect_derivatives_match(law, H, 1e-9);
    }
  } // namespace

  TEST(LinearElastic, stress_and_tangent_are_derivatives_of_the_energy)
  {
    for (const double nu : {-0.3, 0., 0.3, 0.45})
      {
        expect_derivatives_match_everywhere(
          LinearElastic<2>(2., nu, PlaneState::plane_stress));
        expect_derivatives_match_everywhere(
          LinearElastic<2>(2., nu, PlaneState::plane_strain));
        expect_derivatives_match_everywhere(
          LinearElastic<3>(2., nu, PlaneState::three_dimensional));
      }
  }

  TEST(LinearElastic, uniaxial_stress_gives_young_and_poisson)
  {
    const double         E = 200., nu = 0.3, e = 1e-3;
    dealii::Tensor<2, 2> H2;
    H2[0][0]          = e;
    H2[1][1]          = -nu * e;
    const auto stress = LinearElastic<2>(E, nu, PlaneState::plane_stress)
                          .first_piola_kirchhoff(H2);
    EXPECT_NEAR(stress[0][0], E * e, 1e-12);
    EXPECT_NEAR(stress[1][1], 0., 1e-12);

    dealii::Tensor<2, 3> H3;
    H3[0][0] = e;
    H3[1][1] = H3[2][2] = -nu * e;
    const auto stress3  = LinearElastic<3>(E, nu, PlaneState::three_dimensional)
                           .first_piola_kirchhoff(H3);
    EXPECT_NEAR(stress3[0][0], E * e, 1e-12);
    EXPECT_NEAR(stress3[2][2], 0., 1e-12);
  }

  TEST(LinearElastic, plane_strain_has_stress_out_of_the_plane)
  {
    const double E = 200., nu = 0.3;
    const auto   law = LinearElastic<2>(E, nu, PlaneState::plane_strain);
    dealii::Tensor<2, 2> H;
    H[0][0]      = 0.001;
    const auto P = law.first_piola_kirchhoff(H);
    EXPECT_NEAR(law.out_of_plane_stress(H), nu * (P[0][0] + P[1][1]), 1e-12);
    EXPECT_EQ(
      LinearElastic<2>(E, nu, PlaneState::plane_stress).out_of_plane_stress(H),
      0.);
  }

  TEST(LinearElastic, thickness_stretches_in_plane_stress_only)
  {
    dealii::Tensor<2, 2> H;
    H[0][0] = 0.02;
    H[1][1] = 0.01;
    EXPECT_NEAR(LinearElastic<2>(1., 0.2, PlaneState::plane_stress)
                  .out_of_plane_stretch(H),
                1. - 0.2 / 0.8 * 0.03,
                1e-15);
    EXPECT_EQ(LinearElastic<2>(1., 0.2, PlaneState::plane_strain)
                .out_of_plane_stretch(H),
              1.);
  }

  TEST(LinearElastic, small_rotation_is_free)
  {
    const auto law = LinearElastic<2>(1., 0.3, PlaneState::plane_strain);
    dealii::Tensor<2, 2> H;
    H[0][1] = 0.1;
    H[1][0] = -0.1;
    EXPECT_NEAR(law.energy_density(H), 0., 1e-30);
  }
} // namespace Perimorph::Materials
