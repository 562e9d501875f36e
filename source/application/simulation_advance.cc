#include <perimorph/application/crack_setup.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/log.h>
#include <perimorph/fracture/segment_growth.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

    /// A tip and how it may advance.
    struct Plan
    {
      Fracture::CrackTip    tip;
      double                horizon, spacing, length;
      std::vector<double>   angles;    ///< of probes
      std::optional<double> direction; ///< known without probes
      std::optional<double> J;
    };

    /// @param factors  of the tips
    std::vector<Plan>
    make_plans(const Mesh::NodalMesh<2>                   &mesh,
               const Bonds::CrackSet<2>                   &cracks,
               const Mesh::RegionMap                      &region,
               const SimulationParameters<2>              &parameters,
               const std::vector<Fracture::TipQuantities> &factors)
    {
      const auto       &growth = parameters.growth;
      std::vector<Plan> plans;
      for (const auto &known : factors)
        {
          Plan plan;
          plan.tip     = known.tip;
          plan.horizon = horizon_at(mesh, region, plan.tip.frame.origin);
          plan.spacing = plan.horizon / parameters.region.horizon_ratio;
          plan.length  = growth.advance.in_horizons
                           ? growth.advance.value * plan.horizon
                           : growth.advance.value;
          plan.angles =
            Fracture::probe_angles(cracks.facets()[plan.tip.facet].step == 0);
          if (!known.values.empty())
            plan.J = known.values.front().J;
          if (!known.values.empty() && known.is_isotropic &&
              !parameters.finite_strain())
            plan.direction = Fracture::hoop_angle(known.values.front().K_I,
                                                  known.values.front().K_II);
          // Probes that would reach through a ligament say nothing.
          else if (Fracture::distance_ahead(mesh, cracks, plan.tip, 0.) <
                   2. * plan.horizon + 2.2 * plan.spacing)
            plan.direction = 0.;
          plans.push_back(plan);
        }
      return plans;
    }

    /// The region with what the next advances in known directions cut, or the
    /// probes of one.
    Mesh::RegionParameters
    with_room(const Mesh::RegionParameters &region,
              const std::vector<Plan>      &plans,
              const double                  n_advances)
    {
      std::vector<Bonds::CrackFacet<2>> outline;
      for (const auto &plan : plans)
        {
          // An advance may be longer where it meets a surface.
          const double more = 2.2 * plan.spacing;
          if (plan.direction)
            outline.push_back(
              Fracture::advance_facet(plan.tip,
                                      *plan.direction,
                                      n_advances * plan.length + more,
                                      0));
          else
            for (const double angle :
                 {plan.angles.front(), 0., plan.angles.back()})
              outline.push_back(Fracture::advance_facet(
                plan.tip,
                angle,
                std::max(2. * plan.horizon, plan.length + more),
                0));
        }
      auto wider          = region;
      wider.may_fill_body = true;
      for (const auto &feature : crack_features(Bonds::CrackSet<2>(outline)))
        wider.features.push_back(feature);
      return wider;
    }
  } // namespace

  template <int dim>
  std::optional<typename Simulation<dim>::Method>
  Simulation<dim>::state_behind(const Bonds::CrackFacet<dim> &facet,
                                const Method                 &method)
  {
    auto longer = cracks;
    longer.append({facet});
    const auto count_parts = [&](const Bonds::CrackSet<dim> &set) {
      const auto parts = parts_of_body(mesh->nodal(), set);
      return *std::max_element(parts.begin(), parts.end());
    };
    const bool cuts_off = count_parts(longer) > count_parts(cracks);
    // Loads move a loose piece without end.
    if (cuts_off && !loads->empty())
      return std::nullopt;
    try
      {
        return solve_with(longer, method.region, method);
      }
    catch (const Base::SolveError &)
      {
        if (cuts_off)
          return std::nullopt;
        throw;
      }
  }

  template <int dim>
  std::optional<typename Simulation<dim>::Advance>
  Simulation<dim>::best_advance([[maybe_unused]] Method &method)
  {
    if constexpr (dim == 2)
      {
        const auto &nodal = mesh->nodal();
        const auto  plans =
          make_plans(nodal,
                     cracks,
                     method.region,
                     parameters,
                     post_processing->tip_quantities(
                       gather(method),
                       method.region,
                       method.problem->correspondence_families()));
        if (plans.empty())
          return std::nullopt;

        // The core has room before bonds there are cut, for some advances at
        // once; it does not shrink.
        const auto needed =
          make_region_map(*mesh, with_room(parameters.region, plans, 1.)).alpha;
        bool fits = true;
        for (unsigned int n = 0; n < needed.size(); ++n)
          fits = fits && needed[n] <= method.region.alpha[n];
        const double switched =
          fits ? 0.
               : grow_core(method, with_room(parameters.region, plans, 3.));
        const double start       = potential_energy(method);
        const auto   released_by = [&](const std::optional<Method> &after) {
          return after ? start - potential_energy(*after)
                         : std::numeric_limits<double>::infinity();
        };
        const auto by_probes = [&](const Plan &plan) {
          // Without the probes that cut something off.
          std::vector<double> angles, drops;
          for (const double angle : plan.angles)
            {
              const double drop = released_by(state_behind(
                Fracture::advance_facet(plan.tip, angle, 2. * plan.horizon, 0),
                method));
              if (std::isfinite(drop))
                {
                  angles.push_back(angle);
                  drops.push_back(drop);
                }
            }
          return drops.size() < 3 ? 0. : Fracture::best_angle(angles, drops);
        };

        std::optional<Advance> best;
        for (const auto &plan : plans)
          {
            const double angle =
              plan.direction ? *plan.direction : by_probes(plan);
            const double length = Fracture::closing_length(nodal,
                                                           cracks,
                                                           plan.tip,
                                                           angle,
                                                           plan.length,
                                                           plan.spacing);
            Advance      advance;
            advance.facet =
              Fracture::advance_facet(plan.tip, angle, length, n_advances + 1);
            advance.length   = length_inside(nodal, advance.facet);
            advance.switched = switched;
            advance.J        = plan.J;
            auto after       = state_behind(advance.facet, method);
            advance.released = released_by(after);
            if (after)
              advance.after = std::move(*after);
            // Tips that are equal but for round-off go in their order, on any
            // number of ranks.
            if (!best || advance.released * best->length >
                           (1. + 1e-6) * best->released * advance.length)
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
                                 [[maybe_unused]] const Step    &step)
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
                                      "energy_release_rate",
                                      "J",
                                      "load_factor",
                                      "mean_load_factor",
                                      "energy_of_core_growth"});
        // Where the advance is just possible, of loads in proportion to t; by
        // events that is the time itself.
        const double energy =
          parameters.growth.fracture_energy * advance.length;
        const double load_factor =
          step.time * std::sqrt(energy / advance.released);
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
           energy,
           advance.released / advance.length,
           advance.J ? Output::CsvCell(*advance.J) : Output::CsvCell(""),
           load_factor,
           mean,
           advance.switched});
        log << "  advance " << n_advances << ": crack '"
            << parameters.pre_cracks[advance.facet.crack].name << "' to ("
            << corners[1] << "), load factor " << load_factor << std::endl;
      }
  }

#define PERIMORPH_INSTANTIATE(dim)                              \
  template std::optional<Simulation<dim>::Method>               \
  Simulation<dim>::state_behind(const Bonds::CrackFacet<dim> &, \
                                const Method &);                \
  template std::optional<Simulation<dim>::Advance>              \
                Simulation<dim>::best_advance(Method &);        \
  template void Simulation<dim>::write_advance(const Advance &, const Step &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
