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
    double       time     = from;
    const double smallest = std::ldexp(1., -int(parameters.maximum_cuts));
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
            if (time != to)
              on_intermediate(time);
            continue;
          }
        if (0.5 * fraction < smallest)
          break;
        ++total_cuts;
        fraction *= 0.5;
        on_cut(target, time + fraction * (to - from));
      }
    return time;
  }
} // namespace Perimorph::Solvers
