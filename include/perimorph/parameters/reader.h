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
  /// One entry declared in a parameter handler.
  struct DeclaredEntry
  {
    std::vector<std::string> sections;
    std::string              name;
    std::string              value;
    std::string              default_value;
    std::string              documentation;
    /// as deal.II describes it, e.g. "[Selection a|b ]"
    std::string pattern;

    /// "Section / name"
    std::string
    path() const;
  };

  /// All declared entries in the order of their declaration.
  std::vector<DeclaredEntry>
  list_entries(const dealii::ParameterHandler &prm);

  /// Reads the file @p file_name in the grammar of deal.II (set, subsection,
  /// end, comments behind '#', '\' at the end of continued lines) into @p prm,
  /// on which all entries are declared. Valid values are set at once, which
  /// runs the actions of add_parameter(); everything else becomes a message
  /// with file and line, and leaves the default. The origin of each entry is
  /// remembered in @p errors.
  /// @return   false if it is no parameter file at all: missing, a folder,
  ///           binary or without any 'set'; other checks are vain then
  bool
  read_file(const std::string         &file_name,
            dealii::ParameterHandler  &prm,
            Base::InputErrorCollector &errors);

  /// The same for the content of a file; messages name it @p file_name.
  bool
  read_text(const std::string         &text,
            const std::string         &file_name,
            dealii::ParameterHandler  &prm,
            Base::InputErrorCollector &errors);
} // namespace Perimorph::Parameters
