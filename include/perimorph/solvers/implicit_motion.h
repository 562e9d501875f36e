#pragma once

#include <perimorph/solvers/equilibrium.h>
#include <perimorph/solvers/motion_state.h>
#include <perimorph/solvers/nodal_forces.h>

namespace Perimorph::Solvers
{
  /// The generalised-alpha method of one parameter, the spectral radius rho of
  /// the highest frequencies: 1 keeps the energy of a linear body, 0
  /// annihilates what the time step cannot follow. Internal forces are those of
  /// the generalised midpoint u_f = (1 - alpha_f) u_1 + alpha_f u_0, which is
  /// the unknown of the same Newton's method as in statics, with the inertia as
  /// springs:
  ///   M c (u_f - r) + f_int(u_f) = f_ext(t_f),
  ///   c = (1 - alpha_m) / ((1 - alpha_f) beta dt^2).
  /// Source: Chung and Hulbert (1993).
  template <int dim>
  class ImplicitMotion
  {
  public:
    /// @param problem  gets the inertia
    /// @param forces   for supports; evaluated by start() only
    /// @param mass     of all nodes of the mesh
    ImplicitMotion(Coupling::CoupledProblem<dim> &problem,
                   Equilibrium<dim>              &equilibrium,
                   const NodalForces<dim>        &forces,
                   const std::vector<double>     &mass,
                   double                         spectral_radius);

    /// One step forward; a record without convergence leaves the state as it
    /// was.
    NewtonRecord
    step(double                                   time_step,
         MotionState                             &state,
         const typename Equilibrium<dim>::Report &report);

  private:
    Equilibrium<dim>                       &equilibrium;
    const NodalForces<dim>                 &forces;
    std::shared_ptr<Fem::NodalSprings<dim>> inertia;
    double                                  alpha_m, alpha_f, beta, gamma;
  };
} // namespace Perimorph::Solvers
