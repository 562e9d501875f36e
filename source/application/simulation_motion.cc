#include <perimorph/application/motion_integrator.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/log.h>
#include <perimorph/base/progress.h>
#include <perimorph/fem/lumped_mass.h>
#include <perimorph/fem/nodal_values.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    /// Number of equal steps, none longer than wanted, that fill a time.
    unsigned int
    steps_that_fill(const double duration, const double longest)
    {
      return std::max(1., std::ceil(duration / longest * (1. - 1e-9)));
    }

    /// Energy from nothing over the largest energy, at one output or two in a
    /// row (few steps at a sudden start may miss half of a little work):
    /// beyond, a motion is no solution. Beyond the smallest one that needs a
    /// word.
    constexpr double unbounded_drift = 0.9, lasting_drift = 0.5,
                     large_drift = 0.05;
  } // namespace

  template <int dim>
  bool
  Simulation<dim>::starts_in_motion() const
  {
    const auto &time = parameters.time_integration;
    for (const auto *field :
         {&time.initial_displacement, &time.initial_velocity})
      for (const auto &component : *field)
        if (component)
          return true;
    return false;
  }

  template <int dim>
  void
  Simulation<dim>::check_motion() const
  {
    const auto &time = parameters.time_integration;
    if (time.scheme == TimeScheme::equilibrium)
      return;
    Base::InputErrorCollector errors;
    const std::string         scheme =
      "with scheme '" + time_scheme_names()[static_cast<int>(time.scheme)] +
      "'";
    if (!supports->mean_constraints().empty())
      errors.add_parameter(
        "Boundary conditions / mean displacement",
        "'" +
          parameters.boundary_conditions.mean_displacement.front().boundary +
          "' " + scheme,
        "displacement, symmetry",
        "Only 'static' holds boundaries as a whole.");
    if (!supports->rigid_plates().empty())
      errors.add_parameter(
        "Boundary conditions / rigid plate",
        "'" + parameters.boundary_conditions.rigid_plates.front().boundary +
          "' " + scheme,
        "displacement, symmetry",
        "Only 'static' holds boundaries as a whole.");
    for (const auto *field :
         {&time.initial_displacement, &time.initial_velocity})
      for (const auto &component : *field)
        if (component)
          for (const auto &node : mesh->nodal().nodes)
            if (!component->check_finite(node, 0., errors))
              break;
    errors.throw_if_any();
  }

  template <int dim>
  Solvers::NewtonRecord
  Simulation<dim>::solve_equilibrium(
    const double                                      time,
    Method                                           &method,
    const typename Solvers::Equilibrium<dim>::Report &report)
  {
    const auto &choice = parameters.time_integration;
    if (choice.scheme != TimeScheme::relaxation)
      return method.equilibrium->solve(time, method.displacement, report);
    if (!method.relaxation)
      {
        method.problem->keep_cell_stiffness();
        method.forces =
          std::make_unique<Solvers::NodalForces<dim>>(*mesh,
                                                      *method.problem,
                                                      *supports,
                                                      *loads,
                                                      timing);
        method.relaxation = std::make_unique<Solvers::DynamicRelaxation<dim>>(
          *method.forces,
          Solvers::RelaxationParameters{parameters.newton.tolerance,
                                        choice.maximum_relaxation_steps});
      }
    const auto record =
      method.relaxation->solve(time, method.displacement, report);
    if (record.converged)
      method.equilibrium->restore(method.equilibrium->memory(),
                                  time,
                                  method.displacement);
    return record;
  }

  template <int dim>
  Solvers::MotionState
  Simulation<dim>::initial_motion(const Method &method) const
  {
    const auto          &partition = method.problem->partition();
    const auto          &time      = parameters.time_integration;
    Solvers::MotionState motion;
    for (auto *vector :
         {&motion.displacement, &motion.velocity, &motion.acceleration})
      partition.initialize(*vector);
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      {
        const auto &x = partition.position(n);
        const auto  u = Fem::evaluate<dim>(time.initial_displacement, x, 0.);
        const auto  v = Fem::evaluate<dim>(time.initial_velocity, x, 0.);
        for (int d = 0; d < dim; ++d)
          {
            motion.displacement.local_element(dim * n + d) = u[d];
            motion.velocity.local_element(dim * n + d)     = v[d];
          }
      }
    return motion;
  }

  template <int dim>
  State<dim>
  Simulation<dim>::gather_motion(const Method               &method,
                                 const Solvers::MotionState &motion,
                                 const Fem::Vector          &internal_force,
                                 const Fem::Vector &external_force) const
  {
    const auto &partition = method.problem->partition();
    State<dim>  state;
    Fem::Vector displacement(motion.displacement);
    displacement.update_ghost_values();
    state.displacement   = Fem::to_nodal_values(displacement, partition);
    state.velocity       = Fem::to_nodal_values(motion.velocity, partition);
    state.acceleration   = Fem::to_nodal_values(motion.acceleration, partition);
    state.internal_force = Fem::to_nodal_values(internal_force, partition);
    state.external_force = Fem::to_nodal_values(external_force, partition);
    state.time           = motion.time;
    state.strain_energy  = method.problem->strain_energy(displacement);
    return state;
  }

  template <int dim>
  std::unique_ptr<MotionIntegrator<dim>>
  Simulation<dim>::make_integrator(Method &method)
  {
    return std::make_unique<MotionIntegrator<dim>>(*mesh,
                                                   *method.problem,
                                                   *method.equilibrium,
                                                   *supports,
                                                   *loads,
                                                   node_mass,
                                                   parameters.time_integration,
                                                   parameters.load_stepping,
                                                   timing);
  }

  template <int dim>
  typename Simulation<dim>::Instant
  Simulation<dim>::make_instant(Instant                      instant,
                                const MotionIntegrator<dim> &integrator,
                                Method                      &method)
  {
    auto      &motion   = method.motion;
    const auto forces   = integrator.forces_of(motion);
    method.displacement = motion.displacement;
    method.time         = motion.time;
    instant.state =
      gather_motion(method, motion, forces.internal, forces.external);
    instant.kinetic_energy =
      Solvers::kinetic_energy<dim>(method.problem->partition(),
                                   node_mass,
                                   motion.velocity);
    const double energy = instant.state.strain_energy + instant.kinetic_energy;
    if (!std::isfinite(energy))
      {
        std::ostringstream text;
        text << "the motion has no finite energy at t = " << motion.time;
        throw Base::SolveError(text.str());
      }
    if (instant.number == 0)
      energy_at_start = energy;
    largest_energy = std::max({largest_energy, energy, std::abs(motion.work)});
    const double gain = energy + dissipated_energy - switched_energy -
                        energy_at_start - motion.work;
    largest_imbalance = std::max(largest_imbalance, std::abs(gain));
    if (largest_energy > 0.)
      {
        instant.energy_balance = gain / largest_energy;
        energy_drift           = largest_imbalance / largest_energy;
      }
    const double lasts = std::min(instant.energy_balance, latest_balance);
    latest_balance     = instant.energy_balance;
    if (latest_balance > unbounded_drift || lasts > lasting_drift)
      {
        std::ostringstream text;
        text << "the motion gains energy from nothing: at t = " << motion.time
             << " it is " << 100. * instant.energy_balance
             << " % of all energy; use shorter time steps";
        throw Base::SolveError(text.str());
      }
    return instant;
  }

  template <int dim>
  void
  Simulation<dim>::follow_motion(Method &method, const OnInstant &on_instant)
  {
    const bool is_explicit =
      parameters.time_integration.scheme == TimeScheme::explicit_motion;
    const bool is_linear  = method.equilibrium->is_linear();
    const auto times      = parameters.times();
    auto      &motion     = method.motion;
    node_mass             = Fem::lumped_mass(mesh->nodal(), materials.density);
    auto       integrator = make_integrator(method);
    const bool is_fresh   = motion.displacement.size() == 0;
    if (is_fresh)
      {
        motion           = initial_motion(method);
        stable_time_step = 0.;
        limit_reduction  = 1.;
        if (!is_linear)
          displacement_of_limit =
            Fem::to_nodal_values(motion.displacement,
                                 method.problem->partition());
      }
    double longest = longest_time_step(*integrator, method);
    if (is_fresh)
      limit_at_start = stable_time_step;
    integrator->start(motion, is_fresh, longest);
    if (is_fresh)
      on_instant(make_instant({0}, *integrator, method));

    const bool breaks = parameters.growth.active && method.region.n_core > 0;
    std::unique_ptr<Coupling::MovingBonds<dim>> bonds;
    if (breaks)
      bonds = make_moving_bonds(method);
    Base::Progress bar(log, "Motion", 1000);
    try
      {
        for (unsigned int number = progress.number + 1; number <= times.size();
             ++number)
          {
            const double end = times[number - 1];
            Instant      instant{number};
            while (motion.time < end)
              {
                const unsigned int n =
                  steps_that_fill(end - motion.time, longest);
                integrator->step_to(
                  n == 1 ? end : motion.time + (end - motion.time) / n,
                  motion,
                  instant.newton_iterations,
                  instant.linear_iterations);
                ++n_time_steps;
                ++instant.time_steps;
                bar.update(static_cast<std::size_t>(1000. * motion.time /
                                                    parameters.end_time));
                if (breaks)
                  {
                    const auto change = break_in_motion(method, bonds);
                    if (change == MotionChange::region)
                      {
                        integrator = make_integrator(method);
                        integrator->start(motion, false, longest);
                      }
                    else if (change == MotionChange::bonds)
                      integrator->forget_tangent();
                    if (change != MotionChange::none)
                      limit_is_old = true;
                  }
                if (is_explicit && limit_may_have_changed(method))
                  longest = longest_time_step(*integrator, method);
              }
            on_instant(make_instant(instant, *integrator, method));
          }
      }
    catch (const Base::SolveError &error)
      {
        std::ostringstream text;
        text << "time step " << n_time_steps + 1 << " from t = " << motion.time
             << ": " << error.what() << ". The last state kept is in '"
             << parameters.output_folder << "'.";
        throw Base::SolveError(text.str());
      }
  }

  template <int dim>
  void
  Simulation<dim>::integrate_in_time(Method &method)
  {
    const auto &time       = parameters.time_integration;
    auto       &step_table = open_table("time_steps.csv",
                                  {"step",
                                         "time",
                                         "time_steps",
                                         "newton_iterations",
                                         "linear_iterations",
                                         "strain_energy",
                                         "kinetic_energy",
                                         "external_work",
                                         "dissipated_energy",
                                         "energy_balance",
                                         "largest_displacement"});
    double      field_time = progress.step.time;
    bool        evaluated  = false;
    follow_motion(method, [&](const Instant &instant) {
      const auto &state = instant.state;
      result->add_count("newton_iterations", instant.newton_iterations);
      result->add_count("linear_iterations", instant.linear_iterations);
      double largest = 0.;
      for (const auto &u : state.displacement)
        largest = std::max(largest, u.norm());
      step_table.write_row({instant.number,
                            state.time,
                            n_time_steps,
                            instant.newton_iterations,
                            instant.linear_iterations,
                            state.strain_energy,
                            instant.kinetic_energy,
                            method.motion.work,
                            dissipated_energy,
                            instant.energy_balance,
                            largest});
      write_quantities(instant.number, method, state);
      progress.number = instant.number;
      progress.step   = {instant.number, state.time};
      result->set("counts", "time_steps", n_time_steps);
      result->set("checks", "energy_balance", instant.energy_balance);
      result->set("checks", "energy_drift", energy_drift);
      if (parameters.growth.active)
        {
          result->set("counts", "events", n_events);
          result->set("counts", "bonds_broken_in_events", broken.size());
        }
      const bool is_last = instant.number == parameters.n_steps;
      if (instant.number == 0 || is_last ||
          state.time >= field_time + time.field_interval * (1. - 1e-9))
        {
          field_time = state.time;
          log << "t = " << state.time << ": strain energy "
              << state.strain_energy << ", kinetic energy "
              << instant.kinetic_energy << ", energy balance "
              << instant.energy_balance << std::endl;
          if (parameters.write_fields)
            write_fields(method, state, instant.number, state.time);
          last_state = state;
          write_checkpoint(method, state);
        }
      if (is_last)
        {
          evaluate(method, state);
          evaluated = true;
        }
    });
    if (energy_drift > large_drift)
      {
        std::ostringstream text;
        text << "the energy drifts by " << 100. * energy_drift
             << " %: look at 'time_steps.csv'; shorter time steps may help";
        log.warning(text.str());
      }
    if (!evaluated) // resumed at the end
      evaluate(method, gather(method));
    result->set("solver",
                "time_integration",
                time_scheme_names()[static_cast<int>(time.scheme)]);
    if (stable_time_step > 0.)
      result->set("solver", "stable_time_step", stable_time_step);
    result->set("solver",
                "mean_time_step",
                parameters.end_time / std::max<std::size_t>(n_time_steps, 1));
  }

#define PERIMORPH_INSTANTIATE(dim)                                              \
  template bool                  Simulation<dim>::starts_in_motion() const;     \
  template void                  Simulation<dim>::check_motion() const;         \
  template Solvers::NewtonRecord Simulation<dim>::solve_equilibrium(            \
    double,                                                                     \
    Method &,                                                                   \
    const Solvers::Equilibrium<dim>::Report &);                                 \
  template Solvers::MotionState Simulation<dim>::initial_motion(                \
    const Method &) const;                                                      \
  template State<dim> Simulation<dim>::gather_motion(                           \
    const Method &,                                                             \
    const Solvers::MotionState &,                                               \
    const Fem::Vector &,                                                        \
    const Fem::Vector &) const;                                                 \
  template std::unique_ptr<MotionIntegrator<dim>>                               \
                                    Simulation<dim>::make_integrator(Method &); \
  template Simulation<dim>::Instant Simulation<dim>::make_instant(              \
    Instant,                                                                    \
    const MotionIntegrator<dim> &,                                              \
    Method &);                                                                  \
  template void Simulation<dim>::follow_motion(Method &, const OnInstant &);    \
  template void Simulation<dim>::integrate_in_time(Method &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
