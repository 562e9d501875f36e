#pragma once

#include <deal.II/base/patterns.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Parameters
{
  /// A number strictly inside (lower, upper); dealii::Patterns::Double is the
  /// same with the bounds included. Infinite bounds are no bounds.
  class OpenDouble : public dealii::Patterns::PatternBase
  {
  public:
    explicit OpenDouble(double lower,
                        double upper = std::numeric_limits<double>::infinity());

    bool
    match(const std::string &text) const override;

    std::string
    description(OutputStyle style = Machine) const override;

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

  private:
    const double lower;
    const double upper;
  };

  /// A number > 0.
  class PositiveDouble : public OpenDouble
  {
  public:
    PositiveDouble();

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;
  };

  /// "a|b|c" for dealii::Patterns::Selection.
  std::string
  selection_text(const std::vector<std::string> &names);

  /// One of some names.
  dealii::Patterns::Selection
  choice(const std::vector<std::string> &names);

  /// The names behind 'automatic'.
  std::vector<std::string>
  automatic_or(std::vector<std::string> names);

  /// The description of a pattern, as deal.II prints it, in plain words:
  /// "[Double 0...MAX_DOUBLE (inclusive)]" is "a number >= 0".
  std::string
  plain_words(const std::string &pattern_description);

  /// Names of a "[Selection a|b|c ]", true and false of a "[Bool]", otherwise
  /// nothing.
  std::vector<std::string>
  selection_names(const std::string &pattern_description);
} // namespace Perimorph::Parameters
