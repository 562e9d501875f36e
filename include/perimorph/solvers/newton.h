#pragma once

#include <functional>
#include <string>
#include <vector>

namespace Perimorph::Solvers
{
  struct NewtonParameters
  {
    double       tolerance          = 1e-9; ///< relative residual
    unsigned int maximum_iterations = 20;
  };

  /// Residual norms relative to the largest force in the problem.
  struct ResidualNorms
  {
    double residual; ///< of the free equations
    double scale;    ///< largest load, reaction or residual so far
  };

  /// What one solve by Newton's method did.
  struct NewtonRecord
  {
    bool                converged = false;
    std::vector<double> residuals; ///< relative, one per state visited
    unsigned int        linear_iterations = 0;
    std::string         reason; ///< of a failure
  };

  /// Newton's method; knows vectors, physics and parallelism only through the
  /// three functions.
  /// @param evaluate  residual norms at the current state
  /// @param solve_and_update  solves with the tangent at the current state,
  /// adds
  ///        the correction, returns the linear iterations
  /// @param report  called with iteration, relative residual and linear
  ///        iterations of the last solve
  inline NewtonRecord
  newton(const NewtonParameters               &parameters,
         const std::function<ResidualNorms()> &evaluate,
         const std::function<unsigned int()>  &solve_and_update,
         const std::function<void(unsigned int, double, unsigned int)> &report)
  {
    NewtonRecord record;
    unsigned int last_linear_iterations = 0;
    for (unsigned int iteration = 0;; ++iteration)
      {
        const ResidualNorms norms = evaluate();
        const double        relative =
          norms.scale > 0. ? norms.residual / norms.scale : norms.residual;
        record.residuals.push_back(relative);
        report(iteration, relative, last_linear_iterations);
        if (!(relative < 1e100))
          {
            record.reason = "the residual is not finite";
            return record;
          }
        if (relative <= parameters.tolerance)
          {
            record.converged = true;
            return record;
          }
        if (iteration == parameters.maximum_iterations)
          {
            record.reason = "no convergence within the allowed iterations";
            return record;
          }
        last_linear_iterations = solve_and_update();
        record.linear_iterations += last_linear_iterations;
      }
  }
} // namespace Perimorph::Solvers
