#include <perimorph/solvers/tangent.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <map>
#include <set>

namespace Perimorph::Solvers
{
  namespace
  {
    template <int dim>
    dealii::IndexSet
    relevant_nodes(const Fem::NodePartition<dim> &partition)
    {
      dealii::IndexSet relevant(partition.owned_dofs().size() / dim);
      for (unsigned int n = 0; n < partition.n_local(); ++n)
        relevant.add_index(partition.global(n));
      relevant.compress();
      return relevant;
    }

    /// The graph of unknowns from that of nodes, which is a factor dim^2
    /// smaller.
    template <int dim>
    dealii::DynamicSparsityPattern
    unknowns_of(const dealii::DynamicSparsityPattern &graph,
                const dealii::IndexSet               &nodes,
                const dealii::IndexSet               &rows)
    {
      dealii::DynamicSparsityPattern               pattern(dim * graph.n_rows(),
                                             dim * graph.n_rows(),
                                             rows);
      std::vector<dealii::types::global_dof_index> columns;
      for (const auto n : nodes)
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
      return pattern;
    }

    /// Calls an action for the positions in a block of nodes that are coupled
    /// with each other.
    template <typename Action>
    void
    for_coupled(const bool is_star, const unsigned int n, const Action &action)
    {
      std::vector<unsigned int> positions;
      if (is_star && n > 1)
        for (unsigned int k = 1; k < n; ++k)
          {
            positions = {0, k};
            action(positions);
          }
      else
        {
          for (unsigned int k = 0; k < n; ++k)
            positions.push_back(k);
          action(positions);
        }
    }
  } // namespace

  template <int dim>
  TangentAssembler<dim>::TangentAssembler(
    const Fem::NodePartition<dim>           &partition,
    const dealii::AffineConstraints<double> &constraints)
    : partition(partition)
    , constraints(constraints)
  {}

