#include "cracked_body.h"

namespace Perimorph::Coupling
{
  using namespace CrackTests;

  TEST(CutFamilies, patch_test_with_a_crack)
  {
    // Uniform tension along the crack: a crack does not disturb it. The page
    // has 2e-13 (numerics-cracks.md, section 8); bonds alone leave 0.2 to 1.
    for (const double perturbation : {0., 0.2})
      for (const double ratio : {1.5, 2., 3.})
        for (const double degrees : {0., 17., 45.})
          {
            CrackedPlate plate;
            plate.facets = polylines({segment(Point2(.5, .5), .2, degrees)});
            plate.perturbation  = perturbation;
            plate.horizon_ratio = ratio;
            plate.build();
            EXPECT_LT(plate.problem->crack_report().residual, 1e-12);
            EXPECT_LT(
              plate.ghost(uniaxial(degrees, *plate.materials.laws[0], 1., 0.)),
              1e-12)
              << "perturbation " << perturbation << ", m " << ratio << ", "
              << degrees << " degrees";
          }
  }

  TEST(CutFamilies, patch_test_at_finite_strain)
  {
    for (const double degrees : {0., 17.})
      {
        CrackedPlate plate;
        plate.facets = polylines({segment(Point2(.5, .5), .2, degrees)});
        plate.law    = "hencky";
        plate.build();
        EXPECT_LT(plate.ghost(uniaxial(degrees,
                                       *plate.materials.laws[0],
                                       std::exp(.35) - 1.,
                                       .7)),
                  1e-12);
      }
  }

  TEST(CutFamilies, every_affine_field_finds_a_free_surface)
  {
    for (const auto &shape : crack_shapes())
      for (const double perturbation : {0., 0.2})
        {
          CrackedPlate plate;
          plate.facets       = polylines(shape);
          plate.perturbation = perturbation;
          plate.everywhere   = true;
          plate.build();
          EXPECT_LT(plate.problem->crack_report().residual, 1e-12);
          for (const double degrees : {0., 50.})
            EXPECT_LT(
              plate.ghost(uniaxial(degrees, *plate.materials.laws[0], 1., 0.)),
              1e-12)
              << "crack from " << shape[0][0];
        }
  }

  TEST(CutFamilies, patch_test_in_space)
  {
    // A square crack of two triangles, aligned and turned, inside the cube and
    // up to one face.
    using Point3                                     = dealii::Point<3>;
    const std::vector<std::array<Point3, 4>> squares = {
      {{Point3(.3, .3, .5),
        Point3(.7, .3, .5),
        Point3(.7, .7, .5),
        Point3(.3, .7, .5)}},
      {{Point3(.32, .31, .42),
        Point3(.7, .33, .5),
        Point3(.68, .71, .58),
        Point3(.3, .69, .5)}},
      {{Point3(-.1, .3, .5),
        Point3(.5, .3, .5),
        Point3(.5, .7, .5),
        Point3(-.1, .7, .5)}}};
    for (const auto &c : squares)
      for (const double perturbation : {0., 0.2})
        {
          CrackedBody<3> block;
          block.facets       = {{{{c[0], c[1], c[2]}}, 0, 0},
                                {{{c[0], c[2], c[3]}}, 0, 0}};
          block.perturbation = perturbation;
          block.everywhere   = true;
          block.build();
          EXPECT_LT(block.problem->crack_report().residual, 1e-11);
          dealii::Tensor<2, 3> gradient;
          gradient[0][0] = 1.;
          gradient[1][2] = .4;
          gradient[2][1] = -.7;
          EXPECT_LT(block.ghost(gradient), 1e-11) << "crack from " << c[0];
        }
  }

  TEST(CutFamilies, cheap_rule_leaves_a_ghost_force)
  {
    // The other treatment is there to compare with: it must be worse.
    CrackedPlate plate;
    plate.facets                = polylines({segment(Point2(.5, .5), .2, 17.)});
    plate.parameters.crack_rule = CrackRule::shape_tensor;
    plate.build();
    EXPECT_GT(
      plate.disturbance(uniaxial(17., *plate.materials.laws[0], 1., 0.)),
      0.01);
  }
} // namespace Perimorph::Coupling
