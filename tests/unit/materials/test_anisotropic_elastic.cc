#include <perimorph/materials/anisotropic_elastic.h>
#include <perimorph/materials/linear_elastic.h>
#include <perimorph/materials/material_factory.h>

#include "derivative_checks.h"
#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  namespace
  {
    // A carbon fibre ply (GPa), E3 of its own so that no two axes are alike.
    const NamedConstants ply = {{"E1", 144.8},
                                {"E2", 11.7},
                                {"E3", 9.},
                                {"nu12", 0.21},
                                {"nu13", 0.3},
                                {"nu23", 0.45},
                                {"G12", 9.66},
                                {"G13", 8.},
                                {"G23", 3.4}};

    template <int dim>
    PlaneState
    plane_strain_or_space()
    {
      return dim == 2 ? PlaneState::plane_strain
                      : PlaneState::three_dimensional;
    }

    template <int dim>
    std::unique_ptr<Material<dim>>
    turned_ply(const std::array<double, 3> &angles,
               const PlaneState state = plane_strain_or_space<dim>())
    {
      return make_anisotropic_material<dim>("orthotropic",
                                            ply,
                                            state,
                                            material_axes(angles));
    }

    /// Stiffness with all 21 constants, positive definite.
    NamedConstants
    dense_constants()
    {
      NamedConstants constants;
      const auto     names = constant_names<3>("anisotropic");
      for (std::size_t k = 0; k < names.size(); ++k)
        constants[names[k]] =
          names[k][1] == names[k][2] ? 10. + k : std::sin(3. * k + 1.);
      return constants;
    }

    std::vector<std::string>
    messages(const std::string    &law,
             const NamedConstants &constants,
             const PlaneState      state)
    {
      Base::InputErrorCollector errors;
      const bool                fits =
        state == PlaneState::three_dimensional
                         ? check_constants<3>("path", "", law, constants, state, errors)
                         : check_constants<2>("path", "", law, constants, state, errors);
      EXPECT_EQ(fits, errors.empty());
      return errors.messages();
    }

    void
    expect_message(const std::vector<std::string> &list,
                   const std::vector<std::string> &parts)
    {
      ASSERT_EQ(list.size(), 1u);
      for (const auto &part : parts)
        EXPECT_NE(list[0].find(part), std::string::npos) << list[0];
    }
  } // namespace

  TEST(AnisotropicElastic, stress_and_tangent_are_derivatives_of_the_energy)
  {
    for (const auto state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      for (const auto &H : states_of_deformation<2>(7.))
        expect_derivatives_match(*turned_ply<2>({0., 0., 33.}, state), H, 1e-9);
    const auto dense =
      make_anisotropic_material<3>("anisotropic",
                                   dense_constants(),
                                   PlaneState::three_dimensional,
                                   material_axes({20., 50., 70.}));
    for (const auto &H : states_of_deformation<3>(7.))
      {
        expect_derivatives_match(*turned_ply<3>({20., 50., 70.}), H, 1e-9);
        expect_derivatives_match(*dense, H, 1e-9);
      }
  }

  TEST(AnisotropicElastic, isotropic_constants_are_linear_elastic)
  {
    const double         E = 210., nu = 0.3, G = E / (2. * (1. + nu));
    const NamedConstants constants = {{"E1", E},
                                      {"E2", E},
                                      {"E3", E},
                                      {"nu12", nu},
                                      {"nu13", nu},
                                      {"nu23", nu},
                                      {"G12", G},
                                      {"G13", G},
                                      {"G23", G}};
    const auto compare = [](const auto &law, const auto &reference, auto H) {
      const double size = 1e-14 * reference.tangent(H).norm();
      EXPECT_LT((law.tangent(H) - reference.tangent(H)).norm(), size);
      EXPECT_NEAR(law.out_of_plane_stress(H),
                  reference.out_of_plane_stress(H),
                  size);
      EXPECT_NEAR(law.out_of_plane_stretch(H),
                  reference.out_of_plane_stretch(H),
                  1e-15);
      EXPECT_NEAR(law.shear_modulus(), reference.shear_modulus(), size);
    };
    for (const auto state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      compare(*make_anisotropic_material<2>("orthotropic",
                                            constants,
                                            state,
                                            material_axes({0., 0., 31.})),
              LinearElastic<2>(E, nu, state),
              random_gradient<2>(1, 0.1));
    compare(*make_anisotropic_material<3>("orthotropic",
                                          constants,
                                          PlaneState::three_dimensional,
                                          material_axes({10., 20., 31.})),
            LinearElastic<3>(E, nu, PlaneState::three_dimensional),
            random_gradient<3>(1, 0.1));
  }

  TEST(AnisotropicElastic, quarter_turn_swaps_axes)
  {
    auto swapped    = ply;
    swapped["E1"]   = ply.at("E2");
    swapped["E2"]   = ply.at("E1");
    swapped["nu12"] = ply.at("nu12") * ply.at("E2") / ply.at("E1");
    swapped["nu13"] = ply.at("nu23");
    swapped["nu23"] = ply.at("nu13");
    swapped["G13"]  = ply.at("G23");
    swapped["G23"]  = ply.at("G13");
    for (const auto state :
         {PlaneState::plane_stress, PlaneState::plane_strain})
      {
        const auto turned = turned_ply<2>({0., 0., 90.}, state);
        const auto other  = make_anisotropic_material<2>("orthotropic",
                                                        swapped,
                                                        state,
                                                        material_axes({}));
        const auto H      = random_gradient<2>(3, 0.1);
        EXPECT_LT((turned->tangent(H) - other->tangent(H)).norm(), 1e-12);
        EXPECT_NEAR(turned->out_of_plane_stress(H),
                    other->out_of_plane_stress(H),
                    1e-12);
        EXPECT_NEAR(turned->out_of_plane_stretch(H),
                    other->out_of_plane_stretch(H),
                    1e-14);
      }
    const dealii::Tensor<2, 3> H;
    EXPECT_LT((turned_ply<3>({0., 0., 90.})->tangent(H) -
               make_anisotropic_material<3>("orthotropic",
                                            swapped,
                                            PlaneState::three_dimensional,
                                            material_axes({}))
                 ->tangent(H))
                .norm(),
              1e-12);
  }

  TEST(AnisotropicElastic, turns_act_in_the_order_x_y_z)
  {
    // About x by 90 degrees: axis 2 to z. Then about z: axis 1 to y.
    const auto axes = material_axes({90., 0., 90.});
    EXPECT_EQ(axes[0][1], 1.);
    EXPECT_EQ(axes[1][2], 1.);
    EXPECT_EQ(axes[2][0], 1.);
    const auto law = turned_ply<3>({90., 0., 90.});
    // Along y the fibre, along z axis 2.
    dealii::SymmetricTensor<4, 3> stiffness;
    const auto                    A = law->tangent({});
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = k; l < 3; ++l)
            stiffness[i][j][k][l] = A[i][j][k][l];
    const auto S = invert(stiffness);
    EXPECT_NEAR(1. / S[1][1][1][1], ply.at("E1"), 1e-10);
    EXPECT_NEAR(1. / S[2][2][2][2], ply.at("E2"), 1e-10);
    EXPECT_NEAR(1. / S[0][0][0][0], ply.at("E3"), 1e-10);
    EXPECT_NEAR(0.25 / S[1][2][1][2], ply.at("G12"), 1e-10);
  }

  TEST(AnisotropicElastic, compliance_of_an_off_axis_lamina)
  {
    // Jones, Mechanics of Composite Materials, Eq. (2.97); eta_xy,x = E_x
    // times the shear strain of a unit stress along x.
    const double E1 = ply.at("E1"), E2 = ply.at("E2");
    const double nu12 = ply.at("nu12"), G12 = ply.at("G12");
    for (const double degrees : {0., 17., 45., 60., 90., -30.})
      {
        const double t = degrees * dealii::numbers::PI / 180.;
        const double c = std::cos(t), s = std::sin(t);
        const auto   law =
          turned_ply<2>({0., 0., degrees}, PlaneState::plane_stress);
        const double by_modulus = c * c * c * c / E1 +
                                  (1. / G12 - 2. * nu12 / E1) * c * c * s * s +
                                  s * s * s * s / E2;
        const double lateral = -nu12 / E1 * (s * s * s * s + c * c * c * c) +
                               (1. / E1 + 1. / E2 - 1. / G12) * s * s * c * c;
        const double shear =
          (2. / E1 + 2. * nu12 / E1 - 1. / G12) * s * c * c * c -
          (2. / E2 + 2. * nu12 / E1 - 1. / G12) * s * s * s * c;
        dealii::Tensor<2, 2> strain;
        strain[0][0] = by_modulus;
        strain[1][1] = lateral;
        strain[0][1] = strain[1][0] = 0.5 * shear;
        const auto P                = law->first_piola_kirchhoff(strain);
        EXPECT_NEAR(P[0][0], 1., 1e-13);
        EXPECT_NEAR(P[1][1], 0., 1e-13);
        EXPECT_NEAR(P[0][1], 0., 1e-13);
        EXPECT_NEAR(law->out_of_plane_stretch(strain) - 1.,
                    -c * c * ply.at("nu13") / E1 - s * s * ply.at("nu23") / E2,
                    1e-15);
      }
  }

  TEST(AnisotropicElastic, plane_strain_is_space_without_thickness_strain)
  {
    const auto           plane = turned_ply<2>({0., 0., 25.});
    const auto           space = turned_ply<3>({0., 0., 25.});
    const auto           H     = random_gradient<2>(5, 0.1);
    dealii::Tensor<2, 3> H3;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        H3[a][b] = H[a][b];
    const auto P  = plane->first_piola_kirchhoff(H);
    const auto P3 = space->first_piola_kirchhoff(H3);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        EXPECT_NEAR(P[a][b], P3[a][b], 1e-13);
    EXPECT_NEAR(plane->out_of_plane_stress(H), P3[2][2], 1e-13);
    EXPECT_EQ(plane->out_of_plane_stretch(H), 1.);
  }

  TEST(AnisotropicElastic, constants_have_the_order_of_voigt)
  {
    const auto law = make_anisotropic_material<3>("anisotropic",
                                                  dense_constants(),
                                                  PlaneState::three_dimensional,
                                                  material_axes({}));
    const auto A   = law->tangent({});
    EXPECT_EQ(A[1][1][1][2], dense_constants().at("C24"));
    EXPECT_EQ(A[0][0][0][2], dense_constants().at("C15"));
    EXPECT_EQ(A[2][2][0][1], dense_constants().at("C36"));
    EXPECT_EQ(A[1][2][0][1], dense_constants().at("C46"));
    const auto plane = make_anisotropic_material<2>(
      "anisotropic",
      {{"C11", 3.}, {"C22", 2.}, {"C66", 1.}, {"C16", 0.5}, {"C23", 0.7}},
      PlaneState::plane_strain,
      material_axes({}));
    EXPECT_EQ(plane->tangent({})[0][0][0][1], 0.5);
    dealii::Tensor<2, 2> H;
    H[1][1] = 1.;
    EXPECT_EQ(plane->out_of_plane_stress(H), 0.7);
  }

  TEST(AnisotropicElastic, shear_modulus_does_not_depend_on_axes)
  {
    const double mu2 =
      turned_ply<2>({}, PlaneState::plane_stress)->shear_modulus();
    EXPECT_NEAR(
      turned_ply<2>({0., 0., 37.}, PlaneState::plane_stress)->shear_modulus(),
      mu2,
      1e-12);
    // Deviators of the plane: s_11 = -s_22 and s_12.
    const double S11 = 1. / ply.at("E1"), S22 = 1. / ply.at("E2");
    const double normal = 0.5 * (S11 + S22 + 2. * ply.at("nu12") * S11);
    EXPECT_NEAR(mu2, 1. / (normal + 0.5 / ply.at("G12")), 1e-12);
    EXPECT_NEAR(turned_ply<3>({11., 22., 33.})->shear_modulus(),
                turned_ply<3>({})->shear_modulus(),
                1e-12);
  }

  TEST(AnisotropicElastic, bad_constants_name_themselves)
  {
    EXPECT_TRUE(
      messages("orthotropic", ply, PlaneState::three_dimensional).empty());
    auto changed = ply;
    changed.erase("nu12");
    changed.erase("G12");
    expect_message(messages("orthotropic", changed, PlaneState::plane_stress),
                   {"found no nu12, G12", "allowed: E1, E2, nu12, G12"});
    changed       = ply;
    changed["E2"] = -3.;
    expect_message(messages("orthotropic", changed, PlaneState::plane_stress),
                   {"found E2 = -3", "a number > 0"});
    changed         = ply;
    changed["nu12"] = 3.6; // sqrt(144.8 / 11.7) = 3.518
    expect_message(messages("orthotropic", changed, PlaneState::plane_stress),
                   {"nu12 = 3.6", "3.51", "sqrt(E1 / E2)"});
    // Each below its limit, all three not.
    changed = {{"E1", 1.},
               {"E2", 1.},
               {"E3", 1.},
               {"nu12", 0.6},
               {"nu13", 0.6},
               {"nu23", 0.6},
               {"G12", 1.}};
    expect_message(messages("orthotropic", changed, PlaneState::plane_strain),
                   {"nu23 = 0.6", "eigenvalue -0.2"});
    EXPECT_TRUE(
      messages("orthotropic", changed, PlaneState::plane_stress).empty());
    expect_message(
      messages("anisotropic",
               {{"C11", 1.}, {"C12", 2.}, {"C22", 1.}, {"C66", 1.}},
               PlaneState::plane_stress),
      {"eigenvalue -1", "positive definite"});
    expect_message(messages("anisotropic",
                            {{"C11", 1.}, {"C22", 1.}},
                            PlaneState::plane_strain),
                   {"no C66"});
  }
} // namespace Perimorph::Materials
