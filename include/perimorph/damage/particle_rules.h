#pragma once

#include <perimorph/damage/breaking_rule.h>

namespace Perimorph::Damage
{
  // Measures of criteria that see the particles at the ends of a bond. The
  // first sees the bond itself too. The others know no direction and, being
  // means over families, hardly see a cut: they find where damage starts, but
  // cracks by them are wide bands (numerics-damage.md, D4).

  /// |eta_d| / |xi| with eta_d = eta - w eta - tr(eps) / 3 xi, w the mean
  /// rotation. Source: Ren et al. (2017), as in Hashim (2021), section 2.4.5;
  /// the rotation is taken out so that rigid ones do not count.
  double
  deviatoric_bond_strain(const BondState &bond);

  /// sqrt(2/3 e : e), e the deviator. Source: Warren et al. (2009), as in
  /// Hashim (2021), Eq. (2.27).
  double
  equivalent_strain(const dealii::SymmetricTensor<2, 3> &strain);

  /// Factor of a stress at which it fails: by tension, sigma_1 = f_t, or by
  /// shear, (sigma_1 - sigma_3) / 2 = C cos phi - (sigma_1 + sigma_3) / 2 sin
  /// phi, tension positive. Infinity if neither ever happens. Source: Hashim
  /// (2021), Eqs. (2.34) and (2.35), whose mean stress has the sign of
  /// compression.
  double
  mohr_coulomb_load_factor(const dealii::SymmetricTensor<2, 3> &stress,
                           const Limits                        &limits);

  /// Rule of a criterion with sees_particles().
  std::unique_ptr<BreakingRule>
  make_particle_rule(Criterion criterion, const Limits &limits);
} // namespace Perimorph::Damage
