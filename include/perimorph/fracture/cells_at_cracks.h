#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Fracture
{
  /// True if a crack passes between two nodes of the cell or between a Gauss
  /// point and a node.
  /// @param facets  work array
  template <int dim>
  bool
  is_touched(const Mesh::NodalMesh<dim> &mesh,
             unsigned int                cell,
             const Bonds::CrackSet<dim> &cracks,
             std::vector<unsigned int>  &facets);

  /// True if a node of the cell is in the region.
  /// @param region  one flag per node
  template <int dim>
  bool
  in_region(const Mesh::NodalMesh<dim> &mesh,
            unsigned int                cell,
            const std::vector<bool>    &region);

  /// Where a node is; one on a crack is moved by 1e-6 spacings to the side that
  /// its bonds are on (Bonds::CrackSet).
  template <int dim>
  dealii::Point<dim>
  place_beside(const Mesh::NodalMesh<dim> &mesh,
               const Bonds::CrackSet<dim> &cracks,
               unsigned int                node);
} // namespace Perimorph::Fracture
