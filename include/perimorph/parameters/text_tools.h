#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace Perimorph::Parameters
{
  /// Without blanks, tabs and line ends at both ends.
  std::string
  trim(const std::string &text);

  /// Trimmed, inner runs of white space replaced by one blank.
  std::string
  condense_blanks(const std::string &text);

  /// Parts between separators outside of parentheses, trimmed, empty ones
  /// included; a blank text has no parts.
  std::vector<std::string>
  split_top_level(const std::string &text, char separator);

  /// Non-empty words between any of the @p separators.
  std::vector<std::string>
  split_words(const std::string &text, const std::string &separators = " \t");

  /// Does every parenthesis have its partner?
  bool
  parentheses_match(const std::string &text);

  /// Letter or '_', then letters, digits and '_'.
  bool
  is_identifier(const std::string &text);

  /// The whole text as one finite decimal number.
  std::optional<double>
  to_number(const std::string &text);

  /// "1 number", "2 numbers".
  std::string
  count_of(std::size_t count, const std::string &noun);

  /// The whole text as one number of digits only.
  std::optional<unsigned int>
  to_count(const std::string &text);
} // namespace Perimorph::Parameters
