#include <perimorph/application/simulation_parameters.h>
#include <perimorph/parameters/text_tools.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    using Components = std::vector<std::pair<std::string, std::string>>;

    const std::string              by_volume = "Material / by volume";
    const std::vector<std::string> isotropic = {"Young's modulus",
                                                "Poisson's ratio"};

    std::string
    number_text(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    template <typename List, typename Value>
    bool
    contains(const List &list, const Value &value)
    {
      return std::find(list.begin(), list.end(), value) != list.end();
    }

    /// orientation, and in 3D orientation x, ...
    template <int dim>
    std::vector<std::string>
    orientation_components()
    {
      if (dim == 2)
        return {"orientation"};
      return {"orientation", "orientation x", "orientation y", "orientation z"};
    }

    int
    turned_axis(const std::string &component)
    {
      const char axis = component.back();
      return axis == 'x' ? 0 : axis == 'y' ? 1 : 2;
    }

    Parameters::Expression
    angle(const std::string           &path,
          const std::string           &text,
          const Parameters::Constants &constants,
          Base::InputErrorCollector   &errors)
    {
      const Parameters::Expression value(path, text, constants, errors);
      if (value.depends_on_time())
        errors.add_parameter(path,
                             "'" + text + "'",
                             "a number or an expression in x, y, z [degrees]",
                             "Material axes do not turn in time.");
      return value;
    }

    /// The law that the components of a volume make, or "" with a message.
    template <int dim>
    std::string
    law_of_volume(const std::string         &name,
                  const Components          &components,
                  const std::string         &law_of_rest,
                  Base::InputErrorCollector &errors)
    {
      std::set<std::string> laws;
      for (const auto &component : components)
        {
          if (contains(isotropic, component.first))
            laws.insert(Materials::is_anisotropic(law_of_rest)
                          ? "linear elastic"
                          : law_of_rest);
          for (const auto &law : Materials::anisotropic_law_names())
            if (contains(Materials::constant_names<dim>(law), component.first))
              laws.insert(law);
        }
      if (laws.empty())
        return law_of_rest;
      if (laws.size() > 1)
        {
          errors.add_parameter(by_volume,
                               "constants of the laws '" + *laws.begin() +
                                 "' and '" + *laws.rbegin() + "' of " + name,
                               "constants of one law");
          return "";
        }
      const auto &law = *laws.begin();
      if (Materials::is_anisotropic(law) && law_of_rest != "linear elastic" &&
          !Materials::is_anisotropic(law_of_rest))
        {
          errors.add_parameter(by_volume,
                               "constants of the law '" + law + "' of " + name +
                                 " with law '" + law_of_rest + "'",
                               "law = linear elastic, orthotropic, anisotropic",
                               "Laws of small and finite strain do not mix.");
          return "";
        }
      return law;
    }
  } // namespace

  template <int dim>
  bool
  SimulationParameters<dim>::check_material(
    const std::string         &path,
    const std::string         &of,
    const MaterialConstants   &constants,
    Base::InputErrorCollector &errors) const
  {
    const auto n_errors = errors.size();
    const bool is_rest  = of.empty();
    if (!(constants.density >= 0.) || !std::isfinite(constants.density))
      errors.add_parameter(path + (is_rest ? " / density" : ": density" + of),
                           number_text(constants.density),
                           "a number >= 0");
    if (Materials::is_anisotropic(constants.law))
      return Materials::check_constants<dim>(path +
                                               (is_rest ? " / constants" : ""),
                                             of,
                                             constants.law,
                                             constants.constants,
                                             state,
                                             errors) &&
             errors.size() == n_errors;
    const std::string between = is_rest ? " / " : ": ";
    if (!(constants.youngs_modulus > 0.) ||
        !std::isfinite(constants.youngs_modulus))
      errors.add_parameter(path + between + isotropic[0] + of,
                           constants.youngs_modulus == 0.
                             ? "nothing or 0"
                             : number_text(constants.youngs_modulus),
                           "a number > 0");
    if (!(constants.poissons_ratio > -1. && constants.poissons_ratio < 0.5))
      errors.add_parameter(path + between + isotropic[1] + of,
                           number_text(constants.poissons_ratio),
                           "more than -1 and less than 0.5");
    return errors.size() == n_errors;
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_rest_of_body(
    const ParameterTexts      &texts,
    Base::InputErrorCollector &errors)
  {
    material.law        = texts.law;
    material.density    = texts.density;
    const auto n_errors = errors.size();
    if (Materials::is_anisotropic(material.law))
      {
        const std::string path = "Material / constants";
        for (const auto &entry : Parameters::parse_named_components(
               path,
               texts.material_constants,
               Materials::constant_names<dim>(material.law),
               Parameters::NameRule::none,
               errors))
          for (const auto &[name, text] : entry.components)
            material.constants[name] = number(path, name, text, errors);
        for (const auto &[name, value] :
             {std::make_pair(isotropic[0], texts.youngs_modulus),
              std::make_pair(isotropic[1], texts.poissons_ratio)})
          if (value != 0.)
            errors.add_parameter("Material / " + name,
                                 number_text(value) + " with law '" +
                                   material.law + "'",
                                 "nothing",
                                 "Its constants are in 'Material / "
                                 "constants'.");
      }
    else
      {
        material.youngs_modulus = texts.youngs_modulus;
        material.poissons_ratio = texts.poissons_ratio;
        if (!texts.material_constants.empty())
          errors.add_parameter("Material / constants",
                               "'" + texts.material_constants + "' with law '" +
                                 material.law + "'",
                               "nothing, or law = orthotropic, anisotropic");
      }

    const std::string path = "Material / orientation";
    const bool        turns =
      dim == 3 &&
      std::regex_search(texts.orientation, std::regex("^\\s*[xyz]\\s*=[^=]"));
    if (turns)
      for (const auto &entry :
           Parameters::parse_named_components(path,
                                              texts.orientation,
                                              {"x", "y", "z"},
                                              Parameters::NameRule::none,
                                              errors))
        for (const auto &[axis, text] : entry.components)
          material.orientation[turned_axis(axis)] =
            angle(path, text, this->constants, errors);
    else if (!Parameters::trim(texts.orientation).empty())
      material.orientation[2] =
        angle(path, texts.orientation, this->constants, errors);
    if (errors.size() == n_errors)
      check_material("Material", "", material, errors);
  }

  template <int dim>
  double
  SimulationParameters<dim>::number(const std::string         &path,
                                    const std::string         &name,
                                    const std::string         &text,
                                    Base::InputErrorCollector &errors) const
  {
    const Parameters::Expression value(path, text, constants, errors);
    if (value.depends_on_space() || value.depends_on_time())
      errors.add_parameter(path,
                           "'" + text + "' for '" + name + "'",
                           "a number or an expression of constants");
    return value.value(dealii::Point<dim>(), 0.);
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_materials(const ParameterTexts      &texts,
                                            Base::InputErrorCollector &errors)
  {
    const std::vector<std::string> states = {"plane stress",
                                             "plane strain",
                                             "three-dimensional"};
    state = dim == 2 ? Materials::PlaneState::plane_strain
                     : Materials::PlaneState::three_dimensional;
    if (texts.state != "automatic")
      state = static_cast<Materials::PlaneState>(
        std::find(states.begin(), states.end(), texts.state) - states.begin());
    if ((dim == 2) == (state == Materials::PlaneState::three_dimensional))
      {
        errors.add_parameter(
          "Material / state",
          "'" + texts.state + "' with Dimension = " + std::to_string(dim),
          dim == 2 ? "plane stress, plane strain" : "three-dimensional");
        state = dim == 2 ? Materials::PlaneState::plane_strain
                         : Materials::PlaneState::three_dimensional;
      }
    read_rest_of_body(texts, errors);

    auto components = isotropic;
    for (const auto &law : Materials::anisotropic_law_names())
      for (const auto &name : Materials::constant_names<dim>(law))
        components.push_back(name);
    const auto orientation = orientation_components<dim>();
    components.insert(components.end(), orientation.begin(), orientation.end());
    components.push_back("density");
    for (const auto &entry :
         Parameters::parse_named_components(by_volume,
                                            texts.by_volume,
                                            components,
                                            Parameters::NameRule::required,
                                            errors))
      {
        if (entry.name == rest_of_body)
          errors.add_parameter(by_volume,
                               "a volume named '" + rest_of_body + "'",
                               "other names",
                               "It is the name of what is in none of them.");
        MaterialConstants constants = material;
        constants.law               = law_of_volume<dim>(entry.name,
                                           entry.components,
                                           material.law,
                                           errors);
        if (constants.law.empty())
          continue;
        if (constants.law != material.law)
          {
            constants.constants.clear();
            constants.youngs_modulus = constants.poissons_ratio = 0.;
          }
        const auto n_errors = errors.size();
        for (const auto &[name, text] : entry.components)
          if (contains(orientation, name))
            constants.orientation[turned_axis(name)] =
              angle(by_volume, text, this->constants, errors);
          else
            {
              const double value = number(by_volume, name, text, errors);
              if (name == "density")
                constants.density = value;
              else if (name == isotropic[0])
                constants.youngs_modulus = value;
              else if (name == isotropic[1])
                constants.poissons_ratio = value;
              else
                constants.constants[name] = value;
            }
        if (errors.size() == n_errors)
          check_material(by_volume, " of " + entry.name, constants, errors);
        volume_materials[entry.name] = constants;
      }
    check_orientation(errors);
  }

  template <int dim>
  void
  SimulationParameters<dim>::check_orientation(
    Base::InputErrorCollector &errors) const
  {
    if (!finite_strain())
      return;
    const auto check = [&](const std::string       &path,
                           const MaterialConstants &constants) {
      for (const auto &turn : constants.orientation)
        if (turn.text() != Parameters::Expression().text())
          errors.add_parameter(path,
                               "'" + turn.text() + "' with law '" +
                                 constants.law + "'",
                               "nothing",
                               "Laws of finite strain have no axes.");
    };
    check("Material / orientation", material);
    for (const auto &entry : volume_materials)
      check(by_volume + ": orientation of " + entry.first, entry.second);
  }

  template <int dim>
  bool
  SimulationParameters<dim>::has_anisotropic_laws() const
  {
    return Materials::is_anisotropic(material.law) ||
           std::any_of(volume_materials.begin(),
                       volume_materials.end(),
                       [](const auto &entry) {
                         return Materials::is_anisotropic(entry.second.law);
                       });
  }

  template <int dim>
  bool
  SimulationParameters<dim>::knows_thickness_strain() const
  {
    const auto knows = [](const MaterialConstants &one) {
      return !Materials::is_anisotropic(one.law) ||
             one.constants.count("nu13") + one.constants.count("nu23") == 2;
    };
    return state != Materials::PlaneState::plane_stress ||
           (knows(material) && std::all_of(volume_materials.begin(),
                                           volume_materials.end(),
                                           [&](const auto &entry) {
                                             return knows(entry.second);
                                           }));
  }

  template <int dim>
  bool
  SimulationParameters<dim>::finite_strain() const
  {
    return material.law != "linear elastic" &&
           !Materials::is_anisotropic(material.law);
  }

#define PERIMORPH_INSTANTIATE(dim)                                         \
  template void SimulationParameters<dim>::read_materials(                 \
    const ParameterTexts &,                                                \
    Base::InputErrorCollector &);                                          \
  template bool SimulationParameters<dim>::has_anisotropic_laws() const;   \
  template bool SimulationParameters<dim>::knows_thickness_strain() const; \
  template bool SimulationParameters<dim>::finite_strain() const;

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
