#pragma once

#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Perimorph
{
  namespace Bonds
  {
    /// Undirected bonds between nodes, sorted by (nodes[0], nodes[1]).
    struct BondPairs
    {
      /// Smaller node number first.
      std::vector<std::array<unsigned int, 2>> nodes;
      /// Volume factor [-] of the bond in the family of either end.
      std::vector<std::array<double, 2>> beta;
      /// 1 if this rank owns nodes[0]: every bond has exactly one owner.
      std::vector<char> owned;

      std::size_t
      size() const
      {
        return nodes.size();
      }
    };

    /// Which bonds a search returns.
    enum class BondSelection
    {
      all,
      /// Bonds this rank owns, and bonds that may run through one of its cells:
      /// the box of the segment overlaps the box of the cells of this rank.
      of_this_rank
    };

    /// Volume factor clip((horizon + spacing / 2 - length) / spacing, 0, 1) of
    /// a neighbour at the rim of a family; below 1e-10, which is round-off of
    /// an exact zero, it is zero.
    double
    volume_factor(double horizon, double spacing, double length);

    /// All pairs of nodes with a positive volume factor at one end at least and
    /// a positive blending weight at one end at least. The cost is linear in
    /// the number of bonds (times the depth of the search tree).
    /// @param alpha    blending weight of each node, 1 peridynamics, 0 elements
    /// @param horizon  delta of each node [length]
    /// Source: numerics.md, section 3.
    template <int dim>
    BondPairs
    find_bond_pairs(const Mesh::NodalMesh<dim> &mesh,
                    const std::vector<double>  &alpha,
                    const std::vector<double>  &horizon,
                    BondSelection               selection = BondSelection::all);
  } // namespace Bonds
} // namespace Perimorph
