#pragma once

#include <perimorph/base/exceptions.h>

#include <string>
#include <utility>
#include <vector>

/// Parsing of the list entries of a parameter file: entries separated by ';',
/// the name in front of the first ':', components separated by ',' outside of
/// parentheses, "component = expression" split at the first '='. All functions
/// take the path of the parameter ("Boundary conditions / traction"), name it
/// in the messages they add to @p errors, and leave out what is wrong.
namespace Perimorph::Parameters
{
  /// "top: x = 0, y = 0.1*t"
  struct NamedComponents
  {
    /// empty if the entry has none
    std::string name;
    /// component, expression; in the order of the text
    std::vector<std::pair<std::string, std::string>> components;
  };

  /// "hole: 5*t"
  struct NamedValue
  {
    std::string name;
    std::string expression;
  };

  /// "0 0: x = 0, y = 0"
  struct PointEntry
  {
    /// dim numbers
    std::vector<double>                              coordinates;
    std::vector<std::pair<std::string, std::string>> components;
  };

  /// The name in front of the components.
  enum class NameRule
  {
    required,
    /// there is no name
    none,
    /// "volume NAME", or nothing: everywhere
    optional_volume
  };

  /// x, y or x, y, z.
  std::vector<std::string>
  displacement_components(unsigned int dim);

  /// xx, yy, zz, xy and in 3D xz, yz (zz also in 2D: plane strain).
  std::vector<std::string>
  stress_components(unsigned int dim);

  /// displacement, traction, by volume (required); body force
  /// (optional_volume, the name is returned without "volume"); exact
  /// displacement (none: one entry with an empty name).
  /// @param allowed_components   others are errors with the nearest name
  std::vector<NamedComponents>
  parse_named_components(const std::string              &path,
                         const std::string              &text,
                         const std::vector<std::string> &allowed_components,
                         NameRule                        name_rule,
                         Base::InputErrorCollector      &errors);

  /// pressure ("hole: 5; inside: 2*t"), reference data ("ring: ring.csv").
  std::vector<NamedValue>
  parse_named_values(const std::string         &path,
                     const std::string         &text,
                     Base::InputErrorCollector &errors);

  /// symmetry, reaction ("left, bottom"): names, each once.
  std::vector<std::string>
  parse_names(const std::string         &path,
              const std::string         &text,
              Base::InputErrorCollector &errors);

  /// point displacement, point force.
  std::vector<PointEntry>
  parse_point_entries(const std::string              &path,
                      const std::string              &text,
                      unsigned int                    dim,
                      const std::vector<std::string> &allowed_components,
                      Base::InputErrorCollector      &errors);

  /// geometry parameters, reference values ("nr = 24, nt = 12"), in the order
  /// of the text.
  std::vector<std::pair<std::string, double>>
  parse_named_numbers(const std::string         &path,
                      const std::string         &text,
                      Base::InputErrorCollector &errors);

  /// dim numbers separated by blanks or commas, with or without parentheses;
  /// empty, with a message about @p entry, if they are not.
  std::vector<double>
  parse_point(const std::string         &path,
              const std::string         &entry,
              const std::string         &text,
              unsigned int               dim,
              Base::InputErrorCollector &errors);

  /// "x y" or "x y z": how a point is written.
  std::string
  point_form(unsigned int dim);
} // namespace Perimorph::Parameters
