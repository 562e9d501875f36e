#include <perimorph/parameters/patterns.h>
#include <perimorph/parameters/reader.h>

#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace Perimorph;
using namespace Perimorph::Parameters;

namespace
{
  /// A small set of entries, a text read into it, and the messages.
  class Reader : public testing::Test
  {
  protected:
    Reader()
    {
      using namespace dealii::Patterns;
      prm.add_parameter("Mode",
                        mode,
                        "",
                        Selection("coupled|finite elements|peridynamics"));
      prm.add_parameter("Title", title);
      prm.enter_subsection("Mesh");
      prm.add_parameter("file", mesh_file);
      prm.leave_subsection();
      prm.enter_subsection("Material");
      prm.add_parameter("Young's modulus", modulus, "", PositiveDouble());
      prm.leave_subsection();
      prm.enter_subsection("Peridynamics");
      prm.add_parameter("horizon ratio", ratio, "", OpenDouble(1.));
      prm.add_parameter("around", around);
      prm.leave_subsection();
    }

    const std::vector<std::string> &
    read(const std::string &text)
    {
      read_text(text, "a.prm", prm, errors);
      return errors.messages();
    }

    void
    expect_only(const std::string &text, const std::string &message)
    {
      ASSERT_EQ(read(text).size(), 1u) << text;
      EXPECT_EQ(errors.messages()[0], message);
    }

    dealii::ParameterHandler  prm;
    Base::InputErrorCollector errors;
    std::string               mode = "coupled";
    std::string               title;
    std::string               mesh_file;
    std::string               around;
    double                    modulus = 1.;
    double                    ratio   = 3.;
  };
} // namespace

TEST_F(Reader, sets_values_and_runs_their_actions)
{
  EXPECT_TRUE(read("# a case\n"
                   "set Mode = finite elements # pure\n"
                   "SUBSECTION Material\r\n"
                   "  set   Young's   modulus=192e3\r\n"
                   "END\n")
                .empty());
  EXPECT_EQ(mode, "finite elements");
  EXPECT_EQ(modulus, 192e3);
  EXPECT_EQ(prm.get("Mode"), "finite elements");
}

TEST_F(Reader, joins_continued_lines)
{
  read("subsection Peridynamics\n"
       " set around = hole; \\\n"
       "     point 0 0; \\  # a comment\n"
       "     # nothing here \\\n"
       " set horizon ratio = 0\n"
       "end\n");
  EXPECT_EQ(around, "hole; point 0 0;");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors.messages()[0],
            "parameter 'Peridynamics / horizon ratio' in a.prm:5\n"
            "  found '0'; allowed: a number > 1");
}

TEST_F(Reader, collects_all_errors_and_sets_the_rest)
{
  EXPECT_EQ(read("set Mode = couple\n"
                 "set Titel = a\n"
                 "subsection Material\n"
                 "  set Young's modulus = -1\n"
                 "end\n"
                 "subsection Mesh\n"
                 "  set file = a.msh\n"
                 "end\n")
              .size(),
            3u);
  EXPECT_EQ(mode, "coupled");
  EXPECT_EQ(modulus, 1.);
  EXPECT_EQ(mesh_file, "a.msh");
}

TEST_F(Reader, names_the_nearest_choice)
{
  expect_only("set Mode = Couple",
              "parameter 'Mode' in a.prm:1\n  found 'Couple'; allowed: "
              "coupled, finite elements, peridynamics. Did you mean "
              "'coupled'?");
}

TEST_F(Reader, names_an_empty_value)
{
  expect_only("set Mode =",
              "parameter 'Mode' in a.prm:1\n  found nothing; allowed: "
              "coupled, finite elements, peridynamics");
}

TEST_F(Reader, names_the_nearest_section)
{
  expect_only("set Title = a\n"
              "subsection Materail\n"
              "  set Young's modulus = 2\n"
              "  subsection Any\n"
              "  end\n"
              "end\n",
              "section 'Materail' in a.prm:2 is not known; did you mean "
              "'Material'? It has: Mesh, Material, Peridynamics");
}

TEST_F(Reader, names_the_nearest_entry)
{
  expect_only("subsection Peridynamics\n set horizon rati = 2\nend",
              "entry 'horizon rati' in a.prm:2 is not known in section "
              "'Peridynamics'; did you mean 'horizon ratio'? It has: horizon "
              "ratio, around");
}

TEST_F(Reader, says_where_an_entry_belongs)
{
  expect_only("subsection Mesh\n set horizon ratio = 2\nend",
              "entry 'horizon ratio' in a.prm:2 is not known in section "
              "'Mesh'; entry 'horizon ratio' belongs in section "
              "'Peridynamics'");
}

