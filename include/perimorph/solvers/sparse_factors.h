#pragma once

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace Perimorph::Solvers
{
  /// What one rank adds to a square matrix, entries in rising order of rows and
  /// columns; the lower triangle if the matrix is symmetric.
  struct MatrixPart
  {
    unsigned int             n = 0; ///< rows of the whole matrix
    std::vector<std::size_t> row_start{0};
    std::vector<int>         columns;
    std::vector<double>      values;
    bool                     symmetric = true;
  };

  /// A matrix is the sum of parts, so that those that stay are made once; the
  /// same number on all ranks.
  using MatrixParts = std::vector<std::shared_ptr<const MatrixPart>>;

  /// Factors L D L^T (or L U) of the sum of the parts of all ranks, by MUMPS.
  ///
  /// Some unknowns may be left out: the others are eliminated, and what remains
  /// for these is the dense Schur complement.
  class SparseFactors
  {
  public:
    /// @param left_out  unknowns that are not eliminated, rising, the same on
    ///        all ranks
    /// @throws Base::SolveError  a singular matrix
    SparseFactors(const MatrixParts               &parts,
                  MPI_Comm                         communicator,
                  const std::vector<unsigned int> &left_out = {});
    ~SparseFactors();

    /// On rank 0, by rows; only of a symmetric matrix.
    const std::vector<double> &
    schur_complement() const;

    /// Solves in place; right-hand side and solution on rank 0.
    void
    solve(std::vector<double> &vector);

    /// The right-hand side that remains for the unknowns left out; rank 0.
    void
    reduce(std::vector<double> &vector, std::vector<double> &reduced);
    /// After reduce(): the solution from that for the unknowns left out.
    void
    expand(std::vector<double> &reduced, std::vector<double> &vector);

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace Perimorph::Solvers
