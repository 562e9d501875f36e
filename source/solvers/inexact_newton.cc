#include <perimorph/solvers/inexact_newton.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Solvers
{
  ForcingTerm::ForcingTerm(const double tightest, const bool linear)
    : tightest(tightest)
    , linear(linear)
  {}

  double
  ForcingTerm::next(const double residual, const double goal)
  {
    if (linear)
      return tightest;
    constexpr double first = 1e-2, largest = 0.1, gamma = 0.9;
    // A tenth of what is left to the goal.
    const double enough = residual > 0. ? 0.1 * goal / residual : 0.;
    double       term   = first;
    if (last_residual > 0.)
      {
        const double ratio = residual / last_residual;
        term               = gamma * ratio * ratio;
      }
    last_residual = residual;
    return std::min(std::max({term, enough, tightest}), largest);
  }

  PreconditionerAge::PreconditionerAge(const double price)
    : price(price)
    , excess(price)
  {}

  void
  PreconditionerAge::renew()
  {
    excess   = 0.;
    has_rate = false;
  }

  void
  PreconditionerAge::count(const unsigned int iterations,
                           const double       relative_residual)
  {
    const double digits = std::max(0.5, -std::log10(relative_residual));
    if (!has_rate)
      rate = iterations / digits;
    has_rate = true;
    excess += std::max(0., iterations - rate * digits);
  }

  void
  PreconditionerAge::expire()
  {
    excess = price;
  }
} // namespace Perimorph::Solvers
