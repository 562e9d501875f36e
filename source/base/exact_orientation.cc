#include <perimorph/base/exact_orientation.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Base
{
  namespace
  {
    using Integer = boost::multiprecision::cpp_int;

    template <typename Number, int dim>
    using Matrix = std::array<std::array<Number, dim>, dim>;

    /// Determinant, and the same with absolute values throughout.
    template <typename Number>
    std::pair<Number, Number>
    determinant(const Matrix<Number, 2> &m)
    {
      const Number a = m[0][0] * m[1][1], b = m[0][1] * m[1][0];
      using std::abs;
      return {a - b, abs(a) + abs(b)};
    }

    template <typename Number>
    std::pair<Number, Number>
    determinant(const Matrix<Number, 3> &m)
    {
      using std::abs;
      Number value = 0, bound = 0;
      for (int c = 0; c < 3; ++c)
        {
          const int    d = (c + 1) % 3, e = (c + 2) % 3;
          const Number a = m[1][d] * m[2][e], b = m[1][e] * m[2][d];
          value += m[0][c] * (a - b);
          bound += abs(m[0][c]) * (abs(a) + abs(b));
        }
      return {value, bound};
    }

    /// Rows point k - point 0, one column replaced by what each row changes by
    /// when the moved points move by one.
    template <typename Number, int dim>
    Matrix<Number, dim>
    rows(const std::array<std::array<Number, dim>, dim + 1> &points,
         const std::array<bool, dim + 1>                    &moved,
         const int                                           replaced_column)
    {
      Matrix<Number, dim> m;
      for (int k = 0; k < dim; ++k)
        for (int d = 0; d < dim; ++d)
          m[k][d] = d == replaced_column
                      ? Number(int(moved[k + 1]) - int(moved[0]))
                      : points[k + 1][d] - points[0][d];
      return m;
    }

    /// Coordinates times the power of two that makes all of them integers.
    template <int dim>
    std::array<std::array<Integer, dim>, dim + 1>
    as_integers(const std::array<std::array<double, dim>, dim + 1> &points)
    {
      constexpr int digits   = std::numeric_limits<double>::digits;
      int           smallest = std::numeric_limits<int>::max();
      for (const auto &point : points)
        for (const double x : point)
          if (x != 0.)
            smallest = std::min(smallest, std::ilogb(x));
      std::array<std::array<Integer, dim>, dim + 1> result;
      for (int k = 0; k <= dim; ++k)
        for (int d = 0; d < dim; ++d)
          {
            const double x = points[k][d];
            if (x == 0.)
              continue;
            const int exponent = std::ilogb(x);
            result[k][d] =
              Integer(std::llrint(std::scalbn(x, digits - 1 - exponent)))
              << (exponent - smallest);
          }
      return result;
    }

    template <int dim>
    int
    sign(const std::array<dealii::Point<dim>, dim + 1> &points,
         const std::array<bool, dim + 1>               &moved,
         const int                                      replaced_column)
    {
      std::array<std::array<double, dim>, dim + 1> x;
      for (int k = 0; k <= dim; ++k)
        for (int d = 0; d < dim; ++d)
          x[k][d] = points[k][d];
      // Above the bounds of Shewchuk (1997): (3 + 16 e) e, (7 + 56 e) e.
      constexpr double relative_error = 2e-15;
      const auto [value, bound] =
        determinant(rows<double, dim>(x, moved, replaced_column));
      if (std::abs(value) > relative_error * bound)
        return value > 0. ? 1 : -1;
      // A product without a factor that is exactly zero has a bound.
      if (bound == 0.)
        return 0;
      const Integer exact =
        determinant(
          rows<Integer, dim>(as_integers<dim>(x), moved, replaced_column))
          .first;
      return exact.sign();
    }
  } // namespace

  template <int dim>
  int
  orientation(const std::array<dealii::Point<dim>, dim + 1> &points,
              const std::array<bool, dim + 1>               &moved)
  {
    // The determinant is linear in the common motion (e, e^2, e^3): the first
    // coefficient that is not zero decides.
    for (int column = -1; column < dim; ++column)
      if (const int s = sign<dim>(points, moved, column))
        return s;
    return 0;
  }

  template int
  orientation<2>(const std::array<dealii::Point<2>, 3> &,
                 const std::array<bool, 3> &);
  template int
  orientation<3>(const std::array<dealii::Point<3>, 4> &,
                 const std::array<bool, 4> &);
} // namespace Perimorph::Base
