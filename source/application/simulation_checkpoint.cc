#include <perimorph/application/checkpoint.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/fem/nodal_values.h>

#include <algorithm>

namespace Perimorph::Application
{
  namespace
  {
    /// Names with numbers, as a list of words and an array beside it.
    template <typename Map>
    void
    store_sizes(const Map &sizes, Output::Checkpoint &checkpoint)
    {
      auto &names  = checkpoint.words["tables"];
      auto &values = checkpoint.arrays["sizes of tables"];
      names.clear();
      values.clear();
      for (const auto &[name, size] : sizes)
        {
          names.push_back(name);
          values.push_back(static_cast<double>(size));
        }
    }

    std::map<std::string, std::uintmax_t>
    stored_sizes(const Output::Checkpoint &checkpoint)
    {
      std::map<std::string, std::uintmax_t> sizes;
      const auto &names  = checkpoint.words.at("tables");
      const auto &values = checkpoint.arrays.at("sizes of tables");
      for (std::size_t k = 0; k < names.size(); ++k)
        sizes[names[k]] = static_cast<std::uintmax_t>(values[k]);
      return sizes;
    }

    using AllSeries =
      std::map<std::string, std::vector<std::pair<double, std::string>>>;

    void
    store_series(const AllSeries &all, Output::Checkpoint &checkpoint)
    {
      auto &names = checkpoint.words["series"];
      names.clear();
      for (const auto &[name, steps] : all)
        {
          names.push_back(name);
          auto &files = checkpoint.words["files of " + name];
          auto &times = checkpoint.arrays["times of " + name];
          files.clear();
          times.clear();
          for (const auto &[time, file] : steps)
            {
              times.push_back(time);
              files.push_back(file);
            }
        }
    }

    AllSeries
    stored_series(const Output::Checkpoint &checkpoint)
    {
      AllSeries all;
      for (const auto &name : checkpoint.words.at("series"))
        {
          const auto &files = checkpoint.words.at("files of " + name);
          const auto &times = checkpoint.arrays.at("times of " + name);
          for (std::size_t k = 0; k < files.size(); ++k)
            all[name].emplace_back(times[k], files[k]);
        }
      return all;
    }

    template <int dim>
    void
    store_plates(const typename Solvers::Constraints<dim>::State &plates,
                 Output::Checkpoint                              &checkpoint)
    {
      auto &translations = checkpoint.arrays["translations of plates"];
      auto &rotations    = checkpoint.arrays["rotations of plates"];
      translations.clear();
      rotations.clear();
      for (std::size_t p = 0; p < plates.angle.size(); ++p)
        for (int a = 0; a < dim; ++a)
          {
            translations.push_back(plates.translation[p][a]);
            for (int b = 0; b < dim; ++b)
              rotations.push_back(plates.rotation[p][a][b]);
          }
      checkpoint.arrays["angles of plates"] = plates.angle;
    }

    template <int dim>
    typename Solvers::Constraints<dim>::State
    stored_plates(const Output::Checkpoint &checkpoint)
    {
      const auto &translations = checkpoint.arrays.at("translations of plates");
      const auto &rotations    = checkpoint.arrays.at("rotations of plates");
      typename Solvers::Constraints<dim>::State plates;
      plates.angle = checkpoint.arrays.at("angles of plates");
      plates.translation.resize(plates.angle.size());
      plates.rotation.resize(plates.angle.size());
      for (std::size_t p = 0; p < plates.angle.size(); ++p)
        for (int a = 0; a < dim; ++a)
          {
            plates.translation[p][a] = translations[dim * p + a];
            for (int b = 0; b < dim; ++b)
              plates.rotation[p][a][b] = rotations[dim * (dim * p + a) + b];
          }
      return plates;
    }

    void
    store_history(const Fracture::AdvanceHistory &history,
                  Output::Checkpoint             &checkpoint)
    {
      auto &values = checkpoint.arrays["crack advances"];
      values.clear();
      for (const auto &row : history.rows)
        values.insert(values.end(), row.begin(), row.end());
      checkpoint.numbers["rows of crack advances"] = history.rows.size();
    }

    Fracture::AdvanceHistory
    stored_history(const Output::Checkpoint &checkpoint)
    {
      Fracture::AdvanceHistory history;
      const auto              &values = checkpoint.arrays.at("crack advances");
      const auto               n_rows = static_cast<std::size_t>(
        checkpoint.numbers.at("rows of crack advances"));
      for (std::size_t k = 0; k < n_rows; ++k)
        history.rows.emplace_back(values.begin() + k * values.size() / n_rows,
                                  values.begin() +
                                    (k + 1) * values.size() / n_rows);
      return history;
    }

    /// Numbers of results.json that grow or stay from step to step.
    const std::vector<std::pair<std::string, std::string>> result_numbers = {
      {"counts", "newton_iterations"},
      {"counts", "linear_iterations"},
      {"counts", "events"},
      {"counts", "bonds_broken_in_events"},
      {"counts", "isolated_particles"},
      {"checks", "imbalance"},
      {"checks", "energy_balance"}};
  } // namespace

