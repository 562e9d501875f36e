#include <perimorph/application/post_processing.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Perimorph::Application
{
  namespace
  {
    /// Calls an action for every number of a stress.
    template <int dim, typename Action>
    void
    for_each_number(Fracture::Stress<dim> &stress,
                    const bool             finite_strain,
                    const Action          &action)
    {
      for (unsigned int c = 0; c < dim * (dim + 1) / 2; ++c)
        action(stress.in_plane.access_raw_entry(c));
      action(stress.out_of_plane);
      if (!finite_strain)
        return;
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          action(stress.first_piola_kirchhoff[a][b]);
      for (unsigned int c = 0; c < 6; ++c)
        action(stress.kirchhoff.access_raw_entry(c));
      for (unsigned int c = 0; c < 6; ++c)
        action(stress.logarithmic_strain.access_raw_entry(c));
    }

    template <int dim>
    std::vector<double>
    pack(Fracture::Stress<dim> stress, const bool finite_strain)
    {
      std::vector<double> numbers;
      for_each_number(stress, finite_strain, [&](const double number) {
        numbers.push_back(number);
      });
      return numbers;
    }

    template <int dim>
    Fracture::Stress<dim>
    unpack(const double *numbers, const bool finite_strain)
    {
      Fracture::Stress<dim> stress;
      for_each_number(stress, finite_strain, [&](double &number) {
        number = *numbers++;
      });
      return stress;
    }
  } // namespace

  template <int dim>
  std::vector<Fracture::Stress<dim>>
  PostProcessing<dim>::nodal_stress(
    const State<dim>                                    &state,
    const std::function<void(std::size_t, std::size_t)> &progress) const
  {
    const auto at_rest = [](const dealii::Tensor<1, dim> &u) {
      return u == dealii::Tensor<1, dim>();
    };
    if (std::all_of(state.displacement.begin(),
                    state.displacement.end(),
                    at_rest))
      return std::vector<Fracture::Stress<dim>>(state.displacement.size());
    const auto &nodal = mesh.nodal();
    // Complete arrays by adding zeros from the other ranks.
    const unsigned int n_components =
      pack(Fracture::Stress<dim>(), parameters.finite_strain()).size();
    std::vector<double> values(n_components * nodal.n_nodes(), 0.);
    for (unsigned int n = nodal.owned_begin; n < nodal.owned_end; ++n)
      {
        const auto packed = pack(recovery->at_node(n, state.displacement),
                                 parameters.finite_strain());
        std::copy(packed.begin(),
                  packed.end(),
                  values.begin() + n_components * n);
        if ((n - nodal.owned_begin) % 1000 == 0)
          progress(n - nodal.owned_begin, nodal.owned_end - nodal.owned_begin);
      }
    if (dealii::Utilities::MPI::n_mpi_processes(mesh.communicator()) > 1)
      dealii::Utilities::MPI::sum(values, mesh.communicator(), values);
    std::vector<Fracture::Stress<dim>> all(nodal.n_nodes());
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      all[n] = unpack<dim>(values.data() + n_components * n,
                           parameters.finite_strain());
    return all;
  }

  template std::vector<Fracture::Stress<2>>
  PostProcessing<2>::nodal_stress(
    const State<2> &,
    const std::function<void(std::size_t, std::size_t)> &) const;
  template std::vector<Fracture::Stress<3>>
  PostProcessing<3>::nodal_stress(
    const State<3> &,
    const std::function<void(std::size_t, std::size_t)> &) const;
} // namespace Perimorph::Application
