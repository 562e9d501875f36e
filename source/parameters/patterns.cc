#include <perimorph/base/name_help.h>
#include <perimorph/parameters/patterns.h>
#include <perimorph/parameters/text_tools.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>

namespace Perimorph::Parameters
{
  namespace
  {
    /// Bounds as deal.II prints them when there is none.
    bool
    is_unbounded(const std::string &bound)
    {
      return bound == "-MAX_DOUBLE" || bound == "MAX_DOUBLE" ||
             bound == "-2147483648" || bound == "2147483647";
    }


    /// "lower...upper (inclusive)" as words behind @p kind.
    std::string
    range_words(const std::string &kind, const std::string &range)
    {
      const std::size_t dots = range.find("...");
      if (dots == std::string::npos)
        return kind;
      const std::string lower = trim(range.substr(0, dots));
      const std::string upper =
        trim(range.substr(dots + 3, range.find('(') - dots - 3));
      if (is_unbounded(lower) && is_unbounded(upper))
        return kind;
      if (is_unbounded(upper))
        return kind + " >= " + lower;
      if (is_unbounded(lower))
        return kind + " <= " + upper;
      return kind + " from " + lower + " to " + upper;
    }


    /// The rest of @p text behind @p beginning, if it starts like that.
    std::optional<std::string>
    text_behind(const std::string &beginning, const std::string &text)
    {
      if (text.compare(0, beginning.size(), beginning) != 0)
        return std::nullopt;
      return text.substr(beginning.size());
    }


    std::string
    without_brackets(const std::string &description)
    {
      std::string text = trim(description);
      if (text.size() >= 2 && text.front() == '[' && text.back() == ']')
        text = trim(text.substr(1, text.size() - 2));
      return text;
    }
  } // namespace


  OpenDouble::OpenDouble(const double lower, const double upper)
    : lower(lower)
    , upper(upper)
  {}


  bool
  OpenDouble::match(const std::string &text) const
  {
    const std::optional<double> number = to_number(trim(text));
    return number && *number > lower && *number < upper;
  }


  std::string
  OpenDouble::description(const OutputStyle style) const
  {
    std::ostringstream words;
    words << "a number";
    if (std::isfinite(lower))
      words << " > " << lower;
    if (std::isfinite(upper))
      words << (std::isfinite(lower) ? " and < " : " < ") << upper;
    return style == Machine ? "[" + words.str() + "]" : words.str();
  }


  std::unique_ptr<dealii::Patterns::PatternBase>
  OpenDouble::clone() const
  {
    return std::make_unique<OpenDouble>(lower, upper);
  }


  PositiveDouble::PositiveDouble()
    : OpenDouble(0.)
  {}


  std::unique_ptr<dealii::Patterns::PatternBase>
  PositiveDouble::clone() const
  {
    return std::make_unique<PositiveDouble>();
  }


  std::string
  selection_text(const std::vector<std::string> &names)
  {
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "" : "|") + name;
    return text;
  }


  dealii::Patterns::Selection
  choice(const std::vector<std::string> &names)
  {
    return dealii::Patterns::Selection(selection_text(names));
  }

  std::vector<std::string>
  automatic_or(std::vector<std::string> names)
  {
    names.insert(names.begin(), "automatic");
    return names;
  }

  std::string
  plain_words(const std::string &pattern_description)
  {
    const std::vector<std::string> names = selection_names(pattern_description);
    if (!names.empty())
      return Base::join_names(names);
    const std::string text = without_brackets(pattern_description);
    if (const auto range = text_behind("Double", text))
      return range_words("a number", *range);
    if (const auto range = text_behind("Integer range", text))
      return range_words("a whole number", *range);
    if (text == "Integer")
      return "a whole number";
    if (const auto rest = text_behind("List of <", text))
      return "a list, every part being " +
             plain_words(rest->substr(0, rest->rfind('>')));
    if (text_behind("FileName", text))
      return "a file name";
    if (text == "DirectoryName")
      return "a folder name";
    if (text == "Anything")
      return "any text";
    return text;
  }


  std::vector<std::string>
  selection_names(const std::string &pattern_description)
  {
    const std::string text = without_brackets(pattern_description);
    if (text == "Bool")
      return {"true", "false"};
    if (const auto names = text_behind("Selection", text))
      return split_top_level(*names, '|');
    return {};
  }
} // namespace Perimorph::Parameters
