#pragma once

#include <perimorph/damage/breaking_rule.h>

namespace Perimorph::Damage
{
  /// Linear softening of a bond, from its largest force at s_0 to nothing at
  /// s_f = r s_0, in teeth that each take the same share of the stiffness:
  ///   f_l = 1 - l / N,  s_l = s_c q r / ((f_l + f_{l+1}) / 2 (r - 1) + 1)
  /// with q so that all teeth together dissipate k (s_c |xi|)^2 / 2, the energy
  /// of a bond that breaks at s_c at once (numerics-damage.md, section 3).
  class SawTooth
  {
  public:
    /// @param n_teeth  N; 1: the bond breaks at s_c
    explicit SawTooth(unsigned int n_teeth);

    /// Teeth around the softening
    ///   T(s) = (1 - tanh(beta (2 s - s_min - s_cr) / (s_cr - s_min))) / 2
    /// between s_min and s_cr: tooth l is lost where T is the mean of the
    /// shares before and after. Source: Hashim (2021), Eq. (6.1).
    /// @param start      s_min / s_cr, less than 1
    /// @param steepness  beta
    SawTooth(unsigned int n_teeth, double start, double steepness);

    /// s_l / s_c at which a bond that has lost l teeth loses the next.
    double
    stretch(unsigned int n_lost) const
    {
      return stretches[n_lost];
    }

  private:
    std::vector<double> stretches;
  };

  /// Critical stretch of the bonds of the bond-based model, whose lattice sums
  /// are exact (critical_stretch_of_lattice()), with softening.
  /// @param limits  stretch, or fracture_energy and calibration
  template <int dim>
  std::unique_ptr<BreakingRule>
  make_saw_tooth_rule(const Limits         &limits,
                      unsigned int          n_teeth,
                      Materials::PlaneState state);
} // namespace Perimorph::Damage
