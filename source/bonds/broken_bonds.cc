#include <perimorph/bonds/broken_bonds.h>

#include <algorithm>

namespace Perimorph::Bonds
{
  namespace
  {
    std::uint64_t
    key(const unsigned int first, const unsigned int second)
    {
      return (static_cast<std::uint64_t>(std::min(first, second)) << 32) |
             std::max(first, second);
    }
  } // namespace

  bool
  BrokenBonds::add(const unsigned int first,
                   const unsigned int second,
                   const unsigned int event)
  {
    if (!keys.insert(key(first, second)).second)
      return false;
    bonds.push_back(
      {{{std::min(first, second), std::max(first, second)}}, event});
    ++counts[first];
    ++counts[second];
    return true;
  }

  bool
  BrokenBonds::contains(const unsigned int first,
                        const unsigned int second) const
  {
    return keys.count(key(first, second)) > 0;
  }

  unsigned int
  BrokenBonds::count(const unsigned int node) const
  {
    const auto entry = counts.find(node);
    return entry == counts.end() ? 0 : entry->second;
  }
} // namespace Perimorph::Bonds
