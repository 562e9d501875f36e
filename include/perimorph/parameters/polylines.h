#pragma once

#include <perimorph/base/exceptions.h>

#include <string>
#include <vector>

namespace Perimorph::Parameters
{
  /// "edge: 0 0 to 0.5 0 to 0.6 0.1" or "edge: group NAME"
  struct Polyline
  {
    std::string                      name;
    std::vector<std::vector<double>> points; ///< dim numbers each
    std::string                      group;  ///< of the mesh, instead of points
    /// Corners of triangles, in 3D, instead of points; found in the group.
    std::vector<std::vector<double>> triangles;
  };

  /// Pre-cracks: in 2D lines of two points and more, in 3D the corners of flat
  /// convex polygons in order, in both the name of a group. Entries are
  /// separated by ';'. Checked: names, numbers, pieces of length zero, flatness
  /// and convexity.
  std::vector<Polyline>
  parse_polylines(const std::string         &path,
                  const std::string         &text,
                  unsigned int               dim,
                  Base::InputErrorCollector &errors);
} // namespace Perimorph::Parameters
