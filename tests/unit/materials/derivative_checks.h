#pragma once

#include <perimorph/materials/material.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace Perimorph::Materials
{
  /// Displacement gradient with entries in [-size, size].
  template <int dim>
  dealii::Tensor<2, dim>
  random_gradient(const unsigned int seed, const double size)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-size, size);
    dealii::Tensor<2, dim>                 H;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        H[a][b] = number(generator);
    return H;
  }

  /// H = gamma e_1 (x) e_2.
  template <int dim>
  dealii::Tensor<2, dim>
  simple_shear(const double gamma)
  {
    dealii::Tensor<2, dim> H;
    H[0][1] = gamma;
    return H;
  }

  /// F = stretch I, plus a difference of two stretches that is nearly nothing.
  template <int dim>
  dealii::Tensor<2, dim>
  equal_stretches(const double stretch, const double difference = 0.)
  {
    dealii::Tensor<2, dim> H;
    for (int a = 0; a < dim; ++a)
      H[a][a] = stretch - 1.;
    H[0][0] += difference;
    return H;
  }

  /// Rest, equal and nearly equal stretches, anything, strong shear.
  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  states_of_deformation(const double shear)
  {
    std::vector<dealii::Tensor<2, dim>> states = {
      dealii::Tensor<2, dim>(),
      equal_stretches<dim>(1.3),
      equal_stretches<dim>(0.7, 1e-9),
      equal_stretches<dim>(1.2, 1e-6),
      equal_stretches<dim>(1., 1e-8),
      simple_shear<dim>(shear)};
    for (unsigned int seed = 0; seed < 20; ++seed)
      {
        const auto H = random_gradient<dim>(seed, 0.4);
        auto       F = H;
        for (int a = 0; a < dim; ++a)
          F[a][a] += 1.;
        if (determinant(F) > 0.25)
          states.push_back(H);
      }
    return states;
  }

  /// Central difference of fourth order in the entry (k, l) of H.
  template <int dim, typename Function>
  auto
  difference_quotient(const Function               &function,
                      const dealii::Tensor<2, dim> &H,
                      const int                     k,
                      const int                     l)
  {
    const double step = 1e-3;
    const auto   at   = [&](const double distance) {
      auto moved = H;
      moved[k][l] += distance;
      return function(moved);
    };
    return (8. * (at(step) - at(-step)) - (at(2. * step) - at(-2. * step))) /
           (12. * step);
  }

  /// P = dW/dF and A = dP/dF, relative to the larger of the value and the
  /// stress of a strain of 1, and the major symmetry of A.
  template <int dim>
  void
  expect_derivatives_match(const Material<dim>          &material,
                           const dealii::Tensor<2, dim> &H,
                           const double                  tolerance = 1e-7)
  {
    const auto   P = material.first_piola_kirchhoff(H);
    const auto   A = material.tangent(H);
    const double stress_scale =
      std::max(P.norm(), 2. * material.shear_modulus());
    const double tangent_scale = A.norm();
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
        {
          const double dW = difference_quotient<dim>(
            [&](const auto &G) { return material.energy_density(G); },
            H,
            k,
            l);
          EXPECT_NEAR(dW, P[k][l], tolerance * stress_scale)
            << material.name() << " at H = " << H;
          const auto dP = difference_quotient<dim>(
            [&](const auto &G) { return material.first_piola_kirchhoff(G); },
            H,
            k,
            l);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              {
                EXPECT_NEAR(dP[i][j], A[i][j][k][l], tolerance * tangent_scale)
                  << material.name() << " at H = " << H;
                EXPECT_NEAR(A[i][j][k][l], A[k][l][i][j], 1e-12 * tangent_scale)
                  << material.name() << " at H = " << H;
              }
        }
  }
} // namespace Perimorph::Materials
