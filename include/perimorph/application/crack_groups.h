#pragma once

#include <perimorph/mesh/gmsh_reader.h>
#include <perimorph/parameters/polylines.h>

#include <vector>

namespace Perimorph::Application
{
  /// Gives pre-cracks that name a group of the mesh their places: lines in 2D,
  /// joined where two meet and straight where they are, triangles in 3D. The
  /// group may lie on faces of cells or be drawn through them. A group of
  /// several lines becomes as many cracks, NAME_1, NAME_2...
  ///
  /// @throws Base::InputError  no such group
  template <int dim>
  std::vector<Parameters::Polyline>
  read_crack_groups(const Mesh::GmshMesh<dim>               &mesh,
                    const std::vector<Parameters::Polyline> &cracks);
} // namespace Perimorph::Application
