#include <perimorph/application/run.h>

#include <deal.II/base/mpi.h>

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return Perimorph::Application::run_program(argc, argv, MPI_COMM_WORLD);
}
