#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/coupling/bond_set.h>

namespace Perimorph::Coupling
{
  /// Marks the cells whose part of the law goes with a bond: those with both of
  /// its ends; in motion those with either end. What elements have besides the
  /// bonds is not positive definite: where bonds that cross a cell from outside
  /// are gone, it feeds energy into a motion without end.
  template <int dim>
  void
  mark_cells_of_bond(const Mesh::NodalMesh<dim>        &mesh,
                     const std::array<unsigned int, 2> &bond,
                     bool                               in_motion,
                     std::vector<bool>                 &goes);

  /// Takes bonds that broke out of the bond-based model, and of those that
  /// soften the share that they lost.
  ///
  /// What elements have besides the bonds (tensors, springs, parts) goes as
  /// soon as one of its bonds (mark_cells_of_bond()) loses stiffness: left in,
  /// it would bridge the crack; taken out in step with the bonds it may feed
  /// energy in, as it is not positive definite (numerics-damage.md, section 5).
  template <int dim>
  void
  break_bonds(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::BrokenBonds   &broken,
              bool                        in_motion,
              BondCoupling<dim>          &coupling);
} // namespace Perimorph::Coupling
