#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace Perimorph::Base
{
  class Log;

  /// Tells how far a long stage is: silent for stages that are over within
  /// one interval, then one line per interval at most, on rank 0.
  ///
  /// update() costs some ten nanoseconds; still, call it once per cell or
  /// per family, not per bond. Not for use by several threads at once.
  class Progress
  {
  public:
    /// @param title      what is done, e.g. "Family search"
    /// @param total      value of @p done at which the stage is complete
    /// @param interval   [s] between two lines and before the first
    Progress(Log              &log,
             std::string       title,
             const std::size_t total,
             const double      interval = 5.);

    /// @param done   units of work finished on this rank, at most total
    void
    update(const std::size_t done);

  private:
    using Clock = std::chrono::steady_clock;

    Log              &log;
    const std::string title;
    const std::size_t total;
    const double      interval;

    const Clock::time_point start;
    Clock::time_point       last_line;
    bool                    anything_printed = false;
    bool                    complete         = false;
  };
} // namespace Perimorph::Base
