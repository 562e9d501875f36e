#pragma once

#include <perimorph/fem/node_partition.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <memory>
#include <string>

namespace Perimorph::Solvers
{
  using Fem::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  enum class LinearSolverKind
  {
    automatic,
    direct,
    iterative
  };

  enum class TangentKind
  {
    automatic,
    assembled,
    matrix_free
  };

  /// What the choice of the linear solver depends on.
  struct ProblemSize
  {
    unsigned int dim            = 2;
    std::size_t  n_dofs         = 0;
    std::size_t  n_particles    = 0;
    std::size_t  n_bonds        = 0;     ///< of all particles, both directions
    bool         families       = false; ///< bonds of the correspondence model
    unsigned int n_ranks        = 1;
    bool         reuses_factors = false; ///< for problems that differ little
  };

  /// A decision and the reason that is printed with it.
  struct LinearSolverChoice
  {
    bool        direct;
    bool        matrix_free;
    std::string reason;
    /// Matrix entries that a matrix-free product does without, about.
    double entries_saved = 0.;
  };

  /// Chooses between a direct solve of the assembled tangent and conjugate
  /// gradients, assembled or matrix-free, by the expected cost. In 2D a sparse
  /// factorisation is faster than multigrid up to nearly a million unknowns of
  /// elements; wide families bring that down by the square of the entries per
  /// row. In 3D it is only for small problems (doc/performance).
  LinearSolverChoice
  choose_linear_solver(LinearSolverKind   solver,
                       TangentKind        tangent,
                       const ProblemSize &size);

  /// Solves with one operator as often as wanted.
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /// Solves A x = b with zero start value.
    /// @param tolerance  relative residual; a direct solver goes to round-off
    /// @return number of iterations (1 for a direct solver)
    /// @throws Base::SolveError  breakdown or no convergence
    virtual unsigned int
    solve(Vector &x, const Vector &b, double tolerance) = 0;
  };

  /// Collective.
  /// @throws Base::SolveError  a solution that is not finite
  void
  check_finite(const Vector &x);

  /// Conjugate gradients (GMRES if not symmetric) with smoothed-aggregation
  /// multigrid, rigid-body near-null space and Chebyshev smoother.
  /// @param apply  product with the operator
  /// @param preconditioner_matrix  spectrally equivalent assembled matrix: the
  ///        operator itself or the plain finite-element stiffness; must stay
  /// @param on_iteration  called with the iteration and the relative residual
  template <int dim>
  std::unique_ptr<LinearSolver>
  make_iterative_solver(std::function<void(Vector &, const Vector &)> apply,
                        const Matrix                  &preconditioner_matrix,
                        const Fem::NodePartition<dim> &partition,
                        bool                           symmetric,
                        std::function<void(unsigned int, double)> on_iteration);
} // namespace Perimorph::Solvers
