#include <perimorph/solvers/implicit_motion.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace Perimorph::Solvers
{
  template <int dim>
  ImplicitMotion<dim>::ImplicitMotion(Coupling::CoupledProblem<dim> &problem,
                                      Equilibrium<dim>          &equilibrium,
                                      const NodalForces<dim>    &forces,
                                      const std::vector<double> &mass,
                                      const double spectral_radius)
    : equilibrium(equilibrium)
    , forces(forces)
    , alpha_m((2. * spectral_radius - 1.) / (spectral_radius + 1.))
    , alpha_f(spectral_radius / (spectral_radius + 1.))
    , beta(0.25 * (1. - alpha_m + alpha_f) * (1. - alpha_m + alpha_f))
    , gamma(0.5 - alpha_m + alpha_f)
  {
    const auto               &partition = problem.partition();
    std::vector<unsigned int> nodes(partition.n_owned());
    std::iota(nodes.begin(), nodes.end(), 0u);
    std::vector<double> stiffness;
    for (const unsigned int n : nodes)
      stiffness.push_back(mass[partition.global(n)]);
    inertia = std::make_shared<Fem::NodalSprings<dim>>("inertia",
                                                       std::move(nodes),
                                                       std::move(stiffness));
    problem.set_inertia(inertia);
  }

  template <int dim>
  NewtonRecord
  ImplicitMotion<dim>::step(const double                             time_step,
                            MotionState                             &state,
                            const typename Equilibrium<dim>::Report &report)
  {
    auto        &u               = state.displacement;
    auto        &v               = state.velocity;
    auto        &a               = state.acceleration;
    const double dt              = time_step;
    const double of_acceleration = 1. / (beta * dt * dt);
    const double c = (1. - alpha_m) * of_acceleration / (1. - alpha_f);
    inertia->set_factor(c);

    // u_1 = predictor + a_1 / of_acceleration
    Vector predictor = u, rest = u, midpoint = u;
    predictor.add(dt, v, (0.5 - beta) * dt * dt, a);
    rest.sadd(alpha_f, 1. - alpha_f, predictor);
    rest.add(-alpha_m / c, a);
    inertia->set_rest(rest);
    midpoint.add((1. - alpha_f) * dt, v, 0.5 * (1. - alpha_f) * dt * dt, a);
    const auto record =
      equilibrium.solve(state.time + (1. - alpha_f) * dt, midpoint, report);
    if (!record.converged)
      return record;

    const auto   earlier_u = u;
    const Vector earlier_v = v;
    midpoint.zero_out_ghost_values();
    u.sadd(-alpha_f / (1. - alpha_f), 1. / (1. - alpha_f), midpoint);
    state.time += dt;
    forces.impose_supports(state.time, u);
    forces.impose_hanging(u);
    v.add(dt * (1. - gamma), a);
    a = u;
    a -= predictor;
    a *= of_acceleration;
    v.add(dt * gamma, a);
    for (const unsigned int k : forces.held())
      {
        v.local_element(k) =
          (u.local_element(k) - earlier_u.local_element(k)) / dt;
        a.local_element(k) =
          (v.local_element(k) - earlier_v.local_element(k)) / dt;
      }

    const auto &external = equilibrium.external_forces();
    const auto &internal = equilibrium.internal_forces();
    double      work     = 0.;
    for (unsigned int k = 0; k < u.locally_owned_size(); ++k)
      work += external.local_element(k) *
              (u.local_element(k) - earlier_u.local_element(k));
    for (const unsigned int k : forces.held())
      work += (internal.local_element(k) - external.local_element(k)) *
              (u.local_element(k) - earlier_u.local_element(k));
    state.work +=
      dealii::Utilities::MPI::sum(work, forces.partition().communicator());
    return record;
  }

  template class ImplicitMotion<2>;
  template class ImplicitMotion<3>;
} // namespace Perimorph::Solvers
