#include <perimorph/base/name_help.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace Perimorph::Base
{
  namespace
  {
    std::string
    lower_case(std::string text)
    {
      for (char &character : text)
        character = static_cast<char>(
          std::tolower(static_cast<unsigned char>(character)));
      return text;
    }


    /// Levenshtein distance: number of characters to insert, delete or
    /// replace; row by row of the usual table.
    std::size_t
    edit_distance(const std::string &first, const std::string &second)
    {
      std::vector<std::size_t> row(second.size() + 1);
      for (std::size_t j = 0; j <= second.size(); ++j)
        row[j] = j;
      for (std::size_t i = 1; i <= first.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= second.size(); ++j)
            {
              const std::size_t replaced =
                diagonal + (first[i - 1] == second[j - 1] ? 0 : 1);
              diagonal = row[j];
              row[j]   = std::min({replaced, row[j] + 1, row[j - 1] + 1});
            }
        }
      return row.back();
    }
  } // namespace


  std::optional<std::string>
  nearest_name(const std::string              &word,
               const std::vector<std::string> &candidates)
  {
    const std::string          lower_word = lower_case(word);
    std::optional<std::string> nearest;
    std::size_t                smallest = 0;
    for (const std::string &candidate : candidates)
      {
        const std::size_t distance =
          edit_distance(lower_word, lower_case(candidate));
        const std::size_t longer = std::max(word.size(), candidate.size());
        // a swap of two letters counts two, also in short names
        const std::size_t limit =
          std::max<std::size_t>(longer / 3, longer >= 4 ? 2 : 1);
        if (distance > limit || distance >= longer)
          continue;
        if (!nearest || distance < smallest)
          {
            nearest  = candidate;
            smallest = distance;
          }
      }
    return nearest;
  }


  std::string
  join_names(const std::vector<std::string> &candidates)
  {
    std::string text;
    for (const std::string &candidate : candidates)
      text += (text.empty() ? "" : ", ") + candidate;
    return text.empty() ? "none" : text;
  }


  std::string
  did_you_mean(const std::string              &word,
               const std::vector<std::string> &candidates)
  {
    const std::optional<std::string> nearest = nearest_name(word, candidates);
    if (nearest)
      return "; did you mean '" + *nearest +
             "'? It has: " + join_names(candidates);
    return "; it has: " + join_names(candidates);
  }
} // namespace Perimorph::Base
