#include <perimorph/base/name_help.h>
#include <perimorph/parameters/features.h>
#include <perimorph/parameters/lists.h>
#include <perimorph/parameters/text_tools.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace Perimorph::Parameters
{
  namespace
  {
    const std::array<std::pair<FeatureKind, const char *>, 8> feature_words = {
      {{FeatureKind::boundary, "boundary"},
       {FeatureKind::volume, "volume"},
       {FeatureKind::point, "point"},
       {FeatureKind::segment, "segment"},
       {FeatureKind::plane, "plane"},
       {FeatureKind::triangle, "triangle"},
       {FeatureKind::box, "box"},
       {FeatureKind::ball, "ball"}}};


    std::optional<FeatureKind>
    kind_of_word(const std::string &word)
    {
      for (const auto &[kind, kind_word] : feature_words)
        if (word == kind_word)
          return kind;
      return std::nullopt;
    }


    bool
    is_named(const FeatureKind kind)
    {
      return kind == FeatureKind::boundary || kind == FeatureKind::volume;
    }


    std::vector<std::string>
    shape_words()
    {
      std::vector<std::string> words;
      for (const auto &[kind, word] : feature_words)
        if (!is_named(kind))
          words.emplace_back(word);
      return words;
    }


    /// How a feature is written.
    std::string
    feature_form(const FeatureKind kind, const unsigned int dim)
    {
      const bool        plane_case = dim == 2;
      const std::string word       = feature_word(kind) + " ";
      switch (kind)
        {
          case FeatureKind::boundary:
          case FeatureKind::volume:
            return word + "NAME";
          case FeatureKind::point:
            return word + point_form(dim);
          case FeatureKind::segment:
          case FeatureKind::box:
            return word + (plane_case ? "x0 y0 x1 y1" : "x0 y0 z0 x1 y1 z1");
          case FeatureKind::plane:
            return word + (plane_case ? "px py nx ny" : "px py pz nx ny nz");
          case FeatureKind::triangle:
            return word + "x0 y0 z0 x1 y1 z1 x2 y2 z2";
          case FeatureKind::ball:
            return word + (plane_case ? "cx cy radius" : "cx cy cz radius");
        }
      return word;
    }


    std::size_t
    n_numbers(const FeatureKind kind, const unsigned int dim)
    {
      switch (kind)
        {
          case FeatureKind::boundary:
          case FeatureKind::volume:
            return 0;
          case FeatureKind::point:
            return dim;
          case FeatureKind::segment:
          case FeatureKind::plane:
          case FeatureKind::box:
            return 2 * dim;
          case FeatureKind::triangle:
            return 9;
          case FeatureKind::ball:
            return dim + 1;
        }
      return 0;
    }


    /// What is wrong with the numbers of a shape; empty if nothing is.
    std::string
    degeneracy(const Feature &feature, const unsigned int dim)
    {
      const std::vector<double> &numbers = feature.numbers;
      const auto                 middle  = numbers.begin() + dim;
      if (feature.kind == FeatureKind::ball && numbers.back() <= 0.)
        return "a radius > 0";
      if (feature.kind == FeatureKind::plane &&
          std::all_of(middle, numbers.end(), [](const double number) {
            return number == 0.;
          }))
        return "a normal that is not zero";
      if (feature.kind == FeatureKind::triangle && dim == 2)
        return "a triangle in 3D only";
      if (feature.kind == FeatureKind::segment &&
          std::equal(middle, numbers.end(), numbers.begin()))
        return "two different ends";
      if (feature.kind == FeatureKind::box)
        for (unsigned int d = 0; d < dim; ++d)
          if (numbers[d] >= numbers[dim + d])
            return "a lower corner below the upper corner in each direction";
      return "";
    }


    std::optional<Feature>
    parse_shape(const std::string              &path,
                const std::string              &entry,
                const FeatureKind               kind,
                const std::vector<std::string> &words,
                const unsigned int              dim,
                Base::InputErrorCollector      &errors)
    {
      Feature feature{kind, "", {}};
      for (auto word = words.begin() + 1; word != words.end(); ++word)
        if (const auto number = to_number(*word))
          feature.numbers.push_back(*number);
        else
          {
            errors.add_parameter(path,
                                 "'" + entry + "', where '" + *word +
                                   "' is not a number",
                                 feature_form(kind, dim));
            return std::nullopt;
          }
      if (feature.numbers.size() != n_numbers(kind, dim))
        {
          errors.add_parameter(
            path,
            "'" + entry + "' with " +
              count_of(feature.numbers.size(), "number"),
            feature_form(kind, dim),
            words.size() == 1
              ? "A boundary of this name is written 'boundary " + entry + "'"
              : "");
          return std::nullopt;
        }
      const std::string wrong = degeneracy(feature, dim);
      if (!wrong.empty())
        {
          errors.add_parameter(path, "'" + entry + "'", wrong);
          return std::nullopt;
        }
      return feature;
    }
  } // namespace


  std::string
  feature_word(const FeatureKind kind)
  {
    for (const auto &[table_kind, word] : feature_words)
      if (table_kind == kind)
        return word;
    return "";
  }


  std::vector<Feature>
  parse_features(const std::string         &path,
                 const std::string         &text,
                 const unsigned int         dim,
                 Base::InputErrorCollector &errors)
  {
    std::vector<Feature> features;
    for (const std::string &entry : split_top_level(text, ';'))
      {
        const std::vector<std::string> words = split_words(entry, " \t,()");
        if (words.empty())
          continue;
        const auto kind = kind_of_word(words[0]);
        if (kind && !is_named(*kind))
          {
            const auto feature =
              parse_shape(path, entry, *kind, words, dim, errors);
            if (feature)
              features.push_back(*feature);
          }
        else if (kind)
          {
            const std::string name =
              condense_blanks(entry.substr(words[0].size()));
            if (name.empty())
              errors.add_parameter(path,
                                   "'" + entry + "' without a name",
                                   feature_form(*kind, dim));
            else
              features.push_back({*kind, name, {}});
          }
        else if (words.size() > 1 &&
                 std::all_of(words.begin() + 1,
                             words.end(),
                             [](const std::string &word) {
                               return to_number(word).has_value();
                             }))
          errors.add_parameter(path,
                               "'" + entry + "', where '" + words[0] +
                                 "' is no shape" +
                                 Base::did_you_mean(words[0], shape_words()),
                               "");
        else
          features.push_back(
            {FeatureKind::boundary, condense_blanks(entry), {}});
      }
    return features;
  }


  Length
  parse_length(const std::string         &path,
               const std::string         &text,
               const bool                 allow_automatic,
               Base::InputErrorCollector &errors)
  {
    Length            length;
    const std::string condensed = condense_blanks(text);
    if (allow_automatic && condensed == "automatic")
      {
        length.automatic = true;
        return length;
      }
    std::string number = condensed;
    const auto  unit   = condensed.find("horizon");
    if (unit != std::string::npos && (condensed.substr(unit) == "horizon" ||
                                      condensed.substr(unit) == "horizons"))
      {
        length.in_horizons = true;
        number             = trim(condensed.substr(0, unit));
      }
    const auto value = to_number(number);
    if (value && *value >= 0.)
      length.value = *value;
    else
      errors.add_parameter(path,
                           condensed.empty() ? "nothing"
                                             : "'" + condensed + "'",
                           std::string("a length >= 0, or a number of horizons "
                                       "like '2 horizons'") +
                             (allow_automatic ? ", or automatic" : ""));
    return length;
  }
} // namespace Perimorph::Parameters
