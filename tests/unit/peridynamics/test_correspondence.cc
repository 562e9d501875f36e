#include <perimorph/materials/linear_elastic.h>
#include <perimorph/peridynamics/correspondence.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace Perimorph::Peridynamics
{
  namespace
  {
    /// A family with arbitrary bonds and an arbitrary (not classical) gradient.
    template <int dim>
    struct RandomFamily
    {
      explicit RandomFamily(const unsigned int n_bonds)
        : xi(n_bonds)
        , g(n_bonds)
        , w(n_bonds)
        , eta(n_bonds)
        , n_gradient_bonds(n_bonds - 2)
      {
        std::mt19937                           generator(7);
        std::uniform_real_distribution<double> number(-1., 1.);
        for (unsigned int j = 0; j < n_bonds; ++j)
          {
            for (int d = 0; d < dim; ++d)
              {
                xi[j][d]  = number(generator);
                g[j][d]   = j < n_gradient_bonds ? number(generator) : 0.;
                eta[j][d] = 0.1 * number(generator);
              }
            w[j] = 1.1 + number(generator);
          }
      }

      Family<dim>
      family(const double kappa)
      {
        const unsigned int n = xi.size();
        xi_list              = by_components(xi.data(), n);
        g_list               = by_components(g.data(), n);
        return {n,
                n_gradient_bonds,
                n,
                xi_list.data(),
                g_list.data(),
                w.data(),
                kappa};
      }

      std::vector<dealii::Tensor<1, dim>> xi, g;
      std::vector<double>                 w, xi_list, g_list;
      std::vector<dealii::Tensor<1, dim>> eta;
      unsigned int                        n_gradient_bonds;
    };

    template <int dim>
    double
    energy(const Family<dim>                   &family,
           const Materials::Material<dim>      &law,
           std::vector<dealii::Tensor<1, dim>> &eta)
    {
      const auto list = by_components(eta.data(), eta.size());
      const auto H    = displacement_gradient(family, list.data());
      return law.energy_density(H) +
             stabilization_energy(family, list.data(), H);
    }

    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    forces(const Family<dim>                         &family,
           const Materials::Material<dim>            &law,
           const std::vector<dealii::Tensor<1, dim>> &eta)
    {
      const unsigned int  n    = eta.size();
      const auto          list = by_components(eta.data(), n);
      const auto          H    = displacement_gradient(family, list.data());
      std::vector<double> components(dim * n);
      family_forces(family,
                    list.data(),
                    H,
                    law.first_piola_kirchhoff(H),
                    components.data());
      std::vector<dealii::Tensor<1, dim>> result(n);
      for (unsigned int j = 0; j < n; ++j)
        for (int d = 0; d < dim; ++d)
          result[j][d] = components[d * n + j];
      return result;
    }

    template <int dim>
    void
    expect_gradient_and_tangent(const double kappa)
    {
      constexpr unsigned int              n = 23; // lanes of 8, of 4, and one
      RandomFamily<dim>                   data(n);
      const auto                          family = data.family(kappa);
      const Materials::LinearElastic<dim> law(
        2.,
        0.3,
        dim == 2 ? Materials::PlaneState::plane_strain
                 : Materials::PlaneState::three_dimensional);
      const auto                 force = forces(family, law, data.eta);
      const double               step  = 1e-4;
      dealii::FullMatrix<double> tangent;
      family_tangent(family, law.tangent(dealii::Tensor<2, dim>()), tangent);
      ASSERT_EQ(tangent.m(), dim * (n + 1));
      for (unsigned int j = 0; j < n; ++j)
        for (int d = 0; d < dim; ++d)
          {
            auto plus = data.eta, minus = data.eta;
            plus[j][d] += step;
            minus[j][d] -= step;
            const double slope =
              (energy(family, law, plus) - energy(family, law, minus)) /
              (2. * step);
            EXPECT_NEAR(slope, force[j][d], 1e-7 * (1. + kappa));
            const auto force_plus  = forces(family, law, plus);
            const auto force_minus = forces(family, law, minus);
            for (unsigned int k = 0; k < n; ++k)
              for (int e = 0; e < dim; ++e)
                EXPECT_NEAR((force_plus[k][e] - force_minus[k][e]) /
                              (2. * step),
                            tangent(dim * (k + 1) + e, dim * (j + 1) + d),
                            1e-8 * (1. + kappa));
          }
      // Symmetric, and translations are free.
      for (unsigned int r = 0; r < tangent.m(); ++r)
        for (int d = 0; d < dim; ++d)
          {
            double row_sum = 0.;
            for (unsigned int k = 0; k < n + 1; ++k)
              row_sum += tangent(r, dim * k + d);
            EXPECT_NEAR(row_sum, 0., 1e-11 * (1. + kappa));
          }
      for (unsigned int r = 0; r < tangent.m(); ++r)
        for (unsigned int c = 0; c < r; ++c)
          EXPECT_NEAR(tangent(r, c), tangent(c, r), 1e-11 * (1. + kappa));
    }
  } // namespace

  TEST(Correspondence, force_is_gradient_and_tangent_is_derivative)
  {
    for (const double kappa : {0., 1., 30.})
      {
        expect_gradient_and_tangent<2>(kappa);
        expect_gradient_and_tangent<3>(kappa);
      }
  }

  TEST(Correspondence, affine_field_has_no_stabilization_energy)
  {
    // A gradient that is exact for affine fields: w K^-1 xi.
    RandomFamily<2> data(6);
    data.n_gradient_bonds = 6;
    dealii::Tensor<2, 2> K;
    for (unsigned int j = 0; j < 6; ++j)
      K += data.w[j] * outer_product(data.xi[j], data.xi[j]);
    for (unsigned int j = 0; j < 6; ++j)
      data.g[j] = data.w[j] * (invert(K) * data.xi[j]);
    dealii::Tensor<2, 2> gradient;
    gradient[0][0] = 0.2;
    gradient[0][1] = -0.5;
    gradient[1][0] = 0.3;
    for (unsigned int j = 0; j < 6; ++j)
      data.eta[j] = gradient * data.xi[j];
    const auto family = data.family(5.);
    const auto eta    = by_components(data.eta.data(), 6);
    const auto H      = displacement_gradient(family, eta.data());
    EXPECT_NEAR((H - gradient).norm(), 0., 1e-13);
    EXPECT_NEAR(stabilization_energy(family, eta.data(), H), 0., 1e-25);
  }
} // namespace Perimorph::Peridynamics
