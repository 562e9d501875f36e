#include <perimorph/base/exceptions.h>
#include <perimorph/materials/finite_strain.h>
#include <perimorph/materials/linear_elastic.h>
#include <perimorph/materials/material_factory.h>
#include <perimorph/materials/prototype_microelastic.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

#include <limits>

// What every finite-strain law must do, in one table of all laws.

namespace Perimorph::Materials
{
  namespace
  {
    /// One law with its constants.
    struct Case
    {
      std::string law;
      double      nu;
      PlaneState  state;
    };

    std::vector<Case>
    finite_strain_cases(const int dim)
    {
      const std::vector<PlaneState> states =
        dim == 3 ? std::vector<PlaneState>{PlaneState::three_dimensional}
                 : std::vector<PlaneState>{PlaneState::plane_stress,
                                           PlaneState::plane_strain};
      std::vector<Case> cases;
      for (const std::string &law : law_names())
        for (const PlaneState state : states)
          if (law == "prototype microelastic")
            cases.push_back(
              {law, PrototypeMicroelastic<2>::poissons_ratio(state), state});
          else if (law != "linear elastic")
            for (const double nu : {-0.2, 0., 0.3, 0.45})
              cases.push_back({law, nu, state});
      return cases;
    }

    /// Calls check(material, case) for all cases with E = 2.
    template <int dim, typename Check>
    void
    for_all_laws(const Check &check)
    {
      for (const Case &one : finite_strain_cases(dim))
        {
          SCOPED_TRACE(one.law + ", nu = " + std::to_string(one.nu) +
                       ", state " +
                       std::to_string(static_cast<int>(one.state)));
          check(*make_material<dim>(one.law, 2., one.nu, one.state), one);
        }
    }

    bool
    has_no_thickness(const Case &one, const dealii::SymmetricTensor<2, 2> &E)
    {
      return one.law == "saint venant-kirchhoff" &&
             one.state == PlaneState::plane_stress &&
             one.nu / (1. - one.nu) * trace(E) >= 0.45;
    }

    bool
    has_no_thickness(const Case &, const dealii::SymmetricTensor<2, 3> &)
    {
      return false;
    }

    dealii::Tensor<2, 2>
    rotation(const dealii::Tensor<2, 2> &)
    {
      dealii::Tensor<2, 2> Q;
      Q[0][0] = Q[1][1] = std::cos(2.1);
      Q[1][0]           = std::sin(2.1);
      Q[0][1]           = -Q[1][0];
      return Q;
    }

    dealii::Tensor<2, 3>
    rotation(const dealii::Tensor<2, 3> &)
    {
      // half a turn about (1, 2, 2) / 3
      const double         axis[3] = {1. / 3., 2. / 3., 2. / 3.};
      dealii::Tensor<2, 3> Q;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          Q[a][b] = 2. * axis[a] * axis[b] - (a == b ? 1. : 0.);
      return Q;
    }

    template <int dim>
    void
    expect_derivatives()
    {
      for_all_laws<dim>([](const Material<dim> &law, const Case &one) {
        int n_states = 0;
        for (const auto &H : states_of_deformation<dim>(7.))
          if (!has_no_thickness(one, 0.5 * right_cauchy_green_change(H)))
            {
              expect_derivatives_match(law, H);
              ++n_states;
            }
        EXPECT_GE(n_states, 10);
      });
    }

    template <int dim>
    void
    expect_objectivity()
    {
      for_all_laws<dim>([](const Material<dim> &law, const Case &one) {
        for (const auto &H : states_of_deformation<dim>(2.))
          {
            if (has_no_thickness(one, 0.5 * right_cauchy_green_change(H)))
              continue;
            const auto Q = rotation(H);
            auto       F = H;
            for (int a = 0; a < dim; ++a)
              F[a][a] += 1.;
            auto turned = Q * F;
            for (int a = 0; a < dim; ++a)
              turned[a][a] -= 1.;
            const double W = law.energy_density(H);
            const auto   P = law.first_piola_kirchhoff(H);
            EXPECT_NEAR(law.energy_density(turned), W, 1e-12 * (1. + W));
            EXPECT_NEAR((law.first_piola_kirchhoff(turned) - Q * P).norm(),
                        0.,
                        1e-12 * (1. + P.norm()));
            EXPECT_NEAR(law.out_of_plane_stretch(turned),
                        law.out_of_plane_stretch(H),
                        1e-12);
            EXPECT_NEAR(law.out_of_plane_stress(turned),
                        law.out_of_plane_stress(H),
                        1e-12);
          }
      });
    }

