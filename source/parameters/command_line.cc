#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/parameters/command_line.h>

#include <algorithm>
#include <cstddef>

namespace Perimorph::Parameters
{
  namespace
  {
    struct Option
    {
      std::string name;
      /// what follows it; empty for a switch
      std::string value;
      std::string text;
    };


    const std::vector<Option> &
    options()
    {
      static const std::vector<Option> list = {
        {"--set",
         "\"Section/entry=value\"",
         "set an entry, stronger than the file; may be repeated"},
        {"--output", "DIR", "write results into this folder"},
        {"--resume",
         "DIR",
         "go on from the checkpoint in this folder, write into it"},
        {"--validate",
         "",
         "read the file and the mesh, check, report, do not solve"},
        {"--print-parameters",
         "",
         "print all entries with their values and meanings"},
        {"--help", "", "print this text (also -h)"},
        {"--version", "", "print the version"}};
      return list;
    }


    std::vector<std::string>
    option_names()
    {
      std::vector<std::string> names;
      for (const Option &option : options())
        names.push_back(option.name);
      return names;
    }


    const Option *
    find_option(const std::string &name)
    {
      for (const Option &option : options())
        if (option.name == name)
          return &option;
      return nullptr;
    }


    void
    set_switch(const std::string &name, CommandLine &command_line)
    {
      if (name == "--validate")
        command_line.validate = true;
      else if (name == "--print-parameters")
        command_line.print_parameters = true;
      else if (name == "--help")
        command_line.help = true;
      else if (name == "--version")
        command_line.version = true;
    }
  } // namespace


  CommandLine
  parse_command_line(const int argc, const char *const *argv)
  {
    CommandLine               command_line;
    Base::InputErrorCollector errors;
    for (int i = 1; i < argc; ++i)
      {
        const std::string argument = argv[i];
        if (argument.empty() || argument[0] != '-')
          {
            if (argument.empty())
              errors.add("an empty argument on the command line");
            else if (!command_line.parameter_file.empty())
              errors.add("command line\n  found two parameter files, '" +
                         command_line.parameter_file + "' and '" + argument +
                         "'; allowed: one");
            else
              command_line.parameter_file = argument;
            continue;
          }
        const std::size_t equals = argument.find('=');
        const std::string name =
          argument == "-h" ? "--help" : argument.substr(0, equals);
        const Option *option = find_option(name);
        if (option == nullptr)
          {
            errors.add("option '" + name + "' is not known" +
                       Base::did_you_mean(name, option_names()));
            continue;
          }
        if (option->value.empty())
          {
            if (equals != std::string::npos)
              errors.add("option '" + name + "'\n  found a value in '" +
                         argument + "'; allowed: '" + name + "' alone");
            set_switch(name, command_line);
            continue;
          }
        std::string value;
        if (equals != std::string::npos)
          value = argument.substr(equals + 1);
        else if (i + 1 < argc && find_option(argv[i + 1]) == nullptr)
          value = argv[++i];
        if (value.empty())
          errors.add("option '" + name + "'\n  found no value; allowed: " +
                     name + " " + option->value);
        else if (name == "--set")
          command_line.overrides.push_back(value);
        else if (name == "--resume")
          command_line.resume = value;
        else
          command_line.output = value;
      }
    const bool needs_file = !command_line.help && !command_line.version &&
                            !command_line.print_parameters;
    if (needs_file && command_line.parameter_file.empty() && errors.empty())
      errors.add("command line\n  found no parameter file; allowed: "
                 "perimorph FILE.prm [options]. See perimorph --help");
    if (!command_line.resume.empty() && !command_line.output.empty())
      errors.add(
        "command line\n  found --resume " + command_line.resume +
        " and --output " + command_line.output +
        "; allowed: one of them. A resumed run goes on in its folder.");
    errors.throw_if_any();
    return command_line;
  }


  std::string
  help_text()
  {
    std::string text =
      "Perimorph couples finite elements and peridynamics on one mesh.\n"
      "\n"
      "Usage: perimorph FILE.prm [options]\n"
      "       mpirun -np 4 perimorph FILE.prm [options]\n"
      "\n"
      "Options:\n";
    for (const Option &option : options())
      {
        std::string usage = "  " + option.name;
        if (!option.value.empty())
          usage += " " + option.value;
        usage.resize(std::max<std::size_t>(usage.size() + 2, 31), ' ');
        text += usage + option.text + "\n";
      }
    text += "\n"
            "Exit codes: 0 done, 2 bad input, 3 the solve failed.\n"
            "\n"
            "Example:\n"
            "  perimorph plate.prm --set \"Peridynamics/horizon ratio=3\" "
            "--output output/m3\n"
            "and, if it was stopped, with the same entries:\n"
            "  perimorph plate.prm --set \"Peridynamics/horizon ratio=3\" "
            "--resume output/m3\n";
    return text;
  }
} // namespace Perimorph::Parameters
