#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/fracture/crack_tips.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Fracture
{
  /// Energetic segment criterion (numerics-damage.md, section 2): the energy
  /// that the cut itself releases gives the load. The direction of the next
  /// advance is that of the largest hoop stress, from the stress intensity
  /// factors; where there is no room for a domain integral, probe cuts in
  /// several directions give it.

  /// Direction of the largest hoop stress relative to the crack [radians]:
  /// K_I sin(t) + K_II (3 cos(t) - 1) = 0 (Erdogan and Sih 1963), clipped to
  /// 80 degrees (a closed crack under shear would ask for more than 70.5).
  double
  hoop_angle(double K_I, double K_II);

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

  /// Distance along a ray to the surface; infinite if it stays inside.
  /// @param along  unit vector
  double
  surface_ahead(const Mesh::NodalMesh<2>   &mesh,
                const dealii::Point<2>     &origin,
                const dealii::Tensor<1, 2> &along);

  /// Distance from a tip, in a direction, to the surface or another crack;
  /// infinite without.
  double
  distance_ahead(const Mesh::NodalMesh<2> &mesh,
                 const Bonds::CrackSet<2> &cracks,
                 const CrackTip           &tip,
                 double                    angle);

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
