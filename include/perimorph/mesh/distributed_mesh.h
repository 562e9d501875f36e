#pragma once

#include <perimorph/mesh/gmsh_reader.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Mesh
{
  /// The mesh of a run: its partition by METIS, the node numbering, the plain
  /// arrays every other room reads, and the named groups.
  ///
  /// Every rank knows the whole mesh (design.md section 5); that is hidden
  /// here.
  template <int dim>
  class DistributedMesh
  {
  public:
    /// Distributes the cells over the ranks and numbers the nodes.
    DistributedMesh(const GmshMesh<dim> &gmsh_mesh, MPI_Comm communicator);

    const NodalMesh<dim> &
    nodal() const
    {
      return nodal_mesh;
    }

    /// For the owner of per-cell data that has to be filled later (materials).
    NodalMesh<dim> &
    nodal()
    {
      return nodal_mesh;
    }

    /// Faces of the body's surface in a named group (indices into
    /// NodalMesh::boundary_faces).
    /// @throws Base::InputError   with the nearest name; or if the group has no
    ///                            face on the surface of the body
    const std::vector<unsigned int> &
    boundary(const std::string &name, const std::string &used_by) const;

    /// Nodes on a named boundary, sorted by coordinates' first appearance.
    std::vector<unsigned int>
    boundary_nodes(const std::string &name, const std::string &used_by) const;

    /// Cells of a named volume.
    const std::vector<unsigned int> &
    volume(const std::string &name, const std::string &used_by) const;

    std::vector<std::string>
    boundary_names() const;

    std::vector<std::string>
    volume_names() const;

    /// Node of each point of the mesh file: a numbering that does not depend on
    /// the number of ranks.
    const std::vector<unsigned int> &
    node_of_file_point() const
    {
      return node_of_point;
    }

    /// Piece of the body (connected through nodes) each node belongs to.
    const std::vector<unsigned int> &
    pieces() const
    {
      return piece_of_node;
    }

    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }

  private:
    struct CellFace
    {
      typename GmshMesh<dim>::Face points; ///< in rising order
      unsigned int                 cell, face;
    };

    /// @param faces  of all cells, sorted by their points
    void
    number_nodes(const GmshMesh<dim>         &gmsh_mesh,
                 const std::vector<CellFace> &faces);
    void
    find_boundary(const GmshMesh<dim>         &gmsh_mesh,
                  const std::vector<CellFace> &faces);
    void
    find_pieces();

    MPI_Comm       mpi_communicator;
    NodalMesh<dim> nodal_mesh;

    std::vector<unsigned int>                        node_of_point;
    std::map<std::string, std::vector<unsigned int>> boundaries;
    std::map<std::string, std::vector<unsigned int>> volumes;
    std::vector<unsigned int>                        piece_of_node;
  };
} // namespace Perimorph::Mesh
