#pragma once

#include <perimorph/solvers/nodal_forces.h>

namespace Perimorph::Solvers
{
  /// Highest natural frequency omega [1 / time] of the free nodes at a state:
  /// the square root of the largest eigenvalue of M^-1 K, from the Lanczos
  /// process of the conjugate gradient method, which needs a tenth of the
  /// products of a power iteration for the same digits. Rounded to 6 digits, so
  /// that it does not depend on the number of ranks. 0: no node is free, or
  /// nothing is stiff.
  /// @param mass  owned entries; 0 where a node is held or hangs
  template <int dim>
  double
  highest_frequency(const NodalForces<dim> &forces,
                    const Vector           &mass,
                    const Vector           &displacement);
} // namespace Perimorph::Solvers
