#include <perimorph/solvers/motion_state.h>

#include <deal.II/base/mpi.h>

namespace Perimorph::Solvers
{
  template <int dim>
  Fem::Vector
  mass_of_unknowns(const Fem::NodePartition<dim> &partition,
                   const std::vector<double>     &mass)
  {
    Fem::Vector result;
    partition.initialize(result);
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      for (int d = 0; d < dim; ++d)
        result.local_element(dim * n + d) = mass[partition.global(n)];
    return result;
  }

  template <int dim>
  double
  kinetic_energy(const Fem::NodePartition<dim> &partition,
                 const std::vector<double>     &mass,
                 const Fem::Vector             &velocity)
  {
    double sum = 0.;
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      for (int d = 0; d < dim; ++d)
        sum += 0.5 * mass[partition.global(n)] *
               velocity.local_element(dim * n + d) *
               velocity.local_element(dim * n + d);
    return dealii::Utilities::MPI::sum(sum, partition.communicator());
  }

#define PERIMORPH_INSTANTIATE(dim)                                            \
  template Fem::Vector mass_of_unknowns<dim>(const Fem::NodePartition<dim> &, \
                                             const std::vector<double> &);    \
  template double      kinetic_energy<dim>(const Fem::NodePartition<dim> &,   \
                                      const std::vector<double> &,       \
                                      const Fem::Vector &);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Solvers
