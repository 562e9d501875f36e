#include <perimorph/fem/node_partition.h>

#include <algorithm>

namespace Perimorph::Fem
{
  template <int dim>
  NodePartition<dim>::NodePartition(const Mesh::NodalMesh<dim>      &mesh,
                                    const std::vector<unsigned int> &needed,
                                    const MPI_Comm communicator)
    : mpi_communicator(communicator)
    , owned_begin(mesh.owned_begin)
    , owned_end(mesh.owned_end)
    , ghosts(mesh.n_nodes())
    , owned_dof_set(dim * mesh.n_nodes())
  {
    std::vector<unsigned int> others;
    for (const unsigned int n : needed)
      if (!mesh.owns_node(n))
        others.push_back(n);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    ghosts.add_indices(others.begin(), others.end());
    ghosts.compress();

    owned_dof_set.add_range(dim * owned_begin, dim * owned_end);
    owned_dof_set.compress();
    dealii::IndexSet ghost_dofs(dim * mesh.n_nodes());
    for (const unsigned int n : others)
      ghost_dofs.add_range(dim * n, dim * (n + 1));
    ghost_dofs.compress();
    partitioner =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(owned_dof_set,
                                                                  ghost_dofs,
                                                                  communicator);

    for (unsigned int n = owned_begin; n < owned_end; ++n)
      positions.push_back(mesh.nodes[n]);
    for (const unsigned int n : others)
      positions.push_back(mesh.nodes[n]);
  }

  template <int dim>
  bool
  NodePartition<dim>::sees(const std::vector<unsigned int> &nodes) const
  {
    return std::all_of(nodes.begin(),
                       nodes.end(),
                       [this](const unsigned int n) {
                         return (n >= owned_begin && n < owned_end) ||
                                ghosts.is_element(n);
                       });
  }

  template <int dim>
  void
  NodePartition<dim>::initialize(Vector &vector) const
  {
    vector.reinit(partitioner);
  }

  template <int dim>
  dealii::IndexSet
  NodePartition<dim>::relevant_dofs() const
  {
    dealii::IndexSet set = owned_dof_set;
    set.add_indices(partitioner->ghost_indices());
    set.compress();
    return set;
  }

  template class NodePartition<2>;
  template class NodePartition<3>;
} // namespace Perimorph::Fem
