#include <perimorph/application/post_processing.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Perimorph::Application
{
  namespace
  {
    constexpr double missing = std::numeric_limits<double>::quiet_NaN();

    const std::string factor_unit  = "stress length^(1/2)";
    const std::string release_unit = "stress length";

    /// Values of one tip, in the order of their names.
    struct TipValue
    {
      const char *name;
      double      value;
      std::string unit;
    };

    std::vector<TipValue>
    tip_values(const Fracture::TipQuantities &tip)
    {
      Fracture::FractureQuantities q;
      if (tip.values.empty())
        q = {missing, missing, missing, missing, missing};
      else
        q = tip.values.front();
      return {{"_K_I", q.K_I, factor_unit},
              {"_K_II", q.K_II, factor_unit},
              {"_J", q.J, release_unit},
              {"_T_stress", q.T_stress, "stress"},
              {"_K_I_opening", tip.opening.K_I, factor_unit},
              {"_K_II_opening", tip.opening.K_II, factor_unit},
              {"_domain_dependence", tip.domain_dependence(), "-"}};
    }

    std::vector<TipValue>
    front_values(const Fracture::FrontQuantities &front)
    {
      double mean = 0., low = std::numeric_limits<double>::infinity(),
             high = -low, J = 0.;
      for (const auto &station : front.values)
        if (!station.empty())
          {
            const double K = station.front().K_I;
            mean += K / front.values.size();
            J += station.front().J / front.values.size();
            low  = std::min(low, K);
            high = std::max(high, K);
          }
      if (!(low <= high))
        mean = low = high = J = missing;
      return {{"_K_I", mean, factor_unit},
              {"_K_I_smallest", low, factor_unit},
              {"_K_I_largest", high, factor_unit},
              {"_J", J, release_unit}};
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
  } // namespace

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
      for (const auto &tip : Fracture::find_tips(mesh.nodal(), cracks))
        add(tip.crack);
    else
      for (const auto &front : Fracture::find_fronts(mesh.nodal(), cracks))
        add(front.crack);
  }

  template <int dim>
  void
  PostProcessing<dim>::add_crack_names(std::vector<std::string> &names) const
  {
    for (const auto &tip : tip_names)
      for (const auto &value : value_names<dim>())
        names.push_back(tip + value.name);
  }

  template <int dim>
  Fracture::CrackedBody<dim>
  PostProcessing<dim>::cracked_body(
    const State<dim>                   &state,
    const Mesh::RegionMap              &region,
    const Peridynamics::FamilySet<dim> &families) const
  {
    const bool has_families =
      parameters.coupling.model == Coupling::Model::correspondence &&
      region.n_core > 0;
    return {{mesh.nodal(), materials.laws, state.displacement},
            cracks,
            region.alpha,
            region.horizon,
            has_families ? &families : nullptr,
            planes};
  }

  template <int dim>
  std::vector<Fracture::TipQuantities>
  PostProcessing<dim>::tip_quantities(
    const State<dim>                   &state,
    const Mesh::RegionMap              &region,
    const Peridynamics::FamilySet<dim> &families) const
  {
    if constexpr (dim == 2)
      return Fracture::tip_quantities(cracked_body(state, region, families),
                                      Fracture::find_tips(mesh.nodal(), cracks),
                                      {},
                                      mesh.communicator());
    else
      return {};
  }

  template <int dim>
  std::vector<NamedQuantity>
  PostProcessing<dim>::crack_quantities(
    const State<dim>                   &state,
    const Mesh::RegionMap              &region,
    const Peridynamics::FamilySet<dim> &families) const
  {
    std::map<std::string, std::vector<TipValue>> found;
    std::map<unsigned int, unsigned int>         count;
    const auto add = [&](const unsigned int           crack,
                         const std::vector<TipValue> &values) {
      found[parameters.pre_cracks[crack].name + (dim == 2 ? "_tip" : "_front") +
            std::to_string(++count[crack])] = values;
    };
    if (tip_names.empty())
      return {};
    if constexpr (dim == 2)
      for (const auto &tip : tip_quantities(state, region, families))
        add(tip.tip.crack, tip_values(tip));
    else
      for (const auto &front : Fracture::front_quantities(
             cracked_body(state, region, families),
             Fracture::find_fronts(mesh.nodal(), cracks),
             n_stations,
             {},
             mesh.communicator()))
        add(front.front.crack, front_values(front));

    std::vector<NamedQuantity> list;
    for (const auto &tip : tip_names)
      {
        const auto place = found.find(tip);
        for (const auto &value :
             place == found.end() ? value_names<dim>() : place->second)
          list.push_back({tip + value.name,
                          place == found.end() ? missing : value.value,
                          value.unit});
      }
    return list;
  }

#define PERIMORPH_INSTANTIATE(dim)                                           \
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
  template std::vector<NamedQuantity> PostProcessing<dim>::crack_quantities( \
    const State<dim> &,                                                      \
    const Mesh::RegionMap &,                                                 \
    const Peridynamics::FamilySet<dim> &) const;

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
