#include <perimorph/base/exceptions.h>
#include <perimorph/base/gather.h>
#include <perimorph/solvers/direct_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Solvers
{
  namespace
  {
    /// Above, the dense solve costs more than factors of all n unknowns.
    std::size_t
    most_kept(const std::size_t n)
    {
      return std::min<std::size_t>(700, n / 2);
    }

    /// Differences up to this, relative to the largest entry, are round-off.
    constexpr double round_off = 1e-14;

    /// Moves vectors to rank 0 and back; ranks own rising ranges.
    class OnRoot
    {
    public:
      OnRoot(const dealii::IndexSet &owned, MPI_Comm communicator)
        : communicator(communicator)
        , n_owned(owned.n_elements())
        , counts(dealii::Utilities::MPI::gather(communicator, n_owned))
        , starts(counts.size(), 0)
        , size(counts.empty() ? 0 : owned.size())
      {
        for (std::size_t r = 1; r < counts.size(); ++r)
          starts[r] = starts[r - 1] + counts[r - 1];
      }

      std::vector<double>
      gather(const Vector &vector) const
      {
        std::vector<double> all(size);
        MPI_Gatherv(vector.begin(),
                    n_owned,
                    MPI_DOUBLE,
                    all.data(),
                    counts.data(),
                    starts.data(),
                    MPI_DOUBLE,
                    0,
                    communicator);
        return all;
      }

      void
      scatter(const std::vector<double> &all, Vector &vector) const
      {
        MPI_Scatterv(all.data(),
                     counts.data(),
                     starts.data(),
                     MPI_DOUBLE,
                     vector.begin(),
                     n_owned,
                     MPI_DOUBLE,
                     0,
                     communicator);
      }

    private:
      MPI_Comm         communicator;
      int              n_owned;
      std::vector<int> counts, starts; ///< of ranks; on rank 0
      std::size_t      size;
    };

    class DirectSolver : public LinearSolver
    {
    public:
      DirectSolver(const MatrixParts      &matrix,
                   const dealii::IndexSet &owned,
                   MPI_Comm                communicator)
        : on_root(owned, communicator)
        , factors(matrix, communicator)
      {}

      unsigned int
      solve(Vector &x, const Vector &b, double) override
      {
        auto all = on_root.gather(b);
        factors.solve(all);
        on_root.scatter(all, x);
        check_finite(x);
        return 1;
      }

    private:
      const OnRoot  on_root;
      SparseFactors factors;
    };

    template <typename Action>
    void
    compare(const MatrixPart &first,
            const MatrixPart &second,
            const Action     &action)
    {
      for (unsigned int row = 0; row < first.n; ++row)
        {
          auto       a     = first.row_start[row];
          auto       b     = second.row_start[row];
          const auto a_end = first.row_start[row + 1];
          const auto b_end = second.row_start[row + 1];
          while (a < a_end || b < b_end)
            {
              const bool in_a =
                a < a_end &&
                (b == b_end || first.columns[a] <= second.columns[b]);
              const bool in_b = b < b_end && (a == a_end || second.columns[b] <=
                                                              first.columns[a]);
              const int  column = in_a ? first.columns[a] : second.columns[b];
              const double difference =
                (in_b ? second.values[b] : 0.) - (in_a ? first.values[a] : 0.);
              if (difference != 0.)
                action(row, column, difference);
              a += in_a;
              b += in_b;
            }
        }
    }

    /// Calls action(row, column, difference) for each entry that differs.
    template <typename Action>
    void
    for_each_difference(const MatrixParts &first,
                        const MatrixParts &second,
                        const Action      &action)
    {
      for (std::size_t k = 0; k < first.size(); ++k)
        if (first[k] != second[k])
          compare(*first[k], *second[k], action);
    }

    /// Unknowns whose equations differ, rising; the same on all ranks.
    std::vector<unsigned int>
    changed_unknowns(const MatrixParts &first,
                     const MatrixParts &second,
                     MPI_Comm           communicator)
    {
      double largest = 0.;
      for (const auto &part : first)
        for (const double value : part->values)
          largest = std::max(largest, std::abs(value));
      std::vector<unsigned int> changed;
      for_each_difference(first,
                          second,
                          [&](const unsigned int row,
                              const unsigned int column,
                              const double       difference) {
                            if (std::abs(difference) <= round_off * largest)
                              return;
                            changed.push_back(row);
                            changed.push_back(column);
                          });
      const auto make_unique = [](std::vector<unsigned int> &unknowns) {
        std::sort(unknowns.begin(), unknowns.end());
        unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                       unknowns.end());
      };
      make_unique(changed);
      auto all = Base::gather_on_all(communicator, changed);
      make_unique(all);
      return all;
    }

    /// Condensed far field, dense factors of the rest on rank 0.
    class CondensedSolver : public LinearSolver
    {
    public:
      CondensedSolver(std::shared_ptr<Condensation> condensation,
                      const MatrixParts            &matrix,
                      const dealii::IndexSet       &owned,
                      MPI_Comm                      communicator)
        : condensation(std::move(condensation))
        , on_root(owned, communicator)
      {
        const auto       &kept = this->condensation->kept;
        std::vector<int>  position(matrix[0]->n, -1);
        const std::size_t n = kept.size();
        for (std::size_t k = 0; k < n; ++k)
          position[kept[k]] = k;
        std::vector<double> dense(n * n, 0.);
        for_each_difference(this->condensation->matrix,
                            matrix,
                            [&](const unsigned int row,
                                const unsigned int column,
                                const double       difference) {
                              const int i = position[row];
                              const int j = position[column];
                              if (i < 0 || j < 0)
                                return;
                              dense[i * n + j] += difference;
                              if (i != j)
                                dense[j * n + i] += difference;
                            });
        const bool is_root =
          dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
        MPI_Reduce(is_root ? MPI_IN_PLACE : dense.data(),
                   dense.data(),
                   dense.size(),
                   MPI_DOUBLE,
                   MPI_SUM,
                   0,
                   communicator);
        bool failed = false;
        if (is_root)
          {
            const auto &schur = this->condensation->factors->schur_complement();
            complement.reinit(n);
            for (std::size_t i = 0; i < n; ++i)
              for (std::size_t j = 0; j < n; ++j)
                complement(i, j) = schur[i * n + j] + dense[i * n + j];
            complement.set_property(dealii::LAPACKSupport::symmetric);
            try
              {
                complement.compute_cholesky_factorization();
              }
            catch (const dealii::ExceptionBase &)
              {
                failed = true;
              }
          }
        is_definite =
          dealii::Utilities::MPI::max(failed ? 1 : 0, communicator) == 0;
      }

      /// Whether it can solve.
      bool
      positive_definite() const
      {
        return is_definite;
      }

      unsigned int
      solve(Vector &x, const Vector &b, double) override
      {
        auto                all = on_root.gather(b);
        std::vector<double> reduced;
        condensation->factors->reduce(all, reduced);
        if (complement.m() > 0)
          {
            dealii::Vector<double> y(reduced.begin(), reduced.end());
            complement.solve(y);
            std::copy(y.begin(), y.end(), reduced.begin());
          }
        condensation->factors->expand(reduced, all);
        on_root.scatter(all, x);
        check_finite(x);
        return 1;
      }

    private:
      std::shared_ptr<Condensation>    condensation;
      const OnRoot                     on_root;
      dealii::LAPACKFullMatrix<double> complement; ///< on rank 0
      bool                             is_definite = true;
    };
  } // namespace

  std::unique_ptr<LinearSolver>
  make_direct_solver(MatrixParts             matrix,
                     const dealii::IndexSet &owned,
                     MPI_Comm                communicator,
                     FactorMemory           *memory)
  {
    if (!memory || !memory->widen || !matrix[0]->symmetric)
      return std::make_unique<DirectSolver>(matrix, owned, communicator);

    const auto condensed = [&]() -> std::unique_ptr<LinearSolver> {
      auto solver = std::make_unique<CondensedSolver>(memory->condensation,
                                                      matrix,
                                                      owned,
                                                      communicator);
      if (!solver->positive_definite())
        return nullptr;
      return solver;
    };
    auto &condensation = memory->condensation;
    auto &earlier      = condensation ? condensation->matrix : memory->last;
    if (earlier.size() == matrix.size())
      {
        const auto changed = changed_unknowns(earlier, matrix, communicator);
        if (condensation && std::includes(condensation->kept.begin(),
                                          condensation->kept.end(),
                                          changed.begin(),
                                          changed.end()))
          if (auto solver = condensed())
            {
              ++memory->n_reused;
              return solver;
            }
        const auto most = most_kept(matrix[0]->n);
        auto kept = changed.size() <= most ? memory->widen(changed) : changed;
        if (!kept.empty() && kept.size() <= most)
          {
            ++memory->n_factorisations;
            condensation = std::make_shared<Condensation>();
            condensation->factors =
              std::make_unique<SparseFactors>(matrix, communicator, kept);
            condensation->kept   = std::move(kept);
            condensation->matrix = matrix;
            memory->last         = {};
            if (auto solver = condensed())
              return solver;
          }
      }
    ++memory->n_factorisations;
    auto solver = std::make_unique<DirectSolver>(matrix, owned, communicator);
    condensation.reset();
    memory->last = std::move(matrix);
    return solver;
  }
} // namespace Perimorph::Solvers
