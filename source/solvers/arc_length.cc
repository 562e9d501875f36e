#include <perimorph/solvers/equilibrium.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Solvers
{
  template <int dim>
  NewtonRecord
  Equilibrium<dim>::solve_arc_step(double       &time,
                                   Vector       &displacement,
                                   ArcLength    &arc,
                                   const double  first_step,
                                   const Report &report)
  {
    const double start_time = time;
    Vector load_rate(rhs), support_rate(rhs), rate(rhs), tangent_rate(rhs);
    // Loads and supports are smooth in time; a fraction of a step is enough.
    const double time_difference = 1e-3 * first_step;

    // Change of loads and supports with time: the right-hand side of the rate
    // of the displacement, and its prescribed part.
    const auto evaluate_rates = [&]() {
      const Vector now = external;
      evaluate_loads(time + time_difference);
      load_rate.zero_out_ghost_values();
      load_rate = 0.;
      follower.add_residual(displacement, load_rate);
      load_rate.compress(dealii::VectorOperation::add);
      load_rate.sadd(-1., 1., dead_loads);
      load_rate -= now;
      load_rate /= time_difference;
      constraints.particular(time + time_difference,
                             displacement,
                             support_rate);
      support_rate -= particular;
      support_rate /= time_difference;
      tangent_product(displacement, support_rate, product);
      load_rate -= product;
      constraints.condense(load_rate);
      evaluate_loads(time);
    };
    const auto solve_with =
      [&](Vector &solution, Vector &right_hand_side, Vector &prescribed) {
        const auto iterations = solve_tangent(displacement,
                                              solution,
                                              right_hand_side,
                                              parameters.linear_tolerance);
        constraints.distribute(solution);
        solution += prescribed;
        return iterations;
      };

    bool                             predicted = false;
    double                           time_step = 0.;
    double                           base_time = time;
    Vector                           base;
    typename Constraints<dim>::State base_state;
    NewtonActions                    actions;
    actions.evaluate = [&](const unsigned int iteration) {
      displacement.update_ghost_values();
      evaluate_loads(time);
      auto norms = evaluate(time, displacement, iteration == 0);
      // Iteration 0 is the known start of the step.
      norms.supports_move = norms.supports_move || !predicted;
      return norms;
    };
    actions.solve = [&]() {
      prepare_linear_solver(displacement);
      evaluate_rates();
      auto iterations = solve_with(rate, load_rate, support_rate);
      if (!predicted)
        {
          tangent_rate       = rate;
          const double speed = rate.l2_norm();
          if (arc.radius == 0.)
            arc.radius = first_step * speed;
          time_step = speed > 0. ? arc.radius / speed : first_step;
          if (arc.direction.size() > 0 && arc.direction * rate < 0.)
            time_step = -time_step;
          correction = 0.;
          predicted  = true;
        }
      else
        {
          iterations += solve_with(correction, rhs, particular);
          time_step = -(tangent_rate * correction) / (tangent_rate * rate);
        }
      correction.add(time_step, rate);
      displacement.zero_out_ghost_values();
      base       = displacement;
      base_state = constraints.state();
      base_time  = time;
      return iterations;
    };
    actions.move = [&](const double step) {
      displacement.zero_out_ghost_values();
      displacement = base;
      constraints.restore(base_state);
      constraints.move(step, correction, displacement);
      time = base_time + step * time_step;
    };
    actions.slope  = [&]() { return rhs * correction; };
    actions.report = report;

    displacement.zero_out_ghost_values();
    const Vector start  = displacement;
    const auto   record = guarded(displacement, [&]() {
      return newton(parameters.newton, actions);
    });
    if (!record.converged)
      {
        time = start_time;
        arc.radius *= 0.5;
        return record;
      }
    displacement.zero_out_ghost_values();
    arc.direction = displacement;
    arc.direction -= start;
    // Five iterations are a good pace.
    arc.radius *=
      std::clamp(std::sqrt(5. / std::max(1u, record.n_iterations())), 0.5, 1.5);
    return record;
  }

  template NewtonRecord
  Equilibrium<2>::solve_arc_step(double &,
                                 Vector &,
                                 ArcLength &,
                                 double,
                                 const Report &);
  template NewtonRecord
  Equilibrium<3>::solve_arc_step(double &,
                                 Vector &,
                                 ArcLength &,
                                 double,
                                 const Report &);
} // namespace Perimorph::Solvers
