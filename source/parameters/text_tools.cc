#include <perimorph/parameters/text_tools.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace Perimorph::Parameters
{
  namespace
  {
    const char *const white_space = " \t\r\n\v\f";


    bool
    is_digit(const char character)
    {
      return character >= '0' && character <= '9';
    }
  } // namespace


  std::string
  trim(const std::string &text)
  {
    const std::size_t first = text.find_first_not_of(white_space);
    if (first == std::string::npos)
      return "";
    return text.substr(first, text.find_last_not_of(white_space) - first + 1);
  }


  std::string
  condense_blanks(const std::string &text)
  {
    std::string condensed;
    for (const std::string &word : split_words(text, white_space))
      condensed += (condensed.empty() ? "" : " ") + word;
    return condensed;
  }


  std::vector<std::string>
  split_top_level(const std::string &text, const char separator)
  {
    std::vector<std::string> parts;
    if (trim(text).empty())
      return parts;
    int         depth = 0;
    std::string part;
    for (const char character : text)
      {
        if (character == '(')
          ++depth;
        else if (character == ')')
          --depth;
        if (character == separator && depth <= 0)
          {
            parts.push_back(trim(part));
            part.clear();
          }
        else
          part += character;
      }
    parts.push_back(trim(part));
    return parts;
  }


  std::vector<std::string>
  split_words(const std::string &text, const std::string &separators)
  {
    std::vector<std::string> words;
    std::size_t              begin = text.find_first_not_of(separators);
    while (begin != std::string::npos)
      {
        const std::size_t end = text.find_first_of(separators, begin);
        words.push_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(separators, end);
      }
    return words;
  }


  bool
  parentheses_match(const std::string &text)
  {
    int depth = 0;
    for (const char character : text)
      {
        if (character == '(')
          ++depth;
        else if (character == ')' && --depth < 0)
          return false;
      }
    return depth == 0;
  }


  bool
  is_identifier(const std::string &text)
  {
    if (text.empty() || is_digit(text[0]))
      return false;
    for (const char character : text)
      if (character != '_' &&
          !std::isalnum(static_cast<unsigned char>(character)))
        return false;
    return true;
  }


  std::optional<double>
  to_number(const std::string &text)
  {
    // strtod would also take hexadecimal numbers, "inf" and "nan"
    if (text.empty() ||
        text.find_first_not_of("0123456789+-.eE") != std::string::npos)
      return std::nullopt;
    char        *end    = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (end != text.c_str() + text.size() || !std::isfinite(number))
      return std::nullopt;
    return number;
  }


  std::string
  count_of(const std::size_t count, const std::string &noun)
  {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
  }


  std::optional<unsigned int>
  to_count(const std::string &text)
  {
    if (text.empty() ||
        text.find_first_not_of("0123456789") != std::string::npos)
      return std::nullopt;
    const unsigned long long count = std::strtoull(text.c_str(), nullptr, 10);
    if (count > std::numeric_limits<unsigned int>::max())
      return std::nullopt;
    return static_cast<unsigned int>(count);
  }
} // namespace Perimorph::Parameters
