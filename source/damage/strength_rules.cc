#include <perimorph/damage/strength_rules.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace Perimorph::Damage
{
  namespace
  {
    /// Tension along the fibres, both principal ones across them, and the
    /// square of the shear along them.
    struct FibreStress
    {
      double                along;
      std::array<double, 2> across;
      double                shear_square;
    };

    FibreStress
    fibre_stress(const dealii::SymmetricTensor<2, 3> &stress,
                 const dealii::Tensor<2, 3>          &axes)
    {
      const dealii::Tensor<2, 3> local =
        axes * dealii::Tensor<2, 3>(stress) * transpose(axes);
      const double mean = 0.5 * (local[1][1] + local[2][2]);
      const double radius =
        std::hypot(0.5 * (local[1][1] - local[2][2]), local[1][2]);
      const auto tension = [](const double value) {
        return std::max(value, 0.);
      };
      return {tension(local[0][0]),
              {{tension(mean + radius), tension(mean - radius)}},
              local[0][1] * local[0][1] + local[0][2] * local[0][2]};
    }

    class StrengthRule : public BreakingRule
    {
    public:
      explicit StrengthRule(const Criterion criterion)
        : index(criterion == Criterion::tsai_hill ? tsai_hill_index
                                                  : maximum_stress_index)
      {}

      double
      load_factor(const BondState &bond) const override
      {
        constexpr double never = std::numeric_limits<double>::infinity();
        if (!(bond.extension > 0.))
          return never;
        const double value = index(bond.stress, bond.axes, bond.strengths);
        return value > 0. ? 1. / std::sqrt(value) : never;
      }

    private:
      double (*index)(const dealii::SymmetricTensor<2, 3> &,
                      const dealii::Tensor<2, 3> &,
                      const Strengths &);
    };
  } // namespace

  double
  tsai_hill_index(const dealii::SymmetricTensor<2, 3> &stress,
                  const dealii::Tensor<2, 3>          &axes,
                  const Strengths                     &strengths)
  {
    const auto local    = fibre_stress(stress, axes);
    const auto [s2, s3] = local.across;
    const double s1     = local.along;
    const double X      = strengths.longitudinal * strengths.longitudinal;
    const double Y      = strengths.transverse * strengths.transverse;
    return (s1 * s1 - s1 * (s2 + s3) + s2 * s3) / X +
           (s2 - s3) * (s2 - s3) / Y +
           local.shear_square / (strengths.shear * strengths.shear);
  }

  double
  maximum_stress_index(const dealii::SymmetricTensor<2, 3> &stress,
                       const dealii::Tensor<2, 3>          &axes,
                       const Strengths                     &strengths)
  {
    const auto   local = fibre_stress(stress, axes);
    const double largest =
      std::max({local.along / strengths.longitudinal,
                local.across[0] / strengths.transverse,
                std::sqrt(local.shear_square) / strengths.shear});
    return largest * largest;
  }

  dealii::Tensor<1, 3>
  failure_plane_normal(const dealii::SymmetricTensor<2, 3> &stress,
                       const dealii::Tensor<2, 3>          &axes,
                       const Strengths                     &strengths)
  {
    const auto local   = fibre_stress(stress, axes);
    const auto tension = local.across[0] / strengths.transverse;
    const auto shear   = std::sqrt(local.shear_square) / strengths.shear;
    const auto row     = [&](const unsigned int a) {
      return dealii::Tensor<1, 3>({axes[a][0], axes[a][1], axes[a][2]});
    };
    if (local.along / strengths.longitudinal > std::max(tension, shear))
      return row(0);
    const auto component = [&](const unsigned int a, const unsigned int b) {
      return row(a) * (stress * row(b));
    };
    double in_2, in_3;
    if (tension >= shear)
      {
        // Half of the angle of the principal direction in Mohr's circle.
        const double angle =
          0.5 *
          std::atan2(2. * component(1, 2), component(1, 1) - component(2, 2));
        in_2 = std::cos(angle);
        in_3 = std::sin(angle);
      }
    else
      {
        const double size = std::sqrt(local.shear_square);
        in_2              = component(0, 1) / size;
        in_3              = component(0, 2) / size;
      }
    return in_2 * row(1) + in_3 * row(2);
  }

  std::unique_ptr<BreakingRule>
  make_strength_rule(const Criterion criterion)
  {
    return std::make_unique<StrengthRule>(criterion);
  }
} // namespace Perimorph::Damage
