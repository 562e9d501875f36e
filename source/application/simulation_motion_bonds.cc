#include <perimorph/application/simulation.h>
#include <perimorph/base/log.h>
#include <perimorph/fem/nodal_values.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Application
{
  namespace
  {
    /// Of the largest eigenvalue of the body at the start, which sums those of
    /// many families and elements.
    constexpr double share_of_family = 0.5;
  } // namespace

  template <int dim>
  std::unique_ptr<Coupling::MovingBonds<dim>>
  Simulation<dim>::make_moving_bonds(Method &method)
  {
    const Coupling::MotionDamage damage{
      *breaking_rule,
      Damage::sees_particles(parameters.growth.criterion),
      Damage::uses_strengths(parameters.growth.criterion)
        ? &parameters.growth.strengths
        : nullptr,
      is_protected,
      broken,
      node_mass,
      parameters.time_integration.scheme == TimeScheme::explicit_motion
        ? share_of_family * std::pow(2. / limit_at_start, 2)
        : std::numeric_limits<double>::infinity()};
    if (parameters.coupling.model == Coupling::Model::bond_based)
      return Coupling::make_moving_pairs<dim>(*mesh,
                                              method.region,
                                              materials,
                                              damage,
                                              *method.problem);
    return Coupling::make_moving_families<dim>(
      *mesh,
      method.region,
      materials,
      Coupling::family_parameters<dim>(parameters.coupling,
                                       mesh->nodal(),
                                       method.region,
                                       materials.laws),
      damage,
      failure_planes,
      *method.problem);
  }

  template <int dim>
  typename Simulation<dim>::MotionChange
  Simulation<dim>::break_in_motion(
    Method                                      &method,
    std::unique_ptr<Coupling::MovingBonds<dim>> &bonds)
  {
    const auto timer = timing.scope("damage");
    auto      &u     = method.motion.displacement;
    u.update_ghost_values();
    const auto displacement =
      Fem::to_nodal_values(u, method.problem->partition());
    auto found = bonds->overloaded(displacement);
    if (found.nodes.empty())
      {
        u.zero_out_ghost_values();
        return MotionChange::none;
      }
    if (!found.outside_core.empty())
      {
        u.zero_out_ghost_values();
        Fem::Vector start(u);
        start.update_ghost_values();
        const double before = method.problem->strain_energy(start);
        grow_core_in_motion(method, found.outside_core);
        // Takes the weight of families that are too stiff.
        bonds = make_moving_bonds(method);
        Fem::Vector same(method.motion.displacement);
        same.update_ghost_values();
        switched_energy += method.problem->strain_energy(same) - before;
        // The next step breaks what is still overloaded.
        return MotionChange::region;
      }
    const Coupling::OrderByPlace<dim> order{mesh->nodal().nodes};
    for (auto &bond : found.nodes)
      std::sort(bond.begin(), bond.end(), order);
    std::sort(found.nodes.begin(), found.nodes.end(), order);
    ++n_events;
    const double before = method.problem->strain_energy(u);
    for (const auto &bond : found.nodes)
      break_bond(bond, n_time_steps, method.motion.time, std::nullopt);
    failure_planes.keep();
    bonds->take_away(found.nodes);
    dissipated_energy += before - method.problem->strain_energy(u);
    u.zero_out_ghost_values();
    return MotionChange::bonds;
  }

  template <int dim>
  void
  Simulation<dim>::grow_core_in_motion(
    Method                                         &method,
    const std::vector<std::array<unsigned int, 2>> &bonds)
  {
    // Room for many steps: each growth builds the problem anew.
    constexpr double margin = 2.;

    auto wider          = parameters.region;
    wider.may_fill_body = true;
    wider.core_size.value *= margin;
    for (const auto &bond : bonds)
      wider.features.push_back(feature_of(bond));
    const auto next = grown_region(method, wider);
    if (!next)
      throw Base::SolveError(
        "bonds would break where elements carry a part, and the core cannot "
        "grow there: use a larger 'Peridynamics / core size'");

    auto       &motion    = method.motion;
    const auto &partition = method.problem->partition();
    const auto  displacement =
      Fem::to_nodal_values(motion.displacement, partition);
    const auto velocity = Fem::to_nodal_values(motion.velocity, partition);
    const auto acceleration =
      Fem::to_nodal_values(motion.acceleration, partition);
    Method grown      = make_method(*next, cracks);
    grown.time        = method.time;
    grown.motion.time = motion.time;
    grown.motion.work = motion.work;
    for (const auto &[values, vector] :
         {std::make_pair(&displacement, &grown.motion.displacement),
          std::make_pair(&velocity, &grown.motion.velocity),
          std::make_pair(&acceleration, &grown.motion.acceleration)})
      {
        grown.problem->partition().initialize(*vector);
        Fem::set_nodal_values(*values, grown.problem->partition(), *vector);
      }
    method = std::move(grown);
    log << "  t = " << motion.time << ": the peridynamic core grows to "
        << method.region.n_core << " nodes" << std::endl;
  }

#define PERIMORPH_INSTANTIATE(dim)                                         \
  template std::unique_ptr<Coupling::MovingBonds<dim>>                     \
  Simulation<dim>::make_moving_bonds(Method &);                            \
  template Simulation<dim>::MotionChange Simulation<dim>::break_in_motion( \
    Method &,                                                              \
    std::unique_ptr<Coupling::MovingBonds<dim>> &);                        \
  template void Simulation<dim>::grow_core_in_motion(                      \
    Method &,                                                              \
    const std::vector<std::array<unsigned int, 2>> &);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