  template <int dim>
  template <typename Action>
  void
  Simulation<dim>::for_each_number(const Action &action)
  {
    action("number", progress.number);
    action("fraction of load step", progress.fraction);
    action("peak", progress.peak);
    action("arc radius", progress.arc.radius);
    action("step", progress.step.number);
    action("time of step", progress.step.time);
    action("increments of step", progress.step.n_increments);
    action("newton iterations of step", progress.step.newton_iterations);
    action("linear iterations of step", progress.step.linear_iterations);
    action("residual of step", progress.step.relative_residual);
    action("advances", n_advances);
    action("events", n_events);
    action("parts at start", parts_at_start);
    action("released energy", released_energy);
    action("dissipated energy", dissipated_energy);
    action("crack growth", grown_length);
    action("handed over", handed_over);
    action("energy of hand-over", hand_over_energy);
    action("crack at hand-over", hand_over_crack);
    action("event of hand-over", hand_over_event);
    action("bonds replaced", n_replaced);
    action("solves before hand-over", solves_before);
    action("solves of segments", segment_solves);
    action("switched energy", switched_energy);
    action("work", work);
    action("counts work", counts_work);
    action("largest force", largest_force);
    action("point supports checked", point_supports_checked);
    action("stable time step", stable_time_step);
    action("announced limit", announced_limit);
    action("limit at start", limit_at_start);
    action("limit is old", limit_is_old);
    action("steps of limit", steps_of_limit);
    action("reduction of limit", limit_reduction);
    action("steps lost to reduction", steps_lost);
    action("energy at start", energy_at_start);
    action("largest energy", largest_energy);
    action("largest imbalance", largest_imbalance);
    action("latest balance", latest_balance);
    action("energy drift", energy_drift);
    action("time steps", n_time_steps);
  }

  template <int dim>
  void
  Simulation<dim>::write_checkpoint(const Method     &method,
                                    const State<dim> &state)
  {
    if (!parameters.write_checkpoints)
      return;
    const auto timer = timing.scope("output");
    const auto direction =
      progress.arc.direction.size() == 0
        ? std::vector<dealii::Tensor<1, dim>>()
        : Fem::to_nodal_values(progress.arc.direction,
                               method.problem->partition());
    Base::collectively(communicator, [&]() {
      if (mesh->nodal().rank != 0)
        return;
      auto &numbers = checkpoint.numbers;
      auto &arrays  = checkpoint.arrays;
      for_each_number([&](const std::string &name, const auto &value) {
        numbers[name] = static_cast<double>(value);
      });
      numbers["time"]                    = method.time;
      const auto memory                  = method.equilibrium->memory();
      numbers["largest force of solves"] = memory.largest_force;
      store_plates<dim>(memory.supports, checkpoint);
      for (const auto &[section, name] : result_numbers)
        if (const auto value = result->number(section, name))
          numbers[section + " / " + name] = *value;
      arrays["recent loads"] = recent_loads;
      store_history(advance_history, checkpoint);
      arrays["displacement"] = in_file_order(*mesh, state.displacement);
      if (!state.velocity.empty())
        {
          arrays["velocity"]        = in_file_order(*mesh, state.velocity);
          arrays["acceleration"]    = in_file_order(*mesh, state.acceleration);
          numbers["work of motion"] = method.motion.work;
          if (!displacement_of_limit.empty())
            arrays["displacement of limit"] =
              in_file_order(*mesh, displacement_of_limit);
        }
      if (!direction.empty())
        arrays["arc direction"] = in_file_order(*mesh, direction);
      if (method.region.alpha != region.alpha)
        arrays["alpha"] = in_file_order(*mesh, method.region.alpha);
      store_advances(cracks, checkpoint);
      store_broken_bonds(*mesh, broken, checkpoint);
      store_points(failure_planes.places(), arrays["failure planes"]);
      checkpoint.words["warnings"] = log.warnings();
      auto sizes                   = earlier_tables;
      for (const auto &[name, table] : tables)
        sizes[name] = table->size();
      store_sizes(sizes, checkpoint);
      store_series(fields->series(), checkpoint);
      Output::write_checkpoint(checkpoint_file(parameters.output_folder),
                               checkpoint);
    });
    if (!checkpoint_is_announced)
      files.push_back("checkpoint");
    checkpoint_is_announced = true;
  }

  template <int dim>
  void
  Simulation<dim>::resume(const Output::Checkpoint &earlier)
  {
    const auto &folder = parameters.output_folder;
    compare_mesh(*mesh, parameters.mesh_file, earlier, checkpoint_file(folder));
    resumed        = earlier;
    earlier_tables = stored_sizes(earlier);
    Base::collectively(communicator, [&]() {
      if (mesh->nodal().rank == 0)
        for (const auto &[name, size] : earlier_tables)
          Output::check_table(folder + "/" + name, size);
    });
  }

