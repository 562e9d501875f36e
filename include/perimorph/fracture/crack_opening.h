#pragma once

#include <perimorph/fracture/displacement_fit.h>
#include <perimorph/fracture/williams_field.h>

#include <array>
#include <vector>

namespace Perimorph::Fracture
{
  /// Stress intensity factors from the displacement between the crack faces.
  struct OpeningFactors
  {
    double K_I  = 0.; ///< [stress * length^(1/2)]
    double K_II = 0.;
    /// Places that had enough nodes on both sides; with fewer than three the
    /// factors are not numbers.
    unsigned int n_places = 0;
  };

  /// Distance from the tip at which the opening is first measured: 0.15
  /// lengths. In accelerated bodies K(r) bends over the length of waves; there
  /// 0.4 times the geometric mean of horizon and length if that is less, so
  /// that under refinement the places come closer, but in horizons move away
  /// from the tip, beside which the faces do not open as the root of r.
  /// @param length   of the crack, or the half of it with two tips
  /// @param horizon  at the tip; of elements alone two spacings
  double
  nearest_place(double length, double horizon, bool is_accelerated);

  /// (K_II, K_I) = sqrt(pi / (8 r)) L times the sliding and the opening at a
  /// distance r behind the tip, L the tensor of Barnett and Lothe
  /// (near_tip_constants.h; isotropic: E' / 2), at 16 places from the nearest
  /// to 4 times as far, extrapolated to the tip by a straight line
  /// (numerics.md, Q4). A check: less accurate than the domain integral. The
  /// crack must be straight there.
  /// @param fit           one that does not see past the crack (visible_fit)
  /// @param displacement  one vector per node of the mesh
  /// @param nearest       distance of the first place: nearest_place()
  /// @param path          corners of the crack from the tip backwards; none: a
  ///                      straight crack
  template <int dim>
  OpeningFactors
  factors_from_opening(const DisplacementFit<dim>                &fit,
                       const std::vector<dealii::Tensor<1, dim>> &displacement,
                       const TipFrame<dim>                       &tip,
                       double                                     nearest,
                       const NearTipConstants                    &constants,
                       const std::vector<dealii::Point<dim>>     &path = {});
} // namespace Perimorph::Fracture
