#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/base/progress.h>
#include <perimorph/bonds/crack_damage.h>
#include <perimorph/fem/nodal_values.h>
#include <perimorph/output/summary.h>

#include <Eigen/Dense>

#include <algorithm>

namespace Perimorph::Application
{
  namespace
  {
    /// A tensor without symmetry, by component: <name>_xy.
    template <int dim>
    void
    add_components(const std::string                         &name,
                   const std::vector<dealii::Tensor<2, dim>> &tensors,
                   Output::Fields<dim>                       &fields)
    {
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          {
            std::vector<double> component;
            for (const auto &tensor : tensors)
              component.push_back(tensor[a][b]);
            fields.add(name + "_" + "xyz"[a] + "xyz"[b], component);
          }
    }
  } // namespace

  template <int dim>
  void
  Simulation<dim>::remove_mean_rigid_motion(Method &method) const
  {
    // At finite strain a rotation of the displacement is another state under
    // dead loads: there the pins decide.
    if (free_motions.empty() || parameters.finite_strain())
      return;
    const auto &nodal     = mesh->nodal();
    const auto &partition = method.problem->partition();
    const auto  n         = free_motions.size();
    const auto  velocity  = [&](const unsigned int k, const unsigned int node) {
      return mesh->pieces()[node] == free_motions[k].piece
                 ? free_motions[k].at(nodal.nodes[node])
                 : dealii::Tensor<1, dim>();
    };
    Eigen::MatrixXd gram       = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd projection = Eigen::VectorXd::Zero(n);
    const auto      u = Fem::to_nodal_values(method.displacement, partition);
    for (unsigned int node = 0; node < nodal.n_nodes(); ++node)
      for (unsigned int k = 0; k < n; ++k)
        {
          const auto v = velocity(k, node);
          projection[k] += nodal.volume[node] * (v * u[node]);
          for (unsigned int l = 0; l < n; ++l)
            gram(k, l) += nodal.volume[node] * (v * velocity(l, node));
        }
    const Eigen::VectorXd mean = gram.ldlt().solve(projection);
    method.displacement.zero_out_ghost_values();
    for (unsigned int local = 0; local < partition.n_owned(); ++local)
      for (unsigned int k = 0; k < n; ++k)
        {
          const auto v = velocity(k, partition.global(local));
          for (int d = 0; d < dim; ++d)
            method.displacement.local_element(dim * local + d) -=
              mean[k] * v[d];
        }
  }

  template <int dim>
  State<dim>
  Simulation<dim>::gather(const Method &method) const
  {
    const auto &partition = method.problem->partition();
    State<dim>  state;
    Fem::Vector displacement(method.displacement);
    displacement.update_ghost_values();
    state.displacement = Fem::to_nodal_values(displacement, partition);
    state.internal_force =
      Fem::to_nodal_values(method.equilibrium->internal_forces(), partition);
    state.external_force =
      Fem::to_nodal_values(method.equilibrium->external_forces(), partition);
    state.time          = method.time;
    state.strain_energy = method.problem->strain_energy(displacement);
    return state;
  }

