#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/fracture/crack_tips.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Fracture
{
  /// Energetic segment criterion: probe cuts in several directions give the
  /// direction of the next advance, the energy that the cut itself releases
  /// gives the load (numerics-damage.md, section 2).

  /// Directions of the probes relative to the crack [radians], in rising order:
  /// five to 45 degrees, or nine to 80 degrees for the first kink.
  std::vector<double>
  probe_angles(bool first);

  /// Maximum of the parabola fitted to the released energies, clipped to the
  /// range of the angles. One parabola over all of them: the energy is a step
  /// function of the bonds cut, so that the best sample means nothing.
  double
  best_angle(const std::vector<double> &angles,
             const std::vector<double> &released);

  /// A tip and a direction as the facet of an advance.
  Bonds::CrackFacet<2>
  advance_facet(const CrackTip &tip,
                double          angle,
                double          length,
                unsigned int    step);

  /// Length of an advance that does not stop short of a free surface or of
  /// another crack: where one lies less than 2.2 spacings ahead of its end the
  /// advance goes on to a tenth of the length beyond it (numerics-cracks.md,
  /// F8).
  double
  closing_length(const Mesh::NodalMesh<2> &mesh,
                 const Bonds::CrackSet<2> &cracks,
                 const CrackTip           &tip,
                 double                    angle,
                 double                    length,
                 double                    spacing);
} // namespace Perimorph::Fracture
