#include <perimorph/materials/linear_elastic.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace Perimorph::Materials
{
  namespace
  {
    template <int dim>
    dealii::Tensor<2, dim>
    random_gradient(const unsigned int seed)
    {
      std::mt19937                           generator(seed);
      std::uniform_real_distribution<double> number(-0.1, 0.1);
      dealii::Tensor<2, dim>                 H;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          H[a][b] = number(generator);
      return H;
    }

    template <int dim>
    void
    expect_derivatives_match(const Material<dim> &material)
    {
      const double step = 1e-5;
      for (unsigned int seed = 0; seed < 5; ++seed)
        {
          const auto H = random_gradient<dim>(seed);
          const auto P = material.first_piola_kirchhoff(H);
          const auto A = material.tangent(H);
          for (int k = 0; k < dim; ++k)
            for (int l = 0; l < dim; ++l)
              {
                auto plus = H, minus = H;
                plus[k][l] += step;
                minus[k][l] -= step;
                EXPECT_NEAR((material.energy_density(plus) -
                             material.energy_density(minus)) /
                              (2. * step),
                            P[k][l],
                            1e-8);
                const auto dP = (material.first_piola_kirchhoff(plus) -
                                 material.first_piola_kirchhoff(minus)) /
                                (2. * step);
                for (int i = 0; i < dim; ++i)
                  for (int j = 0; j < dim; ++j)
                    {
                      EXPECT_NEAR(dP[i][j], A[i][j][k][l], 1e-8);
                      EXPECT_EQ(A[i][j][k][l], A[k][l][i][j]);
                    }
              }
        }
    }
  } // namespace

  TEST(LinearElastic, stress_and_tangent_are_derivatives_of_the_energy)
  {
    for (const double nu : {-0.3, 0., 0.3, 0.45})
      {
        expect_derivatives_match(
          LinearElastic<2>(2., nu, PlaneState::plane_stress));
        expect_derivatives_match(
          LinearElastic<2>(2., nu, PlaneState::plane_strain));
        expect_derivatives_match(
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

  TEST(LinearElastic, small_rotation_is_free)
  {
    const auto law = LinearElastic<2>(1., 0.3, PlaneState::plane_strain);
    dealii::Tensor<2, 2> H;
    H[0][1] = 0.1;
    H[1][0] = -0.1;
    EXPECT_NEAR(law.energy_density(H), 0., 1e-30);
  }
} // namespace Perimorph::Materials
