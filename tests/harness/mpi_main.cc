#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <iostream>
#include <memory>
#include <sstream>
#include <string>

namespace
{
  /// Prints only failures, each with the number of its rank.
  class FailurePrinter : public testing::EmptyTestEventListener
  {
  public:
    explicit FailurePrinter(const unsigned int rank)
      : rank(rank)
    {}

    void
    OnTestStart(const testing::TestInfo &test) override
    {
      // kept, because asking for it while a failure is reported locks up
      test_name = std::string(test.test_suite_name()) + "." + test.name();
    }

    void
    OnTestPartResult(const testing::TestPartResult &result) override
    {
      if (!result.failed())
        return;

      // one piece, so that the lines of two ranks do not mix
      std::ostringstream message;
      message << "[rank " << rank << "] " << test_name << ", "
              << (result.file_name() ? result.file_name() : "unknown file")
              << ":" << result.line_number() << "\n"
              << result.message() << "\n";
      std::cout << message.str() << std::flush;
    }

  private:
    const unsigned int rank;
    std::string        test_name = "outside of a test";
  };
} // namespace

/// Runs all tests on every rank. Rank 0 prints as usual, the others only their
/// failures; the exit code is the worst of all ranks.
int
main(int argc, char **argv)
{
  // before MPI: libraries behind it would complain about the test options
  testing::InitGoogleTest(&argc, argv);
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int                             rank =
    dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);

  if (rank != 0)
    {
      testing::TestEventListeners &listeners =
        testing::UnitTest::GetInstance()->listeners();
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(std::make_unique<FailurePrinter>(rank).release());
    }

  const int result = RUN_ALL_TESTS();
  return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
}
