#include <perimorph/base/log.h>
#include <perimorph/base/progress.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace Perimorph::Base
{
  namespace
  {
    /// "12 s", "3 min 05 s", "2 h 07 min"
    std::string
    duration_text(const double seconds)
    {
      const auto whole = static_cast<long>(std::lround(seconds));
      char       text[64];
      if (whole < 60)
        std::snprintf(text, sizeof(text), "%ld s", whole);
      else if (whole < 3600)
        std::snprintf(text,
                      sizeof(text),
                      "%ld min %02ld s",
                      whole / 60,
                      whole % 60);
      else
        std::snprintf(text,
                      sizeof(text),
                      "%ld h %02ld min",
                      whole / 3600,
                      whole % 3600 / 60);
      return text;
    }
  } // namespace


  Progress::Progress(Log              &log,
                     std::string       title,
                     const std::size_t total,
                     const double      interval)
    : log(log)
    , title(std::move(title))
    , total(total)
    , interval(interval)
    , start(Clock::now())
    , last_line(start)
  {}


  void
  Progress::update(const std::size_t done)
  {
    if (!log.is_active() || complete)
      return;
    const auto now = Clock::now();
    complete       = (done >= total);
    const bool due =
      std::chrono::duration<double>(now - last_line).count() >= interval;
    // a stage that has printed ends with a line of 100 %
    if (complete ? !anything_printed : !due)
      return;

    const double elapsed = std::chrono::duration<double>(now - start).count();
    const double fraction =
      complete ? 1. : static_cast<double>(done) / static_cast<double>(total);
    log << "  " << title << ": " << static_cast<int>(100. * fraction) << " %, "
        << duration_text(elapsed);
    if (!complete && done > 0)
      log << ", about " << duration_text(elapsed * (1. / fraction - 1.))
          << " left";
    log << '\n';
    last_line        = now;
    anything_printed = true;
  }
} // namespace Perimorph::Base
