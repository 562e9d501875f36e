#pragma once

#include <mpi.h>

namespace Perimorph::Application
{
  /// The whole program: command line, parameters, run.
  /// @return exit code: 0 done, 2 bad input, 3 the solve failed
  int
  run_program(int argc, char **argv, MPI_Comm communicator);
} // namespace Perimorph::Application
