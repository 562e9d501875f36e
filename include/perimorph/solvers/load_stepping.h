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

    /// Fraction of a step that the next increment tries: what it needs to go
    /// on later as if it had not stopped.
    double
    next_fraction() const
    {
      return fraction;
    }

    void
    set_next_fraction(const double value)
    {
      fraction = value;
    }

    unsigned int
    n_cuts() const
    {
      return total_cuts;
    }

  private:
    LoadSteppingParameters parameters;
    double                 fraction   = 1.;
    unsigned int           total_cuts = 0;
  };
} // namespace Perimorph::Solvers
