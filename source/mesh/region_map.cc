#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/base/point_cloud.h>
#include <perimorph/mesh/feature_distance.h>
#include <perimorph/mesh/region_map.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace Perimorph::Mesh
{
  const std::vector<std::string> &
  mode_names()
  {
    static const std::vector<std::string> names = {"coupled",
                                                   "finite elements",
                                                   "peridynamics"};
    return names;
  }

  const std::vector<std::string> &
  blending_function_names()
  {
    static const std::vector<std::string> names = {"linear",
                                                   "cubic",
                                                   "quintic",
                                                   "splice"};
    return names;
  }

  double
  blending_weight(const BlendingFunction function, const double s)
  {
    if (s <= 0.)
      return 1.;
    if (s >= 1.)
      return 0.;
    switch (function)
      {
        case BlendingFunction::linear:
          return 1. - s;
        case BlendingFunction::cubic:
          return 1. - s * s * (3. - 2. * s);
        case BlendingFunction::quintic:
          return 1. - s * s * s * (10. - 15. * s + 6. * s * s);
        case BlendingFunction::splice:
          return 0.;
      }
    return 0.;
  }

  namespace
  {
    /// Below this a weight only adds round-off.
    constexpr double negligible_weight = 1e-8;

    template <int dim>
    void
    set_horizons(const NodalMesh<dim>   &mesh,
                 const RegionParameters &parameters,
                 RegionMap              &map)
    {
      map.horizon.resize(mesh.n_nodes());
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        map.horizon[n] = parameters.horizon_length > 0.
                           ? parameters.horizon_length
                           : parameters.horizon_ratio * mesh.spacing[n];
    }

    template <int dim>
    void
    check_horizons(const NodalMesh<dim>   &mesh,
                   const RegionParameters &parameters,
                   const RegionMap        &map)
    {
      unsigned int worst = dealii::numbers::invalid_unsigned_int;
      unsigned int n_bad = 0;
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        if (map.alpha[n] > 0. && map.horizon[n] < mesh.spacing[n] * (1. - 1e-8))
          {
            ++n_bad;
            if (worst == dealii::numbers::invalid_unsigned_int ||
                mesh.spacing[n] > mesh.spacing[worst])
              worst = n;
          }
      if (n_bad == 0)
        return;
      std::ostringstream found, allowed;
      found << map.horizon[worst] << ", smaller than the spacing "
            << mesh.spacing[worst] << " of the particle at ("
            << mesh.nodes[worst] << ") (" << n_bad << " such particles)";
      allowed << "at least the largest spacing in the peridynamic region, "
              << mesh.spacing[worst];
      throw Base::InputError(Base::InputMessage{
        parameters.horizon_length > 0.
          ? "parameter 'Peridynamics / horizon'"
          : "parameter 'Peridynamics / horizon ratio'",
        found.str(),
        allowed.str(),
        "Usual value: a horizon ratio of 2, which follows the spacing."});
    }

    template <int dim>
    void
    set_alpha(const DistributedMesh<dim> &mesh,
              const RegionParameters     &parameters,
              RegionMap                  &map)
    {
      const auto &nodal = mesh.nodal();
      map.alpha.assign(nodal.n_nodes(), 0.);
      const Base::PointCloud<dim> cloud(nodal.nodes);
      for (const auto &feature : parameters.features)
        {
          const FeatureDistance<dim> distance(feature, mesh);
          // Core size and band width seen from a place on the feature.
          const auto sizes = [&](const dealii::Point<dim> &place) {
            const auto   nearest = cloud.nearest(place).first;
            const double horizon = map.horizon[nearest];
            const auto   length  = [&](const Parameters::Length &size) {
              return length_of(size, nodal.spacing[nearest], horizon);
            };
            return std::make_pair(length(parameters.core_size),
                                  parameters.blending_function ==
                                      BlendingFunction::splice
                                    ? 0.
                                    : length(parameters.blending_width));
          };
          // With some slack: the horizon at the nearest point may differ a
          // little from that at the nearest corner.
          const auto range = [&](const dealii::Point<dim> &place) {
            const auto [core, band] = sizes(place);
            return typename FeatureDistance<dim>::Range{.8 * core,
                                                        2. * (core + band)};
          };
          for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
            {
              if (map.alpha[n] == 1.)
                continue;
              const auto closest = distance.closest_to_node(nodal, n, range);
              const auto [core, band] = sizes(closest.point);
              // Slack: a node exactly at the edge of the core is in it.
              const double beyond = closest.distance - core * (1. + 1e-10);
              double       weight = beyond <= 0. ? 1. : 0.;
              if (band > 0.)
                weight =
                  blending_weight(parameters.blending_function, beyond / band);
              if (weight < negligible_weight)
                weight = 0.;
              if (weight > 1. - negligible_weight)
                weight = 1.;
              map.alpha[n] = std::max(map.alpha[n], weight);
            }
        }
    }
  } // namespace

  double
  length_of(const Parameters::Length &size,
            const double              spacing,
            const double              horizon)
  {
    if (size.automatic)
      return std::max(2. * spacing, horizon);
    return size.in_horizons ? size.value * horizon : size.value;
  }

  void
  RegionMap::set_alpha(const std::vector<double> &weights)
  {
    alpha  = weights;
    n_core = n_blending = n_elements = 0;
    for (const double weight : alpha)
      ++(weight == 1. ? n_core : weight > 0. ? n_blending : n_elements);
  }

  template <int dim>
  RegionMap
  make_region_map(const DistributedMesh<dim> &mesh,
                  const RegionParameters     &parameters)
  {
    RegionMap   map;
    const auto &nodal = mesh.nodal();
    set_horizons(nodal, parameters, map);
    if (parameters.mode == Mode::finite_elements)
      map.alpha.assign(nodal.n_nodes(), 0.);
    else if (parameters.mode == Mode::peridynamics)
      map.alpha.assign(nodal.n_nodes(), 1.);
    else
      {
        if (parameters.features.empty())
          throw Base::InputError(Base::InputMessage{
            "parameter 'Peridynamics / around'",
            "nothing",
            "what the peridynamic region surrounds, since Mode = coupled: a "
            "boundary (" +
              Base::join_names(mesh.boundary_names()) +
              "), volume, point, segment, plane, box or ball",
            ""});
        set_alpha(mesh, parameters, map);
      }
    map.set_alpha(std::vector<double>(map.alpha));
    if (parameters.mode == Mode::coupled && map.n_core + map.n_blending == 0)
      throw Base::InputError(Base::InputMessage{
        "parameter 'Peridynamics / core size'",
        "a region without any node of the mesh",
        "a core around the features that contains nodes",
        "Enlarge the core size, or place the feature inside the body."});
    if (parameters.mode == Mode::coupled && map.n_elements == 0 &&
        !parameters.may_fill_body)
      throw Base::InputError(Base::InputMessage{
        "parameter 'Peridynamics / core size'",
        "a peridynamic region that swallows the whole body",
        "a region that leaves finite elements around it",
        "Use a smaller core size or blending width, or Mode = peridynamics."});
    check_horizons(nodal, parameters, map);
    return map;
  }

  template RegionMap
  make_region_map<2>(const DistributedMesh<2> &, const RegionParameters &);
  template RegionMap
  make_region_map<3>(const DistributedMesh<3> &, const RegionParameters &);
} // namespace Perimorph::Mesh
