#include <perimorph/application/crack_setup.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/fracture/segment_growth.h>
#include <perimorph/solvers/load_stepping.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Perimorph::Application
{
  namespace
  {
    template <int dim>
    double
    horizon_at(const Mesh::NodalMesh<dim> &mesh,
               const Mesh::RegionMap      &region,
               const dealii::Point<dim>   &point)
    {
      double       nearest = std::numeric_limits<double>::infinity();
      unsigned int node    = 0;
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        if (region.alpha[n] > 0. && mesh.nodes[n].distance(point) < nearest)
          {
            nearest = mesh.nodes[n].distance(point);
            node    = n;
          }
      return region.horizon[node];
    }

    /// Length of a facet in the body.
    template <int dim>
    double
    length_inside(const Mesh::NodalMesh<dim>   &mesh,
                  const Bonds::CrackFacet<dim> &facet)
    {
      double     length = 0.;
      const auto points =
        Bonds::crack_points(mesh, Bonds::CrackSet<dim>({facet}));
      for (const auto &point : points)
        length += point.measure;
      return length;
    }
  } // namespace

  template <int dim>
  double
  Simulation<dim>::potential_energy(const Method &method) const
  {
    const auto state     = gather(method);
    double     potential = state.strain_energy;
    for (unsigned int n = 0; n < state.displacement.size(); ++n)
      potential -= state.external_force[n] * state.displacement[n];
    return potential;
  }

  template <int dim>
  typename Simulation<dim>::Method
  Simulation<dim>::solve_with(const Bonds::CrackSet<dim> &other_cracks,
                              const Mesh::RegionMap      &other_region,
                              const Method               &start)
  {
    auto method = make_method(other_region, other_cracks);
    continue_from(start, method);
    return method;
  }

  template <int dim>
  void
  Simulation<dim>::continue_from(const Method &start, Method &method)
  {
    for (unsigned int n = 0; n < method.displacement.locally_owned_size(); ++n)
      method.displacement.local_element(n) =
        start.displacement.local_element(n);
    method.time       = start.time;
    const auto record = method.equilibrium->solve(start.time,
                                                  method.displacement,
                                                  [](const auto &) {});
    result->add_count("newton_iterations", record.n_iterations());
    result->add_count("linear_iterations", record.linear_iterations);
    if (!record.converged)
      throw Base::SolveError("behind an advance or a break at t = " +
                             std::to_string(start.time) + ": " + record.reason);
  }

  template <int dim>
  double
  Simulation<dim>::grow_core(Method                       &method,
                             const Mesh::RegionParameters &wider)
  {
    auto next  = make_region_map(*mesh, wider);
    auto alpha = next.alpha;
    for (unsigned int n = 0; n < alpha.size(); ++n)
      alpha[n] = std::max(alpha[n], method.region.alpha[n]);
    if (alpha == method.region.alpha)
      return 0.;
    next.set_alpha(alpha);
    const double before   = potential_energy(method);
    method                = solve_with(cracks, next, method);
    const double switched = potential_energy(method) - before;
    switched_energy += switched;
    count_work(gather(method));
    return switched;
  }

  template <int dim>
  void
  Simulation<dim>::scale_to(const double    time,
                            Method         &method,
                            Step           &step,
                            const OnNewton &on_newton)
  {
    if (method.time != 0.)
      method.displacement *= time / method.time;
    const auto record =
      method.equilibrium->solve(time, method.displacement, [&](const auto &i) {
        on_newton(step, i);
      });
    if (!record.converged)
      throw Base::SolveError("at load factor " + std::to_string(time) + ": " +
                             record.reason);
    method.time            = time;
    step.time              = time;
    step.n_increments      = 1;
    step.newton_iterations = record.n_iterations();
    step.relative_residual = record.residuals.back();
  }

  template <int dim>
  std::optional<typename Simulation<dim>::Advance>
  Simulation<dim>::best_advance([[maybe_unused]] Method         &method,
                                [[maybe_unused]] const OnNewton &on_newton)
  {
    if constexpr (dim == 2)
      {
        const auto &nodal = mesh->nodal();
        const auto  tips  = Fracture::find_tips(nodal, cracks);
        if (tips.empty())
          return std::nullopt;

        // Probes: two horizons long, in a fan ahead of each tip.
        struct Fan
        {
          double                horizon, spacing, length;
          std::vector<double>   angles;
          std::optional<double> direction; ///< known without probes
        };
        const auto factors = post_processing->tip_quantities(
          gather(method),
          method.region,
          method.problem->correspondence_families());
        std::vector<Fan> fans;
        auto             wider = parameters.region;
        for (unsigned int t = 0; t < tips.size(); ++t)
          {
            const auto &tip = tips[t];
            Fan         fan;
            fan.horizon = horizon_at(nodal, method.region, tip.frame.origin);
            fan.spacing = fan.horizon / parameters.region.horizon_ratio;
            fan.length  = parameters.growth.advance.in_horizons
                            ? parameters.growth.advance.value * fan.horizon
                            : parameters.growth.advance.value;
            fan.angles =
              Fracture::probe_angles(cracks.facets()[tip.facet].step == 0);
            if (!factors[t].values.empty() && !parameters.finite_strain())
              fan.direction =
                Fracture::hoop_angle(factors[t].values.front().K_I,
                                     factors[t].values.front().K_II);
            std::vector<Bonds::CrackFacet<2>> outline;
            for (const double angle :
                 {fan.angles.front(), 0., fan.angles.back()})
              outline.push_back(
                Fracture::advance_facet(tip,
                                        angle,
                                        std::max(2. * fan.horizon, fan.length),
                                        0));
            for (const auto &feature :
                 crack_features(Bonds::CrackSet<2>(outline)))
              wider.features.push_back(feature);
            fans.push_back(fan);
          }
        // The core has room before bonds there are cut; it does not shrink.
        const double           switched = grow_core(method, wider);
        const double           start    = potential_energy(method);
        std::optional<Advance> best;
        const auto with_cut = [&](const Bonds::CrackFacet<2> &facet) {
          auto longer = cracks;
          longer.append({facet});
          return solve_with(longer, method.region, method);
        };
        for (unsigned int t = 0; t < tips.size(); ++t)
          {
            const auto         &tip = tips[t];
            const auto         &fan = fans[t];
            std::vector<double> drops;
            if (!fan.direction)
              for (const double angle : fan.angles)
                drops.push_back(
                  start -
                  potential_energy(with_cut(
                    Fracture::advance_facet(tip, angle, 2. * fan.horizon, 0))));
            const double angle  = fan.direction
                                    ? *fan.direction
                                    : Fracture::best_angle(fan.angles, drops);
            const double length = Fracture::closing_length(nodal,
                                                           cracks,
                                                           tip,
                                                           angle,
                                                           fan.length,
                                                           fan.spacing);
            Advance      advance;
            advance.tip = tip;
            advance.facet =
              Fracture::advance_facet(tip, angle, length, n_advances + 1);
            advance.length   = length_inside(nodal, advance.facet);
            advance.switched = switched;
            advance.after    = with_cut(advance.facet);
            advance.released = start - potential_energy(advance.after);
            if (!best || advance.released * best->length >
                           best->released * advance.length)
              best = std::move(advance);
          }
        return best;
      }
    else
      return std::nullopt;
  }

  template <int dim>
  void
  Simulation<dim>::write_advance([[maybe_unused]] const Advance &advance,
                                 [[maybe_unused]] const Step    &step,
                                 [[maybe_unused]] const double   load_factor)
  {
    if constexpr (dim == 2)
      {
        if (!growth_table)
          growth_table = &open_table("crack_growth.csv",
                                     {"advance",
                                      "step",
                                      "time",
                                      "crack",
                                      "x",
                                      "y",
                                      "direction",
                                      "length",
                                      "released_energy",
                                      "dissipated_energy",
                                      "load_factor",
                                      "mean_load_factor",
                                      "energy_of_core_growth"});
        recent_loads.push_back(load_factor);
        if (recent_loads.size() > 3)
          recent_loads.erase(recent_loads.begin());
        const double mean =
          std::accumulate(recent_loads.begin(), recent_loads.end(), 0.) /
          recent_loads.size();
        const auto &corners = advance.facet.corners;
        const auto  along   = corners[1] - corners[0];
        growth_table->write_row(
          {n_advances,
           step.number,
           step.time,
           parameters.pre_cracks[advance.facet.crack].name,
           corners[1][0],
           corners[1][1],
           std::atan2(along[1], along[0]) * 180. / dealii::numbers::PI,
           advance.length,
           advance.released,
           parameters.growth.fracture_energy * advance.length,
           load_factor,
           mean,
           advance.switched});
        log << "  advance " << n_advances << ": crack '"
            << parameters.pre_cracks[advance.facet.crack].name << "' to ("
            << corners[1] << "), load factor " << load_factor << std::endl;
      }
  }

  template <int dim>
  void
  Simulation<dim>::grow_cracks(Method         &method,
                               Step           &step,
                               const OnStep   &on_step,
                               const OnNewton &on_newton)
  {
    const double G_c = parameters.growth.fracture_energy;
    while (n_advances < parameters.growth.maximum_advances)
      {
        auto advance = best_advance(method, on_newton);
        if (!advance || advance->released < G_c * advance->length)
          return;
        cracks.append({advance->facet});
        method = std::move(advance->after);
        ++n_advances;
        ++step.number;
        released_energy += advance->released;
        dissipated_energy += G_c * advance->length;
        grown_length += advance->length;
        write_advance(*advance,
                      step,
                      std::sqrt(G_c * advance->length / advance->released));
        on_step(step);
      }
    log.warning("the largest number of advances was reached");
  }

  template <int dim>
  bool
  Simulation<dim>::grow_at_fixed_loads(Method         &method,
                                       Step           &step,
                                       const OnStep   &on_step,
                                       const OnNewton &on_newton)
  {
    if (parameters.growth.bonds)
      return break_overloaded_bonds(method, step, on_step);
    if (parameters.growth.active)
      grow_cracks(method, step, on_step, on_newton);
    return true;
  }

  template <int dim>
  void
  Simulation<dim>::start_events(Method         &method,
                                Step           &step,
                                const OnNewton &on_newton)
  {
    if (progress.number > 0)
      return;
    if (!method.equilibrium->is_linear())
      {
        // Small: the first event tells how far to go.
        rise_to(1e-6 * parameters.end_time, method, step, on_newton);
        return;
      }
    scale_to(parameters.end_time, method, step, on_newton);
    const Fem::Vector whole(method.displacement);
    scale_to(0.5 * parameters.end_time, method, step, on_newton);
    Fem::Vector rest(method.displacement);
    rest.add(-0.5, whole);
    if (rest.l2_norm() > 1e-8 * whole.l2_norm())
      throw Base::InputError(
        Base::InputMessage{"parameter 'Cracks / growth control'",
                           "'events' with loads that are not in proportion "
                           "to t",
                           "loads and displacements that are multiples of t",
                           "Write P*t instead of P, or use load steps."});
    scale_to(parameters.end_time, method, step, on_newton);
    // Unloaded until the first load factor is known: what happens to the core
    // before does no work.
    counts_work = false;
  }

  template <int dim>
  void
  Simulation<dim>::rise_to(const double    time,
                           Method         &method,
                           Step           &step,
                           const OnNewton &on_newton)
  {
    // The work of the trapezoidal rule needs steps.
    constexpr double      largest_rise = 0.1;
    const double          start        = method.time;
    Solvers::LoadStepping stepping(parameters.load_stepping);
    while (method.time != time)
      {
        const double limit =
          largest_rise * std::max(std::abs(time), std::abs(method.time));
        const double next =
          std::abs(time - method.time) > limit
            ? method.time + std::copysign(limit, time - method.time)
            : time;
        std::string reason;
        const auto  attempt = [&](const double target) {
          const Fem::Vector before(method.displacement);
          const auto        record = method.equilibrium->solve(
            target,
            method.displacement,
            [&](const auto &i) { on_newton(step, i); });
          if (!record.converged)
            {
              reason              = record.reason;
              method.displacement = before;
              return false;
            }
          method.time            = target;
          step.time              = target;
          step.newton_iterations = record.n_iterations();
          step.relative_residual = record.residuals.back();
          count_work(gather(method));
          return true;
        };
        if (stepping.advance(
              method.time,
              next,
              attempt,
              [](double, double) {},
              [](double) {}) != next)
          {
            // What was reached may be far enough.
            if (method.time != start)
              return;
            throw Base::SolveError("at load factor " + std::to_string(next) +
                                   ": " + reason);
          }
      }
  }

  template <int dim>
  void
  Simulation<dim>::find_load(Advance        &advance,
                             Method         &method,
                             Step           &step,
                             const OnNewton &on_newton)
  {
    const double needed = parameters.growth.fracture_energy * advance.length;
    if (method.equilibrium->is_linear())
      {
        const double factor = std::sqrt(needed / advance.released);
        scale_to(factor * method.time, method, step, on_newton);
        scale_to(method.time, advance.after, step, on_newton);
        advance.released = needed;
        return;
      }
    constexpr unsigned int most_iterations = 20;
    constexpr double       tolerance       = 1e-8;
    double                 exponent        = 2.;
    for (unsigned int k = 0; k < most_iterations; ++k)
      {
        const double ratio = advance.released / needed;
        if (std::abs(ratio - 1.) < tolerance)
          return;
        const double time = method.time;
        rise_to(time * std::clamp(std::pow(ratio, -1. / exponent), 0.25, 1e7),
                method,
                step,
                on_newton);
        auto longer = cracks;
        longer.append({advance.facet});
        advance.after = solve_with(longer, method.region, method);
        const double released =
          potential_energy(method) - potential_energy(advance.after);
        if (!(released > 0.))
          throw Base::SolveError("an advance would release no energy at load "
                                 "factor " +
                                 std::to_string(method.time));
        // Secant in logarithms.
        const double measured =
          std::log(released / advance.released) / std::log(method.time / time);
        if (measured > 0.5 && measured < 8.)
          exponent = measured;
        advance.released = released;
      }
    throw Base::SolveError("no load found at which an advance releases the "
                           "fracture energy");
  }

  template <int dim>
  bool
  Simulation<dim>::follow_growth_events(Method         &method,
                                        const OnStep   &on_step,
                                        const OnNewton &on_newton)
  {
    const double G_c  = parameters.growth.fracture_energy;
    Step         step = progress.step;
    start_events(method, step, on_newton);
    while (n_advances < parameters.growth.maximum_advances)
      {
        auto advance = best_advance(method, on_newton);
        if (!advance)
          {
            log << "  no tip is left" << std::endl;
            return true;
          }
        if (!(advance->released > 0.))
          {
            log << "  an advance would release no energy" << std::endl;
            return true;
          }
        if (!counts_work)
          switched_energy = 0.;
        counts_work = true;
        find_load(*advance, method, step, on_newton);
        ++step.number;
        step.between = true;
        on_step(step);
        step.between = false;
        cracks.append({advance->facet});
        method = std::move(advance->after);
        ++n_advances;
        ++step.number;
        released_energy += advance->released;
        dissipated_energy += G_c * advance->length;
        grown_length += advance->length;
        write_advance(*advance, step, method.time);
        progress.number = n_advances;
        on_step(step);
      }
    log.warning("the largest number of advances was reached");
    return false;
  }

#define PERIMORPH_INSTANTIATE(dim)                                            \
  template double Simulation<dim>::potential_energy(const Method &) const;    \
  template Simulation<dim>::Method Simulation<dim>::solve_with(               \
    const Bonds::CrackSet<dim> &,                                             \
    const Mesh::RegionMap &,                                                  \
    const Method &);                                                          \
  template void   Simulation<dim>::continue_from(const Method &, Method &);   \
  template double Simulation<dim>::grow_core(Method &,                        \
                                             const Mesh::RegionParameters &); \
  template void   Simulation<dim>::scale_to(double,                           \
                                          Method &,                         \
                                          Step &,                           \
                                          const OnNewton &);                \
  template std::optional<Simulation<dim>::Advance>                            \
                Simulation<dim>::best_advance(Method &, const OnNewton &);    \
  template void Simulation<dim>::write_advance(const Advance &,               \
                                               const Step &,                  \
                                               double);                       \
  template void Simulation<dim>::grow_cracks(Method &,                        \
                                             Step &,                          \
                                             const OnStep &,                  \
                                             const OnNewton &);               \
  template bool Simulation<dim>::grow_at_fixed_loads(Method &,                \
                                                     Step &,                  \
                                                     const OnStep &,          \
                                                     const OnNewton &);       \
  template void Simulation<dim>::start_events(Method &,                       \
                                              Step &,                         \
                                              const OnNewton &);              \
  template void Simulation<dim>::rise_to(double,                              \
                                         Method &,                            \
                                         Step &,                              \
                                         const OnNewton &);                   \
  template void Simulation<dim>::find_load(Advance &,                         \
                                           Method &,                          \
                                           Step &,                            \
                                           const OnNewton &);                 \
  template bool Simulation<dim>::follow_growth_events(Method &,               \
                                                      const OnStep &,         \
                                                      const OnNewton &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
