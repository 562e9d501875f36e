#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Bonds
{
  /// Damage of each particle: the volume in its horizon that cracks hide from
  /// it over the volume in its horizon [-].
  /// @param alpha  particles are where it is positive
  /// @param[out] n_hidden  pairs of particles and nodes that cracks separate
  template <int dim>
  std::vector<double>
  crack_damage(const Mesh::NodalMesh<dim> &mesh,
               const std::vector<double>  &alpha,
               const std::vector<double>  &horizon,
               const CrackSet<dim>        &cracks,
               std::size_t                &n_hidden);
} // namespace Perimorph::Bonds
