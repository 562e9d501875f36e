#include <perimorph/fracture/crack_opening.h>
#include <perimorph/fracture/crack_tips.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Fracture
{
  double
  nearest_place(const double length,
                const double horizon,
                const bool   is_accelerated)
  {
    const double at_rest = 0.15 * length;
    return is_accelerated ? std::min(at_rest, 0.4 * std::sqrt(horizon * length))
                          : at_rest;
  }

  template <int dim>
  OpeningFactors
  factors_from_opening(const DisplacementFit<dim>                &fit,
                       const std::vector<dealii::Tensor<1, dim>> &displacement,
                       const TipFrame<dim>                       &tip,
                       const double                               nearest,
                       const NearTipConstants                    &constants,
                       const std::vector<dealii::Point<dim>>     &path)
  {
    constexpr unsigned int n_places = 16;
    const double           farthest = 4. * nearest;
    // Of the faces from the crack, in spacings.
    constexpr double offset = 1e-6;
    const double     pi     = std::acos(-1.);
    const auto stiffness    = invert(inverse_barnett_lothe_tensor(constants));

    // sums of a straight line through K(r) = (K_II, K_I)
    double               n = 0., sum_r = 0., sum_rr = 0.;
    dealii::Tensor<1, 2> sum, sum_times_r;
    for (unsigned int k = 0; k < n_places; ++k)
      {
        const double r = nearest + (farthest - nearest) * (k + 0.5) / n_places;
        const auto   middle  = place_behind(tip, path, r);
        const double spacing = fit.length_at(middle);
        const auto   upper   = fit.fit(middle + offset * spacing * tip.axes[1],
                                   spacing,
                                   DisplacementFit<dim>::any_material,
                                   displacement);
        const auto   lower   = fit.fit(middle - offset * spacing * tip.axes[1],
                                   spacing,
                                   DisplacementFit<dim>::any_material,
                                   displacement);
        if (upper.n_nodes == 0 || lower.n_nodes == 0)
          continue;
        const auto jump = upper.displacement - lower.displacement;
        n += 1.;
        sum_r += r;
        sum_rr += r * r;
        const auto factors =
          std::sqrt(pi / (8. * r)) *
          (stiffness *
           dealii::Tensor<1, 2>({jump * tip.axes[0], jump * tip.axes[1]}));
        sum += factors;
        sum_times_r += r * factors;
      }

    OpeningFactors result;
    result.n_places  = static_cast<unsigned int>(n);
    const auto value = [&](const unsigned int axis) {
      return n < 3. ? std::numeric_limits<double>::quiet_NaN()
                    : (sum_rr * sum[axis] - sum_r * sum_times_r[axis]) /
                        (n * sum_rr - sum_r * sum_r);
    };
    result.K_I  = value(1);
    result.K_II = value(0);
    return result;
  }

#define INSTANTIATE(dim)                             \
  template OpeningFactors factors_from_opening<dim>( \
    const DisplacementFit<dim> &,                    \
    const std::vector<dealii::Tensor<1, dim>> &,     \
    const TipFrame<dim> &,                           \
    double,                                          \
    const NearTipConstants &,                        \
    const std::vector<dealii::Point<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
