#pragma once

#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/fem/follower_pressure.h>
#include <perimorph/fem/loads.h>
#include <perimorph/fem/supports.h>
#include <perimorph/solvers/constraints.h>

namespace Perimorph::Base
{
  class Timing;
}

namespace Perimorph::Solvers
{
  /// Forces on the nodes at a state, for methods without a matrix: nothing is
  /// assembled. Supports must hold single unknowns (no means of boundaries, no
  /// rigid plates). Vectors have owned entries only, ghosts zero.
  template <int dim>
  class NodalForces
  {
  public:
    NodalForces(const Mesh::DistributedMesh<dim>    &mesh,
                const Coupling::CoupledProblem<dim> &problem,
                const Fem::Supports<dim>            &supports,
                const Fem::Loads<dim>               &loads,
                Base::Timing                        &timing);

    const Coupling::CoupledProblem<dim> &
    coupled_problem() const
    {
      return problem;
    }

    const Fem::NodePartition<dim> &
    partition() const
    {
      return problem.partition();
    }

    /// Some prescribed displacement changes with time.
    bool
    supports_move() const
    {
      return moving_supports;
    }

    /// Gives held unknowns their values at a time.
    void
    impose_supports(double time, Vector &displacement) const;

    /// Gives held unknowns the mean velocity of their values over a step.
    void
    impose_support_velocities(double  time,
                              double  time_step,
                              Vector &velocity) const;

    /// Gives hanging nodes the mean of their parents.
    void
    impose_hanging(Vector &field) const;

    /// Sets held unknowns and hanging nodes to zero; forces on hanging nodes go
    /// to their parents.
    void
    condense(Vector &force) const;

    /// Evaluates both forces.
    /// @throws Base::InadmissibleState  on all ranks
    void
    evaluate(double time, Vector &displacement);

    const Vector &
    internal() const
    {
      return internal_force;
    }
    const Vector &
    external() const
    {
      return external_force;
    }

    /// Held unknowns that this rank owns, as local entries.
    const std::vector<unsigned int> &
    held() const
    {
      return held_entries;
    }

    /// Tangent at a state times a direction, condensed.
    void
    tangent_product(const Vector &displacement,
                    const Vector &direction,
                    Vector       &product) const;

  private:
    const Coupling::CoupledProblem<dim> &problem;
    const Fem::Supports<dim>            &supports;
    const Fem::Loads<dim>               &loads;
    Base::Timing                        &timing;
    Constraints<dim>                     constraints;
    Fem::FollowerPressure<dim>           follower;
    std::vector<unsigned int>            held_entries;
    std::vector<unsigned int>            held_unknowns;
    bool                                 moving_supports = false;
    bool                                 loads_are_known = false;
    Vector internal_force, external_force, dead_loads;
  };
} // namespace Perimorph::Solvers
