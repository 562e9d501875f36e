#include <perimorph/application/post_processing.h>
#include <perimorph/base/name_help.h>
#include <perimorph/fem/face_geometry.h>
#include <perimorph/fracture/stress_concentration.h>
#include <perimorph/fracture/stress_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Application
{
  namespace
  {
    constexpr char letters[] = "xyz";

    template <int dim>
    dealii::Point<dim>
    to_point(const std::vector<double> &coordinates)
    {
      dealii::Point<dim> point;
      for (int d = 0; d < dim; ++d)
        point[d] = coordinates[d];
      return point;
    }

    template <int dim>
    double
    stress_component(const Fracture::Stress<dim> &stress,
                     const std::string           &name)
    {
      const unsigned int a = name[0] - 'x', b = name[1] - 'x';
      return a < dim && b < dim ? stress.in_plane[a][b] : stress.out_of_plane;
    }

    /// First Piola-Kirchhoff and Kirchhoff stress, logarithmic strain, by
    /// component; in 2D those of the plane and zz.
    template <int dim>
    std::vector<NamedQuantity>
    finite_strain_measures(const Fracture::Stress<dim> &stress)
    {
      std::vector<NamedQuantity> list;
      const auto                 add = [&](const std::string &name,
                           const std::string &unit,
                           const bool         symmetric,
                           const auto        &tensor) {
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = symmetric ? a : 0; b < 3; ++b)
            if (dim == 3 || (a < 2) == (b < 2))
              list.push_back(
                {name + "_" + letters[a] + letters[b], tensor[a][b], unit});
      };
      add("first_piola_kirchhoff",
          "stress",
          false,
          stress.first_piola_kirchhoff);
      add("kirchhoff", "stress", true, stress.kirchhoff);
      add("logarithmic_strain", "-", true, stress.logarithmic_strain);
      return list;
    }

    /// Hoop stresses are taken about the centre of the circle of that name.
    template <int dim>
    dealii::Point<dim>
    center_of(const std::string                          &name,
              const std::vector<Parameters::ProbeCircle> &circles)
    {
      for (const auto &circle : circles)
        if (circle.name == name)
          return to_point<dim>(circle.center);
      return dealii::Point<dim>();
    }
  } // namespace

  template <int dim>
  PostProcessing<dim>::PostProcessing(
    const SimulationParameters<dim>    &parameters,
    const Mesh::DistributedMesh<dim>   &mesh,
    const Coupling::BodyMaterials<dim> &materials,
    const Fem::Supports<dim>           &supports,
    const Bonds::CrackSet<dim>         &cracks)
    : parameters(parameters)
    , mesh(mesh)
    , materials(materials)
    , supports(supports)
    , cracks(cracks)
  {
    for (const auto &plane : supports.symmetry_planes())
      planes.push_back({plane.point, plane.normal, plane.nodes});
    fit = Fracture::visible_fit(mesh.nodal(), cracks, planes, has_slits());
    recovery =
      std::make_unique<Fracture::NodalStress<dim>>(*fit, materials.laws);
    probe = std::make_unique<Fracture::PointProbe<dim>>(*recovery);
    name_crack_tips();
    Base::InputErrorCollector errors;
    check(errors);
    errors.throw_if_any();
  }

  template <int dim>
  PostProcessing<dim>::~PostProcessing() = default;

  template <int dim>
  void
  PostProcessing<dim>::check(Base::InputErrorCollector &errors)
  {
    const auto boundary = [&](const std::string &name,
                              const std::string &entry) {
      errors.collect([&]() {
        mesh.boundary(name, "parameter 'Quantities / " + entry + "'");
      });
    };
    const auto held = [&](const std::string &name, const std::string &entry) {
      boundary(name, entry);
      for (const auto &support : supports.entries())
        if (support.second.boundary == name)
          return;
      for (const unsigned int node : supports.coupled_nodes())
        if (supports.boundary_motion_at(node) == name)
          return;
      if (errors.empty())
        errors.add_parameter("Quantities / " + entry,
                             "'" + name + "', which no condition supports",
                             "a boundary with a symmetry, displacement, mean "
                             "displacement or rigid plate of its own");
    };
    const auto inside = [&](const dealii::Point<dim> &point,
                            const std::string        &entry) {
      errors.collect([&]() { probe->locate(point); },
                     "parameter '" + entry + "'");
    };
    if (!parameters.stress_concentration.empty())
      boundary(parameters.stress_concentration, "stress concentration");
    if (!parameters.nominal_stress.reaction_of.empty())
      {
        const auto &name = parameters.nominal_stress.reaction_of;
        held(name, "nominal stress");
        if (errors.empty() &&
            vector_area(name).norm() <
              1e-6 * Fem::boundary_area(mesh, name, "nominal stress"))
          errors.add_parameter("Quantities / nominal stress",
                               "the closed boundary '" + name + "'",
                               "a boundary on which a mean normal stress has "
                               "a meaning");
      }
    for (const auto &name : parameters.reactions)
      held(name, "reaction");
    for (const auto &point : parameters.deflections)
      inside(to_point<dim>(point.point), "Quantities / deflection");
    for (const auto &point : parameters.stress_ratios)
      inside(to_point<dim>(point.point), "Quantities / stress ratio");
    for (const auto &point : parameters.points)
      inside(to_point<dim>(point.point), "Quantities / point");
    for (const auto &line : parameters.lines)
      errors.collect(
        [&]() {
          for (const auto &point :
               Fracture::line_points<dim>(to_point<dim>(line.from),
                                          to_point<dim>(line.to),
                                          line.n_points))
            probe->locate(point);
        },
        "parameter 'Quantities / line'");
    for (const auto &circle : parameters.circles)
      errors.collect(
        [&]() {
          for (const auto &point :
               Fracture::circle_points<dim>(to_point<dim>(circle.center),
                                            circle.radius,
                                            circle.from_degrees,
                                            circle.to_degrees,
                                            circle.n_points))
            probe->locate(point);
        },
        "parameter 'Quantities / circle'");
    for (const auto &data : parameters.reference_data)
      errors.collect(
        [&]() {
          auto table = Fracture::read_reference_data<dim>(data.file);
          for (const auto &point : table.points)
            probe->locate(point);
          reference_data.push_back(std::move(table));
        },
        "parameter 'Reference / data'");
    if (parameters.has_reference_displacement)
      for (int d = 0; d < dim; ++d)
        if (parameters.reference_displacement[d])
          for (const auto &node : mesh.nodal().nodes)
            if (!parameters.reference_displacement[d]
                   ->check_finite(node, parameters.end_time, errors))
              break;

    const auto names = expected_names();
    for (const auto &reference : parameters.reference_values)
      if (errors.empty() &&
          std::find(names.begin(), names.end(), reference.first) == names.end())
        errors.add_parameter("Reference / values",
                             "'" + reference.first +
                               "', which this run does not compute" +
                               Base::did_you_mean(reference.first, names),
                             "a quantity of this run");
  }

  template <int dim>
  std::vector<std::string>
  PostProcessing<dim>::expected_names() const
  {
    std::vector<std::string> names = {"strain_energy"};
    add_crack_names(names);
    const auto add_point_names = [&](const std::string &name) {
      for (int d = 0; d < dim; ++d)
        names.push_back(name + "_displacement_" + letters[d]);
      for (const auto &component : Parameters::stress_components(dim))
        names.push_back(name + "_stress_" + component);
      if (parameters.time_integration.has_inertia())
        for (int d = 0; d < dim; ++d)
          names.push_back(name + "_velocity_" + letters[d]);
      if (parameters.finite_strain())
        for (const auto &measure :
             finite_strain_measures(Fracture::Stress<dim>()))
          names.push_back(name + "_" + measure.name);
    };
    if (!parameters.stress_concentration.empty())
      {
        names.push_back("stress_concentration");
        for (int d = 0; d < dim; ++d)
          names.push_back(std::string("stress_concentration_position_") +
                          letters[d]);
      }
    if (!parameters.nominal_stress.reaction_of.empty())
      names.push_back("nominal_stress");
    for (const auto &entry : parameters.deflections)
      names.push_back(entry.name + "_deflection");
    for (const auto &entry : parameters.stress_ratios)
      names.push_back(entry.name + "_stress_ratio");
    for (const auto &entry : parameters.points)
      add_point_names(entry.name);
    for (const auto &name : parameters.reactions)
      for (int d = 0; d < dim; ++d)
        names.push_back("reaction_" + name + "_" + letters[d]);
    for (unsigned int k = 0; k < reference_data.size(); ++k)
      for (const auto &column : reference_data[k].columns)
        names.push_back(parameters.reference_data[k].name + "_" + column +
                        "_error");
    if (parameters.has_reference_displacement)
      {
        names.push_back("relative_displacement_error");
        names.push_back("relative_energy_error");
        names.push_back("relative_maximum_error");
      }
    return names;
  }

  template <int dim>
  void
  PostProcessing<dim>::add_point(const std::string          &name,
                                 const dealii::Point<dim>   &point,
                                 const State<dim>           &state,
                                 std::vector<NamedQuantity> &list) const
  {
    const auto u      = probe->displacement_at(point, state.displacement);
    const auto stress = probe->stress_at(point, state.displacement);
    for (int d = 0; d < dim; ++d)
      list.push_back({name + "_displacement_" + letters[d], u[d], "length"});
    for (const auto &component : Parameters::stress_components(dim))
      list.push_back({name + "_stress_" + component,
                      stress_component(stress, component),
                      "stress"});
    if (!state.velocity.empty())
      {
        const auto v = probe->displacement_at(point, state.velocity);
        for (int d = 0; d < dim; ++d)
          list.push_back({name + "_velocity_" + letters[d], v[d], "velocity"});
      }
    if (parameters.finite_strain())
      for (const auto &measure : finite_strain_measures(stress))
        list.push_back(
          {name + "_" + measure.name, measure.value, measure.unit});
  }

  template <int dim>
  std::vector<NamedQuantity>
  PostProcessing<dim>::evaluate(const State<dim> &state) const
  {
    std::vector<NamedQuantity> list;
    const double               nominal = nominal_stress(state);
    if (!parameters.stress_concentration.empty() && nominal == 0.)
      // An unloaded state has no stress concentration: null in results.json.
      list.push_back({"stress_concentration",
                      std::numeric_limits<double>::quiet_NaN(),
                      "-"});
    else if (!parameters.stress_concentration.empty())
      {
        const auto nodes = mesh.boundary_nodes(parameters.stress_concentration,
                                               "stress concentration");
        const auto result =
          Fracture::stress_concentration(*recovery,
                                         nodes,
                                         state.displacement,
                                         nominal,
                                         parameters.stress_concentration,
                                         mesh.communicator());
        list.push_back({"stress_concentration", result.value, "-"});
        for (int d = 0; d < dim; ++d)
          list.push_back(
            {std::string("stress_concentration_position_") + letters[d],
             result.position[d],
             "length"});
      }
    if (!parameters.nominal_stress.reaction_of.empty())
      list.push_back({"nominal_stress", nominal, "stress"});
    for (const auto &entry : parameters.deflections)
      list.push_back(
        {entry.name + "_deflection",
         probe->displacement_at(to_point<dim>(entry.point),
                                state.displacement)[entry.component[0] - 'x'],
         "length"});
    for (const auto &entry : parameters.stress_ratios)
      list.push_back(
        {entry.name + "_stress_ratio",
         stress_component(
           probe->stress_at(to_point<dim>(entry.point), state.displacement),
           entry.component) /
           (nominal),
         "-"});
    for (const auto &entry : parameters.points)
      add_point(entry.name, to_point<dim>(entry.point), state, list);
    for (const auto &name : parameters.reactions)
      {
        const auto force = reaction(name, state);
        for (int d = 0; d < dim; ++d)
          list.push_back(
            {"reaction_" + name + "_" + letters[d], force[d], "force"});
      }
    list.push_back({"strain_energy", state.strain_energy, "energy"});

    for (unsigned int k = 0; k < reference_data.size(); ++k)
      {
        const auto &name = parameters.reference_data[k].name;
        const auto  table =
          probe->evaluate(reference_data[k].points,
                          state.displacement,
                          center_of<dim>(name, parameters.circles));
        for (const auto &error :
             Fracture::relative_errors<dim>(table, reference_data[k]))
          list.push_back(
            {name + "_" + error.first + "_error", error.second, "-"});
      }
    if (parameters.has_reference_displacement)
      {
        const auto exact = reference_displacement(state.time);
        auto       error = state.displacement;
        for (unsigned int n = 0; n < error.size(); ++n)
          error[n] -= exact[n];
        const auto norms = Fracture::error_norms<dim>(mesh.nodal(),
                                                      materials.laws,
                                                      error,
                                                      exact,
                                                      mesh.communicator());
        list.push_back({"relative_displacement_error", norms.l2, "-"});
        list.push_back({"relative_energy_error", norms.energy, "-"});
        list.push_back({"relative_maximum_error", norms.maximum, "-"});
      }
    return list;
  }

  template <int dim>
  std::vector<std::string>
  PostProcessing<dim>::write_probes(const State<dim>  &state,
                                    const std::string &folder) const
  {
    std::vector<std::string> files;
    const auto               write = [&](const std::string                     &name,
                           const std::vector<dealii::Point<dim>> &points,
                           const dealii::Point<dim>              &center) {
      Fracture::write_probe(probe->evaluate(points, state.displacement, center),
                            folder,
                            name,
                            mesh.communicator());
      files.push_back("probe_" + name + ".csv");
    };
    if (!parameters.points.empty())
      {
        std::vector<dealii::Point<dim>> points;
        for (const auto &entry : parameters.points)
          points.push_back(to_point<dim>(entry.point));
        write("points", points, dealii::Point<dim>());
      }
    for (const auto &line : parameters.lines)
      write(line.name,
            Fracture::line_points<dim>(to_point<dim>(line.from),
                                       to_point<dim>(line.to),
                                       line.n_points),
            dealii::Point<dim>());
    for (const auto &circle : parameters.circles)
      write(circle.name,
            Fracture::circle_points<dim>(to_point<dim>(circle.center),
                                         circle.radius,
                                         circle.from_degrees,
                                         circle.to_degrees,
                                         circle.n_points),
            to_point<dim>(circle.center));
    return files;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  PostProcessing<dim>::reference_displacement(const double time) const
  {
    std::vector<dealii::Tensor<1, dim>> exact;
    if (!parameters.has_reference_displacement)
      return exact;
    for (const auto &node : mesh.nodal().nodes)
      {
        exact.emplace_back();
        for (int d = 0; d < dim; ++d)
          if (parameters.reference_displacement[d])
            exact.back()[d] =
              parameters.reference_displacement[d]->value(node, time);
      }
    return exact;
  }

  template class PostProcessing<2>;
  template class PostProcessing<3>;
} // namespace Perimorph::Application
