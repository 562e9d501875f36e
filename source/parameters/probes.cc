#include <perimorph/base/name_help.h>
#include <perimorph/parameters/lists.h>
#include <perimorph/parameters/probes.h>
#include <perimorph/parameters/text_tools.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace Perimorph::Parameters
{
  namespace
  {
    /// The "name: rest" entries of a list, names checked.
    std::vector<std::pair<std::string, std::string>>
    split_probes(const std::string         &path,
                 const std::string         &text,
                 const std::string         &form,
                 Base::InputErrorCollector &errors)
    {
      std::vector<std::pair<std::string, std::string>> probes;
      std::set<std::string>                            names;
      for (const std::string &entry : split_top_level(text, ';'))
        {
          if (entry.empty())
            continue;
          const std::size_t colon = entry.find(':');
          const std::string name  = trim(entry.substr(0, colon));
          if (colon == std::string::npos)
            errors.add_parameter(path,
                                 "'" + entry + "' without a name",
                                 form,
                                 "Entries are separated by ';'");
          else if (!is_identifier(name))
            errors.add_parameter(path,
                                 "name '" + name + "' in '" + entry + "'",
                                 "letters, digits and '_', a letter first",
                                 "The name becomes the name of a result");
          else if (!names.insert(name).second)
            errors.add_parameter(path,
                                 "'" + name + "' twice",
                                 "each name once");
          else
            probes.emplace_back(name, trim(entry.substr(colon + 1)));
        }
      return probes;
    }


    using KeywordNumbers = std::map<std::string, std::vector<double>>;


    /// Reads "center 0 0, radius 3.5, 91 points": numbers behind their
    /// keyword, except "points", which stands behind its number. Numbers in
    /// front of all keywords belong to the keyword "from".
    /// @return   empty, with a message, if the text is not of this form
    KeywordNumbers
    read_keyword_numbers(const std::string                        &path,
                         const std::string                        &name,
                         const std::string                        &text,
                         const std::string                        &form,
                         const std::map<std::string, std::size_t> &sizes,
                         Base::InputErrorCollector                &errors)
    {
      const std::string entry = "'" + name + ": " + text + "'";
      const auto        fail  = [&](const std::string &found,
                            const std::string &hint = "") {
        errors.add_parameter(path, found + " in " + entry, form, hint);
        return KeywordNumbers();
      };

      std::vector<std::string> keywords;
      for (const auto &keyword_and_size : sizes)
        keywords.push_back(keyword_and_size.first);

      KeywordNumbers numbers;
      std::string    keyword = "from";
      for (const std::string &word : split_words(text, " \t,()"))
        {
          if (const auto number = to_number(word))
            {
              numbers[keyword].push_back(*number);
              continue;
            }
          if (sizes.count(word) == 0)
            {
              const auto nearest = Base::nearest_name(word, keywords);
              return fail("'" + word + "'",
                          nearest ? "Did you mean '" + *nearest + "'?" : "");
            }
          if (numbers.count(word) > 0)
            return fail("'" + word + "' twice");
          if (word == "points")
            {
              std::vector<double> &last = numbers[keyword];
              if (last.empty())
                return fail("'points' without a number in front");
              numbers["points"] = {last.back()};
              last.pop_back();
              if (last.empty())
                numbers.erase(keyword);
              // a number behind "points" has no keyword: too many of them
              keyword = "points";
            }
          else
            {
              keyword = word;
              numbers[keyword];
            }
        }
      for (const auto &[given, values] : numbers)
        if (values.size() != sizes.at(given))
          return fail(count_of(values.size(), "number") + " for '" + given +
                      "'");
      if (numbers.empty())
        return fail("nothing");
      return numbers;
    }


    /// Number of points of a line: a whole number of at least two; 0 with a
    /// message if not.
    unsigned int
    to_n_points(const std::string         &path,
                const std::string         &name,
                const double               number,
                Base::InputErrorCollector &errors)
    {
      const double most = 1e7; // beyond, it is a slip of the keyboard
      if (number >= 2. && number <= most &&
          number == static_cast<double>(static_cast<unsigned int>(number)))
        return static_cast<unsigned int>(number);
      errors.add_parameter(path,
                           "the number of points of '" + name + "'",
                           "a whole number >= 2");
      return 0;
    }


    bool
    has_all(const KeywordNumbers           &numbers,
            const std::string              &path,
            const std::string              &name,
            const std::vector<std::string> &keywords,
            const std::string              &form,
            Base::InputErrorCollector      &errors)
    {
      if (numbers.empty())
        return false; // there is a message already
      for (const std::string &keyword : keywords)
        if (numbers.count(keyword) == 0)
          {
            errors.add_parameter(path,
                                 "'" + name + "' without '" + keyword + "'",
                                 form);
            return false;
          }
      return true;
    }
  } // namespace


  std::vector<ProbePoint>
  parse_probe_points(const std::string              &path,
                     const std::string              &text,
                     const unsigned int              dim,
                     const std::vector<std::string> &allowed_components,
                     Base::InputErrorCollector      &errors)
  {
    const bool        with_component = !allowed_components.empty();
    const std::string form =
      "NAME: " + point_form(dim) + (with_component ? ", COMPONENT" : "");
    std::vector<ProbePoint> list;
    for (const auto &[name, rest] : split_probes(path, text, form, errors))
      {
        ProbePoint  probe{name, {}, ""};
        std::string coordinates = rest;
        if (with_component)
          {
            const std::vector<std::string> parts = split_words(rest, " \t,");
            probe.component = parts.empty() ? "" : parts.back();
            if (std::find(allowed_components.begin(),
                          allowed_components.end(),
                          probe.component) == allowed_components.end())
              {
                errors.add_parameter(path,
                                     "'" + name + ": " + rest +
                                       "' without a component at its end",
                                     form + " with COMPONENT among " +
                                       Base::join_names(allowed_components));
                continue;
              }
            coordinates = trim(rest.substr(0, rest.rfind(probe.component)));
            if (!coordinates.empty() && coordinates.back() == ',')
              coordinates = trim(coordinates.substr(0, coordinates.size() - 1));
          }
        probe.point =
          parse_point(path, name + ": " + rest, coordinates, dim, errors);
        if (!probe.point.empty())
          list.push_back(probe);
      }
    return list;
  }


  std::vector<ProbeLine>
  parse_probe_lines(const std::string         &path,
                    const std::string         &text,
                    const unsigned int         dim,
                    Base::InputErrorCollector &errors)
  {
    const std::string form =
      "NAME: " + point_form(dim) + " to " + point_form(dim) + ", N points";
    std::vector<ProbeLine> list;
    for (const auto &[name, rest] : split_probes(path, text, form, errors))
      {
        const KeywordNumbers numbers =
          read_keyword_numbers(path,
                               name,
                               rest,
                               form,
                               {{"from", dim}, {"to", dim}, {"points", 1}},
                               errors);
        if (!has_all(numbers,
                     path,
                     name,
                     {"from", "to", "points"},
                     form,
                     errors))
          continue;
        const unsigned int n_points =
          to_n_points(path, name, numbers.at("points")[0], errors);
        if (n_points > 0)
          list.push_back(
            {name, numbers.at("from"), numbers.at("to"), n_points});
      }
    return list;
  }


  std::vector<ProbeCircle>
  parse_probe_circles(const std::string         &path,
                      const std::string         &text,
                      const unsigned int         dim,
                      Base::InputErrorCollector &errors)
  {
    const std::string form = "NAME: center " + point_form(dim) +
                             ", radius R, from DEGREES to DEGREES, N points";
    std::vector<ProbeCircle> list;
    for (const auto &[name, rest] : split_probes(path, text, form, errors))
      {
        KeywordNumbers numbers = read_keyword_numbers(path,
                                                      name,
                                                      rest,
                                                      form,
                                                      {{"center", dim},
                                                       {"radius", 1},
                                                       {"from", 1},
                                                       {"to", 1},
                                                       {"points", 1}},
                                                      errors);
        if (!numbers.empty() && numbers.count("from") == 0 &&
            numbers.count("to") == 0)
          {
            numbers["from"] = {0.};
            numbers["to"]   = {360.};
          }
        if (!has_all(numbers,
                     path,
                     name,
                     {"center", "radius", "from", "to", "points"},
                     form,
                     errors))
          continue;
        const double radius = numbers.at("radius")[0];
        if (radius <= 0.)
          errors.add_parameter(path,
                               "the radius of '" + name + "'",
                               "a number > 0");
        const unsigned int n_points =
          to_n_points(path, name, numbers.at("points")[0], errors);
        if (radius > 0. && n_points > 0)
          list.push_back({name,
                          numbers.at("center"),
                          radius,
                          numbers.at("from")[0],
                          numbers.at("to")[0],
                          n_points});
      }
    return list;
  }


  NominalStress
  parse_nominal_stress(const std::string         &path,
                       const std::string         &text,
                       Base::InputErrorCollector &errors)
  {
    NominalStress     nominal;
    const std::string condensed = condense_blanks(text);
    const std::string beginning = "reaction of ";
    const auto        number    = to_number(condensed);
    if (number && *number != 0.)
      nominal.value = number;
    else if (condensed.compare(0, beginning.size(), beginning) == 0)
      nominal.reaction_of = condensed.substr(beginning.size());
    else if (!condensed.empty())
      errors.add_parameter(path,
                           "'" + condensed + "'",
                           "a number other than 0, or 'reaction of NAME'");
    return nominal;
  }
} // namespace Perimorph::Parameters
