#include <perimorph/fracture/crack_quantities.h>

#include "exact_fields.h"
#include <gtest/gtest.h>
#include <harness/test_meshes.h>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Point3 = dealii::Point<3>;

  const double     pi             = std::acos(-1.);
  constexpr double poissons_ratio = 0.3;
  constexpr double shear_modulus  = 1. / 2.6; // E = 1

  /// A box of 4 by 4 by 4 whose nodes move by a field with a plane crack.
  struct Box
  {
    Mesh::NodalMesh<3>                mesh;
    MaterialList<3>                   materials;
    std::vector<dealii::Tensor<1, 3>> displacement;
    Bonds::CrackSet<3>                cracks;
    CrackFront                        front;

    Box(const unsigned int                n_cells,
        const double                      distortion,
        const Testing::VectorField<3>    &field,
        std::vector<Bonds::CrackFacet<3>> facets)
      : mesh(Testing::structured_mesh<3>({{n_cells, n_cells, n_cells}},
                                         Point3(-2., -2., -2.),
                                         Point3(2., 2., 2.),
                                         distortion))
      , materials(
          Testing::unit_material<3>(poissons_ratio,
                                    Materials::PlaneState::three_dimensional))
      , displacement(Testing::nodal_values<3>(mesh, field))
      , cracks(std::move(facets))
      , front(find_fronts(mesh, cracks).at(0))
    {}

    StressPointSet<3>
    points(const double radius) const
    {
      StressPointSet<3> set;
      add_cell_points({mesh, materials, displacement},
                      cracks,
                      *visible_fit(mesh, cracks),
                      nodes_near_front(mesh, front, radius),
                      set);
      return set;
    }

    FractureQuantities
    quantities(StressPointSet<3> &set, const FrontDomain &domain) const
    {
      return fracture_quantities(set,
                                 mesh,
                                 front,
                                 domain,
                                 isotropic_constants(*materials[0]),
                                 MPI_COMM_SELF);
    }
  };

  Bonds::CrackFacet<3>
  triangle(const Point3 &a, const Point3 &b, const Point3 &c)
  {
    Bonds::CrackFacet<3> facet;
    facet.corners = {{a, b, c}};
    return facet;
  }

  constexpr IsotropicConstants constants = {shear_modulus,
                                            3. - 4. * poissons_ratio};

  /// Half plane y = 0.04, x < 0.03 with all three modes.
  Box
  straight_front()
  {
    const TipFrame<3> frame = {
      Point3(0.03, 0.04, 0.),
      {{Point3(1., 0., 0.), Point3(0., 1., 0.), Point3(0., 0., 1.)}},
      0.};
    const auto field = [&](const Point3 &x) {
      return near_tip_state(NearTipField::opening, constants, frame, x)
               .displacement +
             0.5 * near_tip_state(NearTipField::sliding, constants, frame, x)
                     .displacement +
             0.7 * near_tip_state(NearTipField::tearing, constants, frame, x)
                     .displacement;
    };
    const Point3 corners[] = {Point3(0.03, 0.04, -3.),
                              Point3(0.03, 0.04, 3.),
                              Point3(-3., 0.04, 3.),
                              Point3(-3., 0.04, -3.)};
    return Box(16,
               0.15,
               field,
               {triangle(corners[0], corners[2], corners[1]),
                triangle(corners[0], corners[3], corners[2])});
  }

  const double straight_front_J =
    (1. + 0.25) / constants.plane_modulus() + 0.49 / (2. * shear_modulus);

  TEST(FrontIntegral, straight_front_with_three_modes)
  {
    const Box box = straight_front();
    ASSERT_NEAR(box.front.normal[1], 1., 1e-14); // the sign of K_II
    auto       set = box.points(1.5);
    const auto found =
      box.quantities(set, {0.5 * box.front.length(), 1., {0.6, 1.5}});
    // tolerances here and below: about 1.3 times the errors measured
    EXPECT_NEAR(found.K_I, 1., 6e-3);
    EXPECT_NEAR(found.K_II, 0.5, 1.4e-2);
    EXPECT_NEAR(found.K_III, 0.7, 1.6e-2);
    EXPECT_NEAR(found.J / straight_front_J, 1., 1.2e-2);
  }

  /// Stiffer along z.
  class StiffenedLaw : public Materials::LinearElastic<3>
  {
  public:
    StiffenedLaw()
      : Materials::LinearElastic<3>(1.,
                                    poissons_ratio,
                                    Materials::PlaneState::three_dimensional)
    {}

    double
    energy_density(const dealii::Tensor<2, 3> &H) const override
    {
      return LinearElastic<3>::energy_density(H) + 0.5 * H[2][2] * H[2][2];
    }

    dealii::Tensor<2, 3>
    first_piola_kirchhoff(const dealii::Tensor<2, 3> &H) const override
    {
      auto P = LinearElastic<3>::first_piola_kirchhoff(H);
      P[2][2] += H[2][2];
      return P;
    }

    dealii::Tensor<4, 3>
    tangent(const dealii::Tensor<2, 3> &H) const override
    {
      auto A = LinearElastic<3>::tangent(H);
      A[2][2][2][2] += 1.;
      return A;
    }
  };

  // The field has no strain along z: J is that of the isotropic body.
  TEST(FrontIntegral, anisotropic_body_has_J_only)
  {
    Box box          = straight_front();
    box.materials[0] = std::make_unique<StiffenedLaw>();
    ASSERT_FALSE(near_tip_constants(*box.materials[0], box.front.at(0.).frame)
                   .has_value());
    const std::vector<double> none(box.mesh.n_nodes(), 0.);
    const CrackedBody<3> body = {{box.mesh, box.materials, box.displacement},
                                 box.cracks,
                                 none,
                                 none};
    const auto           fronts =
      front_quantities(body, {box.front}, 1, {{0.6, 1.5}}, MPI_COMM_SELF);
    const auto &found = fronts.at(0).values.at(0).at(0);
    EXPECT_FALSE(found.has_factors);
    EXPECT_EQ(found.K_I, 0.);
    EXPECT_NEAR(found.J / straight_front_J, 1., 1.2e-2);
  }

  /// Displacement around a penny crack of radius 1 in the plane z = 0 under
  /// tension 1 along z: that of unit pressure on its faces (V. I. Fabrikant,
  /// Applications of Potential Theory in Mechanics, 1989) and the uniform one.
  dealii::Tensor<1, 3>
  penny_displacement(const Point3 &x)
  {
    const double nu    = poissons_ratio;
    const double z     = std::abs(x[2]);
    const double r     = std::hypot(x[0], x[1]);
    const double l1    = 0.5 * (std::hypot(r + 1., z) - std::hypot(r - 1., z));
    const double l2    = 0.5 * (std::hypot(r + 1., z) + std::hypot(r - 1., z));
    const double angle = std::asin(std::min(1., 1. / l2));
    const double outside = std::sqrt(std::max(0., l2 * l2 - 1.));
    const double inside  = std::sqrt(std::max(0., 1. - l1 * l1));
    const double spread  = l2 * l2 - l1 * l1;
    const double radial_over_r =
      ((1. - 2. * nu) * (outside / (l2 * l2) - angle) +
       2. * z * inside / (l2 * l2 * spread)) /
      (2. * pi * shear_modulus);
    const double axial =
      (2. * (1. - nu) * (inside - z * angle) + z * (angle - outside / spread)) /
      (pi * shear_modulus);
    dealii::Tensor<1, 3> u;
    u[0] = (radial_over_r - nu) * x[0];
    u[1] = (radial_over_r - nu) * x[1];
    u[2] = (x[2] < 0. ? -axial : axial) + x[2];
    return u;
  }

  constexpr double penny_height = 0.06; // over a layer of nodes

  /// A penny crack; the spacing of the mesh is 0.18 of its radius.
  Box
  penny_box()
  {
    const unsigned int n   = 48;
    const auto         rim = [&](const unsigned int k) {
      return Point3(std::cos(2. * pi * k / n),
                    std::sin(2. * pi * k / n),
                    penny_height);
    };
    std::vector<Bonds::CrackFacet<3>> facets;
    for (unsigned int k = 0; k < n; ++k)
      facets.push_back(
        triangle(Point3(0., 0., penny_height), rim(k), rim((k + 1) % n)));
    const auto field = [&](const Point3 &x) {
      return penny_displacement(Point3(x[0], x[1], x[2] - penny_height));
    };
    return Box(22, 0.1, field, facets);
  }

  /// K_I = 2 sqrt(a / pi) (I. N. Sneddon, Proc. Roy. Soc. A 187 (1946) 229).
  /// Without the term of the curvature K_I is 3 to 4 % too small.
  void
  expect_penny(const FractureQuantities &found)
  {
    const double factor  = 2. / std::sqrt(pi);
    const double modulus = 1. / (1. - poissons_ratio * poissons_ratio);
    EXPECT_NEAR(found.K_I / factor, 1., 2.5e-2);
    EXPECT_NEAR(found.J * modulus / (factor * factor), 1., 3.5e-2);
    EXPECT_NEAR(found.K_II / factor, 0., 2.2e-2);
    EXPECT_NEAR(found.K_III / factor, 0., 1.4e-2);
  }

  TEST(FrontIntegral, penny_crack)
  {
    const Box box = penny_box();
    auto      set = box.points(0.7);
    for (const Annulus annulus : {Annulus{0.25, 0.7}, Annulus{0.3, 0.6}})
      for (const double station : box.front.stations(3))
        expect_penny(box.quantities(set, {station, 0.7, annulus}));
  }

  TEST(FrontIntegral, all_fronts_with_default_domains)
  {
    const Box                 box = penny_box();
    const std::vector<double> none(box.mesh.n_nodes(), 0.);
    const CrackedBody<3> body = {{box.mesh, box.materials, box.displacement},
                                 box.cracks,
                                 none,
                                 none};
    const auto           fronts =
      front_quantities(body, {box.front}, 4, {}, MPI_COMM_SELF);
    ASSERT_EQ(fronts.size(), 1u);
    ASSERT_EQ(fronts[0].values.size(), 4u);
    ASSERT_EQ(fronts[0].annuli.size(), 2u);
    for (const auto &values : fronts[0].values)
      for (const auto &value : values)
        expect_penny(value);
  }
} // namespace
