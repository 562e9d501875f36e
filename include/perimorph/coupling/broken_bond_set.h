#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/coupling/bond_set.h>

namespace Perimorph::Coupling
{
  /// Takes bonds that broke out of the bond-based model, and of those that
  /// soften the share that they lost.
  ///
  /// What elements have besides the bonds (tensors, springs, parts) goes as
  /// soon as one bond between two of their nodes loses stiffness: left in, it
  /// would bridge the crack; taken out in step with the bonds it may feed
  /// energy in, as it is not positive definite (numerics-damage.md, section 5).
  template <int dim>
  void
  break_bonds(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::BrokenBonds   &broken,
              BondCoupling<dim>          &coupling);
} // namespace Perimorph::Coupling
