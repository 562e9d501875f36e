#include <perimorph/application/crack_setup.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/log.h>
#include <perimorph/fracture/crack_tips.h>
#include <perimorph/fracture/nucleated_crack.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Application
{
  namespace
  {
    /// Broken and softened bonds so near the line of a crack are replaced by it
    /// [in horizons].
    constexpr double replaced_within = 2.01;

    /// Changes of energy so small are small enough [of the strain energy].
    constexpr double precision = 1e-4;

    /// The cracks with tips once one has the length, at least a horizon. Cracks
    /// at both sides of a hole grow in turns: those of half the length come
    /// along.
    std::vector<Fracture::NucleatedCrack>
    long_enough(const std::vector<Fracture::NucleatedCrack> &all,
                const Parameters::Length                    &length)
    {
      constexpr double enough = 1. - 1e-6; // round-off must not decide
      std::vector<Fracture::NucleatedCrack> found;
      double                                longest = 0.;
      for (const auto &crack : all)
        {
          const double share =
            Fracture::length_of_line(crack.line) /
            (length.in_horizons ? length.value * crack.horizon
                                : std::max(length.value, crack.horizon));
          if (!crack.is_free[1] || share < 0.5 * enough)
            continue;
          longest = std::max(longest, share);
          found.push_back(crack);
        }
      if (longest < enough)
        found.clear();
      return found;
    }

    /// The bonds that stay broken.
    Bonds::BrokenBonds
    without_those_at(const Mesh::NodalMesh<2>                    &mesh,
                     const std::vector<double>                   &horizon,
                     const std::vector<Fracture::NucleatedCrack> &made,
                     const Bonds::BrokenBonds                    &broken)
    {
      Bonds::BrokenBonds left(broken.n_teeth());
      for (const auto &bond : broken.list())
        {
          const auto middle   = Fracture::middle_of(mesh, horizon, bond.nodes);
          bool       replaced = false;
          for (const auto &crack : made)
            for (std::size_t k = 1; k < crack.line.size(); ++k)
              if (Mesh::closest_on_segment(middle.position,
                                           crack.line[k - 1],
                                           crack.line[k])
                    .distance(middle.position) <=
                  replaced_within * middle.horizon)
                replaced = true;
          for (unsigned int tooth = 0; tooth < bond.teeth && !replaced; ++tooth)
            left.add(bond.nodes[0], bond.nodes[1], bond.event);
        }
      return left;
    }

    /// The cracks as facets.
    /// @param next  number of the first new crack
    /// @throws Base::InputError  a crack that cannot open the surface
    std::vector<Bonds::CrackFacet<2>>
    facets_of(const Mesh::NodalMesh<2>                    &mesh,
              const std::vector<Fracture::NucleatedCrack> &made,
              const double                                 move,
              const double                                 horizon_ratio,
              unsigned int                                 next)
    {
      std::vector<Bonds::CrackFacet<2>> facets;
      for (const auto &crack : made)
        {
          Parameters::Polyline line;
          for (const auto &point :
               Fracture::with_tips_moved(crack, move * crack.horizon))
            line.points.push_back({point[0], point[1]});
          const unsigned int number = crack.crack ? *crack.crack : next++;
          const auto opened = make_cracks<2>(mesh, {line}, horizon_ratio);
          for (auto facet : opened.facets())
            {
              facet.crack = number;
              facet.step  = 1;
              facets.push_back(facet);
            }
        }
      return facets;
    }
  } // namespace

  template <int dim>
  void
  Simulation<dim>::name_nucleated_cracks()
  {
    if constexpr (dim == 2)
      for (const auto &facet : cracks.facets())
        if (facet.crack == parameters.pre_cracks.size())
          {
            ++n_nucleated;
            parameters.pre_cracks.push_back(
              {"nucleated_" + std::to_string(n_nucleated), {}, "", {}});
          }
  }

  template <int dim>
  bool
  Simulation<dim>::hand_over([[maybe_unused]] Method       &method,
                             [[maybe_unused]] Step         &step,
                             [[maybe_unused]] const OnStep &on_step)
  {
    if constexpr (dim == 2)
      {
        const auto &growth = parameters.growth;
        if (!growth.hand_over || broken.size() == 0)
          return false;
        const auto &nodal   = mesh->nodal();
        const auto  horizon = method.region.horizon;
        const auto  made =
          long_enough(Fracture::find_nucleated_cracks(
                        nodal,
                        cracks,
                        Fracture::broken_places(nodal, horizon, broken)),
                      *growth.hand_over);
        if (made.empty())
          return false;

        auto wider          = parameters.region;
        wider.may_fill_body = true;
        std::vector<Bonds::CrackFacet<2>> facets;
        const auto                        place = [&](const double move) {
          facets      = facets_of(nodal,
                             made,
                             move,
                             parameters.region.horizon_ratio,
                             parameters.pre_cracks.size());
          auto longer = cracks;
          longer.append(facets);
          return longer;
        };
        try
          {
            for (const auto &feature : crack_features(place(0.)))
              wider.features.push_back(feature);
          }
        catch (const Base::InputError &)
          {
            // Along a side of the body: perhaps later.
            return false;
          }
        grow_core(method, wider);

        const auto   all    = broken;
        const double before = potential_energy(method);
        const double scale  = gather(method).strain_energy;
        broken = without_those_at(nodal, method.region.horizon, made, all);

        std::optional<Method>             best;
        std::vector<Bonds::CrackFacet<2>> best_facets;
        double     best_change = std::numeric_limits<double>::infinity();
        const auto change      = [&](const double move) {
          const auto   longer = place(move);
          auto         other  = solve_with(longer, method.region, method);
          const double value  = potential_energy(other) - before;
          if (std::abs(value) < std::abs(best_change))
            {
              best_change = value;
              best_facets = facets;
              best        = std::move(other);
            }
          return value;
        };
        unsigned int n = 0;
        try
          {
            n = Fracture::try_moves(change, precision * scale);
          }
        catch (const Base::SolveError &error)
          {
            broken = all;
            log << "  no hand-over: " << error.what() << std::endl;
            return false;
          }
        catch (const Base::InputError &)
          {
            broken = all; // moved out of the body
            return false;
          }

        cracks.append(best_facets);
        name_nucleated_cracks();
        method      = std::move(*best);
        handed_over = true;
        hand_over_energy += best_change;
        switched_energy += best_change;
        count_work(gather(method));
        hand_over_event = n_events;
        n_replaced += all.size() - broken.size();
        for (const auto &facet : best_facets)
          hand_over_crack += facet.measure();
        solves_before = n_solves();
        for (const auto &facet : best_facets)
          log << "  broken bonds become crack '"
              << parameters.pre_cracks[facet.crack].name << "': ("
              << facet.corners[0] << ") to (" << facet.corners[1] << ")\n";
        log << "  hand-over to growth by segments: change of energy "
            << best_change << " (" << best_change / scale
            << " of the strain energy), " << n << " solutions" << std::endl;
        ++step.number;
        on_step(step);
        return true;
      }
    else
      return false;
  }

  template <int dim>
  unsigned int
  Simulation<dim>::n_solves() const
  {
    return static_cast<unsigned int>(
      *result->number("counts", "newton_iterations"));
  }

  template <int dim>
  bool
  Simulation<dim>::hand_back()
  {
    if constexpr (dim == 2)
      if (!Fracture::find_tips(mesh->nodal(), cracks).empty())
        return false;
    if (n_large_parts() > parts_at_start)
      return false;
    segment_solves += n_solves() - solves_before;
    handed_over = false;
    return true;
  }

#define PERIMORPH_INSTANTIATE(dim)                                \
  template bool         Simulation<dim>::hand_back();             \
  template unsigned int Simulation<dim>::n_solves() const;        \
  template void         Simulation<dim>::name_nucleated_cracks(); \
  template bool Simulation<dim>::hand_over(Method &, Step &, const OnStep &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
