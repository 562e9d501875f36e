#include <perimorph/materials/extrapolated_stress.h>
#include <perimorph/materials/finite_strain.h>
#include <perimorph/materials/material_factory.h>

#include <deal.II/base/symmetric_tensor.h>

#include <gtest/gtest.h>

#include <cmath>


namespace Perimorph::Materials
{
  namespace
  {
    template <int dim>
    dealii::Tensor<2, dim>
    second_piola_kirchhoff(const Material<dim>          &law,
                           const dealii::Tensor<2, dim> &H)
    {
      return invert(deformation_gradient(H)) * law.first_piola_kirchhoff(H);
    }

    template <int dim>
    void
    check(const PlaneState state)
    {
      dealii::Tensor<2, dim> H, step;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            H[i][j]    = 0.1 * std::sin(1. + 3. * i + j);
            step[i][j] = 0.2 * std::cos(2. + i + 5. * j);
          }
      for (const auto &name : {"hencky", "neo-hookean"})
        {
          const auto law = make_material<dim>(name, 10., 0.3, state);
          // Where nothing is extrapolated the tangent is the usual one.
          const auto S = second_piola_kirchhoff(*law, H);
          EXPECT_LT((extrapolated_stress(*law, H, 0. * step) - S).norm(),
                    1e-14);
          EXPECT_LT((tangent_with_stress(*law, H, S) - law->tangent(H)).norm(),
                    1e-13);
          // The extrapolation is the first-order change of S.
          const double small = 1e-5;
          const auto change  = (second_piola_kirchhoff(*law, H + small * step) -
                               second_piola_kirchhoff(*law, H - small * step)) /
                              (2. * small);
          EXPECT_LT((extrapolated_stress(*law, H, step) - S - change).norm(),
                    1e-7 * change.norm());
        }
    }
  } // namespace

  TEST(ExtrapolatedStress, is_the_linear_change_and_leaves_the_tangent_at_rest)
  {
    check<2>(PlaneState::plane_strain);
    check<2>(PlaneState::plane_stress);
    check<3>(PlaneState::three_dimensional);
  }
} // namespace Perimorph::Materials
