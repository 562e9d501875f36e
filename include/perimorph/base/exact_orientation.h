#pragma once

#include <deal.II/base/point.h>

#include <array>

namespace Perimorph::Base
{
  /// Sign of the volume of the simplex of dim + 1 points (2D: +1 if they turn
  /// to the left), decided without round-off: floating point with an error
  /// bound, exact integers where that does not settle it.
  ///
  /// Points marked `moved` are moved by a common infinitesimal vector (e, e^2,
  /// e^3), which settles the cases in which points lie in one line or plane.
  /// @return +1 or -1; 0 if even the moved points lie in one line or plane
  /// Source: J. R. Shewchuk, Discrete Comput. Geom. 18 (1997) 305 (bounds);
  /// H. Edelsbrunner, E. P. Muecke, ACM Trans. Graphics 9 (1990) 66 (motion).
  template <int dim>
  int
  orientation(const std::array<dealii::Point<dim>, dim + 1> &points,
              const std::array<bool, dim + 1>               &moved);
} // namespace Perimorph::Base
