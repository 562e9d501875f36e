#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace Perimorph::Mesh
{
  /// Multilinear map from the unit cell [0,1]^dim to a straight-sided cell, and
  /// its inverse. Prepared once for many points of a cell; its corners and the
  /// points are relative to a point near the cell, so that no digits are lost
  /// far from the origin.
  template <int dim>
  class MultilinearMap
  {
  public:
    MultilinearMap() = default;

    explicit MultilinearMap(
      const std::array<dealii::Point<dim>, (1u << dim)> &corners);

    /// Inverse of the map by Newton's method.
    /// @param[out] unit_point  result; outside [0,1]^dim when the point is
    /// outside
    /// @return false when Newton's method does not converge (far outside)
    bool
    to_unit(const dealii::Point<dim> &point,
            dealii::Point<dim>       &unit_point) const;

    /// The same from a guess.
    /// @param[in,out] unit_point  guess, result
    bool
    refine(const dealii::Point<dim> &point,
           dealii::Point<dim>       &unit_point) const;

  private:
    static constexpr unsigned int n_terms = 1u << dim;

    /// Products of the coordinates whose bits are set.
    static std::array<double, n_terms>
    products(const dealii::Tensor<1, dim> &t);

    /// x = sum_k terms[k] prod_(bits d of k) t_d with t = unit point - 1/2.
    std::array<dealii::Tensor<1, dim>, n_terms> terms;
    dealii::Tensor<2, dim> inverse; ///< of the Jacobian in the middle
    bool                   is_regular = false;
  };
} // namespace Perimorph::Mesh
