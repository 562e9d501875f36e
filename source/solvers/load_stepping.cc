#include <perimorph/solvers/load_stepping.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Solvers
{
  LoadStepping::LoadStepping(const LoadSteppingParameters &parameters)
    : parameters(parameters)
  {}

  double
  LoadStepping::advance(const double                               from,
                        const double                               to,
                        const std::function<bool(double)>         &attempt,
                        const std::function<void(double, double)> &on_cut,
                        const std::function<void(double)> &on_intermediate)
  {
    double       time   = from;
    unsigned int n_cuts = 0;
    while (time != to)
      {
        double target = time + fraction * (to - from);
        // What would be left over joins the increment.
        if ((to - target) * (to > from ? 1. : -1.) <
            1e-3 * fraction * std::abs(to - from))
          target = to;
        if (attempt(target))
          {
            time     = target;
            fraction = std::min(1., 2. * fraction);
            n_cuts   = 0;
            if (time != to)
              on_intermediate(time);
            continue;
          }
        if (n_cuts == parameters.maximum_cuts)
          break;
        ++n_cuts;
        ++total_cuts;
        fraction *= 0.5;
        on_cut(target, time + fraction * (to - from));
      }
    return time;
  }
} // namespace Perimorph::Solvers
