#include <perimorph/application/post_processing.h>
#include <perimorph/fem/body_force.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    const std::string factor_unit  = "stress length^(1/2)";
    const std::string release_unit = "stress length";

    /// Values of one tip, in the order of their names.
    struct TipValue
    {
      const char           *name;
      std::optional<double> value;
      std::string           unit;
    };

    std::optional<double>
    existing(const bool condition, const double value)
    {
      return condition ? std::optional<double>(value) : std::nullopt;
    }

    std::vector<TipValue>
    tip_values(const Fracture::TipQuantities &tip)
    {
      const bool room   = !tip.values.empty();
      const bool opened = tip.opening.n_places >= 3;
      const auto q = room ? tip.values.front() : Fracture::FractureQuantities();
      const bool factors = room && q.has_factors;
      return {
        {"_K_I", existing(factors, q.K_I), factor_unit},
        {"_K_II", existing(factors, q.K_II), factor_unit},
        {"_J", existing(room, q.J), release_unit},
        {"_T_stress", existing(factors, q.T_stress), "stress"},
        {"_K_I_opening", existing(opened, tip.opening.K_I), factor_unit},
        {"_K_II_opening", existing(opened, tip.opening.K_II), factor_unit},
        {"_domain_dependence",
         existing(tip.values.size() > 1, tip.domain_dependence()),
         "-"}};
    }

    std::vector<TipValue>
    front_values(const Fracture::FrontQuantities &front)
    {
      double mean = 0., low = std::numeric_limits<double>::infinity(),
             high = -low, J = 0.;
      bool room = false, factors = false;
      for (const auto &station : front.values)
        if (!station.empty())
          {
            const double K = station.front().K_I;
            mean += K / front.values.size();
            J += station.front().J / front.values.size();
            low     = std::min(low, K);
            high    = std::max(high, K);
            room    = true;
            factors = station.front().has_factors;
          }
      return {{"_K_I", existing(factors, mean), factor_unit},
              {"_K_I_smallest", existing(factors, low), factor_unit},
              {"_K_I_largest", existing(factors, high), factor_unit},
              {"_J", existing(room, J), release_unit}};
    }

    std::string
    no_room(const double free_distance, const double needed)
    {
      std::ostringstream text;
      text << "no domain integral in some states: the nearest boundary, other "
              "crack or end was "
           << std::setprecision(3) << free_distance << " away";
      if (needed > 0.)
        text << ", it needs " << needed;
      text << "; factors and J of such states are left out";
      return text.str();
    }

    template <int dim>
    std::vector<TipValue>
    value_names()
    {
      if constexpr (dim == 2)
        return tip_values(Fracture::TipQuantities());
      else
        return front_values(Fracture::FrontQuantities());
    }

    constexpr unsigned int n_stations = 16;

    const std::string advance_name = "_advance";
    const std::string speed_name   = "_speed";
  } // namespace

  template <int dim>
  bool
  PostProcessing<dim>::has_slits() const
  {
    return parameters.region.mode == Mesh::Mode::finite_elements;
  }

  template <int dim>
  void
  PostProcessing<dim>::name_crack_tips()
  {
    std::map<unsigned int, unsigned int> count;
    const auto                           add = [&](const unsigned int crack) {
      tip_names.push_back(parameters.pre_cracks[crack].name +
                          (dim == 2 ? "_tip" : "_front") +
                          std::to_string(++count[crack]));
    };
    if constexpr (dim == 2)
      for (const auto &tip :
           Fracture::find_tips(mesh.nodal(), cracks, has_slits()))
        {
          add(tip.crack);
          first_tips.push_back(tip);
        }
    else
      for (const auto &front :
           Fracture::find_fronts(mesh.nodal(), cracks, has_slits()))
        add(front.crack);
  }

  template <int dim>
  void
  PostProcessing<dim>::add_crack_names(std::vector<std::string> &names) const
  {
    for (const auto &tip : tip_names)
      {
        for (const auto &value : value_names<dim>())
          names.push_back(tip + value.name);
        if (dim == 2 && parameters.breaks_in_motion())
          for (const auto &name : {advance_name, speed_name})
            names.push_back(tip + name);
      }
  }

  template <int dim>
  Fracture::CrackedBody<dim>
  PostProcessing<dim>::cracked_body(
    const State<dim>                   &state,
    const Mesh::RegionMap              &region,
    const Peridynamics::FamilySet<dim> &families) const
  {
    const bool has_families =
      has_slits() ||
      (parameters.coupling.model == Coupling::Model::correspondence &&
       region.n_core > 0);
    auto acceleration = state.acceleration;
    if (!acceleration.empty())
      Mesh::set_hanging_values(mesh.nodal().hanging, acceleration);
    return {{mesh.nodal(),
             materials.laws,
             state.displacement,
             Fem::body_force_density(mesh,
                                     parameters.boundary_conditions.body_forces,
                                     state.time),
             std::move(acceleration),
             materials.density},
            cracks,
            region.alpha,
            region.horizon,
            has_families ? &families : nullptr,
            planes,
            has_slits()};
  }

  template <int dim>
  std::vector<Fracture::TipQuantities>
  PostProcessing<dim>::tip_quantities(
    const State<dim>                   &state,
    const Mesh::RegionMap              &region,
    const Peridynamics::FamilySet<dim> &families) const
  {
    if constexpr (dim == 2)
      {
        // The state behind an advance is also the one before the next.
        auto &last = last_tips;
        if (last.n_facets != cracks.facets().size() ||
            last.time != state.time || last.alpha != region.alpha ||
            last.displacement != state.displacement)
          last = {cracks.facets().size(),
                  state.time,
                  region.alpha,
                  state.displacement,
                  Fracture::tip_quantities(
                    cracked_body(state, region, families),
                    Fracture::find_tips(mesh.nodal(), cracks, has_slits()),
                    {},
                    mesh.communicator())};
        return last.quantities;
      }
    else
      return {};
  }

  template <int dim>
  std::vector<NamedQuantity>
  PostProcessing<dim>::crack_quantities(
    const State<dim>                   &state,
    const Mesh::RegionMap              &region,
    const Peridynamics::FamilySet<dim> &families,
    std::map<std::string, std::string> &without_room) const
  {
    if (tip_names.empty())
      return {};
    std::vector<std::vector<TipValue>> found(tip_names.size());
    if constexpr (dim == 2)
      for (const auto &tip : tip_quantities(state, region, families))
        {
          const unsigned int t =
            std::find_if(
              first_tips.begin(),
              first_tips.end(),
              [&](const auto &first) { return first.root == tip.tip.root; }) -
            first_tips.begin();
          if (t == tip_names.size())
            continue;
          found[t] = tip_values(tip);
          if (tip.values.empty())
            without_room[tip_names[t]] =
              no_room(tip.tip.free_distance, tip.needed_distance);
        }
    else
      {
        // Fronts do not grow.
        const auto fronts = Fracture::front_quantities(
          cracked_body(state, region, families),
          Fracture::find_fronts(mesh.nodal(), cracks, has_slits()),
          n_stations,
          {},
          mesh.communicator());
        for (unsigned int f = 0; f < fronts.size(); ++f)
          {
            found[f] = front_values(fronts[f]);
            if (fronts[f].annuli.empty())
              without_room[tip_names[f]] =
                no_room(fronts[f].front.free_distance, 0.);
          }
      }

    std::vector<NamedQuantity> list;
    for (unsigned int t = 0; t < tip_names.size(); ++t)
      for (const auto &value : found[t].empty() ? value_names<dim>() : found[t])
        list.push_back({tip_names[t] + value.name,
                        found[t].empty() ? 0. : value.value.value_or(0.),
                        value.unit,
                        !found[t].empty() && value.value.has_value()});
    return list;
  }

  template <int dim>
  std::vector<NamedQuantity>
  PostProcessing<dim>::crack_advances(
    [[maybe_unused]] const double               time,
    [[maybe_unused]] const std::vector<double> &horizon,
    [[maybe_unused]] const Bonds::BrokenBonds  &broken,
    [[maybe_unused]] Fracture::AdvanceHistory  &history) const
  {
    std::vector<NamedQuantity> list;
    if constexpr (dim == 2)
      {
        const auto advances = Fracture::crack_advances(
          first_tips,
          Fracture::broken_places(mesh.nodal(), horizon, broken));
        history.add(time, advances);
        const bool has_speed = history.rows.size() > 1;
        for (unsigned int t = 0; t < tip_names.size(); ++t)
          {
            list.push_back(
              {tip_names[t] + advance_name, advances[t], "length"});
            list.push_back({tip_names[t] + speed_name,
                            has_speed ? history.speed(t) : 0.,
                            "velocity",
                            has_speed});
          }
      }
    return list;
  }

