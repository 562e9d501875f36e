#include <perimorph/application/crack_setup.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/log.h>
#include <perimorph/solvers/load_stepping.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Application
{
  namespace
  {
    constexpr char loose_piece[] =
      "the next advance cuts off a piece that nothing holds";
  } // namespace

  template <int dim>
  double
  Simulation<dim>::potential_energy(const Method &method) const
  {
    const auto &equilibrium = *method.equilibrium;
    const auto &loads       = equilibrium.external_forces();
    if (equilibrium.is_linear() && equilibrium.is_symmetric())
      return 0.5 * (equilibrium.internal_forces() * method.displacement) -
             loads * method.displacement;
    Fem::Vector displacement(method.displacement);
    displacement.update_ghost_values();
    return method.problem->strain_energy(displacement) -
           loads * method.displacement;
  }

  template <int dim>
  typename Simulation<dim>::Method
  Simulation<dim>::solve_with(const Bonds::CrackSet<dim> &other_cracks,
                              const Mesh::RegionMap      &other_region,
                              const Method               &start)
  {
    auto shared = start.problem->shared();
    shared.intact.reset();
    auto method = make_method(other_region, other_cracks, std::move(shared));
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
    method.time = start.time;
    method.equilibrium->remember_force(start.equilibrium->largest_force_met());
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
  std::optional<Mesh::RegionMap>
  Simulation<dim>::grown_region(const Method                 &method,
                                const Mesh::RegionParameters &wider) const
  {
    auto next  = make_region_map(*mesh, wider);
    auto alpha = next.alpha;
    for (unsigned int n = 0; n < alpha.size(); ++n)
      alpha[n] = std::max(alpha[n], method.region.alpha[n]);
    if (alpha == method.region.alpha)
      return std::nullopt;
    next.set_alpha(alpha);
    return next;
  }

  template <int dim>
  Parameters::Feature
  Simulation<dim>::feature_of(const std::array<unsigned int, 2> &bond) const
  {
    Parameters::Feature feature;
    feature.kind = Parameters::FeatureKind::segment;
    for (const unsigned int n : bond)
      for (int d = 0; d < dim; ++d)
        feature.numbers.push_back(mesh->nodal().nodes[n][d]);
    return feature;
  }

  template <int dim>
  double
  Simulation<dim>::grow_core(Method                       &method,
                             const Mesh::RegionParameters &wider)
  {
    const auto next = grown_region(method, wider);
    if (!next)
      return 0.;
    const double before   = potential_energy(method);
    method                = solve_with(cracks, *next, method);
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
  unsigned int
  Simulation<dim>::n_large_parts() const
  {
    return count_large_parts(parts_of_body(mesh->nodal(), cracks));
  }

  template <int dim>
  void
  Simulation<dim>::end_growth(const std::string &reason,
                              const std::string &text)
  {
    growth_end = reason;
    log << "  " << text << std::endl;
  }

  template <int dim>
  void
  Simulation<dim>::accept(Advance &advance, Method &method, Step &step)
  {
    cracks.append({advance.facet});
    method = std::move(advance.after);
    ++n_advances;
    ++step.number;
    released_energy += advance.released;
    dissipated_energy += parameters.growth.fracture_energy * advance.length;
    grown_length += advance.length;
    write_advance(advance, step);
  }

  template <int dim>
  bool
  Simulation<dim>::grow_cracks(Method       &method,
                               Step         &step,
                               const OnStep &on_step)
  {
    const double G_c = parameters.growth.fracture_energy;
    if (n_advances == 0)
      parts_at_start = n_large_parts();
    while (n_advances < parameters.growth.maximum_advances)
      {
        if (n_large_parts() > parts_at_start)
          {
            end_growth("separated", "the body is separated");
            return false;
          }
        auto advance = best_advance(method);
        if (!advance || advance->released < G_c * advance->length)
          return true;
        if (!std::isfinite(advance->released))
          {
            end_growth("separated", loose_piece);
            return false;
          }
        accept(*advance, method, step);
        on_step(step);
      }
    growth_end = "largest number of advances";
    log.warning("the largest number of advances was reached");
    return true;
  }

  template <int dim>
  bool
  Simulation<dim>::grow_at_fixed_loads(Method       &method,
                                       Step         &step,
                                       const OnStep &on_step)
  {
    if (parameters.growth.bonds)
      return break_overloaded_bonds(method, step, on_step);
    if (parameters.growth.active)
      return grow_cracks(method, step, on_step);
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
        if (advance.J)
          *advance.J *= factor * factor;
        return;
      }
    advance.J.reset();
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
        auto after = state_behind(advance.facet, method);
        if (!after)
          throw Base::SolveError(loose_piece);
        advance.after = std::move(*after);
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
    Step step = progress.step;
    start_events(method, step, on_newton);
    if (n_advances == 0)
      parts_at_start = n_large_parts();
    while (n_advances < parameters.growth.maximum_advances)
      {
        if (n_large_parts() > parts_at_start)
          {
            end_growth("separated", "the body is separated");
            return true;
          }
        auto advance = best_advance(method);
        if (!advance)
          {
            end_growth("no tip left", "no tip is left");
            return true;
          }
        if (!(advance->released > 0.))
          {
            end_growth("no energy released",
                       "an advance would release no energy");
            return true;
          }
        if (!std::isfinite(advance->released))
          {
            end_growth("separated", loose_piece);
            return true;
          }
        if (!counts_work)
          switched_energy = advance->switched = 0.;
        counts_work = true;
        find_load(*advance, method, step, on_newton);
        ++step.number;
        step.between = true;
        on_step(step);
        step.between = false;
        accept(*advance, method, step);
        progress.number = n_events + n_advances;
        on_step(step);
      }
    growth_end = "largest number of advances";
    log.warning("the largest number of advances was reached");
    return false;
  }

#define PERIMORPH_INSTANTIATE(dim)                                                  \
  template double Simulation<dim>::potential_energy(const Method &) const;          \
  template Simulation<dim>::Method Simulation<dim>::solve_with(                     \
    const Bonds::CrackSet<dim> &,                                                   \
    const Mesh::RegionMap &,                                                        \
    const Method &);                                                                \
  template void Simulation<dim>::rise_to(double,                                    \
                                         Method &,                                  \
                                         Step &,                                    \
                                         const OnNewton &);                         \
  template void Simulation<dim>::find_load(Advance &,                               \
                                           Method &,                                \
                                           Step &,                                  \
                                           const OnNewton &);                       \
  template void Simulation<dim>::continue_from(const Method &, Method &);           \
  template std::optional<Mesh::RegionMap> Simulation<dim>::grown_region(            \
    const Method &,                                                                 \
    const Mesh::RegionParameters &) const;                                          \
  template Parameters::Feature Simulation<dim>::feature_of(                         \
    const std::array<unsigned int, 2> &) const;                                     \
  template double       Simulation<dim>::grow_core(Method &,                        \
                                             const Mesh::RegionParameters &); \
  template void         Simulation<dim>::scale_to(double,                           \
                                          Method &,                         \
                                          Step &,                           \
                                          const OnNewton &);                \
  template unsigned int Simulation<dim>::n_large_parts() const;                     \
  template void         Simulation<dim>::end_growth(const std::string &,            \
                                            const std::string &);           \
  template void         Simulation<dim>::accept(Advance &, Method &, Step &);       \
  template bool         Simulation<dim>::grow_cracks(Method &,                      \
                                             Step &,                        \
                                             const OnStep &);               \
  template bool         Simulation<dim>::grow_at_fixed_loads(Method &,              \
                                                     Step &,                \
                                                     const OnStep &);       \
  template void         Simulation<dim>::start_events(Method &,                     \
                                              Step &,                       \
                                              const OnNewton &);            \
  template bool         Simulation<dim>::follow_growth_events(Method &,             \
                                                      const OnStep &,       \
                                                      const OnNewton &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
