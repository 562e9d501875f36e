#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/base/name_help.h>
#include <perimorph/output/results.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace Perimorph::Output
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    using NamedQuantities = std::vector<std::pair<std::string, Quantity>>;

    template <typename List>
    auto
    find_in(List &list, const std::string &name)
    {
      auto entry = list.begin();
      while (entry != list.end() && entry->first != name)
        ++entry;
      return entry;
    }


    void
    set_in(NamedQuantities   &list,
           const std::string &name,
           const double       value,
           const std::string &unit)
    {
      const auto entry = find_in(list, name);
      if (entry == list.end())
        list.emplace_back(name, Quantity{value, unit, {}});
      else
        entry->second = {value, unit, {}};
    }


    Json
    number_or_null(const std::optional<double> &value)
    {
      return value ? Json(*value) : Json();
    }


    /// Replaces numbers that are not finite by null and notes their names.
    void
    remove_not_finite(Json                     &node,
                      const std::string        &path,
                      std::vector<std::string> &not_finite)
    {
      if (node.is_object())
        for (auto &[key, child] : node.items())
          remove_not_finite(child,
                            path.empty() ? key : path + " / " + key,
                            not_finite);
      else if (node.is_number_float() && !std::isfinite(node.get<double>()))
        {
          node = nullptr;
          not_finite.push_back(path);
        }
    }
  } // namespace


  /// Contents of the sections of simple entries, in the order of the file.
  struct Results::Sections
  {
    Json json;
  };


  std::string
  to_string(const Status status)
  {
    switch (status)
      {
        case Status::converged:
          return "converged";
        case Status::stopped:
          return "stopped";
        default:
          return "failed";
      }
  }


  std::optional<double>
  Quantity::relative_error() const
  {
    if (!reference || *reference == 0.)
      return {};
    return std::abs(value - *reference) / std::abs(*reference);
  }


  Results::Results(const std::string &case_name,
                   const std::string &mode,
                   const std::string &version,
                   const unsigned int n_ranks)
    : case_text(case_name)
    , mode_text(mode)
    , version(version)
    , n_ranks(n_ranks)
    , sections(std::make_unique<Sections>())
  {
    // what readers may count on, whatever the run does
    Json &json = sections->json;
    for (const char *name : {"nodes",
                             "dofs",
                             "cells",
                             "active_cells",
                             "particles",
                             "bonds",
                             "broken_bonds",
                             "newton_iterations",
                             "linear_iterations"})
      json["counts"][name] = 0;
    for (const char *name : {"ghost_force", "imbalance", "energy_balance"})
      json["checks"][name] = nullptr;
    for (const char *name :
         {"total", "setup", "assembly", "linear_solver", "damage", "output"})
      json["timings"][name] = 0.;
    json["peak_memory_mb"]     = nullptr;
    json["peak_memory_sum_mb"] = nullptr;
    json["companion"]          = Json::object();
    json["solver"]             = Json::object();
    json["skipped"]            = Json::object();
  }


  Results::~Results() = default;


  void
  Results::set_status(const Status status)
  {
    run_status = status;
  }


  Status
  Results::status() const
  {
    return run_status;
  }


  const std::string &
  Results::case_name() const
  {
    return case_text;
  }


  const std::string &
  Results::mode() const
  {
    return mode_text;
  }


  void
  Results::set_quantity(const std::string &name,
                        const double       value,
                        const std::string &unit)
  {
    set_in(quantities, name, value, unit);
  }


  void
  Results::set_reference(const std::string &name, const double reference)
  {
    references[name] = reference;
  }


  std::vector<std::string>
  Results::unmatched_references() const
  {
    std::vector<std::string> unmatched;
    for (const auto &entry : references)
      if (!has(entry.first))
        unmatched.push_back(entry.first);
    return unmatched;
  }


  bool
  Results::has(const std::string &name) const
  {
    return find_in(quantities, name) != quantities.end();
  }


  double
  Results::value(const std::string &name) const
  {
    return quantity(name).value;
  }


  Quantity
  Results::quantity(const std::string &name) const
  {
    const auto entry = find_in(quantities, name);
    if (entry == quantities.end())
      throw std::out_of_range("quantity '" + name + "' is not in the results" +
                              Base::did_you_mean(name, names()));
    Quantity   result    = entry->second;
    const auto reference = references.find(name);
    if (reference != references.end())
      result.reference = reference->second;
    return result;
  }


  std::vector<std::string>
  Results::names() const
  {
    std::vector<std::string> list;
    for (const auto &entry : quantities)
      list.push_back(entry.first);
    return list;
  }


  void
  Results::set_companion_quantity(const std::string &name,
                                  const double       value,
                                  const std::string &unit)
  {
    set_in(companion, name, value, unit);
  }


  std::optional<double>
  Results::companion_difference(const std::string &name) const
  {
    const auto is_named = [&name](const auto &entry) {
      return entry.first == name;
    };
    const auto own =
      std::find_if(quantities.begin(), quantities.end(), is_named);
    const auto other =
      std::find_if(companion.begin(), companion.end(), is_named);
    if (own == quantities.end() || other == companion.end())
      return std::nullopt;
    double largest = 0.;
    for (const auto *list : {&quantities, &companion})
      for (const auto &entry : *list)
        if (entry.second.unit == other->second.unit)
          largest = std::max(largest, std::abs(entry.second.value));
    const double reference = std::abs(other->second.value);
    if (!(reference > 1e-9 * largest))
      return std::nullopt;
    return (own->second.value - other->second.value) / reference;
  }


  std::map<std::string, double>
  Results::companion_quantities() const
  {
    std::map<std::string, double> values;
    for (const auto &[name, quantity] : companion)
      values[name] = quantity.value;
    return values;
  }


  void
  Results::set_peak_memory(const double max_mb, const double sum_mb)
  {
    sections->json["peak_memory_mb"]     = max_mb;
    sections->json["peak_memory_sum_mb"] = sum_mb;
  }


  std::optional<double>
  Results::peak_memory_mb() const
  {
    const auto &value = sections->json["peak_memory_mb"];
    return value.is_number() ? std::optional<double>(value.get<double>())
                             : std::nullopt;
  }


  void
  Results::set_timings(const std::vector<std::pair<std::string, double>> &table)
  {
    for (const auto &[name, seconds] : table)
      set("timings", name, seconds);
  }


  void
  Results::add_count(const std::string &name, const std::int64_t amount)
  {
    const auto before = number("counts", name).value_or(0.);
    set("counts", name, static_cast<std::int64_t>(before) + amount);
  }


  void
  Results::set(const std::string &section,
               const std::string &name,
               const double       value)
  {
    sections->json[section][name] = value;
  }


  void
  Results::set(const std::string &section,
               const std::string &name,
               const std::string &value)
  {
    sections->json[section][name] = value;
  }


  void
  Results::set(const std::string &section,
               const std::string &name,
               const char        *value)
  {
    set(section, name, std::string(value));
  }


  void
  Results::set_integer(const std::string &section,
                       const std::string &name,
                       const std::int64_t value)
  {
    sections->json[section][name] = value;
  }


  void
  Results::set_bool(const std::string &section,
                    const std::string &name,
                    const bool         value)
  {
    sections->json[section][name] = value;
  }


  std::optional<double>
  Results::number(const std::string &section, const std::string &name) const
  {
    const auto entry = sections->json.find(section);
    if (entry == sections->json.end() || !entry->contains(name) ||
        !entry->at(name).is_number())
      return {};
    return entry->at(name).get<double>();
  }


  std::vector<std::pair<std::string, std::string>>
  Results::entries(const std::string &section) const
  {
    std::vector<std::pair<std::string, std::string>> list;
    const auto entry = sections->json.find(section);
    if (entry == sections->json.end() || !entry->is_object())
      return list;
    for (const auto &[name, value] : entry->items())
      if (value.is_string())
        list.emplace_back(name, value.get<std::string>());
      else if (value.is_number_float())
        {
          char text[32];
          std::snprintf(text, sizeof(text), "%.4g", value.get<double>());
          list.emplace_back(name, text);
        }
      else if (!value.is_null())
        list.emplace_back(name, value.dump());
    return list;
  }


  std::string
  Results::to_json(const std::vector<std::string> &warnings,
                   std::vector<std::string>       *not_finite) const
  {
    Json json;
    json["perimorph_version"] = version;
    json["case"]              = case_text;
    json["mode"]              = mode_text;
    json["status"]            = to_string(run_status);
    json["ranks"]             = n_ranks;

    json["quantities"] = Json::object();
    for (const std::string &name : names())
      {
        const Quantity entry     = quantity(name);
        json["quantities"][name] = {
          {"value", entry.value},
          {"unit", entry.unit},
          {"reference", number_or_null(entry.reference)},
          {"relative_error", number_or_null(entry.relative_error())}};
      }
    for (const auto &[name, section] : sections->json.items())
      json[name] = section;
    for (const auto &[name, entry] : companion)
      {
        auto difference = companion_difference(name);
        if (difference)
          difference = std::abs(*difference);
        json["companion"]["quantities"][name] = {
          {"value", entry.value},
          {"unit", entry.unit},
          {"relative_difference", number_or_null(difference)}};
      }

    std::vector<std::string> names_not_finite;
    remove_not_finite(json, "", names_not_finite);
    json["warnings"] = warnings;
    if (not_finite != nullptr)
      *not_finite = names_not_finite;
    // a name in a wrong encoding must not cost the user the whole file
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }


  void
  Results::write(const std::string &filename, Base::Log &log) const
  {
    std::vector<std::string> not_finite;
    to_json({}, &not_finite);
    for (const std::string &name : not_finite)
      log.warning("'" + name + "' is not a finite number; results.json has " +
                  "null there");
    if (!log.is_active())
      return;

    const std::string aside = filename + ".part";
    std::ofstream     file(aside);
    file << to_json(log.warnings());
    file.close();
    if (!file || std::rename(aside.c_str(), filename.c_str()) != 0)
      throw Base::InputError("the results file " + filename +
                             " cannot be written");
  }
} // namespace Perimorph::Output
