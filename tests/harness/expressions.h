#pragma once

#include <perimorph/parameters/expression.h>

#include <string>

namespace Perimorph::Testing
{
  /// An expression of a parameter file without constants.
  /// @throws Base::InputError
  inline Parameters::Expression
  expression(const std::string &text)
  {
    Base::InputErrorCollector    errors;
    const Parameters::Expression result("test", text, {}, errors);
    errors.throw_if_any();
    return result;
  }
} // namespace Perimorph::Testing
