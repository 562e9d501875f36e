#pragma once

#include <array>

namespace Perimorph::Bonds
{
  /// The part of a bond inside one cell.
  template <int dim>
  struct SegmentPiece
  {
    unsigned int cell;
    /// 1 / number of cells that hold this part (a bond may run along a face).
    double share;
    double length;
    /// Shape functions of the cell where the piece begins and ends.
    std::array<double, (1u << dim)> shape_begin;
    std::array<double, (1u << dim)> shape_end;
  };
} // namespace Perimorph::Bonds
