#pragma once

#include <string>
#include <vector>

namespace Perimorph::Parameters
{
  /// What the user asked for.
  struct CommandLine
  {
    std::string parameter_file;
    /// texts of --set: "Section/entry=value"
    std::vector<std::string> overrides;
    /// folder of --output; empty: as the parameter file says
    std::string output;
    /// folder of --resume: a run that goes on from its checkpoint; empty: none
    std::string resume;
    bool        validate         = false;
    bool        print_parameters = false;
    bool        help             = false;
    bool        version          = false;
  };

  /// @throws Base::InputError   unknown options, missing values, no file (not
  ///                            needed with --help, --version and
  ///                            --print-parameters), two files: all at once
  CommandLine
  parse_command_line(int argc, const char *const *argv);

  /// The text of --help.
  std::string
  help_text();
} // namespace Perimorph::Parameters
