#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace Perimorph::Bonds
{
  /// A bond that broke: two global nodes, the smaller one first.
  struct BrokenBond
  {
    std::array<unsigned int, 2> nodes;
    unsigned int                event; ///< number of the event, from 1
  };

  /// Bonds that broke one by one, without direction: a broken bond is missing
  /// in the families of both its nodes. Bonds never heal.
  ///
  /// The same on every rank. Nodes are those of NodalMesh, whose numbers depend
  /// on the number of ranks.
  class BrokenBonds
  {
  public:
    bool
    empty() const
    {
      return bonds.empty();
    }

    std::size_t
    size() const
    {
      return bonds.size();
    }

    /// In the order they broke.
    const std::vector<BrokenBond> &
    list() const
    {
      return bonds;
    }

    /// @return  false if it was broken before
    bool
    add(unsigned int first, unsigned int second, unsigned int event);

    bool
    contains(unsigned int first, unsigned int second) const;

    /// Broken bonds of a node.
    unsigned int
    count(unsigned int node) const;

  private:
    std::vector<BrokenBond>                        bonds;
    std::unordered_set<std::uint64_t>              keys;
    std::unordered_map<unsigned int, unsigned int> counts;
  };
} // namespace Perimorph::Bonds
