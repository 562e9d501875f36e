#include <perimorph/application/motion_integrator.h>

#include <sstream>

namespace Perimorph::Application
{
  template <int dim>
  MotionIntegrator<dim>::MotionIntegrator(
    const Mesh::DistributedMesh<dim>      &mesh,
    Coupling::CoupledProblem<dim>         &problem,
    Solvers::Equilibrium<dim>             &equilibrium,
    const Fem::Supports<dim>              &supports,
    const Fem::Loads<dim>                 &loads,
    const std::vector<double>             &mass,
    const TimeIntegrationParameters<dim>  &parameters,
    const Solvers::LoadSteppingParameters &stepping,
    Base::Timing                          &timing)
    : problem(problem)
    , equilibrium(equilibrium)
    , mass(mass)
    , parameters(parameters)
    , stepping(stepping)
    , forces(mesh, problem, supports, loads, timing)
    , by_nodes(forces, mass)
  {
    if (parameters.scheme == TimeScheme::explicit_motion)
      problem.keep_cell_stiffness();
  }

  template <int dim>
  void
  MotionIntegrator<dim>::start(Solvers::MotionState &motion,
                               const bool            is_fresh,
                               const double          time_step)
  {
    const bool is_explicit = parameters.scheme == TimeScheme::explicit_motion;
    if (is_fresh)
      by_nodes.start(motion, time_step);
    else
      forces.evaluate(motion.time, motion.displacement);
    // From here on the problem has inertia, which steps by nodes must not see.
    if (!is_explicit)
      by_newton = std::make_unique<Solvers::ImplicitMotion<dim>>(
        problem,
        equilibrium,
        forces,
        mass,
        parameters.spectral_radius);
  }

  template <int dim>
  void
  MotionIntegrator<dim>::step_to(const double          time,
                                 Solvers::MotionState &motion,
                                 unsigned int         &newton_iterations,
                                 unsigned int         &linear_iterations)
  {
    has_stepped = true;
    if (!by_newton)
      {
        by_nodes.step(time - motion.time, motion);
        motion.time = time;
        return;
      }
    Solvers::NewtonRecord record;
    Solvers::LoadStepping cuts(stepping);
    const double          reached = cuts.advance(
      motion.time,
      time,
      [&](const double target) {
        record =
          by_newton->step(target - motion.time, motion, [](const auto &) {});
        newton_iterations += record.n_iterations();
        linear_iterations += record.linear_iterations;
        return record.converged;
      },
      [](double, double) {},
      [](double) {});
    if (reached != time)
      {
        std::ostringstream text;
        text << "the time step to t = " << time
             << " did not converge: " << record.reason;
        throw Base::SolveError(text.str());
      }
    motion.time = time;
  }

  template <int dim>
  typename MotionIntegrator<dim>::Forces
  MotionIntegrator<dim>::forces_of(const Solvers::MotionState &motion) const
  {
    if (by_newton && has_stepped)
      return {equilibrium.internal_forces(), equilibrium.external_forces()};
    Forces result{forces.internal(), forces.external()};
    result.internal += by_nodes.inertia(motion);
    return result;
  }

  template class MotionIntegrator<2>;
  template class MotionIntegrator<3>;
} // namespace Perimorph::Application
