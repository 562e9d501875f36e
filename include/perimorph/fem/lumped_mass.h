#pragma once

#include <perimorph/fem/node_partition.h>

namespace Perimorph::Fem
{
  /// Mass of every node of the mesh, the integral of density times shape
  /// function: a particle is a node, so that both methods have the same.
  /// Hanging nodes have none, their parents have it.
  /// @param density  of each material, index = NodalMesh::cell_material
  template <int dim>
  std::vector<double>
  lumped_mass(const Mesh::NodalMesh<dim> &mesh,
              const std::vector<double>  &density);
} // namespace Perimorph::Fem
