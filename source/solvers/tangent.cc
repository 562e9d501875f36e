#include <perimorph/solvers/tangent.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <map>
#include <set>

namespace Perimorph::Solvers
{
  template <int dim>
  TangentAssembler<dim>::TangentAssembler(
    const Fem::NodePartition<dim>           &partition,
    const dealii::AffineConstraints<double> &constraints)
    : partition(partition)
    , constraints(constraints)
  {}

  template <int dim>
  void
  TangentAssembler<dim>::make_pattern(const Terms &terms, Matrix &matrix) const
  {
    // The graph of nodes is a factor dim^2 smaller than that of the unknowns.
    const unsigned int n_nodes = partition.owned_dofs().size() / dim;
    dealii::IndexSet   owned(n_nodes), relevant(n_nodes);
    for (unsigned int n = 0; n < partition.n_local(); ++n)
      {
        relevant.add_index(partition.global(n));
        if (n < partition.n_owned())
          owned.add_index(partition.global(n));
      }
    owned.compress();
    relevant.compress();
    // Equations of dependent nodes go to the nodes they depend on.
    std::map<unsigned int, std::set<unsigned int>> masters;
    for (const auto &line : constraints.get_lines())
      for (const auto &entry : line.entries)
        masters[line.index / dim].insert(entry.first / dim);
    dealii::DynamicSparsityPattern graph(n_nodes, n_nodes, relevant);
    std::vector<unsigned int>      nodes;
    std::vector<dealii::types::global_dof_index> global;
    for (const auto *term : terms)
      for (unsigned int block = 0; block < term->n_blocks(); ++block)
        {
          term->block_nodes(block, nodes);
          global.resize(nodes.size());
          for (unsigned int k = 0; k < nodes.size(); ++k)
            global[k] = partition.global(nodes[k]);
          if (!masters.empty())
            for (const unsigned int node : nodes)
              {
                const auto found = masters.find(partition.global(node));
                if (found != masters.end())
                  global.insert(global.end(),
                                found->second.begin(),
                                found->second.end());
              }
          std::sort(global.begin(), global.end());
          global.erase(std::unique(global.begin(), global.end()), global.end());
          for (const auto row : global)
            graph.add_entries(row, global.begin(), global.end(), true);
        }
    for (const auto n : owned)
      graph.add(n, n);
    if (dealii::Utilities::MPI::n_mpi_processes(partition.communicator()) > 1)
      dealii::SparsityTools::distribute_sparsity_pattern(
        graph,
        owned,
        partition.communicator(),
        relevant);

    dealii::DynamicSparsityPattern               pattern(dim * n_nodes,
                                           dim * n_nodes,
                                           partition.owned_dofs());
    std::vector<dealii::types::global_dof_index> columns;
    for (const auto n : owned)
      {
        columns.clear();
        for (auto entry = graph.begin(n); entry != graph.end(n); ++entry)
          for (int d = 0; d < dim; ++d)
            columns.push_back(dim * entry->column() + d);
        for (int d = 0; d < dim; ++d)
          pattern.add_entries(dim * n + d,
                              columns.begin(),
                              columns.end(),
                              true);
      }
    matrix.reinit(partition.owned_dofs(),
                  partition.owned_dofs(),
                  pattern,
                  partition.communicator(),
                  false);
  }

  template <int dim>
  void
  TangentAssembler<dim>::assemble(
    const Terms                            &terms,
    const Vector                           &displacement,
    Matrix                                 &matrix,
    const std::function<void(std::size_t)> &progress) const
  {
    matrix = 0.;
    dealii::FullMatrix<double>                   local;
    std::vector<unsigned int>                    nodes;
    std::vector<dealii::types::global_dof_index> dofs;
    std::size_t                                  done = 0;
    for (const auto *term : terms)
      for (unsigned int block = 0; block < term->n_blocks(); ++block)
        {
          term->block_nodes(block, nodes);
          term->block_tangent(block, displacement, local);
          dofs.resize(dim * nodes.size());
          for (unsigned int k = 0; k < nodes.size(); ++k)
            for (int d = 0; d < dim; ++d)
              {
                dofs[dim * k + d] = dim * partition.global(nodes[k]) + d;
                if (!term->is_symmetric())
                  for (unsigned int c = 0; c < local.n(); ++c)
                    local(dim * k + d, c) *= term->row_weight(nodes[k]);
              }
          constraints.distribute_local_to_global(local, dofs, matrix);
          if (progress && ++done % 1000 == 0)
            progress(done);
        }
    matrix.compress(dealii::VectorOperation::add);

    // A constrained row that no block touched would be singular.
    for (const auto &line : constraints.get_lines())
      if (partition.owned_dofs().is_element(line.index) &&
          matrix.diag_element(line.index) == 0.)
        matrix.set(line.index, line.index, 1.);
    matrix.compress(dealii::VectorOperation::insert);
  }

  template <int dim>
  TangentOperator<dim>::TangentOperator(
    const Matrix                               &matrix,
    std::vector<const Fem::Contribution<dim> *> terms,
    const Vector                               &displacement,
    const dealii::AffineConstraints<double>    &constraints,
    const Matrix                               &preconditioner_matrix,
    const dealii::IndexSet                     &owned)
    : matrix(matrix)
    , matrix_free_terms(std::move(terms))
    , displacement(displacement)
    , input(displacement)
    , product(displacement)
  {
    for (const auto &line : constraints.get_lines())
      if (owned.is_element(line.index))
        {
          constrained.push_back(owned.index_within_set(line.index));
          constrained_diagonal.push_back(
            preconditioner_matrix.diag_element(line.index));
        }
  }

  template <int dim>
  void
  TangentOperator<dim>::vmult(Vector &destination, const Vector &source) const
  {
    matrix.vmult(destination, source);
    if (matrix_free_terms.empty())
      return;
    input.copy_locally_owned_data_from(source);
    for (const unsigned int entry : constrained)
      input.local_element(entry) = 0.;
    input.update_ghost_values();
    product.zero_out_ghost_values();
    product = 0.;
    for (const auto *term : matrix_free_terms)
      term->add_tangent_product(displacement, input, product);
    product.compress(dealii::VectorOperation::add);
    input.zero_out_ghost_values();
    for (unsigned int k = 0; k < destination.locally_owned_size(); ++k)
      destination.local_element(k) += product.local_element(k);
    for (unsigned int k = 0; k < constrained.size(); ++k)
      destination.local_element(constrained[k]) =
        constrained_diagonal[k] * source.local_element(constrained[k]);
  }

  template class TangentAssembler<2>;
  template class TangentAssembler<3>;
  template class TangentOperator<2>;
  template class TangentOperator<3>;
} // namespace Perimorph::Solvers
