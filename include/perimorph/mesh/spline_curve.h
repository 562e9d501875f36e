#pragma once

#include <deal.II/grid/manifold.h>

#include <memory>
#include <vector>

namespace Perimorph::Mesh
{
  /// Cubic spline through points of the plane, parametrised by the chords:
  /// twice continuously differentiable, periodic if closed, else with a
  /// continuous third derivative beside its ends ("not a knot"), so that it is
  /// as accurate there.
  /// Source: C. de Boor, A Practical Guide to Splines (1978), chapter IV.
  class SplineCurve : public dealii::ChartManifold<2, 2, 1>
  {
  public:
    /// @param points  at least three, in order; none twice
    SplineCurve(const std::vector<dealii::Point<2>> &points, bool closed);

    std::unique_ptr<dealii::Manifold<2>>
    clone() const override;

    /// Parameter of the nearest point of the curve.
    dealii::Point<1>
    pull_back(const dealii::Point<2> &point) const override;

    dealii::Point<2>
    push_forward(const dealii::Point<1> &parameter) const override;

  private:
    /// Derivatives up to the second at s of piece k.
    std::array<dealii::Tensor<1, 2>, 3>
    at(unsigned int k, double s) const;

    std::vector<dealii::Point<2>>     points; ///< the first again if closed
    std::vector<double>               knots;
    std::vector<dealii::Tensor<1, 2>> second; ///< derivatives at the knots
  };
} // namespace Perimorph::Mesh
