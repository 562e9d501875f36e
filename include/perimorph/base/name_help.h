#pragma once

#include <optional>
#include <string>
#include <vector>

namespace Perimorph::Base
{
  /// The candidate with the smallest edit distance to @p word, upper and
  /// lower case being equal; nothing if none is close enough to be a slip
  /// of the keyboard (distance at most a third of the longer name).
  std::optional<std::string>
  nearest_name(const std::string              &word,
               const std::vector<std::string> &candidates);

  /// "a, b, c"; "none" for an empty list.
  std::string
  join_names(const std::vector<std::string> &candidates);

  /// "; did you mean 'b'? It has: a, b, c", to be put behind
  /// "... 'word' is not in plate.msh"; without a near name "; it has: a, b, c".
  std::string
  did_you_mean(const std::string              &word,
               const std::vector<std::string> &candidates);
} // namespace Perimorph::Base
