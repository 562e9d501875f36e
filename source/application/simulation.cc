#include <perimorph/application/checkpoint.h>
#include <perimorph/application/crack_setup.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/label_sizes.h>
#include <perimorph/base/log.h>
#include <perimorph/base/point_cloud.h>
#include <perimorph/base/progress.h>
#include <perimorph/bonds/crack_damage.h>
#include <perimorph/output/csv_writer.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    /// Removes what an earlier run left in the folder, but for what this one
    /// builds upon: it must not stand beside the results of this one.
    void
    remove_old_results(const std::string           &folder,
                       const std::set<std::string> &kept)
    {
      static const std::regex ours(
        "results\\.json|newton\\.csv|load_steps\\.csv|quantities\\.csv|"
        "time_steps\\.csv|"
        "probe_.*\\.csv|checkpoint|checkpoint\\.part|"
        "crack_growth\\.csv|broken_bonds\\.csv|"
        "(solution|particles|cracks)(_[0-9]+\\.vtu|\\.pvd)");
      std::error_code                    ignored;
      std::vector<std::filesystem::path> old;
      for (const auto &entry :
           std::filesystem::directory_iterator(folder, ignored))
        if (const auto name = entry.path().filename().string();
            std::regex_match(name, ours) && kept.count(name) == 0)
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
  Simulation<dim>::run(const std::string        &parameters_text,
                       const Output::Checkpoint &checkpoint)
  {
    this->checkpoint = checkpoint;
    store_mesh(*mesh, this->checkpoint);
    open_output(parameters_text);
    try
      {
        if (parameters.growth.active)
          factor_memory = make_factor_memory();
        Method method = set_up(parameters.region.mode);
        report_set_up(method);
        if (resumed)
          restore(method);
        bool complete = true;
        if (parameters.time_integration.has_inertia())
          integrate_in_time(method);
        else
          {
            complete = solve_load_steps(method);
            evaluate(method, gather(method));
          }
        report_skipped(method);
        if (parameters.compare_with_finite_elements &&
            parameters.region.mode != Mesh::Mode::finite_elements)
          compare_with_finite_elements(parameters.time_integration.has_inertia()
                                         ? last_state
                                         : gather(method));
        finish(complete ? Output::Status::converged : Output::Status::stopped);
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
      remove_old_results(folder, files_to_keep());
      std::ofstream parameter_copy(folder + "/parameters.prm");
      parameter_copy << parameters_text;
      parameter_copy.close();
      if (status || !parameter_copy)
        throw Base::InputError(
          Base::InputMessage{"parameter 'Output folder'",
                             "'" + folder + "', where nothing can be written",
                             "a folder that exists or can be made",
                             ""});
      log.open(folder + "/log.txt", resumed.has_value());
    });
    fields = std::make_unique<Output::FieldOutput<dim>>(folder, mesh->nodal());
    result = std::make_unique<Output::Results>(
      parameters.case_name,
      Mesh::mode_names()[static_cast<int>(parameters.region.mode)],
      PERIMORPH_VERSION,
      dealii::Utilities::MPI::n_mpi_processes(communicator));
    files = {"parameters.prm", "log.txt", "results.json"};
    if (resumed)
      continue_output();
  }

  template <int dim>
  typename Simulation<dim>::Method
  Simulation<dim>::set_up(const Mesh::Mode mode)
  {
    auto method_region = region;
    if (mode != parameters.region.mode)
      {
        auto other    = parameters.region;
        other.mode    = mode;
        method_region = make_region_map(*mesh, other);
      }
    return make_method(
      method_region,
      mode == Mesh::Mode::finite_elements ? Bonds::CrackSet<dim>() : cracks);
  }

  template <int dim>
  std::vector<unsigned int>
  Simulation<dim>::nodes_cut_off(const Bonds::CrackSet<dim> &cracks) const
  {
    // Loads move them without end: no springs must hide that.
    if (cracks.empty() || !parameters.growth.active || !loads->empty() ||
        parameters.time_integration.has_inertia())
      return {};
    const auto        parts   = parts_of_body(mesh->nodal(), cracks);
    const auto       &pieces  = mesh->pieces();
    const auto        n_parts = Base::label_sizes(parts).size();
    std::vector<bool> is_loose(n_parts, false);
    if (n_parts == Base::label_sizes(pieces).size())
      return {};
    for (const auto &motion :
         Fem::free_motions(mesh->nodal(), parts, *supports))
      is_loose[motion.piece] = true;
    std::vector<unsigned int> nodes;
    for (unsigned int n = 0; n < parts.size(); ++n)
      if (is_loose[parts[n]])
        nodes.push_back(n);
    return nodes;
  }

  template <int dim>
  typename Simulation<dim>::Method
  Simulation<dim>::make_method(const Mesh::RegionMap      &region,
                               const Bonds::CrackSet<dim> &cracks,
                               Coupling::SharedParts<dim>  shared)
  {
    const auto timer = timing.scope("setup");
    Method     method;
    method.region = region;
    warn_of_hanging_families(region);
    std::unique_ptr<Base::Progress> progress;
    const auto report = [&](const std::size_t done, const std::size_t total) {
      if (!progress)
        progress =
          std::make_unique<Base::Progress>(log, "Families and bonds", total);
      progress->update(done);
    };
    {
      const auto family_timer = timing.scope("families");
      method.problem          = std::make_unique<Coupling::CoupledProblem<dim>>(
        *mesh,
        method.region,
        materials,
        parameters.coupling,
        report,
        supports->coupled_nodes(),
        cracks,
        broken,
        std::move(shared),
        nodes_cut_off(cracks));
    }
    method.equilibrium = std::make_unique<Solvers::Equilibrium<dim>>(
      *mesh,
      *method.problem,
      *supports,
      *loads,
      Solvers::EquilibriumParameters{parameters.linear_solver,
                                     parameters.tangent,
                                     parameters.linear_tolerance,
                                     parameters.newton,
                                     factor_memory},
      log,
      timing);
    method.problem->partition().initialize(method.displacement);
    return method;
  }

  template <int dim>
  std::shared_ptr<Solvers::FactorMemory>
  Simulation<dim>::make_factor_memory() const
  {
    // A longer crack changes more than condensation pays for.
    if (!parameters.growth.bonds)
      return std::make_shared<Solvers::FactorMemory>();
    // Where families change, those around them do in the next events.
    constexpr std::size_t many = 1200;
    const auto            cloud =
      std::make_shared<const Base::PointCloud<dim>>(mesh->nodal().nodes);
    return std::make_shared<Solvers::FactorMemory>(
      [this, cloud](const std::vector<unsigned int> &unknowns) {
        for (const double horizons : {2., 1.})
          {
            std::set<unsigned int>    nodes;
            std::vector<unsigned int> near;
            for (std::size_t k = 0; k < unknowns.size(); ++k)
              {
                const unsigned int node = unknowns[k] / dim;
                if (k > 0 && unknowns[k - 1] / dim == node)
                  continue;
                cloud->within(cloud->points()[node],
                              horizons * region.horizon[node],
                              near);
                nodes.insert(node);
                nodes.insert(near.begin(), near.end());
              }
            if (dim * nodes.size() > many)
              continue;
            std::vector<unsigned int> all;
            for (const unsigned int node : nodes)
              for (int d = 0; d < dim; ++d)
                all.push_back(dim * node + d);
            return all;
          }
        return unknowns;
      });
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
    if (!nodal.hanging.empty())
      result->set("counts", "hanging_nodes", nodal.hanging.size());
    result->set("counts", "active_cells", counts.active_cells);
    result->set("counts", "particles", counts.particles);
    result->set("counts", "bonds", counts.bonds);
    report_cracks(method);
    if (!cracks.empty() && method.problem->crack_report().n_dead > 0)
      log.warning(std::to_string(method.problem->crack_report().n_dead) +
                  " families have too few intact bonds and carry no energy");
    result->set("counts", "newton_iterations", 0);
    result->set("counts", "linear_iterations", 0);
    if (!parameters.growth.bonds)
      result->set("skipped", "damage_pass", "no bond can break");
    result->set("skipped",
                "cells_without_element_work",
                nodal.n_cells() - counts.active_cells);
    result->set("skipped", "nodes_without_particle", method.region.n_elements);

    double ghost = 0.;
    {
      const auto timer = timing.scope("patch_test");
      ghost            = method.problem->ghost_force(
        [this](const unsigned int dof) { return supports->hold(dof); });
    }
    result->set("checks", "ghost_force", ghost);
    if (counts.particles == 0)
      result->set("skipped",
                  "patch_test",
                  "elements alone are their own reference");

    const auto &choice = method.equilibrium->choice();
    const auto  name =
      std::string(choice.direct ? "direct (MUMPS)"
                  : method.equilibrium->is_symmetric()
                    ? "conjugate gradients with multigrid"
                    : "GMRES with multigrid") +
      (!choice.matrix_free              ? ""
       : method.problem->has_families() ? ", matrix-free families"
                                        : ", matrix-free bonds");
    result->set("solver", "linear_solver", name);
    result->set("solver", "reason", choice.reason);

    log
      << "Mode: " << result->mode() << ", "
      << Coupling::model_names()[static_cast<int>(parameters.coupling.model)]
      << ", coupling "
      << Coupling::scheme_names()[static_cast<int>(parameters.coupling.scheme)];
    if (counts.particles > 0 &&
        parameters.coupling.model == Coupling::Model::correspondence)
      log
        << ", influence function "
        << Peridynamics::influence_function_names()[static_cast<int>(
             influence_function_of(parameters.coupling, nodal, method.region))]
        << ", gradients over "
        << (has_wide_gradients(parameters.coupling) ? "the horizon"
                                                    : "adjacent cells");
    log << "\n  " << method.region.n_core << " nodes peridynamic, "
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
  Simulation<dim>::report_cracks(const Method &method)
  {
    std::size_t n_hidden = 0;
    if (method.region.n_core > 0)
      Bonds::crack_damage(mesh->nodal(),
                          method.region.alpha,
                          method.region.horizon,
                          cracks,
                          n_hidden,
                          broken);
    result->set("counts", "broken_bonds", n_hidden);
    if (cracks.empty())
      return;
    const auto &cracked = method.problem->crack_report();
    result->set("counts", "cut_families", cracked.n_cut);
    result->set("counts", "families_without_energy", cracked.n_dead);
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Perimorph::Application
