#include <perimorph/base/name_help.h>
#include <perimorph/parameters/expression.h>
#include <perimorph/parameters/lists.h>
#include <perimorph/parameters/text_tools.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/mu_parser_internal.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <sstream>
#include <streambuf>
#include <vector>

namespace Perimorph::Parameters
{
  namespace
  {
    const std::vector<std::string> variables = {"x", "y", "z", "t"};


    bool
    contains(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }


    /// Names in an expression; 'e' and 'E' inside of numbers are none.
    std::vector<std::string>
    identifiers(const std::string &text)
    {
      const auto is_letter = [](const char character) {
        return character == '_' ||
               std::isalpha(static_cast<unsigned char>(character));
      };
      const auto is_digit = [](const char character) {
        return std::isdigit(static_cast<unsigned char>(character)) != 0;
      };

      std::vector<std::string> names;
      std::size_t              i = 0;
      while (i < text.size())
        if (is_letter(text[i]))
          {
            const std::size_t begin = i;
            while (i < text.size() && (is_letter(text[i]) || is_digit(text[i])))
              ++i;
            names.push_back(text.substr(begin, i - begin));
          }
        else if (is_digit(text[i]) || text[i] == '.')
          {
            while (i < text.size() && (is_digit(text[i]) || text[i] == '.'))
              ++i;
            std::size_t exponent = i + 1;
            if (exponent < text.size() &&
                (text[exponent] == '+' || text[exponent] == '-'))
              ++exponent;
            if (i < text.size() && (text[i] == 'e' || text[i] == 'E') &&
                exponent < text.size() && is_digit(text[exponent]))
              i = exponent;
          }
        else
          ++i;
      return names;
    }


    /// A '=' which is not part of ==, !=, <= or >=: muParser assigns.
    bool
    has_assignment(const std::string &text)
    {
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '=')
          {
            if (i + 1 < text.size() && text[i + 1] == '=')
              ++i;
            else if (i == 0 ||
                     std::string("!<>").find(text[i - 1]) == std::string::npos)
              return true;
          }
      return false;
    }


    /// Keeps silent what deal.II prints beside throwing.
    class SilentErrorStream
    {
    public:
      SilentErrorStream()
        : original(std::cerr.rdbuf(nothing.rdbuf()))
      {}

      SilentErrorStream(const SilentErrorStream &) = delete;

      ~SilentErrorStream()
      {
        std::cerr.rdbuf(original);
      }

    private:
      std::ostringstream nothing;
      std::streambuf    *original;
    };


    /// muParser's words out of "Parsing Error at Column 2. The parser said:
    /// Unexpected end of expression at position 3".
    std::string
    parser_words(const dealii::ExceptionBase &exception)
    {
      std::ostringstream stream;
      exception.print_info(stream);
      std::string       words  = condense_blanks(stream.str());
      const std::string marker = "The parser said: ";
      const std::size_t found  = words.find(marker);
      if (found != std::string::npos)
        words = words.substr(found + marker.size());
      while (!words.empty() && words.back() == '.')
        words.pop_back();
      return words;
    }


