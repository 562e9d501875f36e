#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace Perimorph::Fracture
{
  /// Local axes at a crack tip or at a point of a crack front: the crack lies
  /// behind the origin, along -axes[0].
  template <int dim>
  struct TipFrame
  {
    dealii::Point<dim> origin;
    /// Direction of growth, normal of the crack, in 3D tangent of the front:
    /// orthonormal and right-handed.
    std::array<dealii::Tensor<1, dim>, dim> axes;
    /// Of the front in space [1 / length]: 1 / radius for a penny crack.
    double curvature = 0.;
  };

  /// Axes for a direction in 2D; the normal is the direction turned left.
  TipFrame<2>
  tip_frame(const dealii::Point<2>     &origin,
            const dealii::Tensor<1, 2> &direction);
} // namespace Perimorph::Fracture
