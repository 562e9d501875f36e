#pragma once

#include <perimorph/fracture/crack_tips.h>
#include <perimorph/fracture/nucleated_crack.h>

#include <vector>

namespace Perimorph::Fracture
{
  /// How far bonds that broke have carried cracks from each of their tips: the
  /// way along the broken bonds to the farthest of them [length], the shortest
  /// one, in links of one horizon at most. A bond counts for the tip with the
  /// shortest way to it; one with no way to a tip counts for none, nor does one
  /// beside the crack behind the tip. Of branches the longest counts.
  ///
  /// Bonds in one box of a quarter of a horizon count as one, in their mean.
  /// @param tips    of the cracks at the start
  /// @param places  middles of the bonds without any stiffness left
  /// @return        one entry per tip, 0 for one that has not moved
  std::vector<double>
  crack_advances(const std::vector<CrackTip>    &tips,
                 const std::vector<BrokenPlace> &places);

  /// Advances of all tips at the last output times of a motion.
  struct AdvanceHistory
  {
    /// Output times whose advances are kept: ten intervals.
    static constexpr std::size_t n_times = 11;

    /// The time, then the advance of each tip.
    std::vector<std::vector<double>> rows;

    /// Keeps a row; one of the time of the last row replaces it.
    void
    add(double time, const std::vector<double> &advances);

    /// Slope of the line of least squares through the advances of a tip over
    /// time [length / time].
    /// @pre at least two rows
    double
    speed(unsigned int tip) const;
  };
} // namespace Perimorph::Fracture