    std::vector<std::string>
    function_names()
    {
      return dealii::internal::FunctionParser::get_function_names();
    }
  } // namespace


  /// The parser with time as an argument, not as a state.
  class Expression::Parser : public dealii::FunctionParser<3>
  {
  public:
    Parser(const std::string &text, const Constants &constants)
      : dealii::FunctionParser<3>(1)
    {
      this->initialize("x,y,z,t",
                       std::vector<std::string>{text},
                       constants,
                       true);
    }

    double
    evaluate(const dealii::Point<3> &point, const double time) const
    {
      return this->do_value(point, time, 0);
    }
  };


  Constants
  parse_constants(const std::string         &path,
                  const std::string         &text,
                  Base::InputErrorCollector &errors)
  {
    Constants constants;
    for (const auto &[name, number] : parse_named_numbers(path, text, errors))
      if (!is_identifier(name))
        errors.add_parameter(path,
                             "name '" + name + "'",
                             "letters, digits and '_', a letter first");
      else if (name == "pi" || contains(variables, name) ||
               contains(function_names(), name))
        errors.add_parameter(path,
                             "name '" + name + "'",
                             "names that expressions do not know already",
                             "Known are x, y, z, t, pi and the functions: " +
                               Base::join_names(function_names()));
      else
        constants[name] = number;
    return constants;
  }


  Expression::Expression()
    : expression_text("0")
  {}


  Expression::Expression(const std::string         &path,
                         const std::string         &text,
                         const Constants           &constants,
                         Base::InputErrorCollector &errors)
    : path(path)
    , expression_text(trim(text))
  {
    const std::string quoted = "'" + expression_text + "'";
    if (expression_text.empty())
      {
        errors.add_parameter(path, "nothing", "a number or an expression");
        return;
      }

    Constants all_constants        = constants;
    all_constants["pi"]            = dealii::numbers::PI;
    std::vector<std::string> names = variables;
    for (const auto &name_and_value : all_constants)
      names.push_back(name_and_value.first);
    std::vector<std::string> names_and_functions = function_names();
    names_and_functions.insert(names_and_functions.begin(),
                               names.begin(),
                               names.end());

    bool valid = true;
    for (const std::string &name : identifiers(expression_text))
      if (!contains(names_and_functions, name))
        {
          const auto nearest = Base::nearest_name(name, names_and_functions);
          errors.add_parameter(
            path,
            "the unknown name '" + name + "' in " + quoted,
            Base::join_names(names) +
              ", and functions such as sin, exp, sqrt, min, if",
            nearest ? "Did you mean '" + *nearest + "'?"
                    : "Other names are set in 'Expressions / constants'");
          valid = false;
        }
      else
        {
          uses_time  = uses_time || name == "t";
          uses_space = uses_space || name == "x" || name == "y" || name == "z";
        }
    if (!valid)
      return;

    const auto fail = [&](const std::string &why) {
      errors.add_parameter(path,
                           quoted + " (" + why + ")",
                           "one expression in " + Base::join_names(names),
                           "Powers are written x^2, products 2*x");
    };
    if (has_assignment(expression_text))
      fail("'=' assigns, '==' compares");
    else if (split_top_level(expression_text, ',').size() > 1)
      fail("a ',' outside of parentheses");
    else
      try
        {
          const SilentErrorStream silence;
          auto                    new_parser =
            std::make_shared<const Parser>(expression_text, all_constants);
          constant = new_parser->evaluate(dealii::Point<3>(), 0.);
          parser   = new_parser;
        }
      catch (const dealii::ExceptionBase &exception)
        {
          fail(parser_words(exception));
        }
  }


  template <int dim>
  double
  Expression::value(const dealii::Point<dim, double> &point,
                    const double                      time) const
  {
    if (parser == nullptr || !(uses_time || uses_space))
      return constant;
    dealii::Point<3> point_in_space;
    for (unsigned int d = 0; d < dim; ++d)
      point_in_space[d] = point[d];
    return parser->evaluate(point_in_space, time);
  }


  template <int dim>
  bool
  Expression::check_finite(const dealii::Point<dim, double> &point,
                           const double                      time,
                           Base::InputErrorCollector        &errors) const
  {
    const double result = value(point, time);
    if (std::isfinite(result))
      return true;
    std::ostringstream found;
    found << "'" << expression_text
          << "' = " << (std::isnan(result) ? "not a number" : "infinite")
          << " at (";
    for (unsigned int d = 0; d < dim; ++d)
      found << (d > 0 ? ", " : "") << point[d];
    found << "), t = " << time;
    errors.add_parameter(path,
                         found.str(),
                         "a finite value everywhere in the body");
    return false;
  }


  bool
  Expression::depends_on_time() const
  {
    return uses_time;
  }


  bool
  Expression::depends_on_space() const
  {
    return uses_space;
  }


  const std::string &
  Expression::text() const
  {
    return expression_text;
  }


  template double
  Expression::value(const dealii::Point<2, double> &, double) const;
  template double
  Expression::value(const dealii::Point<3, double> &, double) const;
  template bool
  Expression::check_finite(const dealii::Point<2, double> &,
                           double,
                           Base::InputErrorCollector &) const;
  template bool
  Expression::check_finite(const dealii::Point<3, double> &,
                           double,
                           Base::InputErrorCollector &) const;
} // namespace Perimorph::Parameters
