#include <perimorph/application/simulation_parameters.h>
#include <perimorph/base/name_help.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    const std::string section = "Cracks / ";

    double *
    component(Damage::Strengths &strengths, const std::string &name)
    {
      return name == "X"   ? &strengths.longitudinal
             : name == "Y" ? &strengths.transverse
                           : &strengths.shear;
    }

    /// Every strength is given and > 0.
    void
    check(const std::string         &path,
          const std::string         &of,
          Damage::Strengths          strengths,
          const Damage::Criterion    criterion,
          Base::InputErrorCollector &errors)
    {
      bool fits = true;
      for (const std::string name : {"X", "Y", "S"})
        {
          const double value = *component(strengths, name);
          if (value > 0. && std::isfinite(value))
            continue;
          fits = false;
          std::ostringstream found;
          found << value;
          errors.add_parameter(
            path,
            value == 0. ? "no " + name + " (or 0)" + of
                        : name + " = " + found.str() + of,
            name + ", a number > 0",
            "The criterion is '" +
              Damage::criterion_names()[static_cast<int>(criterion)] + "'.");
        }
      if (fits && criterion == Damage::Criterion::tsai_hill &&
          strengths.transverse >= 2. * strengths.longitudinal)
        {
          std::ostringstream found;
          found << "Y = " << strengths.transverse
                << " with X = " << strengths.longitudinal << of;
          errors.add_parameter(path,
                               found.str(),
                               "Y less than 2 X",
                               "Else some tension never makes the material "
                               "fail.");
        }
    }
  } // namespace

  template <int dim>
  void
  SimulationParameters<dim>::read_strengths(const ParameterTexts      &texts,
                                            Base::InputErrorCollector &errors)
  {
    const auto criterion = growth.criterion;
    const struct
    {
      std::string name, text;
    } entries[] = {{"strengths", texts.strengths},
                   {"strengths by volume", texts.strengths_by_volume},
                   {"interface strengths", texts.interface_strengths}};
    if (!Damage::uses_strengths(criterion))
      {
        for (const auto &entry : entries)
          if (!entry.text.empty())
            errors.add_parameter(
              section + entry.name,
              "'" + entry.text + "' with criterion '" +
                Damage::criterion_names()[static_cast<int>(criterion)] + "'",
              "nothing, or criterion = tsai-hill, maximum stress");
        return;
      }

    std::vector<std::string> names = {rest_of_body};
    for (const auto &entry : volume_materials)
      names.push_back(entry.first);
    const auto index = [&](const std::string &path, const std::string &name) {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        errors.add_parameter(path,
                             "'" + name + "'" + Base::did_you_mean(name, names),
                             "volumes of 'Material / by volume', or '" +
                               rest_of_body + "'");
      return found - names.begin();
    };
    const auto parse = [&](const unsigned int         k,
                           const Parameters::NameRule rule) {
      return Parameters::parse_named_components(section + entries[k].name,
                                                entries[k].text,
                                                {"X", "Y", "S"},
                                                rule,
                                                errors);
    };
    const auto take = [&](const unsigned int                 k,
                          const Parameters::NamedComponents &entry,
                          Damage::Strengths                 &strengths) {
      for (const auto &[name, text] : entry.components)
        *component(strengths, name) =
          number(section + entries[k].name, name, text, errors);
    };

    const auto        n_errors = errors.size();
    auto             &table    = growth.strengths;
    Damage::Strengths rest;
    for (const auto &entry : parse(0, Parameters::NameRule::none))
      take(0, entry, rest);
    if (errors.size() == n_errors)
      check(section + entries[0].name, "", rest, criterion, errors);
    table.opens_planes = texts.strength_failure == "planes";
    table.materials.assign(names.size(), rest);
    for (const auto &entry : parse(1, Parameters::NameRule::required))
      {
        const std::string  path     = section + entries[1].name;
        const unsigned int material = index(path, entry.name);
        if (material == names.size())
          continue;
        take(1, entry, table.materials[material]);
        check(path,
              " of " + entry.name,
              table.materials[material],
              criterion,
              errors);
      }
    for (const auto &entry : parse(2, Parameters::NameRule::required))
      {
        const std::string path = section + entries[2].name;
        const auto pair = Parameters::parse_names(path, entry.name, errors);
        if (pair.size() != 2)
          {
            errors.add_parameter(path,
                                 "'" + entry.name + "'",
                                 "two volumes: rest, inclusion: X = ..., ...");
            continue;
          }
        std::array<unsigned int, 2> key = {
          {static_cast<unsigned int>(index(path, pair[0])),
           static_cast<unsigned int>(index(path, pair[1]))}};
        std::sort(key.begin(), key.end());
        if (key[1] == names.size())
          continue;
        if (table.interfaces.count(key) > 0)
          errors.add_parameter(path,
                               "'" + entry.name + "' again",
                               "each pair once, in either order");
        take(2, entry, table.interfaces[key]);
        check(path,
              " of " + entry.name,
              table.interfaces[key],
              criterion,
              errors);
      }
  }

  template void
  SimulationParameters<2>::read_strengths(const ParameterTexts &,
                                          Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::read_strengths(const ParameterTexts &,
                                          Base::InputErrorCollector &);
} // namespace Perimorph::Application
