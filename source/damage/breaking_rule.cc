#include <perimorph/damage/breaking_rule.h>

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
      CriticalStretch(const double                fracture_energy,
                      const double                calibration,
                      const Materials::PlaneState state)
        : fracture_energy(fracture_energy /
                          (calibration > 0. ? calibration : 1.))
        , state(state)
      {}

      double
      load_factor(const BondState &bond) const override
      {
        return bond.extension > 0. ? critical_stretch(fracture_energy,
                                                      bond.youngs_modulus,
                                                      bond.horizon,
                                                      state) *
                                       bond.length / bond.extension
                                   : never;
      }

    private:
      const double                fracture_energy;
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
                                                   "critical energy"};
    return names;
  }

  template <int dim>
  std::unique_ptr<BreakingRule>
  make_breaking_rule(const Criterion             criterion,
                     const double                fracture_energy,
                     const double                calibration,
                     const Materials::PlaneState state,
                     const FamilyShape           shape)
  {
    if (criterion == Criterion::critical_stretch)
      return std::make_unique<CriticalStretch>(fracture_energy,
                                               calibration,
                                               state);
    return std::make_unique<CriticalEnergy<dim>>(fracture_energy,
                                                 calibration,
                                                 shape);
  }

  template std::unique_ptr<BreakingRule>
  make_breaking_rule<2>(Criterion,
                        double,
                        double,
                        Materials::PlaneState,
                        FamilyShape);
  template std::unique_ptr<BreakingRule>
  make_breaking_rule<3>(Criterion,
                        double,
                        double,
                        Materials::PlaneState,
                        FamilyShape);
} // namespace Perimorph::Damage
