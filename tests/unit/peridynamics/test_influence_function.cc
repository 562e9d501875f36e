#include <perimorph/peridynamics/influence_function.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Perimorph::Peridynamics
{
  TEST(InfluenceFunction, falls_from_one)
  {
    for (unsigned int k = 0; k < influence_function_names().size(); ++k)
      {
        const auto function = static_cast<InfluenceFunction>(k);
        EXPECT_EQ(influence_function_from_name(influence_function_names()[k]),
                  function);
        EXPECT_DOUBLE_EQ(influence(function, 0.), 1.);
        EXPECT_DOUBLE_EQ(averaging_weight(function, 0.), 1.);
        for (double r = 0.; r < 1.; r += 0.1)
          {
            EXPECT_GE(influence(function, r), influence(function, r + 0.1));
            EXPECT_GE(averaging_weight(function, r),
                      averaging_weight(function, r + 0.1));
          }
        EXPECT_GE(averaging_weight(function, 2.), std::exp(-4.));
      }
  }

  TEST(InfluenceFunction, averaging_weight_integrates_the_influence)
  {
    // -phi'(r) is proportional to omega(r) r: the ratio at two places agrees.
    for (const auto function : {InfluenceFunction::constant,
                                InfluenceFunction::triangular,
                                InfluenceFunction::cubic_spline,
                                InfluenceFunction::gaussian})
      {
        const auto ratio = [function](const double r) {
          const double step = 1e-5;
          return (averaging_weight(function, r - step) -
                  averaging_weight(function, r + step)) /
                 (2. * step * influence(function, r) * r);
        };
        for (const double r : {0.2, 0.45, 0.6})
          EXPECT_NEAR(ratio(r) / ratio(0.3), 1., 1e-6);
      }
  }
} // namespace Perimorph::Peridynamics
