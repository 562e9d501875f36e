#pragma once

#include <mpi.h>

#include <functional>

namespace Perimorph::Base
{
  /// Runs an action on every rank and makes a failure of any of them the
  /// failure of all: the error of the lowest failing rank is thrown everywhere,
  /// so that no rank waits for one that gave up. Collective; the action must
  /// not communicate after it has failed on some ranks only.
  /// @throws InputError, InadmissibleState; SolveError for any other exception
  void
  collectively(MPI_Comm communicator, const std::function<void()> &action);
} // namespace Perimorph::Base
