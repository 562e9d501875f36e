#pragma once

#include <perimorph/base/exceptions.h>

#include <map>
#include <memory>
#include <string>

namespace dealii
{
  template <int dim, typename Number>
  class Point;
}

namespace Perimorph::Parameters
{
  /// Names of the user for numbers in expressions.
  using Constants = std::map<std::string, double>;

  /// "a = 2.5, S = 10"; names that expressions use otherwise are errors.
  Constants
  parse_constants(const std::string         &path,
                  const std::string         &text,
                  Base::InputErrorCollector &errors);

  /// One number as a function of x, y, z, t (z = 0 in 2D), parsed by muParser.
  /// Copies share the parser.
  class Expression
  {
  public:
    /// Zero.
    Expression();

    /// Unknown names and wrong grammar become a message, naming @p path and
    /// @p text; the expression is then zero.
    Expression(const std::string         &path,
               const std::string         &text,
               const Constants           &constants,
               Base::InputErrorCollector &errors);

    template <int dim>
    double
    value(const dealii::Point<dim, double> &point, double time) const;

    /// Is the value a finite number there? If not, adds a message.
    template <int dim>
    bool
    check_finite(const dealii::Point<dim, double> &point,
                 double                            time,
                 Base::InputErrorCollector        &errors) const;

    /// Does t occur?
    bool
    depends_on_time() const;

    /// Does x, y, or z occur?
    bool
    depends_on_space() const;

    /// As written by the user.
    const std::string &
    text() const;

  private:
    class Parser;

    std::string                   path;
    std::string                   expression_text;
    bool                          uses_time  = false;
    bool                          uses_space = false;
    double                        constant   = 0.;
    std::shared_ptr<const Parser> parser;
  };
} // namespace Perimorph::Parameters
