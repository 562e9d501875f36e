#pragma once

#include <perimorph/solvers/linear_solver.h>
#include <perimorph/solvers/sparse_factors.h>

#include <deal.II/base/index_set.h>

#include <functional>
#include <memory>
#include <vector>

namespace Perimorph::Solvers
{
  /// A matrix from which all unknowns but a few were eliminated: one that
  /// differs from it in the equations of these few only costs a small dense
  /// solve (static condensation of the far field).
  struct Condensation
  {
    MatrixParts                    matrix; ///< what was condensed
    std::vector<unsigned int>      kept;   ///< unknowns, rising
    std::unique_ptr<SparseFactors> factors;
  };

  /// What direct solvers of one body after another share while cracks grow.
  class FactorMemory
  {
  public:
    /// @param widen  unknowns that may change soon, from those that did, both
    ///        rising; the same on all ranks
    using Widen = std::function<std::vector<unsigned int>(
      const std::vector<unsigned int> &)>;

    /// @param widen  none: matrices differ in too much for condensation
    explicit FactorMemory(Widen widen = {})
      : widen(std::move(widen))
    {}

    /// Factorisations and small dense solves in place of one.
    unsigned int n_factorisations = 0;
    unsigned int n_reused         = 0;

    Widen                         widen;
    std::shared_ptr<Condensation> condensation;
    MatrixParts                   last; ///< not condensed

    /// What elements add to a matrix, while they stay the same.
    std::shared_ptr<const void>       elements;
    std::shared_ptr<const MatrixPart> part_of_elements;
  };

  /// Sparse factorisation, computed once. With a memory, equations that did not
  /// change since an earlier matrix are not eliminated again.
  /// @param owned  entries of the vectors of this rank
  /// @throws Base::SolveError  a singular matrix
  std::unique_ptr<LinearSolver>
  make_direct_solver(MatrixParts             matrix,
                     const dealii::IndexSet &owned,
                     MPI_Comm                communicator,
                     FactorMemory           *memory = nullptr);
} // namespace Perimorph::Solvers
