#pragma once

#include <perimorph/fem/boundary_conditions.h>
#include <perimorph/fem/node_partition.h>
#include <perimorph/mesh/distributed_mesh.h>

namespace Perimorph::Fem
{
  /// External forces of a load step: surface, body and point forces, lumped
  /// with the finite-element shape functions (pressures that follow the
  /// surface are FollowerPressure's). Nodes of peridynamic surfaces are
  /// loaded the same way: the consistent internal forces balance exactly these.
  template <int dim>
  class Loads
  {
  public:
    /// @param times  all times of the run; every expression is evaluated once
    /// at
    ///               each of its points, so that bad input is found early
    /// @throws Base::InputError  boundary or volume not in the mesh, values
    ///         that are not finite, a point outside the body
    Loads(const Mesh::DistributedMesh<dim> &mesh,
          const BoundaryConditions<dim>    &conditions,
          const std::vector<double>        &times);

    /// Adds the forces at a time to the nodes; entries of other ranks' nodes
    /// included, so compress() afterwards.
    void
    add_forces(double                    time,
               const NodePartition<dim> &partition,
               Vector                   &forces) const;

    bool
    depend_on_time() const;

    bool
    empty() const;

    const std::vector<SurfaceLoad<dim>> &
    surface_loads() const
    {
      return conditions.surface_loads;
    }

    /// Nodes with a point force.
    const std::vector<unsigned int> &
    loaded_points() const
    {
      return point_force_nodes;
    }

  private:
    template <typename Add>
    void
    for_each_force(double time, const Add &add) const;

    const Mesh::DistributedMesh<dim> &mesh;
    BoundaryConditions<dim>           conditions;
    std::vector<unsigned int>         point_force_nodes;
  };
} // namespace Perimorph::Fem