  template <int dim>
  dealii::DynamicSparsityPattern
  TangentAssembler<dim>::node_graph(const Terms &terms) const
  {
    const unsigned int n_nodes  = partition.owned_dofs().size() / dim;
    const auto         relevant = relevant_nodes(partition);
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
          for_coupled(
            term->has_stars(),
            nodes.size(),
            [&](const auto &coupled) {
              global.clear();
              for (const unsigned int k : coupled)
                {
                  global.push_back(partition.global(nodes[k]));
                  if (masters.empty())
                    continue;
                  const auto found = masters.find(global.back());
                  if (found != masters.end())
                    global.insert(global.end(),
                                  found->second.begin(),
                                  found->second.end());
                }
              std::sort(global.begin(), global.end());
              global.erase(std::unique(global.begin(), global.end()),
                           global.end());
              for (const auto row : global)
                graph.add_entries(row, global.begin(), global.end(), true);
            });
        }
    // Unknowns that dependent ones share.
    for (const auto &line : constraints.get_lines())
      for (const auto &row : line.entries)
        if (relevant.is_element(row.first / dim))
          for (const auto &column : line.entries)
            graph.add(row.first / dim, column.first / dim);
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      graph.add(partition.global(n), partition.global(n));
    return graph;
  }

  template <int dim>
  void
  TangentAssembler<dim>::make_pattern(const Terms &terms, Matrix &matrix) const
  {
    auto             graph = node_graph(terms);
    dealii::IndexSet owned(graph.n_rows());
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      owned.add_index(partition.global(n));
    owned.compress();
    if (dealii::Utilities::MPI::n_mpi_processes(partition.communicator()) > 1)
      dealii::SparsityTools::distribute_sparsity_pattern(
        graph,
        owned,
        partition.communicator(),
        relevant_nodes(partition));
    matrix.reinit(partition.owned_dofs(),
                  partition.owned_dofs(),
                  unknowns_of<dim>(graph, owned, partition.owned_dofs()),
                  partition.communicator(),
                  false);
  }

  template <int dim>
  void
  TangentAssembler<dim>::make_pattern(const Terms &terms,
                                      LocalMatrix &matrix) const
  {
    const auto graph = node_graph(terms);
    matrix.matrix.clear();
    matrix.pattern.copy_from(
      unknowns_of<dim>(graph,
                       relevant_nodes(partition),
                       dealii::complete_index_set(dim * graph.n_rows())));
    matrix.matrix.reinit(matrix.pattern);
  }

  MatrixPart
  matrix_part(const LocalMatrix &local, const bool symmetric)
  {
    MatrixPart part;
    part.n         = local.matrix.m();
    part.symmetric = symmetric;
    part.row_start.reserve(part.n + 1);
    part.columns.reserve(local.matrix.n_nonzero_elements());
    part.values.reserve(local.matrix.n_nonzero_elements());
    const auto add = [&](const unsigned int column, const double value) {
      if (value == 0.)
        return;
      part.columns.push_back(column);
      part.values.push_back(value);
    };
    for (unsigned int row = 0; row < part.n; ++row)
      {
        // The diagonal comes first in the matrix, in its place in the part.
        const double diagonal = local.matrix.diag_element(row);
        auto         entry    = local.matrix.begin(row);
        const auto   end      = local.matrix.end(row);
        for (++entry; entry != end && entry->column() < row; ++entry)
          add(entry->column(), entry->value());
        add(row, diagonal);
        if (!symmetric)
          for (; entry != end; ++entry)
            add(entry->column(), entry->value());
        part.row_start.push_back(part.columns.size());
      }
    return part;
  }

  template <int dim>
  template <typename AnyMatrix>
  void
  TangentAssembler<dim>::assemble(
    const Terms                            &terms,
    const Vector                           &displacement,
    AnyMatrix                              &matrix,
    const std::function<void(std::size_t)> &progress) const
  {
    matrix = 0.;
    dealii::FullMatrix<double>                   local, coupled_part;
    std::vector<unsigned int>                    nodes;
    std::vector<dealii::types::global_dof_index> dofs, rows;
    std::size_t                                  done = 0;
    for (const auto *term : terms)
      for (unsigned int block = 0; block < term->n_blocks(); ++block)
        {
          term->block_nodes(block, nodes);
          term->block_tangent(block, displacement, local);
          if (!term->is_symmetric())
            for (unsigned int row = 0; row < local.m(); ++row)
              for (unsigned int c = 0; c < local.n(); ++c)
                local(row, c) *= term->row_weight(nodes[row / dim]);
          for_coupled(
            term->has_stars(),
            nodes.size(),
            [&](const auto &coupled) {
              dofs.clear();
              rows.clear();
              for (const unsigned int k : coupled)
                for (int d = 0; d < dim; ++d)
                  {
                    dofs.push_back(dim * partition.global(nodes[k]) + d);
                    rows.push_back(dim * k + d);
                  }
              if (rows.size() == local.m())
                {
                  constraints.distribute_local_to_global(local, dofs, matrix);
                  return;
                }
              coupled_part.reinit(rows.size(), rows.size());
              coupled_part.extract_submatrix_from(local, rows, rows);
              constraints.distribute_local_to_global(coupled_part,
                                                     dofs,
                                                     matrix);
              // The node in the middle counts once.
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                  local(i, j) = 0.;
            });
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
#define PERIMORPH_INSTANTIATE(dim, AnyMatrix)               \
  template void TangentAssembler<dim>::assemble<AnyMatrix>( \
    const Terms &,                                          \
    const Vector &,                                         \
    AnyMatrix &,                                            \
    const std::function<void(std::size_t)> &) const;

  PERIMORPH_INSTANTIATE(2, Matrix)
  PERIMORPH_INSTANTIATE(3, Matrix)
  PERIMORPH_INSTANTIATE(2, dealii::SparseMatrix<double>)
  PERIMORPH_INSTANTIATE(3, dealii::SparseMatrix<double>)
#undef PERIMORPH_INSTANTIATE
  template class TangentOperator<2>;
  template class TangentOperator<3>;
} // namespace Perimorph::Solvers
