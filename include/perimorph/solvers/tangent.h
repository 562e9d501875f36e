#pragma once

#include <perimorph/fem/contribution.h>
#include <perimorph/solvers/sparse_factors.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <memory>
#include <vector>

namespace Perimorph::Solvers
{
  using Fem::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /// What the blocks of this rank add to the rows of any rank: no message is
  /// needed to assemble it.
  struct LocalMatrix
  {
    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;

    void
    clear()
    {
      matrix.clear();
      pattern.reinit(0, 0, 0);
    }
  };

  /// Its entries other than zero, for a direct solver.
  MatrixPart
  matrix_part(const LocalMatrix &matrix, bool symmetric);

  /// Assembles the tangents of contributions into one sparse matrix, with the
  /// rows and columns of constrained degrees of freedom eliminated (their
  /// diagonal stays positive).
  template <int dim>
  class TangentAssembler
  {
  public:
    using Terms = std::vector<const Fem::Contribution<dim> *>;

    TangentAssembler(const Fem::NodePartition<dim>           &partition,
                     const dealii::AffineConstraints<double> &constraints);

    /// Gives the matrix the sparsity pattern of the terms.
    void
    make_pattern(const Terms &terms, Matrix &matrix) const;
    void
    make_pattern(const Terms &terms, LocalMatrix &matrix) const;

    /// Fills the matrix (pattern made before) at a displacement; AnyMatrix:
    /// Matrix or that of a LocalMatrix.
    template <typename AnyMatrix>
    void
    assemble(const Terms                            &terms,
             const Vector                           &displacement,
             AnyMatrix                              &matrix,
             const std::function<void(std::size_t)> &progress = {}) const;

  private:
    /// Which nodes the blocks of this rank couple.
    dealii::DynamicSparsityPattern
    node_graph(const Terms &terms) const;

    const Fem::NodePartition<dim>           &partition;
    const dealii::AffineConstraints<double> &constraints;
  };

  /// The tangent as an operator: an assembled matrix plus terms applied without
  /// a matrix. Constrained equations are those of the preconditioner: multigrid
  /// moves constrained entries a little, and any other diagonal there would be
  /// a spurious eigenvalue.
  template <int dim>
  class TangentOperator
  {
  public:
    TangentOperator(const Matrix                               &matrix,
                    std::vector<const Fem::Contribution<dim> *> terms,
                    const Vector                               &displacement,
                    const dealii::AffineConstraints<double>    &constraints,
                    const Matrix           &preconditioner_matrix,
                    const dealii::IndexSet &owned);

    void
    vmult(Vector &destination, const Vector &source) const;

  private:
    const Matrix                               &matrix;
    std::vector<const Fem::Contribution<dim> *> matrix_free_terms;
    const Vector                               &displacement;
    std::vector<unsigned int>                   constrained; ///< local entries
    std::vector<double> constrained_diagonal; ///< of the preconditioner
    mutable Vector      input;
    mutable Vector      product;
  };
} // namespace Perimorph::Solvers
