#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/mesh/distributed_mesh.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace Perimorph::Mesh
{
  namespace
  {
    /// Face 2 d + side of a cell has the vertices whose bit d equals side; they
    /// come out in lexicographic order of the remaining directions.
    template <int dim>
    typename GmshMesh<dim>::Face
    corners_of_face(const std::array<unsigned int, (1u << dim)> &cell,
                    const unsigned int                           face)
    {
      typename GmshMesh<dim>::Face corners;
      unsigned int                 k = 0;
      for (unsigned int v = 0; v < cell.size(); ++v)
        if (((v >> (face / 2)) & 1u) == face % 2)
          corners[k++] = cell[v];
      return corners;
    }

    template <typename Face>
    Face
    sorted(Face face)
    {
      std::sort(face.begin(), face.end());
      return face;
    }

    /// Ranks of the cells: parts of the graph of cells that share a face.
    template <typename CellFaces>
    std::vector<unsigned int>
    partition(const unsigned int n_cells,
              const CellFaces   &faces,
              const unsigned int n_ranks)
    {
      std::vector<unsigned int> rank(n_cells, 0);
      if (n_ranks == 1)
        return rank;
      dealii::DynamicSparsityPattern graph(n_cells, n_cells);
      for (std::size_t k = 1; k < faces.size(); ++k)
        if (faces[k - 1].points == faces[k].points)
          {
            graph.add(faces[k - 1].cell, faces[k].cell);
            graph.add(faces[k].cell, faces[k - 1].cell);
          }
      for (unsigned int c = 0; c < n_cells; ++c)
        graph.add(c, c);
      dealii::SparsityPattern compressed;
      compressed.copy_from(graph);
      dealii::SparsityTools::partition(compressed, n_ranks, rank);
      return rank;
    }
  } // namespace

  template <int dim>
  DistributedMesh<dim>::DistributedMesh(const GmshMesh<dim> &gmsh_mesh,
                                        const MPI_Comm       communicator)
    : mpi_communicator(communicator)
    , volumes(gmsh_mesh.volumes)
  {
    std::vector<CellFace> faces;
    faces.reserve(gmsh_mesh.cells.size() * 2 * dim);
    for (unsigned int c = 0; c < gmsh_mesh.cells.size(); ++c)
      for (unsigned int f = 0; f < 2 * dim; ++f)
        faces.push_back(
          {sorted(corners_of_face<dim>(gmsh_mesh.cells[c], f)), c, f});
    std::sort(
      faces.begin(),
      faces.end(),
      [](const CellFace &a, const CellFace &b) { return a.points < b.points; });
    number_nodes(gmsh_mesh, faces);
    nodal_mesh.compute_derived();
    find_boundary(gmsh_mesh, faces);
    find_pieces();
  }

  template <int dim>
  void
  DistributedMesh<dim>::number_nodes(const GmshMesh<dim>         &gmsh_mesh,
                                     const std::vector<CellFace> &faces)
  {
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(mpi_communicator);
    const auto &cells     = gmsh_mesh.cells;
    nodal_mesh.cell_owner = partition(cells.size(), faces, n_ranks);
    nodal_mesh.cell_material.assign(cells.size(), 0);

    // A node belongs to the first of the ranks around it. The nodes of a rank
    // are numbered as its cells meet them.
    std::vector<unsigned int> owner(gmsh_mesh.points.size(), n_ranks);
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (const unsigned int point : cells[c])
        owner[point] = std::min(owner[point], nodal_mesh.cell_owner[c]);
    std::vector<unsigned int> begin(n_ranks + 2, 0);
    for (const unsigned int rank : owner)
      ++begin[rank + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
    auto                   next = begin;
    node_of_point.assign(gmsh_mesh.points.size(), none);
    nodal_mesh.nodes.resize(gmsh_mesh.points.size());
    nodal_mesh.cells.resize(cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int v = 0; v < NodalMesh<dim>::nodes_per_cell; ++v)
        {
          const unsigned int point = cells[c][v];
          auto              &node  = node_of_point[point];
          if (node == none)
            {
              node                   = next[owner[point]]++;
              nodal_mesh.nodes[node] = gmsh_mesh.points[point];
            }
          nodal_mesh.cells[c][v] = node;
        }
    for (const auto &[point, parents] : gmsh_mesh.hanging)
      for (const auto &[parent, weight] : parents)
        nodal_mesh.hanging[node_of_point[point]].emplace_back(
          node_of_point[parent],
          weight);
    nodal_mesh.rank =
      dealii::Utilities::MPI::this_mpi_process(mpi_communicator);
    nodal_mesh.owned_begin = begin[nodal_mesh.rank];
    nodal_mesh.owned_end   = begin[nodal_mesh.rank + 1];
  }

  template <int dim>
  void
  DistributedMesh<dim>::find_boundary(const GmshMesh<dim>         &gmsh_mesh,
                                      const std::vector<CellFace> &faces)
  {
    using Face = typename GmshMesh<dim>::Face;
    std::set<Face> hanging;
    for (const auto &face : gmsh_mesh.hanging_faces)
      hanging.insert(sorted(face));

    // Surface faces occur once. Index by the sorted points to find groups.
    std::map<Face, unsigned int> surface;
    for (std::size_t k = 0; k < faces.size(); ++k)
      {
        const auto &[points, cell, face] = faces[k];
        const bool shared =
          (k > 0 && faces[k - 1].points == points) ||
          (k + 1 < faces.size() && faces[k + 1].points == points);
        if (shared || hanging.count(points) > 0)
          continue;
        surface[points] = nodal_mesh.boundary_faces.size();
        nodal_mesh.boundary_faces.push_back(
          {cell,
           face,
           dealii::numbers::invalid_unsigned_int,
           corners_of_face<dim>(nodal_mesh.cells[cell], face)});
      }

    unsigned int id = 0;
    for (const auto &group : gmsh_mesh.surfaces)
      {
        auto &list = boundaries[group.first];
        for (const Face &face : group.second)
          {
            const auto found = surface.find(sorted(face));
            if (found == surface.end())
              continue; // interior surface: an interface or a crack
            list.push_back(found->second);
            auto &boundary = nodal_mesh.boundary_faces[found->second].boundary;
            boundary       = std::min(boundary, id);
          }
        ++id;
      }
  }

  template <int dim>
  void
  DistributedMesh<dim>::find_pieces()
  {
    // Union of the nodes of each cell, with path halving.
    std::vector<unsigned int> parent(nodal_mesh.n_nodes());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&parent](unsigned int n) {
      while (parent[n] != n)
        n = parent[n] = parent[parent[n]];
      return n;
    };
    for (const auto &cell : nodal_mesh.cells)
      for (unsigned int v = 1; v < cell.size(); ++v)
        parent[root(cell[v])] = root(cell[0]);
    std::map<unsigned int, unsigned int> number;
    piece_of_node.resize(nodal_mesh.n_nodes());
    for (const auto &cell : nodal_mesh.cells)
      for (const unsigned int n : cell)
        piece_of_node[n] = number.emplace(root(n), number.size()).first->second;
  }

  template <int dim>
  const std::vector<unsigned int> &
  DistributedMesh<dim>::boundary(const std::string &name,
                                 const std::string &used_by) const
  {
    const auto found = boundaries.find(name);
    if (found == boundaries.end())
      throw Base::InputError(used_by + ": boundary '" + name +
                             "' is not in the mesh" +
                             Base::did_you_mean(name, boundary_names()));
    if (found->second.empty())
      throw Base::InputError(
        used_by + ": physical group '" + name +
        "' has no face on the surface of the body; allowed: " +
        Base::join_names(boundary_names()));
    return found->second;
  }

  template <int dim>
  std::vector<unsigned int>
  DistributedMesh<dim>::boundary_nodes(const std::string &name,
                                       const std::string &used_by) const
  {
    std::vector<unsigned int> nodes;
    for (const unsigned int f : boundary(name, used_by))
      for (const unsigned int n : nodal_mesh.boundary_faces[f].nodes)
        nodes.push_back(n);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  template <int dim>
  const std::vector<unsigned int> &
  DistributedMesh<dim>::volume(const std::string &name,
                               const std::string &used_by) const
  {
    const auto found = volumes.find(name);
    if (found == volumes.end() || found->second.empty())
      throw Base::InputError(used_by + ": volume '" + name +
                             "' is not in the mesh" +
                             Base::did_you_mean(name, volume_names()));
    return found->second;
  }

  template <int dim>
  std::vector<std::string>
  DistributedMesh<dim>::boundary_names() const
  {
    std::vector<std::string> names;
    for (const auto &entry : boundaries)
      names.push_back(entry.first);
    return names;
  }

  template <int dim>
  std::vector<std::string>
  DistributedMesh<dim>::volume_names() const
  {
    std::vector<std::string> names;
    for (const auto &entry : volumes)
      names.push_back(entry.first);
    return names;
  }

  template class DistributedMesh<2>;
  template class DistributedMesh<3>;
} // namespace Perimorph::Mesh
