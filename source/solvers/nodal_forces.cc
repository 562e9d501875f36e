#include <perimorph/base/timing.h>
#include <perimorph/solvers/nodal_forces.h>

namespace Perimorph::Solvers
{
  template <int dim>
  NodalForces<dim>::NodalForces(const Mesh::DistributedMesh<dim>    &mesh,
                                const Coupling::CoupledProblem<dim> &problem,
                                const Fem::Supports<dim>            &supports,
                                const Fem::Loads<dim>               &loads,
                                Base::Timing                        &timing)
    : problem(problem)
    , supports(supports)
    , loads(loads)
    , timing(timing)
    , constraints(problem.partition(), supports, mesh.nodal().hanging, true)
    , follower(mesh, problem.partition(), loads.surface_loads())
  {
    Assert(!constraints.couple_unknowns(),
           dealii::ExcMessage("supports couple unknowns"));
    const auto &owned = partition().owned_dofs();
    for (const auto &[unknown, entry] : supports.entries())
      {
        moving_supports =
          moving_supports ||
          (entry.expression && entry.expression->depends_on_time());
        if (!owned.is_element(unknown))
          continue;
        held_unknowns.push_back(unknown);
        held_entries.push_back(dim * partition().local(unknown / dim) +
                               unknown % dim);
      }
    for (auto *vector : {&internal_force, &external_force, &dead_loads})
      partition().initialize(*vector);
  }

  template <int dim>
  void
  NodalForces<dim>::impose_supports(const double time,
                                    Vector      &displacement) const
  {
    for (std::size_t k = 0; k < held_entries.size(); ++k)
      displacement.local_element(held_entries[k]) =
        supports.value(held_unknowns[k], time);
  }

  template <int dim>
  void
  NodalForces<dim>::impose_support_velocities(const double time,
                                              const double time_step,
                                              Vector      &velocity) const
  {
    for (std::size_t k = 0; k < held_entries.size(); ++k)
      velocity.local_element(held_entries[k]) =
        moving_supports ? (supports.value(held_unknowns[k], time + time_step) -
                           supports.value(held_unknowns[k], time)) /
                            time_step
                        : 0.;
  }

  template <int dim>
  void
  NodalForces<dim>::impose_hanging(Vector &field) const
  {
    constraints.set_hanging(field);
  }

  template <int dim>
  void
  NodalForces<dim>::condense(Vector &force) const
  {
    constraints.condense(force);
  }

  template <int dim>
  void
  NodalForces<dim>::evaluate(const double time, Vector &displacement)
  {
    const auto timer = timing.scope("forces");
    displacement.update_ghost_values();
    problem.internal_forces(displacement, internal_force);
    constraints.condense_hanging(internal_force);
    if (!loads_are_known || loads.depend_on_time())
      {
        dead_loads.zero_out_ghost_values();
        dead_loads = 0.;
        loads.add_forces(time, partition(), dead_loads);
        dead_loads.compress(dealii::VectorOperation::add);
        constraints.condense_hanging(dead_loads);
        loads_are_known = true;
      }
    external_force.zero_out_ghost_values();
    external_force = 0.;
    if (follower.acts())
      {
        // The term of an equilibrium: internal minus external.
        follower.set_time(time);
        follower.add_residual(displacement, external_force);
        external_force.compress(dealii::VectorOperation::add);
        constraints.condense_hanging(external_force);
      }
    external_force.sadd(-1., 1., dead_loads);
    displacement.zero_out_ghost_values();
  }

  template <int dim>
  void
  NodalForces<dim>::tangent_product(const Vector &displacement,
                                    const Vector &direction,
                                    Vector       &product) const
  {
    product.zero_out_ghost_values();
    product = 0.;
    displacement.update_ghost_values();
    direction.update_ghost_values();
    problem.add_tangent_product(displacement, direction, product);
    product.compress(dealii::VectorOperation::add);
    direction.zero_out_ghost_values();
    displacement.zero_out_ghost_values();
    constraints.condense(product);
  }

  template class NodalForces<2>;
  template class NodalForces<3>;
} // namespace Perimorph::Solvers
