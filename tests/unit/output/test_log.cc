#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/base/progress.h>
#include <perimorph/base/timing.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <thread>

using namespace Perimorph;

namespace
{
  std::string
  contents(const std::string &filename)
  {
    std::ifstream     file(filename);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }


  void
  wait_milliseconds(const int n)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(n));
  }


  bool
  is_root()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }
} // namespace


TEST(Log, OnlyRankZeroSpeaks)
{
  std::ostringstream console;
  Base::Log          log(MPI_COMM_WORLD, console);
  log << "step " << 3 << ", load " << std::setprecision(3) << 0.12345
      << std::endl;
  EXPECT_EQ(console.str(), is_root() ? "step 3, load 0.123\n" : "");
  EXPECT_EQ(log.is_active(), is_root());
}


TEST(Log, FileHoldsWhatWasSaidBeforeItWasOpened)
{
  const std::string  filename = std::to_string(getpid()) + "_log.txt";
  std::ostringstream console;
  {
    Base::Log log(MPI_COMM_SELF, console);
    log << "early\n";
    if (is_root())
      {
        log.open(filename);
        log << "late\n";
        // each line is in the file at once, not only when the log ends
        EXPECT_EQ(contents(filename), "early\nlate\n");
        std::remove(filename.c_str());
      }
  }
}


TEST(Log, FileThatCannotBeWrittenIsAnInputError)
{
  std::ostringstream console;
  Base::Log          log(MPI_COMM_SELF, console);
  EXPECT_THROW(log.open("no_such_folder/log.txt"), Base::InputError);
}


TEST(Log, WarningIsPrintedOnALineOfItsOwnAndKeptOnce)
{
  std::ostringstream console;
  Base::Log          log(MPI_COMM_SELF, console);
  log << "half a line";
  log.warning("the mesh is coarse");
  log.warning("the mesh is coarse");
  log.warning("second");
  EXPECT_EQ(console.str(),
            "half a line\nWarning: the mesh is coarse\nWarning: second\n");
  EXPECT_EQ(log.warnings(),
            std::vector<std::string>({"the mesh is coarse", "second"}));
}


TEST(Progress, ShortStageIsSilent)
{
  std::ostringstream console;
  Base::Log          log(MPI_COMM_SELF, console);
  Base::Progress     progress(log, "Family search", 100);
  for (unsigned int i = 0; i <= 100; ++i)
    progress.update(i);
  EXPECT_EQ(console.str(), "");
}


TEST(Progress, LongStagePrintsOneLinePerInterval)
{
  std::ostringstream console;
  Base::Log          log(MPI_COMM_SELF, console);
  Base::Progress     progress(log, "Family search", 4, 0.02);
  progress.update(1);
  EXPECT_EQ(console.str(), "");
  wait_milliseconds(25);
  progress.update(2);
  progress.update(2);
  EXPECT_EQ(console.str(), "  Family search: 50 %, 0 s, about 0 s left\n");
  progress.update(4);
  progress.update(4);
  EXPECT_EQ(console.str(),
            "  Family search: 50 %, 0 s, about 0 s left\n"
            "  Family search: 100 %, 0 s\n");
}


TEST(Timing, NestedSectionsCountTheirWholeTimeOnce)
{
  Base::Timing timing(MPI_COMM_SELF);
  {
    const auto outer = timing.scope("setup");
    const auto inner = timing.scope("assembly");
    const auto again = timing.scope("setup");
    wait_milliseconds(20);
  }
  EXPECT_GE(timing.seconds("assembly"), 0.019);
  EXPECT_GE(timing.seconds("setup"), timing.seconds("assembly"));
  EXPECT_LE(timing.seconds("setup"), timing.seconds("total"));
  EXPECT_EQ(timing.seconds("damage"), 0.);
}


TEST(Timing, TableHoldsTheSlowestRankAndSectionsOfSomeRanks)
{
  Base::Timing timing(MPI_COMM_WORLD);
  {
    const auto common = timing.scope("setup");
    wait_milliseconds(is_root() ? 1 : 30);
  }
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == n_ranks - 1)
    {
      const auto only_last = timing.scope("output");
    }
  const auto table = timing.table();
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[0].first, "setup");
  EXPECT_EQ(table[1].first, "output");
  EXPECT_EQ(table[2].first, "total");
  EXPECT_GE(table[0].second, n_ranks > 1 ? 0.029 : 0.001);

  std::ostringstream console;
  Base::Log          log(MPI_COMM_WORLD, console);
  timing.print(log, table);
  EXPECT_EQ(console.str().find("setup") != std::string::npos, is_root());
}


TEST(Timing, PeakMemoryOfAllRanksIsTheSum)
{
  const auto memory = Base::peak_memory(MPI_COMM_WORLD);
  EXPECT_GT(memory.max_mb, 10.);
  EXPECT_GE(memory.sum_mb, memory.max_mb);
  EXPECT_LE(memory.sum_mb,
            memory.max_mb * (1e-12 + dealii::Utilities::MPI::n_mpi_processes(
                                       MPI_COMM_WORLD)));
}
