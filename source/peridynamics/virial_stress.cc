#include <perimorph/peridynamics/virial_stress.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Peridynamics
{
  template <int dim>
  double
  ball_volume(const double radius)
  {
    return dim == 2 ? dealii::numbers::PI * radius * radius
                    : 4. / 3. * dealii::numbers::PI * radius * radius * radius;
  }

  namespace
  {
    /// Lattice points on the sphere itself are inside.
    constexpr double rim_tolerance = 1e-9;
  } // namespace

  template <int dim>
  double
  fraction_in_ball(const dealii::Point<dim> &begin,
                   const dealii::Point<dim> &end,
                   const dealii::Point<dim> &center,
                   const double              radius)
  {
    // |begin - center + s (end - begin)|^2 = radius^2
    const dealii::Tensor<1, dim> start   = begin - center;
    const dealii::Tensor<1, dim> segment = end - begin;

    const double a            = segment.norm_square();
    const double b            = start * segment;
    const double c            = start.norm_square() - radius * radius;
    const double discriminant = b * b - a * c;
    if (discriminant <= 0.)
      return 0.;
    const double root  = std::sqrt(discriminant);
    const double enter = std::max(0., (-b - root) / a);
    const double leave = std::min(1., (-b + root) / a);
    return std::max(0., leave - enter);
  }

  template <int dim>
  dealii::Tensor<2, dim>
  virial_stress(const dealii::Point<dim>          &center,
                const double                       radius,
                const std::vector<PairForce<dim>> &pairs,
                const BondFunction                 function)
  {
    const auto inside = [&](const dealii::Point<dim> &point) {
      return point.distance(center) <= radius * (1. + rim_tolerance);
    };
    dealii::Tensor<2, dim> sum;
    for (const auto &pair : pairs)
      {
        const double weight =
          function == BondFunction::segment_in_ball
            ? fraction_in_ball(pair.begin, pair.end, center, radius)
            : (inside(pair.begin) && inside(pair.end) ? 1. : 0.);
        sum +=
          weight * outer_product(pair.force,
                                 dealii::Tensor<1, dim>(pair.end - pair.begin));
      }
    return sum / ball_volume<dim>(radius);
  }

  template double
  ball_volume<2>(double);
  template double
  ball_volume<3>(double);
  template double
  fraction_in_ball<2>(const dealii::Point<2> &,
                      const dealii::Point<2> &,
                      const dealii::Point<2> &,
                      double);
  template double
  fraction_in_ball<3>(const dealii::Point<3> &,
                      const dealii::Point<3> &,
                      const dealii::Point<3> &,
                      double);
  template dealii::Tensor<2, 2>
  virial_stress<2>(const dealii::Point<2> &,
                   double,
                   const std::vector<PairForce<2>> &,
                   BondFunction);
  template dealii::Tensor<2, 3>
  virial_stress<3>(const dealii::Point<3> &,
                   double,
                   const std::vector<PairForce<3>> &,
                   BondFunction);
} // namespace Perimorph::Peridynamics
