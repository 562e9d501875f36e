#pragma once

#include <perimorph/fracture/williams_field.h>

namespace Perimorph::Fracture
{
  /// A near-tip field of plane anisotropic elasticity in the axes of the tip
  /// (opening, sliding or point force).
  ///
  /// Complex potentials Phi_k(x + m_k y) of S. G. Lekhnitskii; modes I and II
  /// of G. C. Sih, P. C. Paris and G. R. Irwin, Int. J. Fract. Mech. 1 (1965)
  /// 189; point force: Phi_k' = A_k / z_k, which leaves all radial planes free
  /// of traction. Everything is a divided difference over the two roots,
  /// written without a difference of like numbers: equal roots are allowed and
  /// nearly equal ones cost no digits.
  /// @param x, y  place ahead of the tip and above the crack
  NearTipState<2>
  lekhnitskii_state(NearTipField                field,
                    const AnisotropicConstants &constants,
                    double                      x,
                    double                      y);
} // namespace Perimorph::Fracture
