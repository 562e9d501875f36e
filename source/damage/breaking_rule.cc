#include <perimorph/damage/breaking_rule.h>
#include <perimorph/damage/particle_rules.h>
#include <perimorph/damage/strength_rules.h>

#include <cmath>
#include <limits>

namespace Perimorph::Damage
{
  namespace
  {
    constexpr double never = std::numeric_limits<double>::infinity();

    class CriticalStretch : public BreakingRule
    {
    public:
      CriticalStretch(const Limits &limits, const Materials::PlaneState state)
        : fracture_energy(limits.fracture_energy /
                          (limits.calibration > 0. ? limits.calibration : 1.))
        , stretch(limits.stretch)
        , state(state)
      {}

      double
      load_factor(const BondState &bond) const override
      {
        if (!(bond.extension > 0.))
          return never;
        const double critical = stretch > 0.
                                  ? stretch
                                  : critical_stretch(fracture_energy,
                                                     bond.youngs_modulus,
                                                     bond.horizon,
                                                     state);
        return critical * bond.length / bond.extension;
      }

    private:
      const double                fracture_energy, stretch;
      const Materials::PlaneState state;
    };

    template <int dim>
    class CriticalEnergy : public BreakingRule
    {
    public:
      CriticalEnergy(const double      fracture_energy,
                     const double      calibration,
                     const FamilyShape shape)
        : fracture_energy(fracture_energy)
        , calibration(calibration)
        , shape(shape)
      {}

      double
      load_factor(const BondState &bond) const override
      {
        // Halves of different sign may add up to less than nothing.
        if (!(bond.extension > 0.) || !(bond.energy > 0.))
          return never;
        const double kappa = calibration > 0.
                               ? calibration
                               : lattice_trapping(bond.horizon_ratio, shape);
        return std::sqrt(
          critical_energy_density<dim>(fracture_energy, bond.horizon) / kappa *
          bond.volume_product / bond.energy);
      }

    private:
      const double      fracture_energy, calibration;
      const FamilyShape shape;
    };
  } // namespace

  const std::vector<std::string> &
  criterion_names()
  {
    static const std::vector<std::string> names = {"critical stretch",
                                                   "critical energy",
                                                   "bond strain",
                                                   "equivalent strain",
                                                   "volumetric strain",
                                                   "maximum principal stress",
                                                   "tsai-hill",
                                                   "maximum stress"};
    return names;
  }

  bool
  sees_particles(const Criterion criterion)
  {
    return criterion != Criterion::critical_stretch &&
           criterion != Criterion::critical_energy;
  }

  bool
  uses_strengths(const Criterion criterion)
  {
    return criterion == Criterion::tsai_hill ||
           criterion == Criterion::maximum_stress;
  }

  template <int dim>
  std::unique_ptr<BreakingRule>
  make_breaking_rule(const Criterion             criterion,
                     const Limits               &limits,
                     const Materials::PlaneState state,
                     const FamilyShape           shape)
  {
    if (criterion == Criterion::critical_stretch)
      return std::make_unique<CriticalStretch>(limits, state);
    if (criterion == Criterion::critical_energy)
      return std::make_unique<CriticalEnergy<dim>>(limits.fracture_energy,
                                                   limits.calibration,
                                                   shape);
    if (uses_strengths(criterion))
      return make_strength_rule(criterion);
    return make_particle_rule(criterion, limits);
  }

  template std::unique_ptr<BreakingRule>
  make_breaking_rule<2>(Criterion,
                        const Limits &,
                        Materials::PlaneState,
                        FamilyShape);
  template std::unique_ptr<BreakingRule>
  make_breaking_rule<3>(Criterion,
                        const Limits &,
                        Materials::PlaneState,
                        FamilyShape);
} // namespace Perimorph::Damage
