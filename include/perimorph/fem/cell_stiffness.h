#pragma once

#include <perimorph/fem/contribution.h>

#include <array>
#include <vector>

namespace Perimorph::Fem
{
  /// Stiffness matrices of cells whose forces are linear in the displacement,
  /// one per cell whatever number of terms it has, for runs that take very many
  /// products: geometry and laws are not looked at again.
  ///
  /// Displacements are taken relative to the first node of a cell, whose force
  /// balances the others, so 21 numbers per cell are kept in 2D and 231 in 3D:
  /// 0.2 and 1.9 kB.
  template <int dim>
  class CellStiffness
  {
  public:
    /// Whether a term is linear and symmetric and its blocks are cells.
    static bool
    can_hold(const Contribution<dim> &term);

    /// Sums the tangents of terms.
    /// @param terms    that it can hold
    /// @param at_rest  a displacement of zero
    CellStiffness(const std::vector<const Contribution<dim> *> &terms,
                  const Vector                                 &at_rest);

    /// Leaves out cells, by their numbers in the mesh.
    void
    remove(const std::vector<bool> &goes);

    /// Adds the forces of all cells, also into ghost entries.
    /// @param displacement  ghosts up to date
    void
    add_product(const Vector &displacement, Vector &forces) const;

  private:
    static constexpr unsigned int n_nodes   = 1u << dim;
    static constexpr unsigned int n_rows    = dim * (n_nodes - 1);
    static constexpr unsigned int n_entries = n_rows * (n_rows + 1) / 2;
    /// Cells that are multiplied at once: doubles in the widest registers.
    static constexpr unsigned int n_lanes = 8;

    using Lanes = std::array<double, n_lanes>;

    /// Cells side by side. Lanes without a cell have a stiffness of zero.
    struct Group
    {
      std::array<Lanes, n_entries> stiffness; ///< upper triangle by rows
      std::array<std::array<unsigned int, n_nodes>, n_lanes>
                                        nodes; ///< local nodes
      std::array<unsigned int, n_lanes> cells; ///< in the mesh
    };

    std::vector<Group> groups;
    unsigned int       n_cells = 0;
  };
} // namespace Perimorph::Fem
