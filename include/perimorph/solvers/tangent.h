#pragma once

#include <perimorph/fem/contribution.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <memory>
#include <vector>

namespace Perimorph::Solvers
{
  using Fem::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

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

    /// Fills the matrix (pattern made before) at a displacement.
    void
    assemble(const Terms                            &terms,
             const Vector                           &displacement,
             Matrix                                 &matrix,
             const std::function<void(std::size_t)> &progress = {}) const;

  private:
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
