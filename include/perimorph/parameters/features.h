#pragma once

#include <perimorph/base/exceptions.h>

#include <string>
#include <vector>

namespace Perimorph::Parameters
{
  enum class FeatureKind
  {
    boundary,
    volume,
    point,
    segment,
    plane,
    triangle, ///< 3D
    box,
    ball
  };

  /// What peridynamics is placed around: a named part of the mesh or a shape.
  struct Feature
  {
    FeatureKind kind;
    /// of a boundary or volume
    std::string name;
    /// point: x; segment: x0, x1; plane: point, normal; triangle: three
    /// corners; box: lower, upper corner; ball: centre, radius (points have dim
    /// numbers each)
    std::vector<double> numbers;
  };

  /// "boundary", "volume", ...: the word in the parameter file.
  std::string
  feature_word(FeatureKind kind);

  /// The list "hole; volume core; ball 0 0 1". Entries which do not start
  /// with a feature word are names of boundaries. Checked: count of numbers,
  /// radius > 0, normal and segment not of length zero, box not empty.
  std::vector<Feature>
  parse_features(const std::string         &path,
                 const std::string         &text,
                 unsigned int               dim,
                 Base::InputErrorCollector &errors);

  /// A length in units of the mesh, or of the horizon, or chosen by the
  /// program.
  struct Length
  {
    double value       = 0.;
    bool   in_horizons = false;
    bool   automatic   = false;
  };

  /// "0.5", "2 horizons" or, where allowed, "automatic"; never negative.
  Length
  parse_length(const std::string         &path,
               const std::string         &text,
               bool                       allow_automatic,
               Base::InputErrorCollector &errors);
} // namespace Perimorph::Parameters
