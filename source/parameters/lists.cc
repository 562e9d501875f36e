#include <perimorph/base/name_help.h>
#include <perimorph/parameters/lists.h>
#include <perimorph/parameters/text_tools.h>

#include <algorithm>
#include <cstddef>
#include <set>

namespace Perimorph::Parameters
{
  namespace
  {
    using Components = std::vector<std::pair<std::string, std::string>>;


    std::string
    in_quotes(const std::string &text)
    {
      return "'" + text + "'";
    }


    /// "name: rest" at the first ':' that is not part of an expression.
    struct NameAndRest
    {
      bool        has_name;
      std::string name;
      std::string rest;
    };


    NameAndRest
    split_name(const std::string &entry)
    {
      const std::size_t colon = entry.find(':');
      if (colon == std::string::npos || entry.find('=') < colon)
        return {false, "", entry};
      return {true,
              condense_blanks(entry.substr(0, colon)),
              trim(entry.substr(colon + 1))};
    }


    /// The entries between ';'; a ';' at the end is no error.
    std::vector<std::string>
    split_entries(const std::string         &path,
                  const std::string         &text,
                  Base::InputErrorCollector &errors)
    {
      if (!parentheses_match(text))
        {
          errors.add_parameter(path,
                               in_quotes(trim(text)),
                               "as many ')' as '(', in pairs");
          return {};
        }
      std::vector<std::string> entries = split_top_level(text, ';');
      entries.erase(std::remove(entries.begin(), entries.end(), ""),
                    entries.end());
      return entries;
    }


    /// "x = 0, y = 0.1*t"; empty if there is an error.
    Components
    parse_components(const std::string              &path,
                     const std::string              &entry,
                     const std::string              &text,
                     const std::vector<std::string> &allowed,
                     Base::InputErrorCollector      &errors)
    {
      const std::string form = "component = expression, separated by ','";
      const auto        fail = [&](const std::string &found,
                            const std::string &allowed_text,
                            const std::string &hint) {
        errors.add_parameter(path,
                             found + " in " + in_quotes(entry),
                             allowed_text,
                             hint);
        return Components();
      };

      Components components;
      for (const std::string &part : split_top_level(text, ','))
        {
          const std::size_t equals = part.find('=');
          if (equals == std::string::npos)
            return fail(in_quotes(part) + " without '='", form, "");
          const std::string name  = condense_blanks(part.substr(0, equals));
          const std::string value = trim(part.substr(equals + 1));
          if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
            {
              const auto nearest = Base::nearest_name(name, allowed);
              return fail("component " + in_quotes(name),
                          Base::join_names(allowed),
                          nearest ? "Did you mean " + in_quotes(*nearest) + "?"
                                  : "");
            }
          if (value.empty())
            return fail("nothing behind '" + name + " ='", form, "");
          for (const auto &earlier : components)
            if (earlier.first == name)
              return fail("component " + in_quotes(name) + " twice",
                          "each component once",
                          "");
          components.emplace_back(name, value);
        }
      if (components.empty())
        return fail("no component", form, "");
      return components;
    }


    /// Takes "volume" off, or says what is wrong.
    bool
    take_volume_name(const std::string         &path,
                     const std::string         &entry,
                     std::string               &name,
                     Base::InputErrorCollector &errors)
    {
      const std::string keyword = "volume ";
      if (name.compare(0, keyword.size(), keyword) == 0)
        {
          name = name.substr(keyword.size());
          return true;
        }
      errors.add_parameter(path,
                           in_quotes(entry),
                           "'volume NAME: component = expression', or no name "
                           "for the whole body",
                           "Did you mean 'volume " + name + ": ...'?");
      return false;
    }
  } // namespace


  std::vector<std::string>
  displacement_components(const unsigned int dim)
  {
    if (dim == 2)
      return {"x", "y"};
    return {"x", "y", "z"};
  }


  std::vector<std::string>
  stress_components(const unsigned int dim)
  {
    if (dim == 2)
      return {"xx", "yy", "zz", "xy"};
    return {"xx", "yy", "zz", "xy", "xz", "yz"};
  }


  std::string
  point_form(const unsigned int dim)
  {
    return dim == 2 ? "x y" : "x y z";
  }


  std::vector<NamedComponents>
  parse_named_components(const std::string              &path,
                         const std::string              &text,
                         const std::vector<std::string> &allowed_components,
                         const NameRule                  name_rule,
                         Base::InputErrorCollector      &errors)
  {
    std::vector<NamedComponents>                  list;
    std::set<std::pair<std::string, std::string>> given;
    for (const std::string &entry : split_entries(path, text, errors))
      {
        auto [has_name, name, rest] = split_name(entry);
        if (name_rule == NameRule::required && name.empty())
          {
            errors.add_parameter(path,
                                 in_quotes(entry) + " without a name",
                                 "NAME: component = expression, ...",
                                 "Entries are separated by ';'");
            continue;
          }
        if (name_rule == NameRule::none && has_name)
          {
            errors.add_parameter(path,
                                 in_quotes(entry) + " with the name " +
                                   in_quotes(name),
                                 "component = expression, ...");
            continue;
          }
        if (name_rule == NameRule::optional_volume && has_name &&
            !take_volume_name(path, entry, name, errors))
          continue;
        const Components components =
          parse_components(path, entry, rest, allowed_components, errors);
        if (components.empty())
          continue;
        for (const auto &component : components)
          if (!given.emplace(name, component.first).second)
            errors.add_parameter(
              path,
              "component " + in_quotes(component.first) +
                (name.empty() ? "" : " of " + in_quotes(name)) + " twice",
              "each component once");
        list.push_back({name, components});
      }
    return list;
  }


