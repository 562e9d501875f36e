#include <perimorph/damage/particle_rules.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Damage
{
  namespace
  {
    constexpr double never = std::numeric_limits<double>::infinity();

    double
    factor(const double limit, const double measure)
    {
      return measure > 0. ? limit / measure : never;
    }

    class ParticleRule : public BreakingRule
    {
    public:
      ParticleRule(const Criterion criterion, const Limits &limits)
        : criterion(criterion)
        , limits(limits)
      {}

      double
      load_factor(const BondState &bond) const override
      {
        switch (criterion)
          {
            case Criterion::bond_strain:
              return bond.largest_dilatation >= 0.
                       ? factor(limits.bond_strain,
                                deviatoric_bond_strain(bond))
                       : never;
            case Criterion::equivalent_strain:
              return factor(limits.equivalent_strain,
                            equivalent_strain(bond.strain));
            case Criterion::volumetric_strain:
              // At small strain; Hashim's (2.29) adds products of strains.
              return factor(limits.volumetric_strain, trace(bond.strain));
            default:
              return mohr_coulomb_load_factor(bond.stress, limits);
          }
      }

    private:
      const Criterion criterion;
      const Limits    limits;
    };
  } // namespace

  double
  deviatoric_bond_strain(const BondState &bond)
  {
    return (bond.relative - trace(bond.strain) / 3. * bond.direction).norm();
  }

  double
  equivalent_strain(const dealii::SymmetricTensor<2, 3> &strain)
  {
    return std::sqrt(2. / 3.) * deviator(strain).norm();
  }

  double
  mohr_coulomb_load_factor(const dealii::SymmetricTensor<2, 3> &stress,
                           const Limits                        &limits)
  {
    const auto   principal = eigenvalues(stress); // largest first
    const double half      = 0.5 * (principal[0] - principal[2]);
    const double mean      = 0.5 * (principal[0] + principal[2]);
    const double angle     = limits.friction_angle * dealii::numbers::PI / 180.;
    double       result    = factor(limits.tensile_strength, principal[0]);
    if (limits.cohesion > 0.)
      result = std::min(result,
                        factor(limits.cohesion * std::cos(angle),
                               half + mean * std::sin(angle)));
    return result;
  }

  std::unique_ptr<BreakingRule>
  make_particle_rule(const Criterion criterion, const Limits &limits)
  {
    return std::make_unique<ParticleRule>(criterion, limits);
  }
} // namespace Perimorph::Damage
