#pragma once

#include <perimorph/application/simulation_parameters.h>
#include <perimorph/solvers/explicit_motion.h>
#include <perimorph/solvers/implicit_motion.h>

#include <memory>

namespace Perimorph::Application
{
  /// Explicit or implicit steps of one problem.
  template <int dim>
  class MotionIntegrator
  {
  public:
    /// @param mass  of all nodes of the mesh
    MotionIntegrator(const Mesh::DistributedMesh<dim>      &mesh,
                     Coupling::CoupledProblem<dim>         &problem,
                     Solvers::Equilibrium<dim>             &equilibrium,
                     const Fem::Supports<dim>              &supports,
                     const Fem::Loads<dim>                 &loads,
                     const std::vector<double>             &mass,
                     const TimeIntegrationParameters<dim>  &parameters,
                     const Solvers::LoadSteppingParameters &stepping,
                     Base::Timing                          &timing);

    /// Before the first step.
    /// @param is_fresh   the acceleration is not known yet
    /// @param time_step  the first one, roughly
    void
    start(Solvers::MotionState &motion, bool is_fresh, double time_step);

    /// Largest stable time step of explicit motion; before start() only, if
    /// the motion is implicit.
    double
    stable_time_step(const Solvers::MotionState &motion) const
    {
      return by_nodes.stable_time_step(motion);
    }

    /// Goes to a time; iterations are added.
    /// @throws Base::SolveError
    void
    step_to(double                time,
            Solvers::MotionState &motion,
            unsigned int         &newton_iterations,
            unsigned int         &linear_iterations);

    /// The stiffness has changed.
    void
    forget_tangent()
    {
      equilibrium.forget_tangent();
    }

    struct Forces
    {
      Fem::Vector internal; ///< with the inertia
      Fem::Vector external;
    };

    /// Of the last step: explicit at its end, implicit at its generalised
    /// midpoint.
    Forces
    forces_of(const Solvers::MotionState &motion) const;

  private:
    Coupling::CoupledProblem<dim>                &problem;
    Solvers::Equilibrium<dim>                    &equilibrium;
    const std::vector<double>                    &mass;
    TimeIntegrationParameters<dim>                parameters;
    Solvers::LoadSteppingParameters               stepping;
    Solvers::NodalForces<dim>                     forces;
    Solvers::ExplicitMotion<dim>                  by_nodes;
    std::unique_ptr<Solvers::ImplicitMotion<dim>> by_newton;
    bool                                          has_stepped = false;
  };
} // namespace Perimorph::Application
