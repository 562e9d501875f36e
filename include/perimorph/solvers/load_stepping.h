#pragma once

#include <functional>

namespace Perimorph::Solvers
{
  struct LoadSteppingParameters
  {
    /// The smallest increment is a step halved this often.
    unsigned int maximum_cuts = 10;
  };

  /// Goes from one time to the next in as few increments as converge: a failed
  /// increment is halved, the one after a success is twice as long again.
  class LoadStepping
  {
  public:
    explicit LoadStepping(const LoadSteppingParameters &parameters);

    /// @param attempt  tries to solve at a time; on failure the state is what
    ///                 it was
    /// @param on_cut   called with the time that failed and the next one tried
    /// @param on_intermediate  called after each success before the end
    /// @return  the last time reached: `to` unless the cuts are used up
    double
    advance(double                                     from,
            double                                     to,
            const std::function<bool(double)>         &attempt,
            const std::function<void(double, double)> &on_cut,
            const std::function<void(double)>         &on_intermediate);

    unsigned int
    n_cuts() const
    {
      return total_cuts;
    }

  private:
    LoadSteppingParameters parameters;
    /// Fraction of a step that the next increment tries.
    double       fraction   = 1.;
    unsigned int total_cuts = 0;
  };
} // namespace Perimorph::Solvers
