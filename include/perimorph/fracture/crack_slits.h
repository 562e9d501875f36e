#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Fracture
{
  /// Cracks of finite elements alone: they cut nothing, but lie on a slit of
  /// the mesh, a pair of boundary faces with nodes of their own in one place.
  /// Only at the tips the faces share a node.

  /// Faces of the surface that lie on a crack with their corners and their
  /// middle, within 1e-4 of their length; one flag per boundary face.
  template <int dim>
  std::vector<bool>
  faces_on_cracks(const Mesh::NodalMesh<dim> &mesh,
                  const Bonds::CrackSet<dim> &cracks);

  /// The boundary faces that do not lie on a crack.
  template <int dim>
  std::vector<Mesh::BoundaryFace<dim>>
  outer_surface(const Mesh::NodalMesh<dim> &mesh,
                const Bonds::CrackSet<dim> &cracks);

  /// Nodes that hold the two sides of a slit together, in rising order: they
  /// belong to faces on both. A slit has them at its tips or fronts only.
  template <int dim>
  std::vector<unsigned int>
  nodes_of_both_sides(const Mesh::NodalMesh<dim> &mesh,
                      const Bonds::CrackSet<dim> &cracks);

  /// Where each node is seen from past the cracks: the node, but on a slit
  /// 1e-3 spacings inside of its own cells, and at a tip as far ahead of it.
  template <int dim>
  std::vector<dealii::Point<dim>>
  view_points(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::CrackSet<dim> &cracks);
} // namespace Perimorph::Fracture
