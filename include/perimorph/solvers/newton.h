#pragma once

#include <functional>
#include <string>
#include <vector>

namespace Perimorph::Solvers
{
  /// When a Newton step is shortened.
  enum class LineSearch
  {
    inadmissible, ///< only where a law has no answer (J <= 0)
    energy        ///< also until the force along the step has fallen
  };

  struct NewtonParameters
  {
    double       tolerance          = 1e-9; ///< relative residual
    unsigned int maximum_iterations = 20;
    LineSearch   line_search        = LineSearch::inadmissible;
  };

  /// Residual norms relative to the largest force in the problem.
  struct ResidualNorms
  {
    double residual = 0.; ///< of the free equations
    double scale    = 0.; ///< largest load, reaction or first residual so far
    /// The supports have not reached their values yet: not converged, however
    /// small the residual.
    bool supports_move = false;
  };

  /// One state visited.
  struct NewtonIteration
  {
    unsigned int iteration;
    double       residual;
    double       relative_residual;
    double       step_length;       ///< that led here; 0 at the start
    unsigned int linear_iterations; ///< of the step that led here
  };

  /// What one solve by Newton's method did.
  struct NewtonRecord
  {
    bool                converged = false;
    std::vector<double> residuals; ///< relative, one per state visited
    unsigned int        linear_iterations = 0;
    std::string         reason; ///< of a failure

    unsigned int
    n_iterations() const
    {
      return residuals.empty() ? 0 : residuals.size() - 1;
    }
  };

  /// What Newton's method does to a problem; it knows vectors, physics and
  /// parallelism only through these functions.
  struct NewtonActions
  {
    /// Residual norms at the current state, 0 being the first of the solve.
    /// @throws Base::InadmissibleState
    std::function<ResidualNorms(unsigned int iteration)> evaluate;
    /// Solves with the tangent at the current state for a correction, returns
    /// the linear iterations.
    std::function<unsigned int()> solve;
    /// Goes from where the correction was found this part of it.
    std::function<void(double step)> move;
    /// Residual along the correction at the current state.
    std::function<double()>                      slope;
    std::function<void(const NewtonIteration &)> report;
  };

  /// Newton's method with a line search. Gives up on residuals that are not
  /// finite or stagnate, and on steps that stay inadmissible.
  NewtonRecord
  newton(const NewtonParameters &parameters, const NewtonActions &actions);
} // namespace Perimorph::Solvers
