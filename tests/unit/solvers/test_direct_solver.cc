#include <perimorph/base/exceptions.h>
#include <perimorph/solvers/direct_solver.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace Perimorph::Solvers
{
  namespace
  {
    constexpr unsigned int n = 90;

    using Entries = std::map<std::pair<unsigned int, unsigned int>, double>;

    /// A chain of springs between walls with links to the neighbour after next.
    Entries
    chain()
    {
      Entries    entries;
      const auto link = [&](const unsigned int i, const unsigned int j) {
        const double k = 1. + 0.3 * std::sin(i + 2. * j);
        entries[{i, i}] += k;
        entries[{j, j}] += k;
        entries[{i, j}] -= k;
        entries[{j, i}] -= k;
      };
      for (unsigned int i = 0; i + 2 < n; ++i)
        {
          link(i, i + 1);
          link(i, i + 2);
        }
      link(n - 2, n - 1);
      entries[{0, 0}] += 1.;
      entries[{n - 1, n - 1}] += 1.;
      return entries;
    }

    class Ranks : public testing::Test
    {
    protected:
      const unsigned int rank =
        dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      dealii::IndexSet owned{n};

      Ranks()
      {
        owned.add_range(rank * n / n_ranks, (rank + 1) * n / n_ranks);
      }

      /// What this rank adds; every entry is shared out to two ranks, as those
      /// at the border of two ranks are.
      MatrixParts
      parts(const Entries &entries, const bool symmetric = true) const
      {
        auto part       = std::make_shared<MatrixPart>();
        part->n         = n;
        part->symmetric = symmetric;
        for (unsigned int row = 0; row < n; ++row)
          {
            for (const auto &[place, value] : entries)
              for (const unsigned int share : {0, 1})
                if (place.first == row && (!symmetric || place.second <= row) &&
                    (row + share) % n_ranks == rank)
                  {
                    const bool is_there =
                      part->columns.size() > part->row_start[row] &&
                      part->columns.back() == static_cast<int>(place.second);
                    if (is_there)
                      part->values.back() += 0.5 * value;
                    else
                      {
                        part->columns.push_back(place.second);
                        part->values.push_back(0.5 * value);
                      }
                  }
            part->row_start.push_back(part->columns.size());
          }
        return {part};
      }

      /// Largest error of a known solution.
      double
      error(LinearSolver &solver, const Entries &entries) const
      {
        const auto known = [](const unsigned int i) {
          return std::cos(0.7 * i) + 0.01 * i;
        };
        Vector x(owned, MPI_COMM_WORLD), b(owned, MPI_COMM_WORLD);
        for (const auto &[place, value] : entries)
          if (owned.is_element(place.first))
            b(place.first) += value * known(place.second);
        solver.solve(x, b, 0.);
        double largest = 0.;
        for (const auto i : owned)
          largest = std::max(largest, std::abs(x(i) - known(i)));
        return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
      }

      /// The spring between two neighbours gets another stiffness.
      static Entries
      changed(Entries entries, const unsigned int i, const double more)
      {
        entries[{i, i}] += more;
        entries[{i + 1, i + 1}] += more;
        entries[{i, i + 1}] -= more;
        entries[{i + 1, i}] -= more;
        return entries;
      }
    };

    using DirectSolver = Ranks;
  } // namespace

  TEST_F(DirectSolver, SolvesSymmetricAndUnsymmetricSystems)
  {
    auto entries = chain();
    EXPECT_LT(error(*make_direct_solver(parts(entries), owned, MPI_COMM_WORLD),
                    entries),
              1e-10);
    entries[{3, 7}] += 0.4;
    entries[{80, 20}] -= 0.2;
    EXPECT_LT(
      error(*make_direct_solver(parts(entries, false), owned, MPI_COMM_WORLD),
            entries),
      1e-10);
  }

  TEST_F(DirectSolver, AddsUpParts)
  {
    const auto entries = chain();
    Entries    half;
    for (const auto &[place, value] : entries)
      half[place] = 0.5 * value;
    const MatrixParts both = {parts(half)[0], parts(half)[0]};
    EXPECT_LT(error(*make_direct_solver(both, owned, MPI_COMM_WORLD), entries),
              1e-10);
  }

  TEST_F(DirectSolver, SaysThatAMatrixIsSingular)
  {
    auto entries = chain();
    for (unsigned int k = 0; k < n; ++k)
      entries.erase({40, k}), entries.erase({k, 40});
    EXPECT_THROW(make_direct_solver(parts(entries), owned, MPI_COMM_WORLD),
                 Base::SolveError);
  }

  TEST_F(DirectSolver, EliminatesTheFarFieldOnce)
  {
    const auto near = [](const std::vector<unsigned int> &unknowns) {
      std::vector<unsigned int> wider;
      for (unsigned int i = std::max(5u, unknowns.front()) - 5;
           i < std::min(n, unknowns.back() + 6);
           ++i)
        wider.push_back(i);
      return wider;
    };
    FactorMemory memory(near);
    const auto   solve = [&](const Entries &entries) {
      return error(
        *make_direct_solver(parts(entries), owned, MPI_COMM_WORLD, &memory),
        entries);
    };
    auto entries = chain();
    EXPECT_LT(solve(entries), 1e-10);
    EXPECT_EQ(memory.n_factorisations, 1u);

    entries = changed(entries, 40, -0.5);
    EXPECT_LT(solve(entries), 1e-10);
    EXPECT_EQ(memory.n_factorisations, 2u);
    EXPECT_EQ(memory.n_reused, 0u);

    for (const unsigned int i : {41, 38, 44})
      {
        entries = changed(entries, i, -0.5);
        EXPECT_LT(solve(entries), 1e-10);
      }
    EXPECT_EQ(memory.n_factorisations, 2u);
    EXPECT_EQ(memory.n_reused, 3u);

    // Not positive definite any more: no dense factors, but a solution.
    const auto indefinite = changed(entries, 42, -8.);
    EXPECT_LT(solve(indefinite), 1e-9);
    EXPECT_EQ(memory.n_reused, 3u);

    // Somewhere else.
    EXPECT_LT(solve(entries), 1e-10);
    entries = changed(entries, 70, 2.);
    EXPECT_LT(solve(entries), 1e-10);
    EXPECT_EQ(memory.n_reused, 3u);
    entries = changed(entries, 72, 2.);
    EXPECT_LT(solve(entries), 1e-10);
    EXPECT_EQ(memory.n_reused, 4u);

    // Everywhere: nothing stays to be condensed.
    for (unsigned int i = 0; i + 1 < n; ++i)
      entries = changed(entries, i, 0.1);
    EXPECT_LT(solve(entries), 1e-10);
    EXPECT_EQ(memory.n_reused, 4u);
  }

  TEST_F(DirectSolver, SolversOutliveWhatTheyShare)
  {
    FactorMemory memory([](const auto &unknowns) { return unknowns; });
    const auto   first  = chain();
    const auto   second = changed(first, 10, 1.);
    const auto   third  = changed(first, 60, 1.);
    make_direct_solver(parts(first), owned, MPI_COMM_WORLD, &memory);
    const auto solver =
      make_direct_solver(parts(second), owned, MPI_COMM_WORLD, &memory);
    const auto later =
      make_direct_solver(parts(third), owned, MPI_COMM_WORLD, &memory);
    EXPECT_LT(error(*solver, second), 1e-10);
    EXPECT_LT(error(*later, third), 1e-10);
  }
} // namespace Perimorph::Solvers
