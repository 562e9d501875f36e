#pragma once

#include <perimorph/mesh/gmsh_reader.h>
#include <perimorph/mesh/nodal_mesh.h>

namespace Perimorph::Testing
{
  /// The same mesh as it would come from gmsh: boundaries named x-, x+, y-, y+,
  /// z-, z+ by their ids 0 to 5, one volume "body".
  template <int dim>
  Mesh::GmshMesh<dim>
  as_gmsh_mesh(const Mesh::NodalMesh<dim> &nodal)
  {
    static const char *const names[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    Mesh::GmshMesh<dim>      mesh;
    mesh.points = nodal.nodes;
    for (const auto &cell : nodal.cells)
      {
        mesh.volumes["body"].push_back(mesh.cells.size());
        mesh.cells.push_back(cell);
      }
    for (const auto &face : nodal.boundary_faces)
      mesh.surfaces[names[face.boundary]].push_back(face.nodes);
    return mesh;
  }
} // namespace Perimorph::Testing