#define PERIMORPH_INSTANTIATE(dim)                                           \
  template bool PostProcessing<dim>::has_slits() const;                      \
  template void PostProcessing<dim>::name_crack_tips();                      \
  template void PostProcessing<dim>::add_crack_names(                        \
    std::vector<std::string> &) const;                                       \
  template Fracture::CrackedBody<dim> PostProcessing<dim>::cracked_body(     \
    const State<dim> &,                                                      \
    const Mesh::RegionMap &,                                                 \
    const Peridynamics::FamilySet<dim> &) const;                             \
  template std::vector<Fracture::TipQuantities>                              \
  PostProcessing<dim>::tip_quantities(const State<dim> &,                    \
                                      const Mesh::RegionMap &,               \
                                      const Peridynamics::FamilySet<dim> &)  \
    const;                                                                   \
  template std::vector<NamedQuantity> PostProcessing<dim>::crack_advances(   \
    double,                                                                  \
    const std::vector<double> &,                                             \
    const Bonds::BrokenBonds &,                                              \
    Fracture::AdvanceHistory &) const;                                       \
  template std::vector<NamedQuantity> PostProcessing<dim>::crack_quantities( \
    const State<dim> &,                                                      \
    const Mesh::RegionMap &,                                                 \
    const Peridynamics::FamilySet<dim> &,                                    \
    std::map<std::string, std::string> &) const;

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
