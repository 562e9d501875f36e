#include <perimorph/base/keep_where.h>
#include <perimorph/coupling/broken_bond_set.h>

#include <algorithm>

namespace Perimorph::Coupling
{
  namespace
  {
    bool
    has_broken(const Bonds::BrokenBonds        &broken,
               const std::vector<unsigned int> &nodes)
    {
      for (std::size_t a = 0; a < nodes.size(); ++a)
        if (broken.count(nodes[a]) > 0)
          for (std::size_t b = 0; b < nodes.size(); ++b)
            if (a != b && broken.teeth_lost(nodes[a], nodes[b]) > 0)
              return true;
      return false;
    }
  } // namespace

  template <int dim>
  void
  mark_cells_of_bond(const Mesh::NodalMesh<dim>        &mesh,
                     const std::array<unsigned int, 2> &bond,
                     const bool                         in_motion,
                     std::vector<bool>                 &goes)
  {
    if (in_motion)
      {
        for (const unsigned int node : bond)
          for (const unsigned int c : mesh.node_cells.row(node))
            goes[c] = true;
        return;
      }
    for (const unsigned int c : mesh.node_cells.row(bond[0]))
      if (std::find(mesh.cells[c].begin(), mesh.cells[c].end(), bond[1]) !=
          mesh.cells[c].end())
        goes[c] = true;
  }

  template <int dim>
  void
  break_bonds(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::BrokenBonds   &broken,
              const bool                  in_motion,
              BondCoupling<dim>          &coupling)
  {
    auto             &bonds = coupling.bonds;
    std::vector<bool> has_lost(mesh.n_nodes(), false);
    for (const auto &bond : broken.list())
      has_lost[bond.nodes[0]] = has_lost[bond.nodes[1]] = true;
    for (std::size_t b = 0; b < bonds.nodes.size(); ++b)
      if (has_lost[bonds.nodes[b][0]] && has_lost[bonds.nodes[b][1]])
        bonds.stiffness[b] *=
          broken.share_left(bonds.nodes[b][0], bonds.nodes[b][1]);
    const auto remains = [left = bonds.stiffness](const std::size_t b) {
      return left[b] != 0.;
    };
    Base::keep_where(bonds.nodes, remains);
    Base::keep_where(bonds.stiffness, remains);

    coupling.replaced.resize(mesh.n_cells(), false);
    std::vector<bool> goes(mesh.n_cells(), false);
    for (const auto &bond : broken.list())
      mark_cells_of_bond(mesh, bond.nodes, in_motion, goes);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (goes[c])
        coupling.replaced[c] = true;
    const auto stays = [&goes, cells = coupling.cells](const std::size_t k) {
      return !goes[cells[k]];
    };
    Base::keep_where(coupling.cells, stays);
    Base::keep_where(coupling.tensors, stays);
    const auto part_stays =
      [&goes, &broken, parts = coupling.parts](const std::size_t p) {
        return !goes[parts[p].cell] && !has_broken(broken, parts[p].nodes);
      };
    Base::keep_where(coupling.parts, part_stays);
    Base::keep_where(coupling.part_tensors, part_stays);
    coupling.springs.erase(
      std::remove_if(coupling.springs.begin(),
                     coupling.springs.end(),
                     [&goes](const auto &cell) { return goes[cell.cell]; }),
      coupling.springs.end());
  }

#define PERIMORPH_INSTANTIATE(dim)                                      \
  template void mark_cells_of_bond(const Mesh::NodalMesh<dim> &,        \
                                   const std::array<unsigned int, 2> &, \
                                   bool,                                \
                                   std::vector<bool> &);                \
  template void break_bonds(const Mesh::NodalMesh<dim> &,               \
                            const Bonds::BrokenBonds &,                 \
                            bool,                                       \
                            BondCoupling<dim> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
