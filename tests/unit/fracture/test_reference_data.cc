#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/reference_data.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;

  /// A file of this rank that disappears again.
  class TemporaryFile
  {
  public:
    explicit TemporaryFile(const std::string &text)
      : name(testing::TempDir() + "perimorph_reference_" +
             std::to_string(
               dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) +
             ".csv")
    {
      std::ofstream(name) << text;
    }
    ~TemporaryFile()
    {
      std::remove(name.c_str());
    }
    const std::string name;
  };

  /// The message for a file with this content, without its name.
  std::string
  message_for(const std::string &text)
  {
    const TemporaryFile file(text);
    try
      {
        read_reference_data<2>(file.name);
      }
    catch (const Base::InputError &error)
      {
        std::string message = error.what();
        const auto  found   = message.find(file.name);
        if (found != std::string::npos)
          message.replace(found, file.name.size(), "FILE");
        return message;
      }
    return "no exception";
  }

  TEST(ReferenceData, reads_columns_behind_comments)
  {
    const TemporaryFile file("# source: a book\n"
                             "\n"
                             "x, y, syy ,stt\r\n"
                             "# in between\n"
                             "0,1,2.5e1,-1\n"
                             "1, 2, 3, 4\n");
    const auto          data = read_reference_data<2>(file.name);
    ASSERT_EQ(data.points.size(), 2u);
    EXPECT_EQ(data.points[1][0], 1.);
    EXPECT_EQ(data.points[1][1], 2.);
    EXPECT_EQ(data.columns, (std::vector<std::string>{"syy", "stt"}));
    EXPECT_EQ(data.values[0], (std::vector<double>{25., 3.}));
    EXPECT_EQ(data.values[1], (std::vector<double>{-1., 4.}));
  }

  TEST(ReferenceData, reads_three_dimensions)
  {
    const TemporaryFile file("x,y,z,uz,syz\n1,2,3,4,5\n");
    const auto          data = read_reference_data<3>(file.name);
    EXPECT_EQ(data.points[0][2], 3.);
    EXPECT_EQ(data.values[1][0], 5.);
  }

  TEST(ReferenceData, gives_relative_errors)
  {
    ReferenceData<2> data;
    data.points  = {dealii::Point<2>(), dealii::Point<2>(1., 0.)};
    data.columns = {"syy", "ux"};
    data.values  = {{3., 4.}, {1., 0.}};
    ProbeTable table;
    table.columns     = {"x", "y", "ux", "syy"};
    table.rows        = {{0., 0., 1., 3.3}, {1., 0., 0., 4.4}};
    const auto errors = relative_errors(table, data);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].first, "syy");
    EXPECT_NEAR(errors[0].second, 0.1, 1e-12);
    EXPECT_EQ(errors[1].second, 0.);
  }

  TEST(ReferenceData, names_a_missing_file)
  {
    try
      {
        read_reference_data<2>("no_such_file.csv");
        FAIL() << "no exception";
      }
    catch (const Base::InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find("no_such_file.csv"),
                  std::string::npos);
      }
  }

  TEST(ReferenceData, names_a_bad_column)
  {
    EXPECT_EQ(message_for("# c\nx,y,sttt\n0,0,1\n"),
              "Error: reference file FILE:2\n"
              "  found the column 'sttt'; allowed: ux, uy, sxx, syy, szz, sxy, "
              "stt. Did you mean 'stt'?");
    EXPECT_NE(message_for("x,y,uz\n").find("found the column 'uz'"),
              std::string::npos);
    EXPECT_NE(message_for("x,y,ux,ux\n").find("'ux' twice"), std::string::npos);
    EXPECT_NE(message_for("x,syy,y\n").find("allowed: x, y, then"),
              std::string::npos);
    EXPECT_NE(message_for("x,y\n0,0\n").find("at least one of"),
              std::string::npos);
  }

  TEST(ReferenceData, names_a_cell_that_is_no_number)
  {
    EXPECT_EQ(message_for("x,y,sxx\n0,0,1\n0,1,2 MPa\n"),
              "Error: reference file FILE:3\n"
              "  found '2 MPa' in column 'sxx'; allowed: a number");
    EXPECT_NE(message_for("x,y,sxx\n0,0,\n").find("found '' in column 'sxx'"),
              std::string::npos);
  }

  TEST(ReferenceData, names_a_line_of_wrong_length)
  {
    EXPECT_EQ(message_for("x,y,sxx\n0,0\n"),
              "Error: reference file FILE:2\n"
              "  found 2 cells; allowed: 3 cells, one for each of x, y, sxx");
  }

  TEST(ReferenceData, refuses_what_cannot_be_compared)
  {
    EXPECT_NE(message_for("x,y,ux\n").find("no line with numbers"),
              std::string::npos);
    EXPECT_NE(message_for("# nothing\n").find("no line with names"),
              std::string::npos);
    EXPECT_NE(message_for("x,y,ux\n0,0,0\n1,0,0\n").find("zero everywhere"),
              std::string::npos);
  }
} // namespace
