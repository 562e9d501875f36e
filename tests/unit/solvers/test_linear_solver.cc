#include <perimorph/solvers/linear_solver.h>

#include <gtest/gtest.h>

namespace Perimorph::Solvers
{
  namespace
  {
    LinearSolverChoice
    automatic(const ProblemSize &size)
    {
      return choose_linear_solver(LinearSolverKind::automatic,
                                  TangentKind::automatic,
                                  size);
    }
  } // namespace

  TEST(LinearSolverChoice, large_or_wide_problems_are_iterated)
  {
    ProblemSize size;
    size.dim    = 2;
    size.n_dofs = 500000;
    EXPECT_TRUE(automatic(size).direct);
    size.n_dofs = 1000000;
    EXPECT_FALSE(automatic(size).direct);
    EXPECT_FALSE(automatic(size).matrix_free);

    // A quarter of the nodes with families of two or three spacings.
    size.n_dofs      = 200000;
    size.n_particles = 25000;
    size.n_bonds     = 12 * size.n_particles;
    size.families    = true;
    EXPECT_TRUE(automatic(size).direct);
    size.n_bonds = 28 * size.n_particles;
    EXPECT_FALSE(automatic(size).direct);
    EXPECT_TRUE(automatic(size).matrix_free);
    // Rows of bonds have a third of the entries, which counts if factors are
    // used again.
    size.families = false;
    EXPECT_FALSE(automatic(size).direct);
    EXPECT_TRUE(automatic(size).matrix_free);
    size.n_dofs         = 80000;
    size.n_particles    = 10000;
    size.n_bonds        = 28 * size.n_particles;
    size.reuses_factors = true;
    EXPECT_TRUE(automatic(size).direct);
    size.families = true;
    EXPECT_FALSE(automatic(size).direct);

    // Factorisation gains nothing from more ranks.
    size        = ProblemSize();
    size.n_dofs = 200000;
    EXPECT_TRUE(automatic(size).direct);
    size.n_ranks = 3;
    EXPECT_FALSE(automatic(size).direct);

    size        = ProblemSize();
    size.dim    = 3;
    size.n_dofs = 3000;
    EXPECT_TRUE(automatic(size).direct);
    size.n_dofs = 30000;
    EXPECT_FALSE(automatic(size).direct);
  }
} // namespace Perimorph::Solvers
