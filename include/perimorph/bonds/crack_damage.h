#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Bonds
{
  /// Damage of each particle: the volume in its horizon that cracks hide from
  /// it, or to which its bonds are broken, over the volume in its horizon [-].
  /// Bonds that soften count with the share of the stiffness they lost.
  /// @param alpha  particles are where it is positive
  /// @param[out] n_hidden  pairs of particles and nodes that cracks or broken
  ///                       bonds separate
  template <int dim>
  std::vector<double>
  crack_damage(const Mesh::NodalMesh<dim> &mesh,
               const std::vector<double>  &alpha,
               const std::vector<double>  &horizon,
               const CrackSet<dim>        &cracks,
               std::size_t                &n_hidden,
               const BrokenBonds          &broken = {});
} // namespace Perimorph::Bonds
