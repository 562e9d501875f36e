#pragma once

#include <perimorph/mesh/hanging_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Perimorph::Mesh
{
  /// What a gmsh file holds, before any distribution. Groups are physical
  /// groups; one without a name is called by its number.
  template <int dim>
  struct GmshMesh
  {
    using Cell = std::array<unsigned int, (1u << dim)>;
    using Face = std::array<unsigned int, (1u << (dim - 1))>;

    std::vector<dealii::Point<dim>> points;
    std::vector<Cell>               cells; ///< lexicographic (x fastest)
    /// Cells of each named volume (surface in 2D).
    std::map<std::string, std::vector<unsigned int>> volumes;
    /// Faces of each named boundary or interior surface, by their points.
    std::map<std::string, std::vector<Face>> surfaces;
    /// Lines (2D) and triangles (3D) of named surfaces that no cell has, by
    /// their places: drawn, not meshed.
    std::map<std::string, std::vector<std::array<dealii::Point<dim>, dim>>>
      drawn;
    /// What local refinement leaves; none in a file.
    HangingPoints hanging;
    /// Faces between cells of different size, of both sides.
    std::vector<Face> hanging_faces;
  };

  /// Reads a gmsh mesh (.msh of any version) or meshes a geometry (.geo) with
  /// the gmsh library on rank 0 and sends the result to all ranks.
  ///
  /// @param file  path of the mesh or geometry
  /// @param geometry_parameters  values for names in DefineConstant of a .geo
  /// @throws Base::InputError on all ranks: file missing or unreadable, wrong
  ///         dimension, triangles or tetrahedra, curved elements, inverted
  ///         cells
  template <int dim>
  GmshMesh<dim>
  read_gmsh(const std::string                   &file,
            const std::map<std::string, double> &geometry_parameters,
            MPI_Comm                             communicator);
} // namespace Perimorph::Mesh
