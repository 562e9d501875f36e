#pragma once

#include <perimorph/base/timing.h>

#include <string>
#include <vector>

namespace Perimorph::Base
{
  class Log;
}

namespace Perimorph::Output
{
  class Results;

  /// The last page of a run: what was solved, the quantities with reference
  /// and error, checks, warnings, timing, files. Not collective; prints on
  /// rank 0.
  /// @param folder   output folder, printed in front of the list of files
  /// @param files    names in that folder
  /// @param table    result of timing.table()
  void
  print_summary(Base::Log                      &log,
                const Results                  &results,
                const std::string              &folder,
                const std::vector<std::string> &files,
                const Base::Timing             &timing,
                const Base::Timing::Table      &table);
} // namespace Perimorph::Output
