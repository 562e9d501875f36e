#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace Perimorph::Output
{
  /// One named array of a VTU file, tuple by tuple.
  struct VtuArray
  {
    std::string         name;
    unsigned int        n_components = 1;
    std::vector<double> values; ///< n_components per point or cell
  };

  /// Cell types of VTK that are used here, with VTK's numbers.
  enum class VtuCell : std::uint8_t
  {
    vertex        = 1,
    line          = 3,
    triangle      = 5,
    quadrilateral = 9,
    hexahedron    = 12
  };

  /// An unstructured grid of one kind of cell.
  struct VtuGrid
  {
    VtuCell                   cell_type = VtuCell::vertex;
    std::vector<double>       points;       ///< x y z of each point
    std::vector<std::int32_t> connectivity; ///< points of each cell, VTK order
    std::vector<VtuArray>     point_data;
    std::vector<VtuArray>     cell_data;

    unsigned int
    n_points_per_cell() const;
  };

  /// Writes @p grid in VTK's XML format (zlib at its fastest, base64). Points
  /// are shared by cells, so files are small and ParaView's filters for
  /// surfaces and gradients work. All values are doubles.
  /// @throws Base::InputError   the file cannot be written
  void
  write_vtu(const std::string &filename,
            const VtuGrid     &grid,
            const double       time);

  /// Writes the list of a time series: time and file name of each step. Aside
  /// and renamed, so that a viewer can open it during the run.
  /// @throws Base::InputError   the file cannot be written
  void
  write_pvd(const std::string                                 &filename,
            const std::vector<std::pair<double, std::string>> &steps);
} // namespace Perimorph::Output
