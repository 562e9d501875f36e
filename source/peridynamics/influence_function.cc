#include <perimorph/peridynamics/influence_function.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Perimorph::Peridynamics
{
  const std::vector<std::string> &
  influence_function_names()
  {
    static const std::vector<std::string> names = {"constant",
                                                   "triangular",
                                                   "cubic spline",
                                                   "gaussian"};
    return names;
  }

  InfluenceFunction
  influence_function_from_name(const std::string &name)
  {
    const auto &names = influence_function_names();
    for (unsigned int k = 0; k < names.size(); ++k)
      if (names[k] == name)
        return static_cast<InfluenceFunction>(k);
    throw std::out_of_range("influence function " + name);
  }

  double
  influence(const InfluenceFunction function, const double r)
  {
    switch (function)
      {
        case InfluenceFunction::constant:
          return 1.;
        case InfluenceFunction::triangular:
          return std::max(0., 1. - r);
        case InfluenceFunction::cubic_spline:
          if (r < 0.5)
            return 1. - 6. * r * r + 6. * r * r * r;
          {
            const double t = std::max(0., 1. - r);
            return 2. * t * t * t;
          }
        case InfluenceFunction::gaussian:
          return std::exp(-4. * r * r);
      }
    return 0.;
  }

  double
  averaging_weight(const InfluenceFunction function, const double r)
  {
    // The floor keeps cells at the edge of the horizon in the average.
    static const double smallest = std::exp(-4.);
    const double        s        = std::min(r, 1.);
    const double        s2       = s * s;
    double              weight   = 0.;
    switch (function)
      {
        case InfluenceFunction::constant:
          weight = 1. - s2;
          break;
        case InfluenceFunction::triangular:
          weight = 1. - 3. * s2 + 2. * s2 * s;
          break;
        case InfluenceFunction::cubic_spline:
          // Integral of omega s over [r, 1], divided by its value 7/80 at 0.
          if (s < 0.5)
            weight =
              1. - (80. / 7.) * (0.5 * s2 - 1.5 * s2 * s2 + 1.2 * s2 * s2 * s);
          else
            {
              // 2 (1-s)^3 s integrates to (1-s)^4 / 2 - 2 (1-s)^5 / 5.
              const double t = 1. - s;
              weight         = (80. / 7.) * (t * t * t * t) * (0.5 - 0.4 * t);
            }
          break;
        case InfluenceFunction::gaussian:
          weight = std::exp(-4. * s2);
          break;
      }
    return std::max(weight, smallest);
  }
} // namespace Perimorph::Peridynamics
