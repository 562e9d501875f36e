#pragma once

#include <perimorph/fem/boundary_conditions.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/distributed_mesh.h>

#include <functional>
#include <vector>

namespace Perimorph::Fem
{
  /// Value of given components; zero for the others.
  template <int dim>
  dealii::Tensor<1, dim>
  value_of(const ComponentExpressions<dim> &components,
           const dealii::Point<dim>        &point,
           const double                     time)
  {
    dealii::Tensor<1, dim> value;
    for (int d = 0; d < dim; ++d)
      if (components[d])
        value[d] = components[d]->value(point, time);
    return value;
  }

  /// Cell, its geometry, one of its Gauss points and the force density there
  /// [force / volume].
  template <int dim>
  using BodyForceVisitor = std::function<void(unsigned int,
                                              const Mesh::CellGeometry<dim> &,
                                              unsigned int,
                                              const dealii::Tensor<1, dim> &)>;

  /// Visits the Gauss points of all cells under a body force, once for each
  /// force.
  /// @param everywhere  also cells of other ranks
  template <int dim>
  void
  for_each_body_force(const Mesh::DistributedMesh<dim>  &mesh,
                      const std::vector<BodyForce<dim>> &forces,
                      double                             time,
                      bool                               everywhere,
                      const BodyForceVisitor<dim>       &visit);

  /// Force density at all nodes [force / volume], the same on every rank: mean
  /// over the cells at a node, weighted with its shape function, so that
  /// expressions are evaluated at the points of the loads only. No forces:
  /// empty.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  body_force_density(const Mesh::DistributedMesh<dim>  &mesh,
                     const std::vector<BodyForce<dim>> &forces,
                     double                             time);
} // namespace Perimorph::Fem
