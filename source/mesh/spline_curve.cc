#include <perimorph/mesh/spline_curve.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Mesh
{
  namespace
  {
    std::vector<dealii::Point<2>>
    close(std::vector<dealii::Point<2>> points, const bool closed)
    {
      if (closed)
        points.push_back(points[0]);
      return points;
    }

    std::vector<double>
    chords(const std::vector<dealii::Point<2>> &points)
    {
      std::vector<double> knots = {0.};
      for (unsigned int k = 1; k < points.size(); ++k)
        knots.push_back(knots.back() + points[k].distance(points[k - 1]));
      return knots;
    }
  } // namespace

  SplineCurve::SplineCurve(const std::vector<dealii::Point<2>> &points_,
                           const bool                           closed)
    : dealii::ChartManifold<2, 2, 1>(
        closed ? dealii::Tensor<1, 1>({chords(close(points_, closed)).back()})
               : dealii::Tensor<1, 1>())
    , points(close(points_, closed))
    , knots(chords(points))
    , second(points.size())
  {
    // Equations for the second derivatives m at the knots, pieces of length h:
    // h0 m0 + 2 (h0 + h1) m1 + h1 m2 = 6 (slope1 - slope0).
    const unsigned int n      = points.size();
    Eigen::MatrixXd    matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd    right  = Eigen::MatrixXd::Zero(n, 2);
    const auto         length = [this](const unsigned int k) {
      return knots[k + 1] - knots[k];
    };
    const auto add_row = [&](const unsigned int row,
                             const unsigned int before,
                             const unsigned int after) {
      matrix(row, before) += length(before);
      matrix(row, row) += 2. * (length(before) + length(after));
      matrix(row, after + 1) += length(after);
      for (int d = 0; d < 2; ++d)
        right(row, d) =
          6. * ((points[after + 1][d] - points[after][d]) / length(after) -
                (points[before + 1][d] - points[before][d]) / length(before));
    };
    for (unsigned int k = 1; k + 1 < n; ++k)
      add_row(k, k - 1, k);
    if (closed)
      {
        add_row(0, n - 2, 0);
        matrix(n - 1, n - 1) = 1.;
        matrix(n - 1, 0)     = -1.;
      }
    else if (n == 3) // a parabola
      {
        matrix(0, 0) = matrix(2, 2) = 1.;
        matrix(0, 1) = matrix(2, 1) = -1.;
      }
    else
      for (const unsigned int end : {0u, n - 1})
        {
          const unsigned int first = end == 0 ? 0 : n - 3;
          matrix(end, first)       = length(first + 1);
          matrix(end, first + 1)   = -length(first) - length(first + 1);
          matrix(end, first + 2)   = length(first);
        }
    const Eigen::MatrixXd solution = matrix.partialPivLu().solve(right);
    for (unsigned int k = 0; k < n; ++k)
      for (int d = 0; d < 2; ++d)
        second[k][d] = solution(k, d);
  }

  std::unique_ptr<dealii::Manifold<2>>
  SplineCurve::clone() const
  {
    return std::make_unique<SplineCurve>(*this);
  }

  std::array<dealii::Tensor<1, 2>, 3>
  SplineCurve::at(const unsigned int k, const double s) const
  {
    const double               h = knots[k + 1] - knots[k];
    const double               b = (s - knots[k]) / h;
    const double               a = 1. - b;
    const dealii::Tensor<1, 2> first(points[k]), last(points[k + 1]);
    return {
      {a * first + b * last +
         (h * h / 6.) *
           ((a * a * a - a) * second[k] + (b * b * b - b) * second[k + 1]),
       (last - first) / h + (h / 6.) * ((3. * b * b - 1.) * second[k + 1] -
                                        (3. * a * a - 1.) * second[k]),
       a * second[k] + b * second[k + 1]}};
  }

  dealii::Point<1>
  SplineCurve::pull_back(const dealii::Point<2> &point) const
  {
    const dealii::Tensor<1, 2> x(point);
    double                     best     = 0.;
    double                     smallest = std::numeric_limits<double>::max();
    const auto compare = [&](const unsigned int k, const double s) {
      const double square = (at(k, s)[0] - x).norm_square();
      if (square < smallest)
        {
          smallest = square;
          best     = s;
        }
    };
    constexpr unsigned int n_samples = 8; // of a piece
    unsigned int           piece     = 0;
    for (unsigned int k = 0; k + 1 < knots.size(); ++k)
      for (unsigned int j = 0; j <= n_samples; ++j)
        {
          const double before = smallest;
          compare(k, knots[k] + (knots[k + 1] - knots[k]) * j / n_samples);
          if (smallest < before)
            piece = k;
        }
    // Newton's method for the foot of the perpendicular.
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const auto   curve = at(piece, best);
        const double slope = (curve[0] - x) * curve[1];
        const double change =
          slope / (curve[1] * curve[1] + (curve[0] - x) * curve[2]);
        best = std::clamp(best - change, knots.front(), knots.back());
        if (std::abs(change) < 1e-15 * knots.back())
          break;
        piece =
          std::clamp<long>(std::upper_bound(knots.begin(), knots.end(), best) -
                             knots.begin() - 1,
                           0,
                           knots.size() - 2);
      }
    return dealii::Point<1>(best);
  }

  dealii::Point<2>
  SplineCurve::push_forward(const dealii::Point<1> &parameter) const
  {
    const double s = std::clamp(parameter[0], knots.front(), knots.back());
    const auto   k = std::clamp<long>(
      std::upper_bound(knots.begin(), knots.end(), s) - knots.begin() - 1,
      0,
      knots.size() - 2);
    return dealii::Point<2>(at(k, s)[0]);
  }
} // namespace Perimorph::Mesh