  template <int dim>
  void
  Simulation<dim>::write_fields(const Method      &method,
                                const State<dim>  &state,
                                const unsigned int step,
                                const double       time)
  {
    const auto          timer = timing.scope("output");
    Output::Fields<dim> nodal_fields;
    nodal_fields.add("displacement", state.displacement);
    if (!state.velocity.empty())
      nodal_fields.add("velocity", state.velocity);
    nodal_fields.add("alpha", method.region.alpha);
    nodal_fields.add("horizon", method.region.horizon);
    std::vector<double> damage(mesh->nodal().n_nodes(), 0.);
    if ((!cracks.empty() || parameters.growth.bonds) &&
        method.region.n_core > 0)
      {
        std::size_t n_hidden;
        damage = Bonds::crack_damage(mesh->nodal(),
                                     method.region.alpha,
                                     method.region.horizon,
                                     cracks,
                                     n_hidden,
                                     broken);
        nodal_fields.add("damage", damage);
      }
    if (!cracks.empty() &&
        (method.region.n_core > 0 ||
         parameters.region.mode == Mesh::Mode::finite_elements))
      {
        std::vector<std::array<dealii::Point<dim>, dim>> pieces;
        std::vector<double>                              numbers, steps;
        for (const auto &facet : cracks.facets())
          {
            pieces.push_back(facet.corners);
            numbers.push_back(facet.crack);
            steps.push_back(facet.step);
          }
        Output::Fields<dim> crack_fields;
        crack_fields.add("crack", numbers);
        crack_fields.add("advance", steps);
        Base::collectively(communicator, [&]() {
          fields->write_cracks(step, time, pieces, crack_fields);
        });
      }
    if (parameters.write_stress)
      {
        Base::Progress progress(log,
                                "Stress recovery",
                                mesh->nodal().owned_end -
                                  mesh->nodal().owned_begin);
        const auto     stresses = post_processing->nodal_stress(
          state,
          [&](const std::size_t done, const std::size_t) {
            progress.update(done);
          });
        std::vector<dealii::SymmetricTensor<2, dim>> in_plane;
        std::vector<double> out_of_plane, principal, mises;
        for (const auto &stress : stresses)
          {
            in_plane.push_back(stress.in_plane);
            out_of_plane.push_back(stress.out_of_plane);
            principal.push_back(Fracture::principal_stresses(stress)[0]);
            mises.push_back(Fracture::von_mises_stress(stress));
          }
        nodal_fields.add("stress", in_plane);
        if (parameters.state == Materials::PlaneState::plane_strain)
          nodal_fields.add("stress_zz", out_of_plane);
        if (parameters.finite_strain())
          {
            std::vector<dealii::SymmetricTensor<2, dim>> kirchhoff, strain;
            std::vector<dealii::Tensor<2, dim>>          piola;
            for (const auto &stress : stresses)
              {
                kirchhoff.emplace_back();
                strain.emplace_back();
                piola.emplace_back();
                for (int a = 0; a < dim; ++a)
                  for (int b = 0; b < dim; ++b)
                    {
                      kirchhoff.back()[a][b] = stress.kirchhoff[a][b];
                      strain.back()[a][b]    = stress.logarithmic_strain[a][b];
                      piola.back()[a][b] = stress.first_piola_kirchhoff[a][b];
                    }
              }
            add_components("first_piola_kirchhoff", piola, nodal_fields);
            nodal_fields.add("kirchhoff_stress", kirchhoff);
            nodal_fields.add("logarithmic_strain", strain);
          }
        nodal_fields.add("stress_principal_max", principal);
        nodal_fields.add("stress_von_mises", mises);
      }
    Base::collectively(communicator,
                       [&]() { fields->write(step, time, nodal_fields); });

    if (!parameters.write_particles ||
        method.region.n_core + method.region.n_blending == 0)
      return;
    const auto                         &nodal = mesh->nodal();
    std::vector<unsigned int>           nodes;
    std::vector<double>                 alpha, horizon, volume, own_damage;
    std::vector<dealii::Tensor<1, dim>> displacement;
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      if (method.region.alpha[n] > 0.)
        {
          nodes.push_back(n);
          alpha.push_back(method.region.alpha[n]);
          horizon.push_back(method.region.horizon[n]);
          volume.push_back(nodal.volume[n]);
          own_damage.push_back(damage[n]);
          displacement.push_back(state.displacement[n]);
        }
    Output::Fields<dim> particle_fields;
    particle_fields.add("displacement", displacement);
    particle_fields.add("alpha", alpha);
    particle_fields.add("horizon", horizon);
    particle_fields.add("volume", volume);
    particle_fields.add("damage", own_damage);
    if (parameters.write_virial_stress)
      {
        Fem::Vector complete_displacement(method.displacement);
        complete_displacement.update_ghost_values();
        const auto all =
          method.problem->virial_stress(complete_displacement, method.region);
        std::vector<dealii::Tensor<2, dim>> virial;
        for (const unsigned int n : nodes)
          virial.push_back(all[n]);
        add_components("virial_stress", virial, particle_fields);
      }
    Base::collectively(communicator, [&]() {
      fields->write_particles(step, time, nodes, particle_fields);
    });
  }

  template <int dim>
  std::vector<NamedQuantity>
  Simulation<dim>::quantities(const Method &method, const State<dim> &state)
  {
    auto       list = post_processing->evaluate(state);
    const bool own  = method.region.n_core + method.region.n_blending > 0 ||
                     parameters.region.mode == Mesh::Mode::finite_elements;
    // The companion with finite elements has no cracks; those made of broken
    // bonds have no domain integrals.
    if (own && parameters.breaks_in_motion())
      for (const auto &quantity :
           post_processing->crack_advances(state.time,
                                           method.region.horizon,
                                           broken,
                                           advance_history))
        list.push_back(quantity);
    if (own && !parameters.growth.bonds && !cracks.empty())
      {
        std::map<std::string, std::string> without_room;
        for (const auto &quantity : post_processing->crack_quantities(
               state,
               method.region,
               method.problem->correspondence_families(),
               without_room))
          list.push_back(quantity);
        for (const auto &[tip, reason] : without_room)
          {
            // Once per tip: the numbers differ from state to state.
            const auto about = [start = tip + ": "](const std::string &text) {
              return text.compare(0, start.size(), start) == 0;
            };
            const auto &said = log.warnings();
            if (std::none_of(said.begin(), said.end(), about))
              log.warning(tip + ": " + reason);
          }
      }
    return list;
  }

  template <int dim>
  void
  Simulation<dim>::write_quantities(const unsigned int step,
                                    const Method      &method,
                                    const State<dim>  &state)
  {
    const auto timer  = timing.scope("recovery");
    const auto values = quantities(method, state);
    if (!quantity_table)
      {
        std::vector<std::string> columns = {"step", "time"};
        for (const auto &quantity : values)
          columns.push_back(quantity.name);
        quantity_table = &open_table("quantities.csv", columns);
      }
    std::vector<Output::CsvCell> row = {step, state.time};
    for (const auto &quantity : values)
      row.push_back(quantity.exists ? Output::CsvCell(quantity.value)
                                    : Output::CsvCell(""));
    quantity_table->write_row(row);
  }

