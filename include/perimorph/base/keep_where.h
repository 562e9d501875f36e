#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace Perimorph::Base
{
  /// Keeps the entries of a list whose index passes.
  template <typename Value, typename Keeps>
  void
  keep_where(std::vector<Value> &list, const Keeps &keeps)
  {
    std::size_t n_kept = 0;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (keeps(k))
        {
          if (n_kept != k)
            list[n_kept] = std::move(list[k]);
          ++n_kept;
        }
    list.resize(n_kept);
  }
} // namespace Perimorph::Base
