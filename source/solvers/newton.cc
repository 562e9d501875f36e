#include <perimorph/base/exceptions.h>
#include <perimorph/solvers/newton.h>

#include <cmath>

namespace Perimorph::Solvers
{
  namespace
  {
    constexpr double shortest_step = 1. / 64.;
    /// Iterations without a new smallest residual after which a solve is given
    /// up. Bending of thin bodies needs a few: their first steps stretch them.
    constexpr unsigned int patience = 8;

    /// Moves by the longest acceptable part of the correction.
    /// @return  the step; zero if there is none, with the reason
    double
    line_search(const NewtonParameters &parameters,
                const NewtonActions    &actions,
                const unsigned int      iteration,
                ResidualNorms          &norms,
                std::string            &reason)
    {
      const bool   energy = parameters.line_search == LineSearch::energy;
      const double before = energy ? actions.slope() : 0.;
      for (double step = 1.; step >= shortest_step; step *= 0.5)
        {
          actions.move(step);
          try
            {
              norms = actions.evaluate(iteration);
            }
          catch (const Base::InadmissibleState &error)
            {
              reason = error.what();
              continue;
            }
          if (!energy || norms.supports_move ||
              std::abs(actions.slope()) <= 0.8 * std::abs(before) ||
              step < 2. * shortest_step)
            return step;
        }
      return 0.;
    }
  } // namespace

  NewtonRecord
  newton(const NewtonParameters &parameters, const NewtonActions &actions)
  {
    NewtonRecord  record;
    ResidualNorms norms;
    try
      {
        norms = actions.evaluate(0);
      }
    catch (const Base::InadmissibleState &error)
      {
        record.reason = error.what();
        return record;
      }
    unsigned int    best = 0;
    NewtonIteration last{0, 0., 0., 0., 0};
    for (unsigned int iteration = 0;; ++iteration)
      {
        last.iteration = iteration;
        last.residual  = norms.residual;
        last.relative_residual =
          norms.scale > 0. ? norms.residual / norms.scale : norms.residual;
        record.residuals.push_back(last.relative_residual);
        actions.report(last);
        if (!(last.relative_residual < 1e100))
          {
            record.reason = "the residual is not finite";
            return record;
          }
        if (last.relative_residual <= parameters.tolerance &&
            !norms.supports_move)
          {
            record.converged = true;
            return record;
          }
        if (last.relative_residual < record.residuals[best])
          best = iteration;
        if (iteration == parameters.maximum_iterations)
          record.reason = "no convergence within the allowed iterations";
        else if (iteration - best >= patience)
          record.reason = "the residual no longer falls";
        if (!record.reason.empty())
          return record;
        last.linear_iterations = actions.solve();
        record.linear_iterations += last.linear_iterations;
        last.step_length =
          line_search(parameters, actions, iteration + 1, norms, record.reason);
        if (last.step_length == 0.)
          return record;
        record.reason.clear();
      }
  }
} // namespace Perimorph::Solvers
