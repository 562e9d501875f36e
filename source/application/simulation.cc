#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/base/progress.h>
#include <perimorph/output/csv_writer.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    /// |work - energy| relative to the larger one; zero where both are only
    /// round-off of the largest force times the largest displacement.
    double
    energy_balance(const double work, const double energy, const double scale)
    {
      const double larger = std::max(std::abs(work), std::abs(energy));
      return larger > 1e-12 * scale ? std::abs(work - energy) / larger : 0.;
    }

    /// Removes what an earlier run left in the folder: it must not stand
    /// beside the results of this one.
    void
    remove_old_results(const std::string &folder)
    {
      static const std::regex ours(
        "results\\.json|newton\\.csv|load_steps\\.csv|probe_.*\\.csv|"
        "(solution|particles)(_[0-9]+\\.vtu|\\.pvd)");
      std::error_code                    ignored;
      std::vector<std::filesystem::path> old;
      for (const auto &entry :
           std::filesystem::directory_iterator(folder, ignored))
        if (std::regex_match(entry.path().filename().string(), ours))
          old.push_back(entry.path());
      for (const auto &path : old)
        std::filesystem::remove(path, ignored);
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
      remove_old_results(folder);
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
        progress =
          std::make_unique<Base::Progress>(log, "Families and bonds", total);
      progress->update(done);
    };
    {
      const auto family_timer = timing.scope("families");
      method.problem =
        std::make_unique<Coupling::CoupledProblem<dim>>(*mesh,
                                                        method.region,
                                                        materials,
                                                        parameters.coupling,
                                                        report);
    }
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
    const auto                        &folder = parameters.output_folder;
    const auto                         times  = parameters.times();
    std::unique_ptr<Output::CsvWriter> newton_table, step_table;
    Base::collectively(communicator, [&]() {
      newton_table = std::make_unique<Output::CsvWriter>(
        folder + "/newton.csv",
        std::vector<std::string>{"step",
                                 "time",
                                 "iteration",
                                 "relative_residual",
                                 "linear_iterations"},
        log);
      step_table = std::make_unique<Output::CsvWriter>(
        folder + "/load_steps.csv",
        std::vector<std::string>{"step",
                                 "time",
                                 "newton_iterations",
                                 "linear_iterations",
                                 "relative_residual",
                                 "strain_energy",
                                 "external_work",
                                 "largest_displacement",
                                 "imbalance"},
        log);
    });
    files.push_back("newton.csv");
    files.push_back("load_steps.csv");
    State<dim> previous      = gather(method);
    double     work          = 0.; // of loads and supports
    double     largest_force = 0.;
    if (parameters.write_fields)
      write_fields(method, previous, 0, 0.);
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
                newton_table->write_row(
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
        const auto state   = gather(method);
        double     largest = 0.;
        for (unsigned int n = 0; n < state.displacement.size(); ++n)
          {
            work += 0.5 *
                    (post_processing->outer_force(n, previous) +
                     post_processing->outer_force(n, state)) *
                    (state.displacement[n] - previous.displacement[n]);
            largest = std::max(largest, state.displacement[n].norm());
          }
        largest_force =
          std::max(largest_force, method.equilibrium->largest_force_met());
        const double imbalance =
          post_processing->imbalance(state, largest_force);
        step_table->write_row({step,
                               time,
                               record.residuals.size() - 1,
                               record.linear_iterations,
                               record.residuals.back(),
                               state.strain_energy,
                               work,
                               largest,
                               imbalance});
        result->set("checks", "imbalance", imbalance);
        result->set(
          "checks",
          "energy_balance",
          energy_balance(work, state.strain_energy, largest_force * largest));
        log << "  largest displacement " << largest << ", strain energy "
            << state.strain_energy << ", out-of-balance " << imbalance
            << std::endl;
        if (imbalance > 1e-6)
          log.warning("loads and reactions do not balance (relative "
                      "out-of-balance force or moment above 1e-6)");
        if (parameters.write_fields)
          write_fields(method, state, step, time);
        previous = state;
      }
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Perimorph::Application
