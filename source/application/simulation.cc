#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/base/name_help.h>
#include <perimorph/base/progress.h>
#include <perimorph/output/csv_writer.h>
#include <perimorph/output/summary.h>

#include <Eigen/Dense>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    /// A vector of unknowns complete on every rank, one entry per node.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    complete(const Fem::Vector             &vector,
             const Fem::NodePartition<dim> &partition)
    {
      std::vector<double> values(vector.size(), 0.);
      const auto first = dim * static_cast<std::size_t>(partition.n_owned() > 0
                                                          ? partition.global(0)
                                                          : 0);
      for (unsigned int k = 0; k < dim * partition.n_owned(); ++k)
        values[first + k] = vector.local_element(k);
      if (dealii::Utilities::MPI::n_mpi_processes(partition.communicator()) > 1)
        dealii::Utilities::MPI::sum(values, partition.communicator(), values);
      std::vector<dealii::Tensor<1, dim>> nodal(values.size() / dim);
      for (std::size_t n = 0; n < nodal.size(); ++n)
        for (int d = 0; d < dim; ++d)
          nodal[n][d] = values[dim * n + d];
      return nodal;
    }
  } // namespace

  template <int dim>
  Simulation<dim>::Simulation(const SimulationParameters<dim> &parameters,
                              Base::Log                       &log,
                              const MPI_Comm                   communicator)
    : parameters(parameters)
    , log(log)
    , communicator(communicator)
    , timing(communicator)
  {}

  template <int dim>
  Simulation<dim>::~Simulation() = default;

  template <int dim>
  void
  Simulation<dim>::prepare()
  {
    const auto timer = timing.scope("setup");
    read_mesh();
    Base::InputErrorCollector errors;
    const auto                collect = [&errors](const auto &action) {
      try
        {
          action();
        }
      catch (const Base::InputError &error)
        {
          for (const auto &message : error.messages())
            errors.add(message);
        }
    };
    const auto times = parameters.times();
    collect([&]() { assign_materials(); });
    collect([&]() { region = make_region_map(*mesh, parameters.region); });
    collect([&]() {
      supports =
        std::make_unique<Fem::Supports<dim>>(*mesh,
                                             parameters.boundary_conditions,
                                             times);
    });
    collect([&]() {
      loads = std::make_unique<Fem::Loads<dim>>(*mesh,
                                                parameters.boundary_conditions,
                                                times);
    });
    if (supports && !materials.laws.empty())
      collect([&]() {
        post_processing = std::make_unique<PostProcessing<dim>>(parameters,
                                                                *mesh,
                                                                materials,
                                                                *supports);
      });
    if (supports && loads)
      collect([&]() { hold_rigid_motion(); });
    errors.throw_if_any();
  }

  template <int dim>
  void
  Simulation<dim>::read_mesh()
  {
    const auto  timer = timing.scope("mesh");
    const auto &file  = parameters.mesh_file;
    const auto  gmsh_mesh =
      Mesh::read_gmsh<dim>(file, parameters.geometry_parameters, communicator);
    mesh =
      std::make_unique<Mesh::DistributedMesh<dim>>(gmsh_mesh, communicator);
    const auto &nodal = mesh->nodal();
    log << "Mesh: " << file << "\n  " << nodal.n_nodes() << " nodes, "
        << nodal.n_cells() << " cells; boundaries: ";
    log << Base::join_names(mesh->boundary_names()) << std::endl;
  }

  template <int dim>
  void
  Simulation<dim>::assign_materials()
  {
    const auto add = [this](const MaterialConstants &constants) {
      materials.laws.push_back(std::make_unique<Materials::LinearElastic<dim>>(
        constants.youngs_modulus,
        constants.poissons_ratio,
        parameters.state));
      materials.bond_constants.push_back(
        {constants.youngs_modulus, parameters.state});
    };
    add(parameters.material);
    auto &nodal = mesh->nodal();
    for (const auto &entry : parameters.volume_materials)
      {
        const unsigned int index = materials.laws.size();
        for (const unsigned int c :
             mesh->volume(entry.first, "parameter 'Material / by volume'"))
          nodal.cell_material[c] = index;
        add(entry.second);
      }
  }

  template <int dim>
  void
  Simulation<dim>::hold_rigid_motion()
  {
    free_motions = Fem::free_motions(*mesh, *supports);
    if (free_motions.empty())
      return;
    std::string list;
    for (const auto &motion : free_motions)
      list += (list.empty() ? "" : ", ") + motion.description();
    if (!parameters.boundary_conditions.remove_rigid_motion)
      throw Base::InputError(
        Base::InputMessage{"section 'Boundary conditions'",
                           "no support against " + list,
                           "supports that prevent every rigid motion",
                           "Add symmetry or displacement conditions, or set "
                           "'remove rigid motion = true'."});
    if (supports->entries().empty() && loads->empty())
      throw Base::InputError(Base::InputMessage{
        "section 'Boundary conditions'",
        "neither supports nor loads",
        "at least one displacement, traction, pressure, body "
        "force or point condition",
        ""});
    std::vector<unsigned int> needed;
    Fem::add_cell_nodes(mesh->nodal(), needed);
    check_load_balance(
      Fem::NodePartition<dim>(mesh->nodal(), needed, communicator));
    for (const unsigned int pin : Fem::pins_against(*mesh, free_motions))
      supports->pin(pin);
    log << "No support prevents " << list
        << "; the mean of this motion is removed." << std::endl;
  }

  template <int dim>
  void
  Simulation<dim>::check_load_balance(
    const Fem::NodePartition<dim> &partition) const
  {
    Fem::Vector forces;
    partition.initialize(forces);
    for (const double time : parameters.times())
      {
        forces.zero_out_ghost_values();
        forces = 0.;
        loads->add_forces(time, partition, forces);
        forces.compress(dealii::VectorOperation::add);
        for (const auto &motion : free_motions)
          {
            double work = 0., magnitude = 0.;
            for (unsigned int n = 0; n < partition.n_owned(); ++n)
              if (mesh->pieces()[partition.global(n)] == motion.piece)
                {
                  const auto velocity = motion.at(partition.position(n));
                  for (int d = 0; d < dim; ++d)
                    {
                      const double term =
                        forces.local_element(dim * n + d) * velocity[d];
                      work += term;
                      magnitude += std::abs(term);
                    }
                }
            work      = dealii::Utilities::MPI::sum(work, communicator);
            magnitude = dealii::Utilities::MPI::sum(magnitude, communicator);
            if (std::abs(work) > 1e-8 * magnitude)
              throw Base::InputError(Base::InputMessage{
                "section 'Boundary conditions'",
                "loads that push the body in a direction that no support "
                "prevents: " +
                  motion.description(),
                "loads in balance, or supports that take them",
                "Add symmetry or displacement conditions."});
          }
      }
  }

  template <int dim>
  void
  Simulation<dim>::report_validation()
  {
    log
      << "Mode: "
      << Mesh::mode_names()[static_cast<int>(parameters.region.mode)] << ", "
      << Coupling::model_names()[static_cast<int>(parameters.coupling.model)]
      << ", coupling "
      << Coupling::scheme_names()[static_cast<int>(parameters.coupling.scheme)]
      << "\n  " << region.n_core << " nodes peridynamic, " << region.n_blending
      << " blended, " << region.n_elements << " finite elements only\n"
      << "The input is valid." << std::endl;
  }

  template <int dim>
  void
  Simulation<dim>::run(const std::string &parameters_text)
  {
    open_output(parameters_text);
    try
      {
        Method method = set_up(parameters.region.mode);
        report_set_up(method);
        solve_load_steps(method);
        const auto state = gather(method);
        evaluate(state);
        if (parameters.compare_with_finite_elements &&
            parameters.region.mode != Mesh::Mode::finite_elements)
          compare_with_finite_elements(state);
        finish(Output::Status::converged);
      }
    catch (const Base::SolveError &)
      {
        finish(Output::Status::failed);
        throw;
      }
  }

  template <int dim>
  void
  Simulation<dim>::open_output(const std::string &parameters_text)
  {
    const auto &folder = parameters.output_folder;
    Base::collectively(communicator, [&]() {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        return;
      std::error_code status;
      std::filesystem::create_directories(folder, status);
      std::ofstream parameter_copy(folder + "/parameters.prm");
      parameter_copy << parameters_text;
      parameter_copy.close();
      if (status || !parameter_copy)
        throw Base::InputError(
          Base::InputMessage{"parameter 'Output folder'",
                             "'" + folder + "', where nothing can be written",
                             "a folder that exists or can be made",
                             ""});
      log.open(folder + "/log.txt");
    });
    fields = std::make_unique<Output::FieldOutput<dim>>(folder, mesh->nodal());
    result = std::make_unique<Output::Results>(
      parameters.case_name,
      Mesh::mode_names()[static_cast<int>(parameters.region.mode)],
      PERIMORPH_VERSION,
      dealii::Utilities::MPI::n_mpi_processes(communicator));
    files = {"parameters.prm", "log.txt", "results.json"};
  }

  template <int dim>
  typename Simulation<dim>::Method
  Simulation<dim>::set_up(const Mesh::Mode mode)
  {
    const auto timer = timing.scope("setup");
    Method     method;
    if (mode == parameters.region.mode)
      method.region = region;
    else
      {
        auto other    = parameters.region;
        other.mode    = mode;
        method.region = make_region_map(*mesh, other);
      }
    std::unique_ptr<Base::Progress> progress;
    const auto report = [&](const std::size_t done, const std::size_t total) {
      if (!progress)
        progress = std::make_unique<Base::Progress>(log, "Bonds", total);
      progress->update(done);
    };
    method.problem =
      std::make_unique<Coupling::CoupledProblem<dim>>(*mesh,
                                                      method.region,
                                                      materials,
                                                      parameters.coupling,
                                                      report);
    method.equilibrium = std::make_unique<Solvers::Equilibrium<dim>>(
      *method.problem,
      *supports,
      *loads,
      Solvers::EquilibriumParameters{parameters.linear_solver,
                                     parameters.tangent,
                                     parameters.linear_tolerance,
                                     parameters.newton},
      log,
      timing);
    method.problem->partition().initialize(method.displacement);
    return method;
  }

  template <int dim>
  void
  Simulation<dim>::report_set_up(const Method &method)
  {
    const auto &nodal  = mesh->nodal();
    const auto  counts = method.problem->counts();
    result->set("counts", "nodes", nodal.n_nodes());
    result->set("counts", "dofs", dim * nodal.n_nodes());
    result->set("counts", "cells", nodal.n_cells());
    result->set("counts", "active_cells", counts.active_cells);
    result->set("counts", "particles", counts.particles);
    result->set("counts", "bonds", counts.bonds);
    result->set("counts", "broken_bonds", 0);
    result->set("counts", "newton_iterations", 0);
    result->set("counts", "linear_iterations", 0);
    result->set("skipped", "damage_pass", "no bond can break");
    result->set("skipped",
                "cells_without_element_work",
                nodal.n_cells() - counts.active_cells);
    result->set("skipped", "nodes_without_particle", method.region.n_elements);

    double ghost = 0.;
    {
      const auto  timer   = timing.scope("patch_test");
      const auto &entries = supports->entries();
      ghost               = method.problem->ghost_force(
        [&entries](const unsigned int dof) { return entries.count(dof) > 0; });
    }
    result->set("checks", "ghost_force", ghost);

    const auto &choice = method.equilibrium->choice();
    const auto  name   = std::string(choice.direct ? "direct (MUMPS)"
                                  : method.problem->is_symmetric()
                                    ? "conjugate gradients with multigrid"
                                    : "GMRES with multigrid") +
                      (choice.matrix_free ? ", matrix-free families" : "");
    result->set("solver", "linear_solver", name);
    result->set("solver", "reason", choice.reason);

    log
      << "Mode: " << result->mode() << ", "
      << Coupling::model_names()[static_cast<int>(parameters.coupling.model)]
      << ", coupling "
      << Coupling::scheme_names()[static_cast<int>(parameters.coupling.scheme)]
      << "\n  " << method.region.n_core << " nodes peridynamic, "
      << method.region.n_blending << " blended, " << method.region.n_elements
      << " finite elements only; " << counts.bonds << " bonds, "
      << counts.active_cells << " active cells\n";
    if (counts.dropped > 0)
      log << "  " << counts.dropped << " bonds would leave the body: dropped\n";
    log << "Affine patch test on this mesh: ghost force " << ghost
        << " |stress| h^" << dim - 1 << "\n"
        << "Linear solver: " << name << " (" << choice.reason << ")"
        << std::endl;
    if (ghost > 1e-9 &&
        parameters.coupling.scheme != Coupling::Scheme::consistent)
      log.warning(
        "coupling '" +
        Coupling::scheme_names()[static_cast<int>(parameters.coupling.scheme)] +
        "' leaves ghost forces on this mesh; 'consistent' does not");
    else if (ghost > 1e-9)
      log.warning("the patch test is not exact to round-off on this mesh");
  }

  template <int dim>
  void
  Simulation<dim>::solve_load_steps(Method &method)
  {
    const auto       &folder = parameters.output_folder;
    const auto        times  = parameters.times();
    Output::CsvWriter newton_table(
      folder + "/newton.csv",
      {"step", "time", "iteration", "relative_residual", "linear_iterations"},
      log);
    Output::CsvWriter step_table(folder + "/load_steps.csv",
                                 {"step",
                                  "time",
                                  "newton_iterations",
                                  "linear_iterations",
                                  "relative_residual",
                                  "strain_energy",
                                  "external_work",
                                  "largest_displacement",
                                  "imbalance"},
                                 log);
    files.push_back("newton.csv");
    files.push_back("load_steps.csv");
    if (parameters.write_fields)
      write_fields(method, gather(method), 0, 0.);
    for (unsigned int step = 1; step <= times.size(); ++step)
      {
        const double time = times[step - 1];
        log << "Load step " << step << " of " << times.size()
            << ", t = " << time << std::endl;
        Solvers::NewtonRecord record;
        try
          {
            record = method.equilibrium->solve(
              time,
              method.displacement,
              [&](const unsigned int iteration,
                  const double       residual,
                  const unsigned int linear_iterations) {
                log << "  Newton iteration " << iteration
                    << ": relative residual " << residual;
                if (iteration > 0)
                  log << ", " << linear_iterations << " linear iteration"
                      << (linear_iterations == 1 ? "" : "s");
                log << std::endl;
                newton_table.write_row(
                  {step, time, iteration, residual, linear_iterations});
              });
          }
        catch (const Base::SolveError &error)
          {
            record.reason = error.what();
          }
        result->add_count("newton_iterations",
                          std::max<int>(0, record.residuals.size() - 1));
        result->add_count("linear_iterations", record.linear_iterations);
        if (!record.converged)
          {
            std::ostringstream text;
            text << "load step " << step << " (t = " << time
                 << ") did not converge: " << record.reason;
            if (!record.residuals.empty())
              {
                text << "; relative residuals";
                for (const double residual : record.residuals)
                  text << " " << residual;
              }
            text << ". The states before this step are in '" << folder << "'.";
            throw Base::SolveError(text.str());
          }
        remove_mean_rigid_motion(method);
        const auto state = gather(method);
        double     work = 0., largest = 0.;
        for (unsigned int n = 0; n < state.displacement.size(); ++n)
          {
            work += state.external_force[n] * state.displacement[n];
            largest = std::max(largest, state.displacement[n].norm());
          }
        const double imbalance = post_processing->imbalance(state);
        step_table.write_row({step,
                              time,
                              record.residuals.size() - 1,
                              record.linear_iterations,
                              record.residuals.back(),
                              state.strain_energy,
                              work,
                              largest,
                              imbalance});
        result->set("checks", "imbalance", imbalance);
        log << "  largest displacement " << largest << ", strain energy "
            << state.strain_energy << ", out-of-balance " << imbalance
            << std::endl;
        if (imbalance > 1e-6)
          log.warning("loads and reactions do not balance (relative "
                      "out-of-balance force or moment above 1e-6)");
        if (parameters.write_fields)
          write_fields(method, state, step, time);
      }
  }

  template <int dim>
  void
  Simulation<dim>::remove_mean_rigid_motion(Method &method) const
  {
    if (free_motions.empty())
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
    const auto      u          = complete(method.displacement, partition);
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
    state.displacement = complete(displacement, partition);
    state.internal_force =
      complete(method.equilibrium->internal_forces(), partition);
    state.external_force =
      complete(method.equilibrium->external_forces(), partition);
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
    nodal_fields.add("alpha", method.region.alpha);
    nodal_fields.add("horizon", method.region.horizon);
    if (parameters.write_stress)
      {
        const auto stresses = post_processing->nodal_stress(state);
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
        nodal_fields.add("stress_principal_max", principal);
        nodal_fields.add("stress_von_mises", mises);
      }
    fields->write(step, time, nodal_fields);

    if (!parameters.write_particles ||
        method.region.n_core + method.region.n_blending == 0)
      return;
    const auto                         &nodal = mesh->nodal();
    std::vector<unsigned int>           nodes;
    std::vector<double>                 alpha, horizon, volume, damage;
    std::vector<dealii::Tensor<1, dim>> displacement;
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      if (method.region.alpha[n] > 0.)
        {
          nodes.push_back(n);
          alpha.push_back(method.region.alpha[n]);
          horizon.push_back(method.region.horizon[n]);
          volume.push_back(nodal.volume[n]);
          damage.push_back(0.);
          displacement.push_back(state.displacement[n]);
        }
    Output::Fields<dim> particle_fields;
    particle_fields.add("displacement", displacement);
    particle_fields.add("alpha", alpha);
    particle_fields.add("horizon", horizon);
    particle_fields.add("volume", volume);
    particle_fields.add("damage", damage);
    fields->write_particles(step, time, nodes, particle_fields);
  }

  template <int dim>
  void
  Simulation<dim>::evaluate(const State<dim> &state)
  {
    const auto timer = timing.scope("recovery");
    for (const auto &quantity : post_processing->evaluate(state))
      result->set_quantity(quantity.name, quantity.value, quantity.unit);
    for (const auto &reference : parameters.reference_values)
      result->set_reference(reference.first, reference.second);
    for (const auto &file :
         post_processing->write_probes(state, parameters.output_folder))
      files.push_back(file);
  }

  template <int dim>
  void
  Simulation<dim>::compare_with_finite_elements(const State<dim> &state)
  {
    const auto timer = timing.scope("companion");
    log << "Companion run: finite elements only, same mesh" << std::endl;
    Method method = set_up(Mesh::Mode::finite_elements);
    for (const double time : parameters.times())
      {
        const auto record =
          method.equilibrium->solve(time,
                                    method.displacement,
                                    [&](const unsigned int iteration,
                                        const double       residual,
                                        const unsigned int) {
                                      log << "  Newton iteration " << iteration
                                          << ": relative residual " << residual
                                          << std::endl;
                                    });
        if (!record.converged)
          throw Base::SolveError("the companion run with finite elements did "
                                 "not converge: " +
                                 record.reason);
        remove_mean_rigid_motion(method);
      }
    const auto companion = gather(method);
    for (const auto &quantity : post_processing->evaluate(companion))
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
  Simulation<dim>::finish(const Output::Status status)
  {
    for (const auto &file : fields->files())
      files.push_back(file);
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
