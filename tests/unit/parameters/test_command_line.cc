#include <perimorph/base/exceptions.h>
#include <perimorph/parameters/command_line.h>

#include <gtest/gtest.h>

using namespace Perimorph;
using namespace Perimorph::Parameters;

namespace
{
  CommandLine
  parse(std::vector<const char *> arguments)
  {
    arguments.insert(arguments.begin(), "perimorph");
    return parse_command_line(static_cast<int>(arguments.size()),
                              arguments.data());
  }

  std::string
  message(const std::vector<const char *> &arguments)
  {
    try
      {
        parse(arguments);
      }
    catch (const Base::InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(CommandLine, reads_all_options)
{
  const CommandLine line = parse({"--set",
                                  "Mesh/file=a.msh",
                                  "plate.prm",
                                  "--set=Mode=coupled",
                                  "--output",
                                  "results",
                                  "--validate",
                                  "--print-parameters"});
  EXPECT_EQ(line.parameter_file, "plate.prm");
  EXPECT_EQ(line.overrides,
            (std::vector<std::string>{"Mesh/file=a.msh", "Mode=coupled"}));
  EXPECT_EQ(line.output, "results");
  EXPECT_TRUE(line.validate);
  EXPECT_TRUE(line.print_parameters);
  EXPECT_FALSE(line.help);
}

TEST(CommandLine, needs_no_file_for_help)
{
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(parse({"-h"}).help);
  EXPECT_TRUE(parse({"--version"}).version);
  EXPECT_TRUE(parse({"--print-parameters"}).print_parameters);
}

TEST(CommandLine, wants_a_file)
{
  EXPECT_EQ(message({}),
            "Error: command line\n  found no parameter file; allowed: "
            "perimorph FILE.prm [options]. See perimorph --help");
  EXPECT_NE(message({"--validate"}), "");
}

TEST(CommandLine, wants_one_file)
{
  EXPECT_EQ(message({"a.prm", "b.prm"}),
            "Error: command line\n  found two parameter files, 'a.prm' and "
            "'b.prm'; allowed: one");
}

TEST(CommandLine, names_the_nearest_option)
{
  EXPECT_EQ(message({"a.prm", "--validat"}),
            "Error: option '--validat' is not known; did you mean "
            "'--validate'? It has: --set, --output, --resume, --validate, "
            "--print-parameters, --help, --version");
}

TEST(CommandLine, wants_values)
{
  EXPECT_EQ(message({"a.prm", "--output"}),
            "Error: option '--output'\n  found no value; allowed: --output "
            "DIR");
  EXPECT_EQ(message({"a.prm", "--set", "--validate"}),
            "Error: option '--set'\n  found no value; allowed: --set "
            "\"Section/entry=value\"");
}

TEST(CommandLine, resumes_in_one_folder)
{
  EXPECT_EQ(parse({"a.prm", "--resume", "out"}).resume, "out");
  EXPECT_EQ(message({"a.prm", "--resume", "out", "--output=other"}),
            "Error: command line\n  found --resume out and --output other; "
            "allowed: one of them. A resumed run goes on in its folder.");
}

TEST(CommandLine, refuses_values_of_switches)
{
  EXPECT_EQ(message({"a.prm", "--validate=yes"}),
            "Error: option '--validate'\n  found a value in "
            "'--validate=yes'; allowed: '--validate' alone");
}

TEST(CommandLine, help_lists_options_and_exit_codes)
{
  const std::string text = help_text();
  for (const std::string part : {"Usage: perimorph FILE.prm",
                                 "--set \"Section/entry=value\"",
                                 "--output DIR",
                                 "--resume DIR",
                                 "--validate",
                                 "--print-parameters",
                                 "--version",
                                 "Exit codes: 0 done, 2 bad input"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}
