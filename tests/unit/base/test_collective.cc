#include <perimorph/base/collective.h>
#include <perimorph/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace Perimorph::Base;

namespace
{
  /// Runs an action that fails on the last rank only.
  template <typename Error>
  void
  fail_on_last_rank(const char *message)
  {
    namespace MPI = dealii::Utilities::MPI;
    collectively(MPI_COMM_WORLD, [&]() {
      if (MPI::this_mpi_process(MPI_COMM_WORLD) + 1 ==
          MPI::n_mpi_processes(MPI_COMM_WORLD))
        throw Error(message);
    });
  }
} // namespace

TEST(Collectively, is_silent_when_nothing_fails)
{
  EXPECT_NO_THROW(collectively(MPI_COMM_WORLD, []() {}));
}

TEST(Collectively, carries_the_kind_of_error_to_all_ranks)
{
  EXPECT_THROW(fail_on_last_rank<InputError>("entry"), InputError);
  EXPECT_THROW(fail_on_last_rank<InadmissibleState>("state"),
               InadmissibleState);
  EXPECT_THROW(fail_on_last_rank<SolveError>("step"), SolveError);
  EXPECT_THROW(fail_on_last_rank<std::runtime_error>("other"), SolveError);
}

TEST(Collectively, distinguishes_inadmissible_states_from_other_failures)
{
  try
    {
      fail_on_last_rank<SolveError>("step 3");
      FAIL() << "nothing thrown";
    }
  catch (const InadmissibleState &)
    {
      FAIL() << "wrong kind of error";
    }
  catch (const SolveError &error)
    {
      EXPECT_STREQ(error.what(), "step 3");
    }
}

TEST(Collectively, carries_the_message_of_an_inadmissible_state)
{
  try
    {
      fail_on_last_rank<InadmissibleState>("J = -1");
      FAIL() << "nothing thrown";
    }
  catch (const InadmissibleState &error)
    {
      EXPECT_STREQ(error.what(), "J = -1");
    }
}
