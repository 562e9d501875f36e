#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/mesh/distributed_mesh.h>

#include <deal.II/base/index_set.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace Perimorph::Mesh
{
  template <int dim>
  DistributedMesh<dim>::DistributedMesh(const GmshMesh<dim> &gmsh_mesh,
                                        const MPI_Comm       communicator)
    : mpi_communicator(communicator)
    , volumes(gmsh_mesh.volumes)
  {
    number_nodes(gmsh_mesh);
    nodal_mesh.compute_derived();
    find_boundary(gmsh_mesh);
    find_pieces();
  }

  template <int dim>
  DistributedMesh<dim>::~DistributedMesh() = default;

  template <int dim>
  void
  DistributedMesh<dim>::number_nodes(const GmshMesh<dim> &gmsh_mesh)
  {
    std::vector<dealii::CellData<dim>> cells(gmsh_mesh.cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      cells[c].vertices.assign(gmsh_mesh.cells[c].begin(),
                               gmsh_mesh.cells[c].end());
    dealii::GridTools::consistently_order_cells(cells);

    using Shared = dealii::parallel::shared::Triangulation<dim>;
    Shared triangulation(mpi_communicator,
                         dealii::Triangulation<dim>::none,
                         false,
                         Shared::partition_metis);
    triangulation.create_triangulation(gmsh_mesh.points,
                                       cells,
                                       dealii::SubCellData());

    const dealii::FE_Q<dim> element(1);
    dealii::DoFHandler<dim> dof_handler(triangulation);
    dof_handler.distribute_dofs(element);

    node_of_point.resize(gmsh_mesh.points.size());
    nodal_mesh.nodes.resize(gmsh_mesh.points.size());
    nodal_mesh.cells.resize(cells.size());
    nodal_mesh.cell_owner.resize(cells.size());
    nodal_mesh.cell_material.assign(cells.size(), 0);
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        const unsigned int c     = cell->active_cell_index();
        nodal_mesh.cell_owner[c] = cell->subdomain_id();
        for (unsigned int v = 0; v < NodalMesh<dim>::nodes_per_cell; ++v)
          {
            const unsigned int node              = cell->vertex_dof_index(v, 0);
            nodal_mesh.cells[c][v]               = node;
            nodal_mesh.nodes[node]               = cell->vertex(v);
            node_of_point[cell->vertex_index(v)] = node;
          }
      }
    for (const auto &[point, parents] : gmsh_mesh.hanging)
      for (const auto &[parent, weight] : parents)
        nodal_mesh.hanging[node_of_point[point]].emplace_back(
          node_of_point[parent],
          weight);
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(mpi_communicator);
    const auto owned_counts = dealii::Utilities::MPI::all_gather(
      mpi_communicator,
      dof_handler.locally_owned_dofs().n_elements());
    nodal_mesh.rank = rank;
    nodal_mesh.owned_begin =
      std::accumulate(owned_counts.begin(), owned_counts.begin() + rank, 0u);
    nodal_mesh.owned_end = nodal_mesh.owned_begin + owned_counts[rank];
  }

  template <int dim>
  void
  DistributedMesh<dim>::find_boundary(const GmshMesh<dim> &gmsh_mesh)
  {
    using Face                          = typename GmshMesh<dim>::Face;
    constexpr unsigned int n_face_nodes = 1u << (dim - 1);
    struct CellFace
    {
      Face         sorted;
      unsigned int cell, face;
    };
    // Face 2 d + side of a cell has the vertices whose bit d equals side; they
    // come out in lexicographic order of the remaining directions.
    const auto nodes_of = [&](const unsigned int c, const unsigned int f) {
      Face         nodes;
      unsigned int k = 0;
      for (unsigned int v = 0; v < NodalMesh<dim>::nodes_per_cell; ++v)
        if (((v >> (f / 2)) & 1u) == f % 2)
          nodes[k++] = nodal_mesh.cells[c][v];
      return nodes;
    };
    std::vector<CellFace> faces;
    faces.reserve(nodal_mesh.n_cells() * 2 * dim);
    for (unsigned int c = 0; c < nodal_mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < 2 * dim; ++f)
        {
          auto nodes = nodes_of(c, f);
          std::sort(nodes.begin(), nodes.end());
          faces.push_back({nodes, c, f});
        }
    const auto before = [](const CellFace &a, const CellFace &b) {
      return a.sorted < b.sorted;
    };
    std::sort(faces.begin(), faces.end(), before);

    std::set<Face> hanging;
    const auto     sorted_nodes = [this](Face face) {
      for (auto &point : face)
        point = node_of_point[point];
      std::sort(face.begin(), face.end());
      return face;
    };
    for (const auto &face : gmsh_mesh.hanging_faces)
      hanging.insert(sorted_nodes(face));

    // Surface faces occur once. Index by the sorted nodes to find groups.
    std::map<Face, unsigned int> surface;
    for (std::size_t k = 0; k < faces.size(); ++k)
      {
        const bool shared =
          (k > 0 && faces[k - 1].sorted == faces[k].sorted) ||
          (k + 1 < faces.size() && faces[k + 1].sorted == faces[k].sorted);
        if (shared || hanging.count(faces[k].sorted) > 0)
          continue;
        surface[faces[k].sorted] = nodal_mesh.boundary_faces.size();
        nodal_mesh.boundary_faces.push_back(
          {faces[k].cell,
           faces[k].face,
           dealii::numbers::invalid_unsigned_int,
           nodes_of(faces[k].cell, faces[k].face)});
      }
    static_assert(n_face_nodes == std::tuple_size<Face>::value, "");

    unsigned int id = 0;
    for (const auto &group : gmsh_mesh.surfaces)
      {
        auto &list = boundaries[group.first];
        for (const Face &face : group.second)
          {
            const auto found = surface.find(sorted_nodes(face));
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
