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
    const auto [entry, is_new] =
      place.emplace(key(first, second), bonds.size());
    if (is_new)
      {
        bonds.push_back(
          {{{std::min(first, second), std::max(first, second)}}, event, 0});
        ++counts[first];
        ++counts[second];
      }
    unsigned int &teeth = bonds[entry->second].teeth;
    if (teeth == n_teeth_of_bond)
      return false;
    n_broken += ++teeth == n_teeth_of_bond ? 1 : 0;
    return true;
  }

  bool
  BrokenBonds::contains(const unsigned int first,
                        const unsigned int second) const
  {
    return teeth_lost(first, second) == n_teeth_of_bond;
  }

  unsigned int
  BrokenBonds::teeth_lost(const unsigned int first,
                          const unsigned int second) const
  {
    const auto entry = place.find(key(first, second));
    return entry == place.end() ? 0 : bonds[entry->second].teeth;
  }

  double
  BrokenBonds::share_left(const unsigned int first,
                          const unsigned int second) const
  {
    return double(n_teeth_of_bond - teeth_lost(first, second)) /
           n_teeth_of_bond;
  }

  unsigned int
  BrokenBonds::count(const unsigned int node) const
  {
    const auto entry = counts.find(node);
    return entry == counts.end() ? 0 : entry->second;
  }
} // namespace Perimorph::Bonds