TEST_F(Reader, finds_near_entries_of_other_sections)
{
  expect_only("set horizon_ratio = 2",
              "entry 'horizon_ratio' in a.prm:1 is not known in the top "
              "level; did you mean 'horizon ratio' in section "
              "'Peridynamics'?");
}

TEST_F(Reader, reports_a_missing_end_before_a_section)
{
  expect_only("subsection Mesh\n"
              " set file = a\n"
              "subsection Material\n"
              " set Young's modulus = 7\n"
              "end\n",
              "section 'Mesh' opened in a.prm:1 has no 'end' before "
              "'subsection Material' in line 3");
  EXPECT_EQ(modulus, 7.);
}

TEST_F(Reader, reports_a_missing_end_at_the_end)
{
  expect_only("subsection Mesh\n set file = a\n",
              "section 'Mesh' opened in a.prm:1 has no 'end' before the end "
              "of the file");
}

TEST_F(Reader, reports_an_end_too_many)
{
  expect_only("set Title = a\nend\n",
              "line a.prm:2\n  found 'end', but no subsection is open; "
              "allowed: one 'end' for each 'subsection'");
}

TEST_F(Reader, reports_a_missing_equals_sign)
{
  expect_only("set Mode coupled",
              "line a.prm:1\n  found 'set Mode coupled' without '='; "
              "allowed: set NAME = VALUE");
}

TEST_F(Reader, reports_other_statements)
{
  expect_only("Mode = coupled",
              "line a.prm:1\n  found 'Mode = coupled'; allowed: set NAME = "
              "VALUE, subsection NAME, end, or a comment behind #. Is 'set' "
              "missing?");
}

TEST_F(Reader, reports_an_entry_set_twice)
{
  expect_only("set Title = a\n\nset Title = b",
              "parameter 'Title' in a.prm:3\n  found a second time, first in "
              "line 1; allowed: once in a file");
  EXPECT_EQ(title, "a");
}

TEST_F(Reader, reports_two_assignments_in_a_line)
{
  expect_only("subsection Peridynamics\n"
              " set around = hole  set horizon ratio = 2\n"
              "end",
              "parameter 'Peridynamics / around' in a.prm:2\n  found 'set "
              "horizon ratio' in the same line; allowed: one 'set' per line");
}

TEST_F(Reader, reports_a_file_without_entries)
{
  expect_only("# nothing\n",
              "parameter file a.prm\n  found no 'set' in it; allowed: lines "
              "'set NAME = VALUE' in 'subsection NAME' ... 'end'");
}

TEST_F(Reader, reports_binary_data)
{
  expect_only(std::string("set Mode\0= coupled", 18),
              "parameter file a.prm\n  found binary data; allowed: a text "
              "file. Is it another file than you meant?");
}

TEST_F(Reader, skips_a_byte_order_mark)
{
  EXPECT_TRUE(read("\xEF\xBB\xBFset Title = a").empty());
  EXPECT_EQ(title, "a");
}

TEST_F(Reader, remembers_where_a_value_came_from)
{
  read("\n\nsubsection Peridynamics\n set around = nowhere\nend");
  errors.add_parameter("Peridynamics / around", "'nowhere'", "hole");
  EXPECT_EQ(errors.messages()[0],
            "parameter 'Peridynamics / around' in a.prm:4\n  found "
            "'nowhere'; allowed: hole");
}

TEST_F(Reader, reports_files_that_cannot_be_read)
{
  const std::string folder = testing::TempDir() + "perimorph_reader";
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/plate.prm") << "set Title = b\n";
  read_file(folder + "/plate.prm", prm, errors);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(title, "b");
  read_file(folder + "/plat.prm", prm, errors);
  read_file(folder, prm, errors);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors.messages()[0],
            "parameter file " + folder +
              "/plat.prm does not exist; did you mean 'plate.prm'?");
  EXPECT_EQ(errors.messages()[1],
            "parameter file " + folder +
              "\n  found a folder; allowed: a text file");
  std::filesystem::remove_all(folder);
}

TEST_F(Reader, lists_all_declared_entries)
{
  const auto entries = list_entries(prm);
  ASSERT_EQ(entries.size(), 6u);
  EXPECT_EQ(entries[0].path(), "Mode");
  EXPECT_EQ(entries[3].path(), "Material / Young's modulus");
  EXPECT_EQ(entries[3].default_value, "1");
}