  std::vector<NamedValue>
  parse_named_values(const std::string         &path,
                     const std::string         &text,
                     Base::InputErrorCollector &errors)
  {
    std::vector<NamedValue> list;
    std::set<std::string>   names;
    for (const std::string &entry : split_entries(path, text, errors))
      {
        const std::size_t colon = entry.find(':');
        const std::string name  = condense_blanks(entry.substr(0, colon));
        const std::string value =
          colon == std::string::npos ? "" : trim(entry.substr(colon + 1));
        if (name.empty() || value.empty())
          errors.add_parameter(path,
                               in_quotes(entry),
                               "NAME: value; NAME: value; ...");
        else if (!names.insert(name).second)
          errors.add_parameter(path,
                               in_quotes(name) + " twice",
                               "each name once");
        else
          list.push_back({name, value});
      }
    return list;
  }


  std::vector<std::string>
  parse_names(const std::string         &path,
              const std::string         &text,
              Base::InputErrorCollector &errors)
  {
    std::vector<std::string> names;
    for (const std::string &part : split_top_level(text, ','))
      {
        const std::string name = condense_blanks(part);
        if (name.empty() || name.find_first_of(":;=") != std::string::npos)
          errors.add_parameter(path,
                               name.empty()
                                 ? "an empty name in " + in_quotes(trim(text))
                                 : in_quotes(name),
                               "names separated by ','");
        else if (std::find(names.begin(), names.end(), name) != names.end())
          errors.add_parameter(path,
                               in_quotes(name) + " twice",
                               "each name once");
        else
          names.push_back(name);
      }
    return names;
  }


  std::vector<PointEntry>
  parse_point_entries(const std::string              &path,
                      const std::string              &text,
                      const unsigned int              dim,
                      const std::vector<std::string> &allowed_components,
                      Base::InputErrorCollector      &errors)
  {
    std::vector<PointEntry> list;
    for (const std::string &entry : split_entries(path, text, errors))
      {
        const auto [has_name, name, rest] = split_name(entry);
        if (!has_name)
          {
            errors.add_parameter(path,
                                 in_quotes(entry) + " without ':'",
                                 point_form(dim) +
                                   ": component = expression, ...",
                                 "Entries are separated by ';'");
            continue;
          }
        const std::vector<double> point =
          parse_point(path, entry, name, dim, errors);
        const Components components =
          parse_components(path, entry, rest, allowed_components, errors);
        if (!point.empty() && !components.empty())
          list.push_back({point, components});
      }
    return list;
  }


  std::vector<std::pair<std::string, double>>
  parse_named_numbers(const std::string         &path,
                      const std::string         &text,
                      Base::InputErrorCollector &errors)
  {
    std::vector<std::pair<std::string, double>> list;
    std::set<std::string>                       names;
    for (const std::string &part : split_top_level(text, ','))
      {
        const std::size_t equals = part.find('=');
        const std::string name   = condense_blanks(part.substr(0, equals));
        if (equals == std::string::npos || name.empty())
          {
            errors.add_parameter(path,
                                 in_quotes(part),
                                 "name = number, separated by ','");
            continue;
          }
        const std::string value  = trim(part.substr(equals + 1));
        const auto        number = to_number(value);
        if (!number)
          errors.add_parameter(path,
                               in_quotes(value) + " for " + in_quotes(name),
                               "a number");
        else if (!names.insert(name).second)
          errors.add_parameter(path,
                               in_quotes(name) + " twice",
                               "each name once");
        else
          list.emplace_back(name, *number);
      }
    return list;
  }


  std::vector<double>
  parse_point(const std::string         &path,
              const std::string         &entry,
              const std::string         &text,
              const unsigned int         dim,
              Base::InputErrorCollector &errors)
  {
    std::string inside = trim(text);
    if (inside.size() >= 2 && inside.front() == '(' && inside.back() == ')')
      inside = inside.substr(1, inside.size() - 2);
    const std::string place =
      entry == text ? in_quotes(entry)
                    : in_quotes(trim(text)) + " in " + in_quotes(entry);

    std::vector<double> point;
    for (const std::string &word : split_words(inside, " \t,"))
      if (const auto number = to_number(word))
        point.push_back(*number);
      else
        {
          errors.add_parameter(path,
                               place + ", where " + in_quotes(word) +
                                 " is not a number",
                               point_form(dim) + " (numbers)");
          return {};
        }
    if (point.size() != dim)
      {
        errors.add_parameter(
          path,
          place + " with " + count_of(point.size(), "number"),
          point_form(dim) + " (" + std::to_string(dim) + " numbers)");
        return {};
      }
    return point;
  }
} // namespace Perimorph::Parameters
