#pragma once

#include <perimorph/mesh/nodal_mesh.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <vector>

namespace Perimorph::Fem
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Which nodes a rank owns and which it must see (one ghost layer as deep as
  /// the widest contribution), and the numbering it uses for both.
  ///
  /// Local nodes are the owned ones followed by the ghosts in rising order; the
  /// entry of node n and component c in a vector is dim * local(n) + c.
  template <int dim>
  class NodePartition
  {
  public:
    /// @param needed  nodes this rank reads or adds to, in any order
    NodePartition(const Mesh::NodalMesh<dim>      &mesh,
                  const std::vector<unsigned int> &needed,
                  MPI_Comm                         communicator);

    /// Vector of all degrees of freedom with room for the ghosts, zero.
    void
    initialize(Vector &vector) const;

    unsigned int
    local(const unsigned int node) const
    {
      return node >= owned_begin && node < owned_end
               ? node - owned_begin
               : n_owned() + ghosts.index_within_set(node);
    }

    unsigned int
    global(const unsigned int local_node) const
    {
      return local_node < n_owned()
               ? owned_begin + local_node
               : ghosts.nth_index_in_set(local_node - n_owned());
    }

    /// Whether it has room for these nodes of the mesh; of this rank.
    bool
    sees(const std::vector<unsigned int> &nodes) const;

    unsigned int
    n_owned() const
    {
      return owned_end - owned_begin;
    }

    unsigned int
    n_local() const
    {
      return n_owned() + ghosts.n_elements();
    }

    /// Reference position of a local node.
    const dealii::Point<dim> &
    position(const unsigned int local_node) const
    {
      return positions[local_node];
    }

    const dealii::IndexSet &
    owned_dofs() const
    {
      return owned_dof_set;
    }

    dealii::IndexSet
    relevant_dofs() const;

    MPI_Comm
    communicator() const
    {
      return mpi_communicator;
    }

  private:
    MPI_Comm                        mpi_communicator;
    unsigned int                    owned_begin;
    unsigned int                    owned_end;
    dealii::IndexSet                ghosts;
    dealii::IndexSet                owned_dof_set;
    std::vector<dealii::Point<dim>> positions;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  };
} // namespace Perimorph::Fem
