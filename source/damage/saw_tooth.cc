#include <perimorph/damage/saw_tooth.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Perimorph::Damage
{
  namespace
  {
    /// r = s_f / s_0 (numerics-damage.md, section 3).
    constexpr double softening_ratio = 4.;

    template <int dim>
    class SawToothRule : public BreakingRule
    {
    public:
      SawToothRule(const Limits               &limits,
                   const unsigned int          n_teeth,
                   const Materials::PlaneState state)
        : limits(limits)
        , state(state)
        , teeth(limits.softening_stretch > 0.
                  ? SawTooth(n_teeth,
                             limits.softening_stretch / limits.stretch,
                             limits.softening_steepness)
                  : SawTooth(n_teeth))
      {}

      double
      load_factor(const BondState &bond) const override
      {
        if (!(bond.extension > 0.))
          return std::numeric_limits<double>::infinity();
        return teeth.stretch(bond.teeth_lost) *
               (limits.stretch > 0. ? limits.stretch : of_lattice(bond)) *
               bond.length / bond.extension;
      }

    private:
      double
      of_lattice(const BondState &bond) const
      {
        // s_c goes with the roots of 1 / E and 1 / horizon; ratios repeat but
        // for round-off.
        const double ratio = std::round(bond.horizon_ratio * 1e6) / 1e6;
        auto         unit  = of_ratio.find(ratio);
        if (unit == of_ratio.end())
          unit =
            of_ratio
              .emplace(ratio,
                       critical_stretch_of_lattice<dim>(
                         limits.fracture_energy /
                           (limits.calibration > 0. ? limits.calibration : 1.),
                         1.,
                         1.,
                         ratio,
                         state))
              .first;
        return unit->second / std::sqrt(bond.youngs_modulus * bond.horizon);
      }

      const Limits                     limits;
      const Materials::PlaneState      state;
      const SawTooth                   teeth;
      mutable std::map<double, double> of_ratio; ///< s_c for E = horizon = 1
    };
  } // namespace

  SawTooth::SawTooth(const unsigned int n_teeth)
  {
    double energy = 0.;
    for (unsigned int l = 0; l < n_teeth; ++l)
      {
        const double mean_share = 1. - (l + 0.5) / n_teeth;
        stretches.push_back(softening_ratio /
                            (mean_share * (softening_ratio - 1.) + 1.));
        energy += stretches.back() * stretches.back() / n_teeth;
      }
    for (double &stretch : stretches)
      stretch /= std::sqrt(energy);
  }

  SawTooth::SawTooth(const unsigned int n_teeth,
                     const double       start,
                     const double       steepness)
  {
    for (unsigned int l = 0; l < n_teeth; ++l)
      {
        const double mean_share = 1. - (l + 0.5) / n_teeth;
        // T is not quite 1 and 0 at the ends of the range.
        stretches.push_back(
          std::clamp(0.5 * (1. + start) + 0.5 * (1. - start) / steepness *
                                            std::atanh(1. - 2. * mean_share),
                     start,
                     1.));
      }
  }

  template <int dim>
  std::unique_ptr<BreakingRule>
  make_saw_tooth_rule(const Limits               &limits,
                      const unsigned int          n_teeth,
                      const Materials::PlaneState state)
  {
    return std::make_unique<SawToothRule<dim>>(limits, n_teeth, state);
  }

  template std::unique_ptr<BreakingRule>
  make_saw_tooth_rule<2>(const Limits &, unsigned int, Materials::PlaneState);
  template std::unique_ptr<BreakingRule>
  make_saw_tooth_rule<3>(const Limits &, unsigned int, Materials::PlaneState);
} // namespace Perimorph::Damage
