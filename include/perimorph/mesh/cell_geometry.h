#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace Perimorph
{
  namespace Mesh
  {
    /// Multilinear shape functions of a straight-sided quadrilateral or
    /// hexahedron at its 2^dim Gauss points: the one quadrature behind node
    /// volumes, blending, consistency targets and element stiffness, so that
    /// their sums agree to round-off (numerics-explicit.md, E6).
    template <int dim>
    struct CellGeometry
    {
      static constexpr unsigned int n_nodes  = 1u << dim;
      static constexpr unsigned int n_points = 1u << dim;

      using Corners = std::array<dealii::Point<dim>, n_nodes>;

      std::array<double, n_points>             jxw;    ///< weight [volume]
      std::array<dealii::Point<dim>, n_points> points; ///< quadrature points
      /// gradients[q][v] = gradient of shape function v at point q [1 / length]
      std::array<std::array<dealii::Tensor<1, dim>, n_nodes>, n_points>
        gradients;

      explicit CellGeometry(const Corners &corners);

      /// Value of shape function v at Gauss point q (the same for all cells).
      static double
      shape_value(unsigned int q, unsigned int v);
    };

    /// Multilinear shape functions at a unit point in [0,1]^dim.
    template <int dim>
    std::array<double, (1u << dim)>
    shape_values(const dealii::Point<dim> &unit_point);

    /// Inverse of the multilinear map by Newton's method.
    /// @param[out] unit_point  result; outside [0,1]^dim when the point is
    /// outside
    /// @return false when Newton's method does not converge (far outside)
    template <int dim>
    bool
    map_to_unit_cell(const std::array<dealii::Point<dim>, (1u << dim)> &corners,
                     const dealii::Point<dim>                          &point,
                     dealii::Point<dim> &unit_point);

    /// Smallest Jacobian determinant over the corners and Gauss points,
    /// relative to the mean; not positive for an inverted or non-convex cell.
    template <int dim>
    double
    smallest_relative_jacobian(
      const std::array<dealii::Point<dim>, (1u << dim)> &corners);
  } // namespace Mesh
} // namespace Perimorph
