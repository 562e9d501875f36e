#pragma once

#include <perimorph/fem/node_partition.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Perimorph::Fem
{
  /// A vector of unknowns complete on every rank, one entry per node.
  /// Collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  to_nodal_values(const Vector &vector, const NodePartition<dim> &partition);

  /// Sets the owned entries of a vector; the values are complete on every rank.
  template <int dim>
  void
  set_nodal_values(const std::vector<dealii::Tensor<1, dim>> &values,
                   const NodePartition<dim>                  &partition,
                   Vector                                    &vector);

  /// Hands forces on hanging nodes to their parents, whose motion they follow.
  /// On return owned entries are complete. Collective.
  template <int dim>
  void
  condense_hanging(const Mesh::HangingPoints &hanging,
                   const NodePartition<dim>  &partition,
                   Vector                    &force);
} // namespace Perimorph::Fem