    template <int dim>
    void
    expect_small_strain_limit()
    {
      for_all_laws<dim>([](const Material<dim> &law, const Case &one) {
        const LinearElastic<dim> linear(2., one.nu, one.state);
        EXPECT_FALSE(law.is_linear());
        EXPECT_NEAR(law.shear_modulus(), linear.shear_modulus(), 1e-14);
        const dealii::Tensor<2, dim> rest;
        EXPECT_EQ(law.energy_density(rest), 0.);
        EXPECT_EQ(law.first_piola_kirchhoff(rest).norm(), 0.);
        EXPECT_EQ(law.out_of_plane_stress(rest), 0.);
        EXPECT_EQ(law.out_of_plane_stretch(rest), 1.);
        EXPECT_NEAR((law.tangent(rest) - linear.tangent(rest)).norm(),
                    0.,
                    1e-12);
        for (unsigned int seed = 0; seed < 5; ++seed)
          {
            const auto H      = random_gradient<dim>(seed, 1e-12);
            const auto P      = law.first_piola_kirchhoff(H);
            const auto wanted = linear.first_piola_kirchhoff(H);
            EXPECT_LT((P - wanted).norm(), 1e-10 * wanted.norm());
            EXPECT_NEAR(law.energy_density(H) / linear.energy_density(H),
                        1.,
                        1e-10);
            EXPECT_NEAR(law.out_of_plane_stress(H),
                        linear.out_of_plane_stress(H),
                        1e-10 * wanted.norm());
            const auto larger = random_gradient<dim>(seed, 1e-5);
            EXPECT_NEAR(law.out_of_plane_stretch(larger),
                        linear.out_of_plane_stretch(larger),
                        1e-9);
          }
      });
    }

    /// The stress P33 is the derivative of a three-dimensional energy, so the
    /// 3D law has the stresses of plane strain.
    void
    expect_plane_strain_is_a_slice(const std::string &name)
    {
      const auto plane =
        make_material<2>(name, 2., 0.3, PlaneState::plane_strain);
      const auto solid =
        make_material<3>(name, 2., 0.3, PlaneState::three_dimensional);
      for (unsigned int seed = 0; seed < 5; ++seed)
        {
          const auto           H = random_gradient<2>(seed, 0.3);
          dealii::Tensor<2, 3> H3;
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              H3[a][b] = H[a][b];
          const auto P  = plane->first_piola_kirchhoff(H);
          const auto P3 = solid->first_piola_kirchhoff(H3);
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              EXPECT_NEAR(P[a][b], P3[a][b], 1e-13);
          EXPECT_NEAR(plane->out_of_plane_stress(H), P3[2][2], 1e-13);
          EXPECT_EQ(plane->out_of_plane_stretch(H), 1.);
        }
    }

    /// With the thickness stretch of plane stress the 3D law has no P33 and
    /// the same P in the plane.
    void
    expect_plane_stress_is_free(const std::string &name, const double nu)
    {
      const auto plane =
        make_material<2>(name, 2., nu, PlaneState::plane_stress);
      const auto solid =
        make_material<3>(name, 2., nu, PlaneState::three_dimensional);
      for (unsigned int seed = 0; seed < 10; ++seed)
        {
          const auto           H = random_gradient<2>(seed, 0.3);
          dealii::Tensor<2, 3> H3;
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              H3[a][b] = H[a][b];
          const double stretch = plane->out_of_plane_stretch(H);
          H3[2][2]             = stretch - 1.;
          const auto P         = plane->first_piola_kirchhoff(H);
          const auto P3        = solid->first_piola_kirchhoff(H3);
          // of a stiffness of order 1 / (1 - 2 nu)
          EXPECT_NEAR(P3[2][2], 0., 1e-13);
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              EXPECT_NEAR(P[a][b], P3[a][b], 1e-13);
          EXPECT_NEAR(plane->energy_density(H),
                      solid->energy_density(H3),
                      1e-13);
          EXPECT_EQ(plane->out_of_plane_stress(H), 0.);
        }
    }

