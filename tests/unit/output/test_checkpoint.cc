#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/output/checkpoint.h>
#include <perimorph/output/csv_writer.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

using namespace Perimorph;
using namespace Perimorph::Output;

namespace
{
  /// A folder of this process alone, gone at the end of the test.
  class CheckpointFile : public ::testing::Test
  {
  protected:
    CheckpointFile()
    {
      std::filesystem::create_directories(folder);
      checkpoint.numbers["third"] = 1. / 3.;
      checkpoint.numbers["smallest"] =
        std::numeric_limits<double>::denorm_min();
      checkpoint.numbers["infinite"] = std::numeric_limits<double>::infinity();
      checkpoint.numbers["missing"]  = std::nan("");
      checkpoint.arrays["none"]      = {};
      checkpoint.arrays["two"]       = {0.1, -1e300};
      checkpoint.words["lines"]      = {"a, \"b\"\n", "", "\xC3\xA4"};
    }
    ~CheckpointFile() override
    {
      std::filesystem::remove_all(folder);
    }

    std::string
    content() const
    {
      std::ifstream     stream(file, std::ios::binary);
      std::stringstream text;
      text << stream.rdbuf();
      return text.str();
    }

    void
    replace(const std::string &text) const
    {
      std::ofstream(file, std::ios::binary) << text;
    }

    std::string
    message() const
    {
      try
        {
          read_checkpoint(file);
        }
      catch (const Base::InputError &error)
        {
          return error.what();
        }
      return "";
    }

    const std::string folder =
      (std::filesystem::temp_directory_path() /
       ("perimorph_checkpoint_" + std::to_string(getpid())))
        .string();
    const std::string file = folder + "/checkpoint";
    Checkpoint        checkpoint;
  };
} // namespace

TEST_F(CheckpointFile, keeps_every_bit)
{
  write_checkpoint(file, checkpoint);
  const auto read = read_checkpoint(file);
  EXPECT_TRUE(std::isnan(read.numbers.at("missing")));
  for (const auto name : {"third", "smallest", "infinite"})
    EXPECT_EQ(read.numbers.at(name), checkpoint.numbers.at(name)) << name;
  EXPECT_EQ(read.numbers.size(), checkpoint.numbers.size());
  EXPECT_EQ(read.arrays, checkpoint.arrays);
  EXPECT_EQ(read.words, checkpoint.words);
}

TEST_F(CheckpointFile, replaces_the_earlier_one)
{
  write_checkpoint(file, checkpoint);
  checkpoint.numbers["third"] = 3.;
  write_checkpoint(file, checkpoint);
  EXPECT_EQ(read_checkpoint(file).numbers.at("third"), 3.);
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
}

TEST_F(CheckpointFile, stays_when_the_next_cannot_be_written)
{
  write_checkpoint(file, checkpoint);
  std::filesystem::create_directories(file + ".part/full");
  checkpoint.numbers["third"] = 3.;
  EXPECT_THROW(write_checkpoint(file, checkpoint), Base::InputError);
  EXPECT_EQ(read_checkpoint(file).numbers.at("third"), 1. / 3.);
}

TEST_F(CheckpointFile, notices_every_flipped_bit_and_every_length)
{
  write_checkpoint(file, checkpoint);
  const auto whole = content();
  ASSERT_EQ(message(), "");
  for (std::size_t k = 0; k < whole.size(); ++k)
    {
      auto flipped = whole;
      flipped[k]   = static_cast<char>(flipped[k] ^ 4);
      replace(flipped);
      EXPECT_NE(message(), "") << "byte " << k;
      replace(whole.substr(0, k));
      EXPECT_NE(message(), "") << "length " << k;
    }
  replace(whole + "x");
  EXPECT_NE(message().find("damaged"), std::string::npos);
}

TEST_F(CheckpointFile, names_what_is_missing)
{
  EXPECT_NE(message().find("checkpoint '" + file + "'\n  found no such file"),
            std::string::npos);
}

class ContinuedTable : public CheckpointFile
{};

TEST_F(ContinuedTable, goes_on_behind_the_rows_that_are_kept)
{
  const Base::Log log(MPI_COMM_SELF);
  std::uintmax_t  size = 0;
  {
    CsvWriter table(file, {"step", "word"}, log);
    table.write_row({1, "a,b"});
    size = table.size();
    table.write_row({2, "lost"});
  }
  check_table(file, size);
  cut_table(file, size);
  {
    CsvWriter table(file, {"step", "word"}, size, log);
    EXPECT_EQ(table.size(), size);
    table.write_row({2, "again"});
    EXPECT_EQ(table.size(), std::filesystem::file_size(file));
  }
  EXPECT_EQ(content(), "step,word\n1,\"a,b\"\n2,again\n");
}

TEST_F(ContinuedTable, must_be_there_and_long_enough)
{
  EXPECT_THROW(check_table(file, 0), Base::InputError);
  replace("step\n");
  EXPECT_NO_THROW(check_table(file, 5));
  EXPECT_THROW(check_table(file, 6), Base::InputError);
}
