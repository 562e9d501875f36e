#include <perimorph/fem/nodal_values.h>

#include <deal.II/base/mpi.h>

namespace Perimorph::Fem
{
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  to_nodal_values(const Vector &vector, const NodePartition<dim> &partition)
  {
    std::vector<double> values(vector.size(), 0.);
    const auto first = dim * static_cast<std::size_t>(partition.n_owned() > 0
                                                        ? partition.global(0)
                                                        : 0);
    for (unsigned int k = 0; k < dim * partition.n_owned(); ++k)
      values[first + k] = vector.local_element(k);
    if (dealii::Utilities::MPI::n_mpi_processes(partition.communicator()) > 1)
      dealii::Utilities::MPI::sum(values, partition.communicator(), values);
    std::vector<dealii::Tensor<1, dim>> nodal(values.size() / dim);
    for (std::size_t n = 0; n < nodal.size(); ++n)
      for (int d = 0; d < dim; ++d)
        nodal[n][d] = values[dim * n + d];
    return nodal;
  }

  template <int dim>
  void
  set_nodal_values(const std::vector<dealii::Tensor<1, dim>> &values,
                   const NodePartition<dim>                  &partition,
                   Vector                                    &vector)
  {
    vector.zero_out_ghost_values();
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      for (int d = 0; d < dim; ++d)
        vector.local_element(dim * n + d) = values[partition.global(n)][d];
  }

  template <int dim>
  void
  condense_hanging(const Mesh::HangingPoints &hanging,
                   const NodePartition<dim>  &partition,
                   Vector                    &force)
  {
    if (hanging.empty())
      return;
    force.zero_out_ghost_values();
    const auto &owned = partition.owned_dofs();
    for (const auto &[node, parents] : hanging)
      if (owned.is_element(dim * node))
        for (int d = 0; d < dim; ++d)
          {
            double &value =
              force.local_element(dim * partition.local(node) + d);
            for (const auto &[parent, weight] : parents)
              force.local_element(dim * partition.local(parent) + d) +=
                weight * value;
            value = 0.;
          }
    force.compress(dealii::VectorOperation::add);
  }

#define PERIMORPH_INSTANTIATE(dim)                                            \
  template std::vector<dealii::Tensor<1, dim>> to_nodal_values(               \
    const Vector &,                                                           \
    const NodePartition<dim> &);                                              \
  template void set_nodal_values(const std::vector<dealii::Tensor<1, dim>> &, \
                                 const NodePartition<dim> &,                  \
                                 Vector &);                                   \
  template void condense_hanging(const Mesh::HangingPoints &,                 \
                                 const NodePartition<dim> &,                  \
                                 Vector &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Fem