    template <int dim>
    void
    expect_inadmissible()
    {
      for_all_laws<dim>([](const Material<dim> &law, const Case &one) {
        dealii::Tensor<2, dim> inverted, flat, infinite, nothing;
        inverted[0][0] = -1.2;
        flat[0][0]     = -1.;
        infinite[0][1] = infinite[1][0] = 1e200;
        nothing[1][0] = std::numeric_limits<double>::quiet_NaN();
        for (const auto &H : {inverted, flat, infinite, nothing})
          {
            EXPECT_THROW(law.energy_density(H), Base::InadmissibleState);
            EXPECT_THROW(law.first_piola_kirchhoff(H), Base::InadmissibleState);
            EXPECT_THROW(law.tangent(H), Base::InadmissibleState);
            EXPECT_THROW(law.out_of_plane_stress(H), Base::InadmissibleState);
            EXPECT_THROW(law.out_of_plane_stretch(H), Base::InadmissibleState);
          }
        try
          {
            law.first_piola_kirchhoff(inverted);
            FAIL() << "nothing thrown";
          }
        catch (const Base::InadmissibleState &error)
          {
            EXPECT_EQ(std::string(error.what()),
                      "the law '" + one.law +
                        "' has no answer at J = det F = -0.2; J must be "
                        "positive and finite");
          }
      });
    }
  } // namespace

  TEST(FiniteStrainLaws, stress_and_tangent_are_derivatives_of_the_energy)
  {
    expect_derivatives<2>();
    expect_derivatives<3>();
  }

  TEST(FiniteStrainLaws, do_not_see_rotations)
  {
    expect_objectivity<2>();
    expect_objectivity<3>();
  }

  TEST(FiniteStrainLaws, are_linear_elastic_at_small_strain)
  {
    expect_small_strain_limit<2>();
    expect_small_strain_limit<3>();
  }

  TEST(FiniteStrainLaws, plane_strain_is_a_slice_of_the_solid)
  {
    for (const char *law : {"hencky", "saint venant-kirchhoff", "neo-hookean"})
      {
        SCOPED_TRACE(law);
        expect_plane_strain_is_a_slice(law);
      }
  }

  TEST(FiniteStrainLaws, plane_stress_is_free_of_stress_across_the_plane)
  {
    for (const char *law : {"hencky", "saint venant-kirchhoff", "neo-hookean"})
      for (const double nu : {-0.1, 0., 0.3, 0.4})
        {
          SCOPED_TRACE(law);
          expect_plane_stress_is_free(law, nu);
        }
  }

  TEST(FiniteStrainLaws, refuse_inverted_and_endless_states)
  {
    expect_inadmissible<2>();
    expect_inadmissible<3>();
  }

  TEST(FiniteStrain, small_differences_keep_their_digits)
  {
    // series x^2/2 - x^3/3 + x^4/4 and x^2/2 + x^3/6 + x^4/24
    for (const double x : {1e-12, -1e-7, 1e-4})
      {
        EXPECT_NEAR(excess_over_logarithm(x, std::log1p(x)) / (x * x),
                    0.5 - x / 3. + x * x / 4.,
                    1e-12);
        EXPECT_NEAR(exponential_excess(x) / (x * x),
                    0.5 + x / 6. + x * x / 24.,
                    1e-12);
      }
    // both sides of the bounds between the forms
    for (const double x : {-0.3, 0.3, -0.5, 0.5})
      for (const double nearby : {x * (1. - 1e-15), x * (1. + 1e-15)})
        {
          EXPECT_NEAR(excess_over_logarithm(nearby, std::log1p(nearby)),
                      x - std::log1p(x),
                      1e-15);
          EXPECT_NEAR(exponential_excess(nearby), std::expm1(x) - x, 1e-15);
        }
  }
} // namespace Perimorph::Materials
