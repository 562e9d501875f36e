#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/output/csv_writer.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    /// |work - energy| relative to the larger one; zero where both are only
    /// round-off of the largest force times the largest displacement.
    double
    energy_balance(const double work, const double energy, const double scale)
    {
      const double larger = std::max(std::abs(work), std::abs(energy));
      return larger > 1e-12 * scale ? std::abs(work - energy) / larger : 0.;
    }

    std::string
    residuals_text(const Solvers::NewtonRecord &record)
    {
      std::ostringstream text;
      if (!record.residuals.empty())
        text << "; relative residuals";
      for (const double residual : record.residuals)
        text << " " << residual;
      return text.str();
    }
  } // namespace

  template <int dim>
  bool
  Simulation<dim>::follow_loads(Method         &method,
                                const OnStep   &on_step,
                                const OnNewton &on_newton)
  {
    // The companion with finite elements does not grow cracks.
    const bool grows = method.region.n_core > 0;
    if (parameters.growth.events && grows)
      return parameters.growth.bonds
               ? follow_bond_events(method, on_step, on_newton)
               : follow_growth_events(method, on_step, on_newton);
    if (parameters.arc_length)
      return follow_arc(method, on_step, on_newton);
    const auto times        = parameters.times();
    auto       step_control = parameters.load_stepping;
    // A linear problem that fails fails with smaller loads too.
    if (method.equilibrium->is_linear())
      step_control.maximum_cuts = 0;
    Solvers::LoadStepping stepping(step_control);
    stepping.set_next_fraction(progress.fraction);
    double time = 0.;
    if (progress.number > 0)
      {
        time      = times[progress.number - 1];
        Step step = progress.step;
        if (grows && !grow_at_fixed_loads(method, step, on_step))
          return true;
      }
    for (unsigned int number = progress.number + 1; number <= times.size();
         ++number)
      {
        const double          end = times[number - 1];
        Step                  step{number, end};
        Solvers::NewtonRecord record;
        log << "Load step " << number << " of " << times.size()
            << ", t = " << end << std::endl;
        const auto attempt = [&](const double target) {
          step.time = target;
          record =
            solve_equilibrium(target, method, [&](const auto &iteration) {
              on_newton(step, iteration);
            });
          step.newton_iterations += record.n_iterations();
          step.linear_iterations += record.linear_iterations;
          if (record.converged)
            {
              ++step.n_increments;
              method.time            = target;
              step.relative_residual = record.residuals.back();
            }
          return record.converged;
        };
        const auto on_cut = [&](const double failed, const double next) {
          log << "  t = " << failed << " failed: " << record.reason
              << "; cut to t = " << next << std::endl;
        };
        const auto on_intermediate = [&](const double reached) {
          log << "  t = " << reached << " converged" << std::endl;
        };
        const double reached =
          stepping.advance(time, end, attempt, on_cut, on_intermediate);
        if (reached == end)
          {
            step.number += n_advances + n_events;
            progress.number   = number;
            progress.fraction = stepping.next_fraction();
            on_step(step);
            if (grows && !grow_at_fixed_loads(method, step, on_step))
              return true;
            time = end;
            continue;
          }
        std::ostringstream text;
        text << "load step " << number << " (t = " << end
             << ") did not converge";
        if (step_control.maximum_cuts > 0)
          text << ", not even with " << step_control.maximum_cuts << " cuts";
        text << ": " << record.reason << residuals_text(record)
             << ". The last converged state is that of t = " << reached
             << ", in '" << parameters.output_folder << "'.";
        if (parameters.finite_strain())
          text << " Beyond a limit point 'Load steps / control = arc length' "
                  "may help.";
        if (reached != time)
          {
            step.time    = reached;
            step.between = true;
            on_step(step);
          }
        throw Base::SolveError(text.str());
      }
    return true;
  }

  template <int dim>
  bool
  Simulation<dim>::follow_arc(Method         &method,
                              const OnStep   &on_step,
                              const OnNewton &on_newton)
  {
    const double end        = parameters.end_time;
    const double first_step = end / parameters.n_steps;
    double       time       = method.time;
    double       peak       = progress.peak;
    unsigned int n_cuts     = 0;
    if (progress.number > 0 && time == end)
      return true;

    Solvers::ArcLength arc = progress.arc;
    for (unsigned int number = progress.number + 1;
         number <= parameters.maximum_arc_steps;)
      {
        Step step{number, time};
        log << "Arc step " << number << " from t = " << time << std::endl;
        const auto report = [&](const auto &iteration) {
          on_newton(step, iteration);
        };
        Fem::Vector start(method.displacement);
        start                = method.displacement;
        const auto start_arc = arc;
        double     target    = time;
        auto       record    = method.equilibrium->solve_arc_step(target,
                                                         method.displacement,
                                                         arc,
                                                         first_step,
                                                         report);
        bool       last      = false;
        if (record.converged && target >= end)
          {
            // The path crosses the end: go there exactly.
            auto beyond         = method.displacement;
            method.displacement = start;
            step.time           = end;
            const auto exact =
              method.equilibrium->solve(end, method.displacement, report);
            last = exact.converged;
            if (last)
              {
                record = exact;
                target = end;
              }
            else
              method.displacement = beyond;
          }
        step.newton_iterations += record.n_iterations();
        step.linear_iterations += record.linear_iterations;
        if (!record.converged)
          {
            log << "  failed: " << record.reason << "; half the arc length"
                << std::endl;
            if (++n_cuts > parameters.load_stepping.maximum_cuts ||
                arc.radius == 0.)
              {
                std::ostringstream text;
                text << "arc step " << number << " (from t = " << time
                     << ") did not converge: " << record.reason
                     << residuals_text(record)
                     << ". The last converged state is in '"
                     << parameters.output_folder << "'.";
                throw Base::SolveError(text.str());
              }
            continue;
          }
        n_cuts                 = 0;
        time                   = target;
        peak                   = std::max(peak, time);
        step.time              = time;
        method.time            = time;
        step.n_increments      = 1;
        step.relative_residual = record.residuals.back();
        progress.number        = number;
        progress.peak          = peak;
        progress.arc           = arc;
        on_step(step);
        if (last)
          return true;
        ++number;
      }
    log.warning("the arc length stopped before the end time: the largest t "
                "reached is " +
                Output::shortest_text(peak));
    return false;
  }

  template <int dim>
  void
  Simulation<dim>::count_work(const State<dim> &state)
  {
    if (!counts_work)
      return;
    for (unsigned int n = 0; n < state.displacement.size(); ++n)
      work += 0.5 *
              (post_processing->outer_force(n, last_state) +
               post_processing->outer_force(n, state)) *
              (state.displacement[n] - last_state.displacement[n]);
    last_state = state;
  }

  template <int dim>
  bool
  Simulation<dim>::solve_load_steps(Method &method)
  {
    auto &newton_table = open_table("newton.csv",
                                    {"step",
                                     "time",
                                     "iteration",
                                     "residual",
                                     "relative_residual",
                                     "step_length",
                                     "linear_iterations"});
    auto &step_table   = open_table("load_steps.csv",
                                  {"step",
                                     "time",
                                     "increments",
                                     "newton_iterations",
                                     "linear_iterations",
                                     "relative_residual",
                                     "strain_energy",
                                     "external_work",
                                     "released_energy",
                                     "dissipated_energy",
                                     "crack_growth",
                                     "largest_displacement",
                                     "imbalance"});
    if (progress.number == 0)
      {
        last_state = gather(method);
        if (parameters.write_fields)
          write_fields(method, last_state, 0, 0.);
        write_checkpoint(method, last_state);
      }

    const auto on_newton = [&](const Step                     &step,
                               const Solvers::NewtonIteration &iteration) {
      log << "  Newton iteration " << iteration.iteration
          << ": relative residual " << iteration.relative_residual;
      if (iteration.iteration > 0)
        log << ", " << iteration.linear_iterations << " linear iteration"
            << (iteration.linear_iterations == 1 ? "" : "s");
      if (iteration.iteration > 0 && iteration.step_length < 1.)
        log << ", step length " << iteration.step_length;
      log << std::endl;
      newton_table.write_row({step.number,
                              step.time,
                              iteration.iteration,
                              iteration.residual,
                              iteration.relative_residual,
                              iteration.step_length,
                              iteration.linear_iterations});
    };
    const auto on_step = [&](const Step &step) {
      result->add_count("newton_iterations", step.newton_iterations);
      result->add_count("linear_iterations", step.linear_iterations);
      remove_mean_rigid_motion(method);
      const auto state = gather(method);
      count_work(state);
      double largest = 0.;
      for (const auto &u : state.displacement)
        largest = std::max(largest, u.norm());
      largest_force =
        std::max(largest_force, method.equilibrium->largest_force_met());
      const double imbalance = post_processing->imbalance(state, largest_force);
      step_table.write_row({step.number,
                            step.time,
                            step.n_increments,
                            step.newton_iterations,
                            step.linear_iterations,
                            step.relative_residual,
                            state.strain_energy,
                            work,
                            released_energy,
                            dissipated_energy,
                            grown_length,
                            largest,
                            imbalance});
      result->set("checks", "imbalance", imbalance);
      // Between the states of a path that is not straight the work is that of
      // the trapezoidal rule.
      if (method.equilibrium->is_linear() || parameters.growth.events)
        result->set("checks",
                    "energy_balance",
                    energy_balance(work,
                                   state.strain_energy + released_energy -
                                     switched_energy,
                                   largest_force * largest));
      log << "  largest displacement " << largest << ", strain energy "
          << state.strain_energy << ", out-of-balance " << imbalance
          << std::endl;
      if (imbalance > 1e-6)
        log.warning("loads and reactions do not balance (relative "
                    "out-of-balance force or moment above 1e-6)");
      warn_of_point_supports(state, largest_force);
      if (parameters.n_steps > 1 || parameters.arc_length ||
          parameters.growth.active)
        write_quantities(step.number, method, state);
      // Several states of growth may have one load.
      if (parameters.write_fields)
        write_fields(method,
                     state,
                     step.number,
                     parameters.growth.active ? step.number : step.time);
      progress.step = step;
      if (!step.between)
        write_checkpoint(method, state);
    };
    bool some_step_converged = progress.number > 0;
    try
      {
        return follow_loads(
          method,
          [&](const Step &step) {
            on_step(step);
            some_step_converged = true;
          },
          on_newton);
      }
    catch (const Base::SolveError &)
      {
        if (some_step_converged)
          evaluate(method, gather(method));
        throw;
      }
  }

  template <int dim>
  void
  Simulation<dim>::warn_of_point_supports(const State<dim> &state,
                                          const double      largest_force)
  {
    if (point_supports_checked)
      return;
    point_supports_checked = true;
    for (const auto &[node, label] : supports->point_supports())
      {
        // Only what the point itself holds: the node may be on a boundary that
        // is held too.
        dealii::Tensor<1, dim> reaction =
          post_processing->outer_force(node, state) -
          state.external_force[node];
        for (int d = 0; d < dim; ++d)
          {
            const auto entry = supports->entries().find(dim * node + d);
            if (entry == supports->entries().end() ||
                entry->second.label != label)
              reaction[d] = 0.;
          }
        if (reaction.norm() < 1e-6 * largest_force)
          continue;
        std::ostringstream text;
        text << "the " << label << " carries a force of " << reaction.norm()
             << ": in a " << dim << "D solid a force in a single point moves "
             << "it without limit as the mesh is refined. Spread the support "
                "over a boundary ('mean displacement', 'rigid plate').";
        log.warning(text.str());
      }
  }

  template bool
  Simulation<2>::follow_loads(Method &, const OnStep &, const OnNewton &);
  template bool
  Simulation<3>::follow_loads(Method &, const OnStep &, const OnNewton &);
  template bool
  Simulation<2>::follow_arc(Method &, const OnStep &, const OnNewton &);
  template bool
  Simulation<3>::follow_arc(Method &, const OnStep &, const OnNewton &);
  template void
  Simulation<2>::count_work(const State<2> &);
  template void
  Simulation<3>::count_work(const State<3> &);
  template bool
  Simulation<2>::solve_load_steps(Method &);
  template bool
  Simulation<3>::solve_load_steps(Method &);
  template void
  Simulation<2>::warn_of_point_supports(const State<2> &, double);
  template void
  Simulation<3>::warn_of_point_supports(const State<3> &, double);
} // namespace Perimorph::Application