  template <int dim>
  std::set<std::string>
  Simulation<dim>::files_to_keep() const
  {
    std::set<std::string> names;
    if (!resumed)
      return names;
    names.insert("checkpoint");
    for (const auto &table : earlier_tables)
      names.insert(table.first);
    for (const auto &[name, steps] : stored_series(*resumed))
      {
        names.insert(name + ".pvd");
        for (const auto &step : steps)
          names.insert(step.second);
      }
    return names;
  }

  template <int dim>
  void
  Simulation<dim>::continue_output()
  {
    Base::collectively(communicator, [&]() {
      if (mesh->nodal().rank == 0)
        for (const auto &[name, size] : earlier_tables)
          Output::cut_table(parameters.output_folder + "/" + name, size);
      fields->restore(stored_series(*resumed));
    });
  }

  template <int dim>
  Output::CsvWriter &
  Simulation<dim>::open_table(const std::string              &name,
                              const std::vector<std::string> &columns)
  {
    const auto file    = parameters.output_folder + "/" + name;
    const auto earlier = earlier_tables.find(name);
    Base::collectively(communicator, [&]() {
      tables[name] = earlier == earlier_tables.end()
                       ? std::make_unique<Output::CsvWriter>(file, columns, log)
                       : std::make_unique<Output::CsvWriter>(file,
                                                             columns,
                                                             earlier->second,
                                                             log);
    });
    if (std::find(files.begin(), files.end(), name) == files.end())
      files.push_back(name);
    return *tables[name];
  }

  template <int dim>
  void
  Simulation<dim>::restore(Method &method)
  {
    const auto &numbers = resumed->numbers;
    const auto &arrays  = resumed->arrays;
    for (const auto &warning : resumed->words.at("warnings"))
      log.warning(warning);
    for (const auto &table : earlier_tables)
      files.push_back(table.first);
    for_each_number([&](const std::string &name, auto &value) {
      value = static_cast<std::decay_t<decltype(value)>>(numbers.at(name));
    });
    log << "Resumed from '" << checkpoint_file(parameters.output_folder)
        << "': step " << progress.step.number << ", t = " << progress.step.time
        << std::endl;
    // A motion has a state before its first step, with rows in the tables.
    if (progress.number == 0 && arrays.count("velocity") == 0)
      {
        resumed.reset();
        return;
      }

    for (const auto &[section, name] : result_numbers)
      if (const auto found = numbers.find(section + " / " + name);
          found != numbers.end())
        {
          if (section == "counts")
            result->set(section, name, static_cast<long>(found->second));
          else
            result->set(section, name, found->second);
        }
    recent_loads        = arrays.at("recent loads");
    advance_history     = stored_history(*resumed);
    const auto advances = stored_advances<dim>(*resumed);
    const auto alpha    = arrays.find("alpha");
    cracks.append(advances);
    name_nucleated_cracks();
    broken = stored_broken_bonds(*mesh, *resumed);
    for (const auto &center : stored_points<dim>(arrays.at("failure planes")))
      failure_planes.add_place(center);
    if (alpha != arrays.end() || !advances.empty() || !broken.empty())
      {
        auto grown = method.region;
        if (alpha != arrays.end())
          grown.set_alpha(from_file_order(*mesh, alpha->second));
        method = make_method(grown, cracks);
      }
    const auto &partition = method.problem->partition();
    Fem::set_nodal_values(
      vectors_from_file_order(*mesh, arrays.at("displacement")),
      partition,
      method.displacement);
    if (const auto direction = arrays.find("arc direction");
        direction != arrays.end())
      {
        partition.initialize(progress.arc.direction);
        Fem::set_nodal_values(vectors_from_file_order(*mesh, direction->second),
                              partition,
                              progress.arc.direction);
      }
    method.time = numbers.at("time");
    if (arrays.count("velocity") > 0)
      {
        auto &motion = method.motion;
        motion.time  = method.time;
        motion.work  = numbers.at("work of motion");
        if (const auto found = arrays.find("displacement of limit");
            found != arrays.end())
          displacement_of_limit = vectors_from_file_order(*mesh, found->second);
        for (const auto &[name, vector] :
             {std::make_pair("displacement", &motion.displacement),
              std::make_pair("velocity", &motion.velocity),
              std::make_pair("acceleration", &motion.acceleration)})
          {
            partition.initialize(*vector);
            Fem::set_nodal_values(
              vectors_from_file_order(*mesh, arrays.at(name)),
              partition,
              *vector);
          }
      }
    method.equilibrium->restore(
      {numbers.at("largest force of solves"), stored_plates<dim>(*resumed)},
      method.time,
      method.displacement);
    last_state = gather(method);
    resumed.reset();
  }

#define PERIMORPH_INSTANTIATE(dim)                                       \
  template void Simulation<dim>::write_checkpoint(const Method &,        \
                                                  const State<dim> &);   \
  template void Simulation<dim>::resume(const Output::Checkpoint &);     \
  template std::set<std::string> Simulation<dim>::files_to_keep() const; \
  template void                  Simulation<dim>::continue_output();     \
  template Output::CsvWriter    &Simulation<dim>::open_table(            \
    const std::string &,                                              \
    const std::vector<std::string> &);                                \
  template void Simulation<dim>::restore(Method &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
