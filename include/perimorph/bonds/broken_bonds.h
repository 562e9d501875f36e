#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace Perimorph::Bonds
{
  /// A bond that lost stiffness: two global nodes, the smaller one first.
  struct BrokenBond
  {
    std::array<unsigned int, 2> nodes;
    unsigned int                event; ///< number of the first one, from 1
    unsigned int                teeth; ///< lost
  };

  /// Bonds that broke one by one, without direction: a broken bond is missing
  /// in the families of both its nodes. Softening bonds break in teeth, each of
  /// which takes the same share of the stiffness. Bonds never heal.
  ///
  /// The same on every rank. Nodes are those of NodalMesh, whose numbers depend
  /// on the number of ranks.
  class BrokenBonds
  {
  public:
    BrokenBonds() = default;

    /// @param n_teeth  that a bond has; one breaks at once
    explicit BrokenBonds(unsigned int n_teeth)
      : n_teeth_of_bond(n_teeth)
    {}

    unsigned int
    n_teeth() const
    {
      return n_teeth_of_bond;
    }

    bool
    empty() const
    {
      return bonds.empty();
    }

    /// Bonds without any tooth left.
    std::size_t
    size() const
    {
      return n_broken;
    }

    /// In the order they lost their first tooth.
    const std::vector<BrokenBond> &
    list() const
    {
      return bonds;
    }

    /// Takes one tooth.
    /// @return  false if it was broken before
    bool
    add(unsigned int first, unsigned int second, unsigned int event);

    /// Whether no tooth is left.
    bool
    contains(unsigned int first, unsigned int second) const;

    unsigned int
    teeth_lost(unsigned int first, unsigned int second) const;

    /// Share of the stiffness that is left [-].
    double
    share_left(unsigned int first, unsigned int second) const;

    /// Bonds of a node that lost teeth.
    unsigned int
    count(unsigned int node) const;

  private:
    unsigned int                                   n_teeth_of_bond = 1;
    std::size_t                                    n_broken        = 0;
    std::vector<BrokenBond>                        bonds;
    std::unordered_map<std::uint64_t, std::size_t> place; ///< in bonds
    std::unordered_map<unsigned int, unsigned int> counts;
  };
} // namespace Perimorph::Bonds