  template <int dim>
  void
  Simulation<dim>::evaluate(const Method &method, const State<dim> &state)
  {
    const auto timer = timing.scope("recovery");
    for (const auto &quantity : quantities(method, state))
      if (quantity.exists)
        result->set_quantity(quantity.name, quantity.value, quantity.unit);
    if (parameters.growth.active)
      report_cracks(method);
    for (const auto &reference : parameters.reference_values)
      result->set_reference(reference.first, reference.second);
    Base::collectively(communicator, [&]() {
      for (const auto &file :
           post_processing->write_probes(state, parameters.output_folder))
        files.push_back(file);
    });
  }

  template <int dim>
  void
  Simulation<dim>::compare_with_finite_elements(const State<dim> &state)
  {
    const auto timer = timing.scope("companion");
    log << "Companion run: finite elements only, same mesh" << std::endl;
    progress             = {};
    Method     method    = set_up(Mesh::Mode::finite_elements);
    const auto on_newton = [&](const Step &, const auto &iteration) {
      log << "  Newton iteration " << iteration.iteration
          << ": relative residual " << iteration.relative_residual << std::endl;
    };
    State<dim> companion;
    try
      {
        if (parameters.time_integration.has_inertia())
          follow_motion(method, [&](const Instant &instant) {
            companion = instant.state;
          });
        else
          follow_loads(
            method,
            [&](const Step &) { remove_mean_rigid_motion(method); },
            on_newton);
      }
    catch (const Base::SolveError &error)
      {
        throw Base::SolveError("the companion run with finite elements: " +
                               std::string(error.what()));
      }
    if (companion.displacement.empty())
      companion = gather(method);
    for (const auto &quantity : quantities(method, companion))
      if (quantity.exists)
        result->set_companion_quantity(quantity.name,
                                       quantity.value,
                                       quantity.unit);
    auto difference = state.displacement;
    for (unsigned int n = 0; n < difference.size(); ++n)
      difference[n] -= companion.displacement[n];
    const auto norms = Fracture::error_norms<dim>(mesh->nodal(),
                                                  materials.laws,
                                                  difference,
                                                  companion.displacement,
                                                  communicator);
    result->set("companion", "relative_difference_l2", norms.l2);
    result->set("companion", "relative_difference_energy", norms.energy);
    result->set("companion", "relative_difference_maximum", norms.maximum);
  }

  template <int dim>
  void
  Simulation<dim>::report_skipped(const Method &method)
  {
    const auto &solver = *method.equilibrium;
    if (solver.linear_solves() > solver.linear_solvers_made())
      result->set("skipped",
                  solver.choice().direct ? "factorisations" : "preconditioners",
                  solver.linear_solves() - solver.linear_solvers_made());
    if (solver.choice().entries_saved > 0.)
      result->set("skipped",
                  "matrix_entries_of_particles",
                  static_cast<std::size_t>(solver.choice().entries_saved));
    if (factor_memory && factor_memory->n_reused > 0)
      result->set("skipped",
                  "eliminations_of_far_field",
                  factor_memory->n_reused);
    if (!parameters.write_fields)
      result->set("skipped", "fields", "not asked for");
  }

  template <int dim>
  void
  Simulation<dim>::finish(const Output::Status status)
  {
    for (const auto &file : fields->files())
      files.push_back(file);
    if (parameters.growth.active)
      {
        result->set("growth", "end", growth_end);
        if (parameters.growth.bonds)
          result->set("growth", "events", n_events);
        const bool by_segments = hand_over_event > 0;
        if (!parameters.growth.bonds || by_segments)
          {
            result->set("growth", "advances", n_advances);
            result->set("growth", "crack_growth", grown_length);
          }
        if (by_segments)
          {
            result->set("growth", "hand_over_event", hand_over_event);
            result->set("growth", "hand_over_crack_length", hand_over_crack);
            result->set("growth", "hand_over_energy", hand_over_energy);
            result->set("growth",
                        "solves_of_segments",
                        segment_solves +
                          (handed_over ? n_solves() - solves_before : 0u));
          }
        if (!parameters.time_integration.has_inertia())
          result->set("growth", "released_energy", released_energy);
        result->set("growth", "dissipated_energy", dissipated_energy);
      }
    const auto table  = timing.table();
    const auto memory = Base::peak_memory(communicator);
    result->set_status(status);
    result->set_timings(table);
    result->set_peak_memory(memory.max_mb, memory.sum_mb);
    Base::collectively(communicator, [&]() {
      result->write(parameters.output_folder + "/results.json", log);
    });
    Output::print_summary(log,
                          *result,
                          parameters.output_folder,
                          files,
                          timing,
                          table);
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Perimorph::Application
