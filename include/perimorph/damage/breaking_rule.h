#pragma once

#include <perimorph/damage/thresholds.h>

#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Damage
{
  /// One bond under load, as criteria see it.
  struct BondState
  {
    double length;         ///< |xi|
    double extension;      ///< e . eta, e = xi / |xi| [length]
    double energy;         ///< of both halves of the bond
    double volume_product; ///< V_i V_j
    double horizon;        ///< mean of both ends [length]
    double horizon_ratio;  ///< mean of horizon over spacing of both ends [-]
    double youngs_modulus; ///< mean of both ends
  };

  /// When a bond breaks: one rule, one bond, no memory.
  class BreakingRule
  {
  public:
    virtual ~BreakingRule() = default;

    /// Factor of the loads at which the bond breaks in a linear problem; 1 or
    /// less: it breaks now. Infinity for bonds that do not extend.
    virtual double
    load_factor(const BondState &bond) const = 0;
  };

  enum class Criterion
  {
    critical_stretch, ///< extension / length >= s_c
    critical_energy   ///< energy / (V_i V_j) >= w_0 / kappa
  };

  /// Names as in the parameter file, in the order of the enumeration.
  const std::vector<std::string> &
  criterion_names();

  /// @param fracture_energy  G_c > 0
  /// @param calibration  kappa > 0 by which the energy of a bond at break is
  ///        divided; 0: lattice_trapping() for the energy, 1 for the stretch
  template <int dim>
  std::unique_ptr<BreakingRule>
  make_breaking_rule(Criterion             criterion,
                     double                fracture_energy,
                     double                calibration,
                     Materials::PlaneState state,
                     FamilyShape           shape);
} // namespace Perimorph::Damage
