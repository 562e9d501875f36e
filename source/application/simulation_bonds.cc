#include <perimorph/application/crack_setup.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/coupling/bond_energies.h>
#include <perimorph/coupling/bond_states.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Application
{
  namespace
  {
    /// Bonds that break at loads up to this much above the lowest break in one
    /// event (numerics-damage.md, section 3).
    constexpr double tolerance = 0.02;

    constexpr double never = std::numeric_limits<double>::infinity();

    /// Factor by which one event changes the energy of a body of which only a
    /// mechanism is left.
    constexpr double mechanism = 1e4;

    /// Share of the core inside the body whose nodes sit in the middle of their
    /// neighbours, as those of a lattice do.
    template <int dim>
    double
    share_on_lattice(const Mesh::NodalMesh<dim> &mesh,
                     const Mesh::RegionMap      &region)
    {
      std::vector<bool> on_surface(mesh.n_nodes(), false);
      for (const auto &face : mesh.boundary_faces)
        for (const unsigned int n : face.nodes)
          on_surface[n] = true;
      unsigned int n_inside = 0, n_lattice = 0;
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        {
          if (region.alpha[n] < 1. || on_surface[n])
            continue;
          ++n_inside;
          dealii::Tensor<1, dim> sum;
          unsigned int           n_cells = 0;
          for (const unsigned int c : mesh.node_cells.row(n))
            {
              sum += mesh.cell_centroid[c] - mesh.nodes[n];
              ++n_cells;
            }
          if (n_cells == (1u << dim) && sum.norm() < 1e-6 * mesh.spacing[n])
            ++n_lattice;
        }
      return n_inside > 0 ? double(n_lattice) / n_inside : 0.;
    }
  } // namespace

  template <int dim>
  void
  Simulation<dim>::warn_of_bond_criteria() const
  {
    if (share_on_lattice(mesh->nodal(), region) > 0.5)
      log.warning("bonds break along the rows of a regular mesh; use an "
                  "unstructured one where cracks are to find their way");
    if (Damage::sees_particles(parameters.growth.criterion) &&
        parameters.growth.criterion != Damage::Criterion::bond_strain &&
        !(Damage::uses_strengths(parameters.growth.criterion) &&
          parameters.growth.strengths.opens_planes))
      log.warning("the criterion sees means over families, which hardly feel a "
                  "cut: it finds where damage starts, but damage becomes a "
                  "band several horizons wide instead of a crack");
    const double ratio = parameters.region.horizon_ratio;
    if (parameters.growth.criterion == Damage::Criterion::critical_energy &&
        parameters.growth.limits.calibration == 0. &&
        (parameters.has_anisotropic_laws() ||
         parameters.state != Materials::PlaneState::plane_stress ||
         parameters.coupling.gamma != 1. || ratio < 2. || ratio > 3.))
      log.warning("the automatic 'Cracks / energy calibration' was measured "
                  "for isotropic laws in plane stress, for horizon ratios of 2 "
                  "to 3 and a "
                  "stabilisation of 1; measure it with a known crack here");
  }

  template <int dim>
  std::vector<BondLoad>
  Simulation<dim>::bond_loads(const Method &method) const
  {
    const auto &nodal = mesh->nodal();
    const auto  state = gather(method);
    const auto  energies =
      parameters.coupling.model == Coupling::Model::bond_based
         ? Coupling::bond_energies(nodal,
                                  method.problem->bonds(),
                                  state.displacement,
                                  communicator)
         : Coupling::bond_energies(nodal,
                                  method.problem->correspondence_families(),
                                  materials.laws,
                                  state.displacement,
                                  communicator);
    const auto &alpha = method.region.alpha;

    std::vector<std::array<unsigned int, 2>> pairs;
    for (const auto &bond : energies)
      pairs.push_back(bond.nodes);
    const auto in_core = Coupling::nodes_in_core(alpha, pairs, communicator);

    Coupling::ParticleStates particles;
    if (Damage::sees_particles(parameters.growth.criterion))
      particles =
        Coupling::particle_states(nodal,
                                  method.problem->correspondence_families(),
                                  materials.laws,
                                  state.displacement,
                                  communicator);

    std::vector<BondLoad> loads;
    loads.reserve(energies.size());
    for (const auto &bond : energies)
      {
        const auto [i, j] = bond.nodes;
        const auto xi     = nodal.nodes[j] - nodal.nodes[i];
        const auto eta    = state.displacement[j] - state.displacement[i];
        auto       one    = Coupling::bond_state(nodal,
                                        method.region,
                                        materials.bond_constants,
                                        i,
                                        j,
                                        eta);
        // Where elements carry a part, the whole bond would have more.
        one.energy =
          bond.energy /
          (0.5 * (std::max(alpha[i], 1e-3) + std::max(alpha[j], 1e-3)));
        one.teeth_lost = broken.teeth_lost(i, j);
        if (!particles.nodes.empty())
          Coupling::see_particles<dim>(particles.nodes[i],
                                       particles.nodes[j],
                                       xi,
                                       eta,
                                       one);
        const bool with_strengths =
          Damage::uses_strengths(parameters.growth.criterion);
        const Coupling::StrengthLoad load =
          is_protected[i] || is_protected[j] ? Coupling::StrengthLoad{never, {}}
          : with_strengths
            ? Coupling::load_factor_by_strength(bond.nodes,
                                                particles,
                                                materials,
                                                parameters.growth.strengths,
                                                *breaking_rule,
                                                one)
            : Coupling::StrengthLoad{breaking_rule->load_factor(one), {}};
        loads.push_back({bond.nodes,
                         load.load_factor,
                         bond.energy / (broken.n_teeth() - one.teeth_lost),
                         in_core[i] && in_core[j],
                         load.normal});
      }
    return loads;
  }

  template <int dim>
  std::vector<BondLoad>
  Simulation<dim>::lowest_loads(const Method          &method,
                                const double           limit,
                                std::vector<BondLoad> &loads)
  {
    const auto           &nodes = mesh->nodal().nodes;
    std::vector<BondLoad> first;
    while (first.empty())
      {
        double lowest = never;
        for (const auto &bond : loads)
          lowest = std::min(lowest, bond.factor);
        if (!(lowest < never) || lowest > limit)
          break;
        const double highest      = std::min(limit, (1. + tolerance) * lowest);
        const auto   breaks_alone = [&](const BondLoad &bond) {
          return bond.factor <= highest && bond.normal.norm_square() == 0.;
        };
        std::vector<Coupling::OverloadedBond> openers;
        for (const auto &bond : loads)
          if (bond.factor <= highest && !breaks_alone(bond))
            openers.push_back({bond.nodes, bond.factor, bond.normal});
        failure_planes.open(openers, nodes, method.region.horizon);
        for (auto &bond : loads)
          {
            const auto &[i, j] = bond.nodes;
            if (breaks_alone(bond) || (failure_planes.cut(nodes[i], nodes[j]) &&
                                       !is_protected[i] && !is_protected[j]))
              first.push_back(bond);
            else if (bond.factor <= highest)
              bond.factor = never; // waits for a crack beside it
          }
      }
    return first;
  }

  template <int dim>
  std::vector<BondLoad>
  Simulation<dim>::next_to_break(Method &method, const double limit)
  {
    while (true)
      {
        auto       loads = bond_loads(method);
        const auto first = lowest_loads(method, limit, loads);
        if (first.empty())
          return {};
        bool in_core = true;
        for (const auto &bond : first)
          in_core = in_core && bond.in_core;
        if (in_core)
          return first;

        auto wider          = parameters.region;
        wider.may_fill_body = true;
        const auto add      = [&](const std::array<unsigned int, 2> &nodes) {
          wider.features.push_back(feature_of(nodes));
        };
        std::set<unsigned int> ends;
        for (const auto &bond : first)
          if (!bond.in_core)
            {
              add(bond.nodes);
              ends.insert(bond.nodes.begin(), bond.nodes.end());
            }
        const auto before = method.region.alpha;
        // Where cells grow, families reach further than the core around them.
        for (unsigned int k = 0; k < 6 && before == method.region.alpha; ++k)
          {
            grow_core(method, wider);
            wider.core_size.value *= 1.5;
          }
        if (before == method.region.alpha)
          {
            // Horizons that differ much: room around all bonds of these nodes.
            for (const auto &bond : loads)
              if (ends.count(bond.nodes[0]) + ends.count(bond.nodes[1]) > 0)
                add(bond.nodes);
            grow_core(method, wider);
          }
        if (before == method.region.alpha)
          throw Base::SolveError(
            "bonds would break where elements carry a part, and the core "
            "cannot grow there: use a larger 'Peridynamics / core size'");
        log << "  the peridynamic core grows: " << method.region.n_core
            << " nodes" << std::endl;
      }
  }

  template <int dim>
  unsigned int
  Simulation<dim>::n_parts(const Method &method, const State<dim> &loaded) const
  {
    std::vector<bool> is_loaded;
    for (const auto &force : loaded.external_force)
      is_loaded.push_back(force.norm() > 0.);
    return count_large_parts(method.problem->parts(method.region), is_loaded);
  }

  template <int dim>
  void
  Simulation<dim>::break_bond(const std::array<unsigned int, 2> &nodes,
                              const Output::CsvCell             &step,
                              const double                       time,
                              const std::optional<double>       &energy)
  {
    if (!broken_table)
      {
        std::vector<std::string> columns = {"event",
                                            "step",
                                            energy ? "load_factor" : "time"};
        for (const std::string end : {"1", "2"})
          for (int d = 0; d < dim; ++d)
            columns.push_back(std::string(1, "xyz"[d]) + end);
        if (energy)
          columns.push_back("energy");
        columns.push_back("share_left");
        broken_table = &open_table("broken_bonds.csv", columns);
      }
    broken.add(nodes[0], nodes[1], n_events);
    std::vector<Output::CsvCell> row = {n_events, step, time};
    for (const unsigned int n : nodes)
      for (int d = 0; d < dim; ++d)
        row.push_back(mesh->nodal().nodes[n][d]);
    if (energy)
      row.push_back(*energy);
    row.push_back(broken.share_left(nodes[0], nodes[1]));
    broken_table->write_row(row);
  }

  template <int dim>
  bool
  Simulation<dim>::break_bonds(Method               &method,
                               std::vector<BondLoad> bonds,
                               const Step           &step)
  {
    failure_planes.keep();
    const auto state = gather(method);
    if (broken.empty())
      parts_at_start = n_parts(method, state);
    const Coupling::OrderByPlace<dim> order{mesh->nodal().nodes};
    for (auto &bond : bonds)
      std::sort(bond.nodes.begin(), bond.nodes.end(), order);
    std::sort(bonds.begin(),
              bonds.end(),
              [&](const auto &one, const auto &two) {
                return order(one.nodes, two.nodes);
              });
    ++n_events;
    double stored = 0.;
    for (const auto &bond : bonds)
      {
        stored += bond.energy;
        break_bond(bond.nodes, step.number, method.time, bond.energy);
      }
    auto next = make_method(method.region, cracks, method.problem->shared());
    next.time = method.time;
    log << "  event " << n_events << ": " << bonds.size()
        << (broken.n_teeth() > 1 ? " bonds soften" : " bonds break")
        << " at load factor " << method.time << std::endl;
    const bool falls_apart = n_parts(next, state) > parts_at_start;
    result->set("counts", "events", n_events);
    result->set("counts", "bonds_broken_in_events", broken.size() + n_replaced);
    result->set("counts",
                "isolated_particles",
                next.problem->counts().isolated);
    dissipated_energy += stored;
    if (falls_apart && !loads->empty())
      {
        // Loads move a loose part without end: there is no state to solve for.
        end_growth("separated", "the body falls apart");
        return false;
      }
    const double before = potential_energy(method);
    try
      {
        continue_from(method, next);
      }
    catch (const Base::SolveError &error)
      {
        // Loads move a mechanism without end, too; or the largest part is
        // held by nothing.
        if (loads->empty() && !falls_apart)
          throw;
        end_growth("separated",
                   std::string("the body falls apart: ") + error.what());
        return false;
      }
    method             = std::move(next);
    const double after = potential_energy(method);
    released_energy += before - after;
    if (falls_apart || std::abs(after) * mechanism < std::abs(before) ||
        std::abs(after) > mechanism * std::abs(before))
      {
        end_growth("separated", "the body falls apart");
        return false;
      }
    return true;
  }

  template <int dim>
  bool
  Simulation<dim>::follow_bond_events(Method         &method,
                                      const OnStep   &on_step,
                                      const OnNewton &on_newton)
  {
    Step step = progress.step;
    start_events(method, step, on_newton);
    while (n_events < parameters.growth.maximum_advances)
      {
        if (handed_over || hand_over(method, step, on_step))
          {
            const bool complete =
              follow_growth_events(method, on_step, on_newton);
            if (!complete || !hand_back())
              return complete;
            step = progress.step;
          }
        auto bonds = next_to_break(method, never);
        if (bonds.empty())
          {
            end_growth("no bond extends", "no bond extends");
            return true;
          }
        double factor = never;
        for (const auto &bond : bonds)
          factor = std::min(factor, bond.factor);
        for (auto &bond : bonds)
          bond.energy *= factor * factor;
        if (!counts_work)
          switched_energy = 0.;
        counts_work = true;
        scale_to(factor * method.time, method, step, on_newton);
        ++step.number;
        step.between = true;
        on_step(step);
        step.between     = false;
        const bool holds = break_bonds(method, bonds, step);
        ++step.number;
        progress.number = n_events + n_advances;
        on_step(step);
        if (!holds)
          return true;
      }
    growth_end = "largest number of events";
    log.warning("the largest number of events was reached");
    return false;
  }

  template <int dim>
  bool
  Simulation<dim>::break_overloaded_bonds(Method       &method,
                                          Step         &step,
                                          const OnStep &on_step)
  {
    while (n_events < parameters.growth.maximum_advances)
      {
        if (handed_over || hand_over(method, step, on_step))
          {
            if (!grow_cracks(method, step, on_step))
              return false;
            if (!hand_back())
              return true;
          }
        auto bonds = next_to_break(method, 1.);
        if (bonds.empty())
          return true;
        // Beyond its limit a bond stores more than breaking it takes.
        for (auto &bond : bonds)
          bond.energy *= std::pow(std::min(bond.factor, 1.), 2);
        const bool holds = break_bonds(method, bonds, step);
        ++step.number;
        on_step(step);
        if (!holds)
          return false;
      }
    growth_end = "largest number of events";
    log.warning("the largest number of events was reached");
    return true;
  }

#define PERIMORPH_INSTANTIATE(dim)                                                   \
  template void                  Simulation<dim>::warn_of_bond_criteria() const;     \
  template std::vector<BondLoad> Simulation<dim>::bond_loads(const Method &)         \
    const;                                                                           \
  template std::vector<BondLoad> Simulation<dim>::lowest_loads(                      \
    const Method &,                                                                  \
    double,                                                                          \
    std::vector<BondLoad> &);                                                        \
  template std::vector<BondLoad> Simulation<dim>::next_to_break(Method &,            \
                                                                double);             \
  template unsigned int          Simulation<dim>::n_parts(const Method &,            \
                                                 const State<dim> &) const; \
  template void                  Simulation<dim>::break_bond(                        \
    const std::array<unsigned int, 2> &,                            \
    const Output::CsvCell &,                                        \
    double,                                                         \
    const std::optional<double> &);                                 \
  template bool Simulation<dim>::break_bonds(Method &,                               \
                                             std::vector<BondLoad>,                  \
                                             const Step &);                          \
  template bool Simulation<dim>::follow_bond_events(Method &,                        \
                                                    const OnStep &,                  \
                                                    const OnNewton &);               \
  template bool Simulation<dim>::break_overloaded_bonds(Method &,                    \
                                                        Step &,                      \
                                                        const OnStep &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
