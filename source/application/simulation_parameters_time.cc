#include <perimorph/application/simulation_parameters.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Application
{
  const std::vector<std::string> &
  time_scheme_names()
  {
    static const std::vector<std::string> names = {"static",
                                                   "explicit",
                                                   "implicit",
                                                   "relaxation"};
    return names;
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_time_integration(
    const ParameterTexts      &texts,
    Base::InputErrorCollector &errors)
  {
    const std::string section = "Time integration / ";
    const auto       &names   = time_scheme_names();
    auto             &time    = time_integration;
    time.scheme               = static_cast<TimeScheme>(
      std::find(names.begin(), names.end(), texts.scheme) - names.begin());
    time.time_step                = texts.time_step;
    time.safety_factor            = texts.safety_factor;
    time.spectral_radius          = texts.spectral_radius;
    time.field_interval           = texts.field_interval;
    time.maximum_relaxation_steps = texts.maximum_relaxation_steps;
    const auto field = [&](const std::string &entry, const std::string &text) {
      const auto read = Parameters::parse_named_components(
        section + entry,
        text,
        Parameters::displacement_components(dim),
        Parameters::NameRule::none,
        errors);
      if (!read.empty() && !time.has_inertia())
        errors.add_parameter(section + entry,
                             "'" + text + "' with scheme '" + texts.scheme +
                               "'",
                             "nothing, or scheme = explicit or implicit",
                             "Only motion has a start.");
      return read.empty() ? Fem::ComponentExpressions<dim>()
                          : component_expressions(section + entry,
                                                  read[0].components,
                                                  errors);
    };
    time.initial_displacement =
      field("initial displacement", texts.initial_displacement);
    time.initial_velocity = field("initial velocity", texts.initial_velocity);
    coupling.is_in_motion = time.has_inertia();
    if (time.scheme == TimeScheme::equilibrium)
      return;

    if (texts.control != "load")
      errors.add_parameter("Load steps / control",
                           "'" + texts.control + "' with scheme '" +
                             texts.scheme + "'",
                           "load");
    if (growth.active && !growth.bonds)
      errors.add_parameter("Cracks / growth",
                           "'" + texts.crack_growth + "' with scheme '" +
                             texts.scheme + "'",
                           "none, bonds",
                           "Segments advance in equilibrium.");
    if (growth.active && growth.events)
      errors.add_parameter("Cracks / growth control",
                           "'events' with scheme '" + texts.scheme + "'",
                           "load steps",
                           "Events scale the loads of equilibrium.");
    if (!time.has_inertia())
      return;
    if (growth.bonds && growth.hand_over)
      errors.add_parameter("Cracks / hand over length",
                           "'" + texts.hand_over_length + "' with scheme '" +
                             texts.scheme + "'",
                           "never",
                           "Segments advance in equilibrium.");
    if (growth.bonds && growth.criterion == Damage::Criterion::critical_energy)
      errors.add_parameter("Cracks / criterion",
                           "'critical energy' with scheme '" + texts.scheme +
                             "'",
                           "critical stretch, or one of stress or strain",
                           "The energy of bonds is not followed in time.");
    if (coupling.scheme == Coupling::Scheme::force_blending)
      errors.add_parameter("Peridynamics / coupling",
                           "'force blending' with scheme '" + texts.scheme +
                             "'",
                           "consistent, energy blending",
                           "Blended equations have no energy, so that motion "
                           "may gain it.");
    const auto check_density = [&](const std::string       &entry,
                                   const MaterialConstants &constants) {
      if (constants.density == 0.)
        errors.add_parameter(
          entry,
          "nothing or 0",
          "a number > 0",
          "Bodies that move need it (scheme = " + texts.scheme + ").");
    };
    check_density("Material / density", material);
    for (const auto &[name, constants] : volume_materials)
      check_density("Material / by volume: density of " + name, constants);
    for (const auto &[entry, interval] :
         {std::make_pair("output interval", texts.output_interval),
          std::make_pair("field interval", texts.field_interval)})
      if (interval > end_time * (1. + 1e-9))
        {
          std::ostringstream found, allowed;
          found << interval;
          allowed << "at most the end time, " << end_time;
          errors.add_parameter(section + entry, found.str(), allowed.str());
        }
    if (texts.output_interval > 0.)
      n_steps = std::max(1u,
                         static_cast<unsigned int>(
                           std::lround(end_time / texts.output_interval)));
    else if (n_steps == 1)
      n_steps = 100;
    if (time.field_interval == 0.)
      time.field_interval = end_time / 20.;
  }

  template void
  SimulationParameters<2>::read_time_integration(const ParameterTexts &,
                                                 Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::read_time_integration(const ParameterTexts &,
                                                 Base::InputErrorCollector &);
} // namespace Perimorph::Application
