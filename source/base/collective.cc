#include <perimorph/base/collective.h>
#include <perimorph/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <string>
#include <vector>

namespace Perimorph::Base
{
  void
  collectively(MPI_Comm communicator, const std::function<void()> &action)
  {
    enum Outcome
    {
      fine,
      bad_input,
      inadmissible_state,
      failed_solve
    };
    int                      outcome = fine;
    std::vector<std::string> messages;
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        outcome  = bad_input;
        messages = error.messages();
      }
    catch (const InadmissibleState &error)
      {
        outcome  = inadmissible_state;
        messages = {error.what()};
      }
    catch (const std::exception &error)
      {
        outcome  = failed_solve;
        messages = {error.what()};
      }
    namespace MPI           = dealii::Utilities::MPI;
    const unsigned int size = MPI::n_mpi_processes(communicator);
    const unsigned int rank = MPI::this_mpi_process(communicator);
    const unsigned int first =
      MPI::min(outcome == fine ? size : rank, communicator);
    if (first == size)
      return;
    outcome  = MPI::broadcast(communicator, outcome, first);
    messages = MPI::broadcast(communicator, messages, first);
    if (outcome == bad_input)
      throw InputError(messages);
    if (outcome == inadmissible_state)
      throw InadmissibleState(messages.front());
    throw SolveError(messages.front());
  }
} // namespace Perimorph::Base
