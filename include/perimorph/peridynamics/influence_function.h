#pragma once

#include <string>
#include <vector>

namespace Perimorph::Peridynamics
{
  /// How the weight of a bond falls with its length.
  enum class InfluenceFunction
  {
    constant,
    triangular,
    cubic_spline,
    gaussian
  };

  /// Names as in the parameter file, in the order of the enumeration.
  const std::vector<std::string> &
  influence_function_names();

  /// @throws std::out_of_range   unknown name (the parameter reader checked it)
  InfluenceFunction
  influence_function_from_name(const std::string &name);

  /// omega(r), r = |xi| / horizon in [0, 1]; 1 at r = 0. The cubic spline is
  /// the B-spline with support 1. Gaussian: exp(-4 r^2) (numerics.md, D4).
  double
  influence(InfluenceFunction function, double r);

  /// Smallest weight kept for a bond of the family, so that neighbours at the
  /// edge of the horizon count (numerics.md, section 2).
  constexpr double smallest_influence = 0.02;

  /// phi(r) = integral of omega(s) s ds from r to 1, scaled to 1 at r = 0: the
  /// averaging weight whose gradient is omega xi. With the Gaussian it is taken
  /// as exp(-4 r^2) itself, with its value at r = 1 as the smallest value
  /// (numerics-explicit.md, section 2).
  double
  averaging_weight(InfluenceFunction function, double r);
} // namespace Perimorph::Peridynamics
