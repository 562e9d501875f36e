#include <perimorph/solvers/explicit_motion.h>
#include <perimorph/solvers/highest_frequency.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace Perimorph::Solvers
{
  template <int dim>
  ExplicitMotion<dim>::ExplicitMotion(NodalForces<dim>          &forces,
                                      const std::vector<double> &mass)
    : forces(forces)
    , mass(mass_of_unknowns(forces.partition(), mass))
    , moving_mass(this->mass)
  {
    for (const unsigned int entry : forces.held())
      moving_mass.local_element(entry) = 0.;
    inverse_mass = moving_mass;
    for (unsigned int k = 0; k < inverse_mass.locally_owned_size(); ++k)
      if (inverse_mass.local_element(k) > 0.)
        inverse_mass.local_element(k) = 1. / inverse_mass.local_element(k);
  }

  template <int dim>
  void
  ExplicitMotion<dim>::accelerate(MotionState &state)
  {
    forces.evaluate(state.time, state.displacement);
    const auto &external = forces.external();
    const auto &internal = forces.internal();
    for (unsigned int k = 0; k < inverse_mass.locally_owned_size(); ++k)
      state.acceleration.local_element(k) =
        inverse_mass.local_element(k) *
        (external.local_element(k) - internal.local_element(k));
  }

  template <int dim>
  void
  ExplicitMotion<dim>::start(MotionState &state, const double time_step)
  {
    forces.impose_supports(state.time, state.displacement);
    forces.impose_hanging(state.displacement);
    forces.impose_support_velocities(state.time, time_step, state.velocity);
    forces.impose_hanging(state.velocity);
    accelerate(state);
  }

  template <int dim>
  void
  ExplicitMotion<dim>::step(const double time_step, MotionState &state)
  {
    auto        &u    = state.displacement;
    auto        &v    = state.velocity;
    auto        &a    = state.acceleration;
    const double half = 0.5 * time_step;
    const auto   n    = u.locally_owned_size();

    // Forces from outside: loads, and reactions where supports move.
    const auto reaction = [&](const unsigned int k) {
      return forces.internal().local_element(k) -
             forces.external().local_element(k) +
             mass.local_element(k) * a.local_element(k);
    };
    double work = 0.;
    for (unsigned int k = 0; k < n; ++k)
      {
        v.local_element(k) += half * a.local_element(k);
        u.local_element(k) += time_step * v.local_element(k);
        work += half * v.local_element(k) * forces.external().local_element(k);
      }
    state.time += time_step;
    std::vector<double> earlier_velocity;
    if (forces.supports_move())
      {
        for (const unsigned int k : forces.held())
          {
            // Back to where it was.
            u.local_element(k) -= time_step * v.local_element(k);
            work -=
              half * v.local_element(k) * forces.external().local_element(k);
          }
        const Vector before = u;
        forces.impose_supports(state.time, u);
        for (const unsigned int k : forces.held())
          {
            const double velocity =
              (u.local_element(k) - before.local_element(k)) / time_step;
            const double earlier =
              v.local_element(k) - half * a.local_element(k);
            work += half * velocity *
                    (forces.external().local_element(k) + reaction(k));
            a.local_element(k) = (velocity - earlier) / time_step;
            v.local_element(k) = velocity;
          }
      }
    forces.impose_hanging(u);
    const Vector held_acceleration = forces.supports_move() ? a : Vector();
    accelerate(state);
    for (unsigned int k = 0; k < n; ++k)
      {
        work += half * v.local_element(k) * forces.external().local_element(k);
        v.local_element(k) += half * a.local_element(k);
      }
    if (forces.supports_move())
      for (const unsigned int k : forces.held())
        {
          a.local_element(k) = held_acceleration.local_element(k);
          work += half * v.local_element(k) * reaction(k);
        }
    forces.impose_hanging(v);
    state.work +=
      dealii::Utilities::MPI::sum(work, forces.partition().communicator());
  }

  template <int dim>
  double
  ExplicitMotion<dim>::stable_time_step(const MotionState &state) const
  {
    const double frequency =
      highest_frequency(forces, moving_mass, state.displacement);
    return frequency > 0. ? 2. / frequency
                          : std::numeric_limits<double>::infinity();
  }

  template <int dim>
  Vector
  ExplicitMotion<dim>::inertia(const MotionState &state) const
  {
    Vector result(state.acceleration);
    result.scale(mass);
    return result;
  }

  template class ExplicitMotion<2>;
  template class ExplicitMotion<3>;
} // namespace Perimorph::Solvers
