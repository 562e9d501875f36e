#include <perimorph/application/simulation_parameters.h>
#include <perimorph/base/name_help.h>
#include <perimorph/peridynamics/bond_based.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    template <typename Enum>
    Enum
    from_name(const std::string &name, const std::vector<std::string> &names)
    {
      return static_cast<Enum>(std::find(names.begin(), names.end(), name) -
                               names.begin());
    }

    /// A path in a parameter file: relative to its folder, or to where we are.
    std::string
    resolve(const std::string &path, const std::string &parameter_file)
    {
      namespace fs = std::filesystem;
      if (path.empty() || fs::path(path).is_absolute())
        return path;
      const fs::path  beside = fs::path(parameter_file).parent_path() / path;
      std::error_code status;
      return fs::exists(beside, status) || !fs::exists(path, status)
               ? beside.lexically_normal().string()
               : path;
    }

    std::string
    number_text(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  } // namespace

  template <int dim>
  SimulationParameters<dim>::SimulationParameters(
    const ParameterTexts      &texts,
    const std::string         &parameter_file,
    Base::InputErrorCollector &errors)
    : case_name(texts.title)
    , output_folder(texts.output_folder)
    , mesh_file(resolve(texts.mesh_file, parameter_file))
    , n_steps(texts.n_steps)
    , end_time(texts.end_time)
    , linear_tolerance(texts.linear_tolerance)
    , compare_with_finite_elements(texts.compare_with_finite_elements)
    , write_fields(texts.write_fields)
    , write_stress(texts.write_stress)
    , write_particles(texts.write_particles)
    , write_virial_stress(texts.write_virial_stress)
    , write_checkpoints(texts.write_checkpoints)
  {
    const std::string stem =
      std::filesystem::path(parameter_file).stem().string();
    if (case_name.empty())
      case_name = stem;
    if (output_folder.empty())
      output_folder = "output/" + stem;
    if (mesh_file.empty())
      errors.add_parameter("Mesh / file",
                           "nothing",
                           "the path of a gmsh mesh (.msh) or geometry (.geo)");
    for (const auto &entry :
         Parameters::parse_named_numbers("Mesh / geometry parameters",
                                         texts.geometry_parameters,
                                         errors))
      geometry_parameters[entry.first] = entry.second;

    newton.tolerance          = texts.newton_tolerance;
    newton.maximum_iterations = texts.maximum_newton_iterations;
    newton.line_search =
      from_name<Solvers::LineSearch>(texts.line_search,
                                     {"inadmissible", "energy"});
    arc_length                 = texts.control == "arc length";
    maximum_arc_steps          = texts.maximum_arc_steps;
    load_stepping.maximum_cuts = texts.maximum_cuts;
    linear_solver              = from_name<Solvers::LinearSolverKind>(
      texts.linear_solver,
      {"automatic", "direct", "iterative"});
    tangent = from_name<Solvers::TangentKind>(
      texts.tangent,
      {"automatic", "assembled", "matrix-free"});

    constants = Parameters::parse_constants("Expressions / constants",
                                            texts.constants,
                                            errors);
    read_materials(texts, errors);
    read_region(texts, errors);
    read_refinement(texts, errors);
    read_boundary_conditions(texts, errors);
    read_quantities(texts, parameter_file, errors);
    read_cracks(texts, errors);
    read_time_integration(texts, errors);
    check_law(errors);
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_region(const ParameterTexts      &texts,
                                         Base::InputErrorCollector &errors)
  {
    region.mode      = from_name<Mesh::Mode>(texts.mode, Mesh::mode_names());
    region.features  = Parameters::parse_features("Peridynamics / around",
                                                 texts.around,
                                                 dim,
                                                 errors);
    region.core_size = Parameters::parse_length("Peridynamics / core size",
                                                texts.core_size,
                                                true,
                                                errors);
    region.blending_width =
      Parameters::parse_length("Peridynamics / blending width",
                               texts.blending_width,
                               true,
                               errors);
    region.blending_function =
      from_name<Mesh::BlendingFunction>(texts.blending_function,
                                        Mesh::blending_function_names());
    region.horizon_ratio  = texts.horizon_ratio;
    region.horizon_length = texts.horizon;

    coupling.model =
      from_name<Coupling::Model>(texts.model, Coupling::model_names());
    coupling.scheme =
      from_name<Coupling::Scheme>(texts.coupling, Coupling::scheme_names());
    if (texts.influence_function != "automatic")
      coupling.influence =
        Peridynamics::influence_function_from_name(texts.influence_function);
    if (texts.gradient_support != "automatic")
      coupling.support = from_name<Coupling::GradientSupport>(
        texts.gradient_support,
        Coupling::gradient_support_names());
    else if (!texts.pre_cracks.empty() || texts.crack_growth != "none")
      // The rules that break bonds were found for families whose stress is
      // nonlocal over the horizon (doc/theory, 3).
      coupling.support = Coupling::GradientSupport::horizon;
    coupling.gamma = texts.stabilization;
    if (texts.stabilization_scale != "automatic")
      coupling.scale =
        from_name<Coupling::StabilizationScale>(texts.stabilization_scale,
                                                {"bending", "shear modulus"});
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_refinement(const ParameterTexts      &texts,
                                             Base::InputErrorCollector &errors)
  {
    const std::string section  = "Mesh / Refinement / ";
    refinement.spacing         = texts.target_spacing;
    refinement.features        = Parameters::parse_features(section + "around",
                                                     texts.refined_places,
                                                     dim,
                                                     errors);
    refinement.distance        = Parameters::parse_length(section + "distance",
                                                   texts.refined_distance,
                                                   false,
                                                   errors);
    refinement.grading         = texts.grading;
    refinement.error_cycles    = texts.error_cycles;
    refinement.error_tolerance = texts.error_tolerance;
    refinement.error_fraction  = texts.refined_fraction;
    refinement.find_curves     = texts.curved_boundaries == "automatic";
    if (refinement.error_cycles > 0 && refinement.error_fraction == 0.)
      errors.add_parameter(section + "refined fraction",
                           "0 with '" + section + "error cycles'",
                           "a number > 0, at most 1");
    if (refinement.spacing == 0. && !refinement.features.empty())
      errors.add_parameter(section + "target spacing",
                           "0 with '" + section + "around'",
                           "a number > 0");
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_quantities(const ParameterTexts &texts,
                                             const std::string &parameter_file,
                                             Base::InputErrorCollector &errors)
  {
    const std::string section      = "Quantities / ";
    const auto        probe_points = [&](const std::string              &entry,
                                  const std::string              &text,
                                  const std::vector<std::string> &components) {
      return Parameters::parse_probe_points(section + entry,
                                            text,
                                            dim,
                                            components,
                                            errors);
    };
    stress_concentration = texts.stress_concentration;
    nominal_stress =
      Parameters::parse_nominal_stress(section + "nominal stress",
                                       texts.nominal_stress,
                                       errors);
    deflections   = probe_points("deflection",
                               texts.deflection,
                               Parameters::displacement_components(dim));
    stress_ratios = probe_points("stress ratio",
                                 texts.stress_ratio,
                                 Parameters::stress_components(dim));
    points        = probe_points("point", texts.point, {});
    lines =
      Parameters::parse_probe_lines(section + "line", texts.line, dim, errors);
    circles = Parameters::parse_probe_circles(section + "circle",
                                              texts.circle,
                                              dim,
                                              errors);
    reactions =
      Parameters::parse_names(section + "reaction", texts.reaction, errors);

    std::set<std::string> files;
    if (!points.empty())
      files.insert("points");
    const auto claim = [&](const std::string &name, const std::string &entry) {
      if (!files.insert(name).second)
        errors.add_parameter(section + entry,
                             "the name '" + name + "' again",
                             "names of lines and circles once each, and not "
                             "'points'",
                             "The results go into probe_" + name + ".csv.");
    };
    for (const auto &line : lines)
      claim(line.name, "line");
    for (const auto &circle : circles)
      claim(circle.name, "circle");

    // A single constant traction is the obvious nominal stress.
    const bool nominal_needed =
      !stress_concentration.empty() || !stress_ratios.empty();
    if (nominal_needed && !nominal_stress.value &&
        nominal_stress.reaction_of.empty())
      {
        const auto &loads = boundary_conditions.surface_loads;
        if (loads.size() == 1 && !loads[0].pressure)
          {
            double square   = 0.;
            bool   constant = true;
            for (const auto &component : loads[0].traction)
              if (component)
                {
                  constant = constant && !component->depends_on_space();
                  square +=
                    std::pow(component->value(dealii::Point<dim>(), end_time),
                             2);
                }
            if (constant && square > 0.)
              nominal_stress.value = std::sqrt(square);
          }
        if (!nominal_stress.value && errors.empty())
          errors.add_parameter(section + "nominal stress",
                               "nothing",
                               "a number or 'reaction of NAME', since a stress "
                               "concentration or ratio is asked for");
      }
    if (nominal_stress.value && *nominal_stress.value == 0.)
      errors.add_parameter(section + "nominal stress",
                           "0",
                           "a number not zero");

    reference_values = Parameters::parse_named_numbers("Reference / values",
                                                       texts.reference_values,
                                                       errors);
    const auto exact = Parameters::parse_named_components(
      "Reference / displacement",
      texts.reference_displacement,
      Parameters::displacement_components(dim),
      Parameters::NameRule::none,
      errors);
    has_reference_displacement = !exact.empty();
    if (has_reference_displacement)
      reference_displacement = component_expressions("Reference / displacement",
                                                     exact[0].components,
                                                     errors);
    for (const auto &entry :
         Parameters::parse_named_values("Reference / data",
                                        texts.reference_data,
                                        errors))
      reference_data.push_back(
        {entry.name, resolve(entry.expression, parameter_file)});
  }

  template <int dim>
  void
  SimulationParameters<dim>::check_law(Base::InputErrorCollector &errors) const
  {
    const bool bonds = coupling.model == Coupling::Model::bond_based &&
                       region.mode != Mesh::Mode::finite_elements;
    const auto &law          = material.law;
    const bool  microelastic = law == "prototype microelastic";
    if (bonds && has_anisotropic_laws())
      {
        errors.add_parameter("Material / law",
                             "'orthotropic' or 'anisotropic' with bond-based "
                             "peridynamics",
                             "linear elastic in all volumes",
                             "Pair forces along bonds do not know material "
                             "axes; use model = correspondence.");
        return;
      }
    if (bonds && finite_strain() && !microelastic)
      errors.add_parameter("Material / law",
                           "'" + law + "' with bond-based peridynamics",
                           "prototype microelastic (finite strain) or linear "
                           "elastic (small strain)",
                           "Bonds are a law of their own at finite strain; use "
                           "model = correspondence for other laws.");
    if (write_virial_stress && coupling.model != Coupling::Model::bond_based)
      errors.add_parameter(
        "Output / virial stress",
        "true with model = correspondence",
        "false",
        "It is the stress of bonds; families have the stress "
        "of their material.");
    if (!bonds && !microelastic)
      return;
    const double allowed = Peridynamics::allowed_poissons_ratio(state);
    const auto   check   = [&](const std::string &path, const double found) {
      if (std::abs(found - allowed) > 1e-3)
        errors.add_parameter(
          path,
          number_text(found),
          std::string(allowed > 0.3 ? "1/3" : "1/4") + " with " +
            (bonds ? "bond-based peridynamics"
                       : "the law prototype microelastic") +
            " in " +
            (state == Materials::PlaneState::plane_stress   ? "plane stress"
                 : state == Materials::PlaneState::plane_strain ? "plane strain"
                                                                : "3D"),
          bonds ? "Pair forces along bonds leave no choice; use "
                      "model = correspondence for other values."
                    : "It is the continuum of pair forces, which leave no choice.");
    };
    check("Material / Poisson's ratio", material.poissons_ratio);
    for (const auto &entry : volume_materials)
      check("Material / by volume: Poisson's ratio of " + entry.first,
            entry.second.poissons_ratio);
  }

  template <int dim>
  std::vector<double>
  SimulationParameters<dim>::times() const
  {
    std::vector<double> list;
    for (unsigned int step = 1; step <= n_steps; ++step)
      list.push_back(end_time * step / n_steps);
    return list;
  }

  template struct SimulationParameters<2>;
  template struct SimulationParameters<3>;
} // namespace Perimorph::Application
