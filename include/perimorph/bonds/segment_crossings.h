#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace Perimorph::Bonds
{
  /// Segments end, cells begin, and crossings are kept with these tolerances.
  /// Lengths are relative to the segment, or unit coordinates of a cell.
  constexpr double merge_tolerance = 1e-12; ///< crossings that are the same
  constexpr double face_tolerance  = 1e-6;  ///< spare crossings do no harm

  /// Crossings of a straight segment, from the origin to a point, with the
  /// faces of cells: edges in 2D, bilinear faces in 3D (numerics-explicit.md,
  /// section 3).
  template <int dim>
  class SegmentCrossings
  {
  public:
    static constexpr unsigned int n_corners      = 1u << dim;
    static constexpr unsigned int n_face_corners = 1u << (dim - 1);

    using Corners = std::array<dealii::Point<dim>, n_corners>;

    struct Crossing
    {
      double                      s;       ///< between 0 and 1
      unsigned int                face;    ///< 2 * axis across + side
      std::array<double, dim - 1> on_face; ///< unit coordinates of the face
    };

    explicit SegmentCrossings(const dealii::Tensor<1, dim> &segment);

    /// Adds the crossings with the faces of a cell.
    /// @param corners  of the cell, relative to the beginning of the segment
    /// @return false when the line through the segment misses the cell
    bool
    add(const Corners &corners, std::vector<Crossing> &crossings) const;

    /// Corners of a face, the first of its unit coordinates fastest.
    static std::array<unsigned int, n_face_corners>
    face_corners(unsigned int face);

  private:
    /// Directions across the segment that cells are looked at along.
    static constexpr unsigned int n_views = dim == 2 ? 1 : 4;

    dealii::Tensor<1, dim>                      segment;
    std::array<dealii::Tensor<1, dim>, n_views> across;
  };
} // namespace Perimorph::Bonds
