#include "cracked_body.h"

namespace Perimorph::Coupling::CrackTests
{
  namespace
  {
    /// Energy of the elements of the preconditioner relative to that of full
    /// elements, under a uniform stretch of a square of 24 x 24 equal cells.
    double
    energy_left(const std::vector<std::vector<Point2>> &cracks)
    {
      CrackedBody<2> body{polylines(cracks)};
      body.perturbation = 0.;
      body.everywhere   = true;
      body.build();
      const auto &problem = *body.problem;
      Fem::Vector u;
      problem.partition().initialize(u);
      for (unsigned int n = 0; n < problem.partition().n_owned(); ++n)
        u.local_element(2 * n) = problem.partition().position(n)[0];
      u.update_ghost_values();
      const auto energy = [&](const Fem::ElasticCells<2> &elements) {
        return dealii::Utilities::MPI::sum(elements.energy(u), MPI_COMM_WORLD);
      };
      return energy(problem.preconditioner_elements()) /
             energy(problem.full_elements());
    }
  } // namespace

  TEST(SoftenedElements, cells_that_a_crack_cuts_keep_a_hundredth)
  {
    // Through a row of cells, and through 12 cells of it.
    EXPECT_NEAR(energy_left({{Point2(-.1, .52), Point2(1.1, .52)}}),
                1. - .99 * 24. / 576.,
                1e-12);
    EXPECT_NEAR(energy_left({{Point2(-.1, .52), Point2(.49, .52)}}),
                1. - .99 * 12. / 576.,
                1e-12);
  }

  TEST(SoftenedElements, nothing_changes_without_a_cut)
  {
    CrackedBody<2> body{polylines({})};
    body.everywhere = true;
    body.build();
    EXPECT_EQ(&body.problem->preconditioner_elements(),
              &body.problem->full_elements());
  }
} // namespace Perimorph::Coupling::CrackTests
