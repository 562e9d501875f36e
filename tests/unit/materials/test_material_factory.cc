#include <perimorph/base/exceptions.h>
#include <perimorph/materials/material_factory.h>

#include <gtest/gtest.h>

namespace Perimorph::Materials
{
  TEST(MaterialFactory, every_law_carries_its_name)
  {
    EXPECT_EQ(law_names().size(), 5u);
    for (const std::string &law : law_names())
      {
        for (const auto state :
             {PlaneState::plane_stress, PlaneState::plane_strain})
          EXPECT_EQ(make_material<2>(law, 2.5, 0.25, state)->name(), law);
        const auto solid =
          make_material<3>(law, 2.5, 0.25, PlaneState::three_dimensional);
        EXPECT_EQ(solid->name(), law);
        EXPECT_NEAR(solid->shear_modulus(), 1., 1e-14);
        EXPECT_EQ(solid->is_linear(), law == "linear elastic");
      }
  }

  TEST(MaterialFactory, names_the_nearest_law)
  {
    try
      {
        make_material<2>("henky", 1., 0.3, PlaneState::plane_stress);
        FAIL() << "nothing thrown";
      }
    catch (const Base::InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("did you mean 'hencky'?"),
                  std::string::npos)
          << error.what();
      }
  }
} // namespace Perimorph::Materials
