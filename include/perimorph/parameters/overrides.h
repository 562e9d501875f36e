#pragma once

#include <perimorph/base/exceptions.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Perimorph::Parameters
{
  /// Sets "Section/entry=value" texts of the command line, with the same
  /// checks; blanks around '/' and '=' do not matter. Later ones win.
  void
  apply_overrides(const std::vector<std::string> &overrides,
                  dealii::ParameterHandler       &prm,
                  Base::InputErrorCollector      &errors);
} // namespace Perimorph::Parameters
