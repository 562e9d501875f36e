#pragma once

#include <perimorph/solvers/motion_state.h>
#include <perimorph/solvers/nodal_forces.h>

namespace Perimorph::Solvers
{
  /// Central differences in the form of velocity Verlet, with lumped mass:
  ///   v += dt/2 a,  u += dt v,  a = M^-1 (f_ext - f_int),  v += dt/2 a.
  /// Stable for dt < 2 / highest_frequency().
  template <int dim>
  class ExplicitMotion
  {
  public:
    /// @param mass  of all nodes of the mesh
    ExplicitMotion(NodalForces<dim> &forces, const std::vector<double> &mass);

    /// Acceleration of a state whose displacement and velocity were set;
    /// supports are imposed, those that move with their velocity, so that one
    /// that moves at once is no blow.
    /// @param time_step  the first one, roughly
    void
    start(MotionState &state, double time_step);

    /// One step forward.
    /// @throws Base::InadmissibleState  on all ranks
    void
    step(double time_step, MotionState &state);

    /// Largest stable time step at a state.
    double
    stable_time_step(const MotionState &state) const;

    /// Force that accelerates: mass times acceleration of each unknown, of held
    /// ones too; owned entries.
    Vector
    inertia(const MotionState &state) const;

  private:
    void
    accelerate(MotionState &state);

    NodalForces<dim> &forces;
    Vector            mass;         ///< of each unknown, held ones too
    Vector            moving_mass;  ///< free_mass()
    Vector            inverse_mass; ///< 0 where nothing is free
  };
} // namespace Perimorph::Solvers
