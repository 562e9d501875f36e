#pragma once

#include <perimorph/base/exceptions.h>

#include <optional>
#include <string>
#include <vector>

/// Parsing of the entries of section Quantities. Names of probes become names
/// of results and files: letters, digits and '_' only, each once in a list.
namespace Perimorph::Parameters
{
  /// "tip: 4 0, y"
  struct ProbePoint
  {
    std::string         name;
    std::vector<double> point;
    /// empty where all components are meant
    std::string component;
  };

  /// "equator: 2.5 0 to 25 0, 101 points"
  struct ProbeLine
  {
    std::string         name;
    std::vector<double> from;
    std::vector<double> to;
    unsigned int        n_points;
  };

  /// "ring: center 0 0, radius 3.5, from 0 to 90, 91 points"; without
  /// "from ... to ..." the full circle from 0 to 360 degrees.
  struct ProbeCircle
  {
    std::string         name;
    std::vector<double> center;
    double              radius;
    double              from_degrees;
    double              to_degrees;
    unsigned int        n_points;
  };

  /// "10" or "reaction of top"
  struct NominalStress
  {
    std::optional<double> value;
    /// name of a boundary, if there is no value
    std::string reaction_of;
  };

  /// deflection, stress ratio: "name: point, component; ...".
  /// @param allowed_components   see displacement_components(),
  ///                             stress_components(); none: "name: point"
  std::vector<ProbePoint>
  parse_probe_points(const std::string              &path,
                     const std::string              &text,
                     unsigned int                    dim,
                     const std::vector<std::string> &allowed_components,
                     Base::InputErrorCollector      &errors);

  std::vector<ProbeLine>
  parse_probe_lines(const std::string         &path,
                    const std::string         &text,
                    unsigned int               dim,
                    Base::InputErrorCollector &errors);

  std::vector<ProbeCircle>
  parse_probe_circles(const std::string         &path,
                      const std::string         &text,
                      unsigned int               dim,
                      Base::InputErrorCollector &errors);

  /// An empty text gives neither value nor boundary.
  NominalStress
  parse_nominal_stress(const std::string         &path,
                       const std::string         &text,
                       Base::InputErrorCollector &errors);
} // namespace Perimorph::Parameters
