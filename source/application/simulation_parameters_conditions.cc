#include <perimorph/application/simulation_parameters.h>

namespace Perimorph::Application
{
  namespace
  {
    unsigned int
    component_index(const std::string &component)
    {
      return component == "x" ? 0 : (component == "y" ? 1 : 2);
    }
  } // namespace

  template <int dim>
  Fem::ComponentExpressions<dim>
  SimulationParameters<dim>::component_expressions(
    const std::string                                      &path,
    const std::vector<std::pair<std::string, std::string>> &components,
    Base::InputErrorCollector                              &errors) const
  {
    Fem::ComponentExpressions<dim> result;
    for (const auto &component : components)
      result[component_index(component.first)] =
        Parameters::Expression(path, component.second, constants, errors);
    return result;
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_boundary_conditions(
    const ParameterTexts      &texts,
    Base::InputErrorCollector &errors)
  {
    const std::string section = "Boundary conditions / ";
    const auto        xyz     = Parameters::displacement_components(dim);
    using Parameters::NameRule;
    auto &conditions = boundary_conditions;

    conditions.remove_rigid_motion = texts.remove_rigid_motion;
    conditions.symmetry =
      Parameters::parse_names(section + "symmetry", texts.symmetry, errors);
    const auto named = [&](const std::string &entry,
                           const std::string &text,
                           const NameRule     rule) {
      return Parameters::parse_named_components(section + entry,
                                                text,
                                                xyz,
                                                rule,
                                                errors);
    };
    const auto components = [&](const std::string &entry, const auto &list) {
      return component_expressions(section + entry, list, errors);
    };
    for (const auto &entry :
         named("displacement", texts.displacement, NameRule::required))
      conditions.displacement.push_back(
        {entry.name, {}, components("displacement", entry.components)});
    for (const auto &entry :
         named("traction", texts.traction, NameRule::required))
      conditions.surface_loads.push_back(
        {entry.name, components("traction", entry.components), {}});
    for (const auto &entry :
         Parameters::parse_named_values(section + "pressure",
                                        texts.pressure,
                                        errors))
      conditions.surface_loads.push_back(
        {entry.name,
         {},
         Parameters::Expression(section + "pressure",
                                entry.expression,
                                constants,
                                errors)});
    for (const auto &entry :
         Parameters::parse_named_values(section + "follower pressure",
                                        texts.follower_pressure,
                                        errors))
      conditions.surface_loads.push_back(
        {entry.name,
         {},
         Parameters::Expression(section + "follower pressure",
                                entry.expression,
                                constants,
                                errors),
         true});
    if (!texts.follower_pressure.empty() && !finite_strain())
      errors.add_parameter(section + "follower pressure",
                           "with the law linear elastic",
                           "a law of finite strain",
                           "At small strain a surface keeps its direction: use "
                           "'pressure'.");
    auto motion_components = xyz;
    motion_components.push_back("rotation");
    const auto read_motions = [&](const std::string                     &entry,
                                  const std::string                     &text,
                                  std::vector<Fem::BoundaryMotion<dim>> &list) {
      for (const auto &named_entry :
           Parameters::parse_named_components(section + entry,
                                              text,
                                              motion_components,
                                              NameRule::required,
                                              errors))
        {
          Fem::BoundaryMotion<dim> motion;
          motion.boundary = named_entry.name;
          std::vector<std::pair<std::string, std::string>> translation;
          for (const auto &component : named_entry.components)
            if (component.first == "rotation")
              {
                motion.rotation = Parameters::Expression(section + entry,
                                                         component.second,
                                                         constants,
                                                         errors);
                if (dim == 3 && component.second != "0")
                  errors.add_parameter(section + entry,
                                       "rotation = " + component.second,
                                       "rotation = 0 in 3D, or free");
              }
            else
              translation.push_back(component);
          motion.translation = components(entry, translation);
          list.push_back(motion);
        }
    };
    read_motions("mean displacement",
                 texts.mean_displacement,
                 conditions.mean_displacement);
    read_motions("rigid plate", texts.rigid_plate, conditions.rigid_plates);
    for (const auto &entry :
         named("body force", texts.body_force, NameRule::optional_volume))
      conditions.body_forces.push_back(
        {entry.name, components("body force", entry.components)});
    for (const auto &entry :
         Parameters::parse_point_entries(section + "point displacement",
                                         texts.point_displacement,
                                         dim,
                                         xyz,
                                         errors))
      conditions.displacement.push_back(
        {"",
         entry.coordinates,
         components("point displacement", entry.components)});
    for (const auto &entry :
         Parameters::parse_point_entries(section + "point force",
                                         texts.point_force,
                                         dim,
                                         xyz,
                                         errors))
      conditions.point_forces.push_back(
        {entry.coordinates, components("point force", entry.components)});
  }

#define INSTANTIATE(dim)                                             \
  template Fem::ComponentExpressions<dim>                            \
  SimulationParameters<dim>::component_expressions(                  \
    const std::string &,                                             \
    const std::vector<std::pair<std::string, std::string>> &,        \
    Base::InputErrorCollector &) const;                              \
  template void SimulationParameters<dim>::read_boundary_conditions( \
    const ParameterTexts &,                                          \
    Base::InputErrorCollector &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Application
