#include <perimorph/coupling/bond_term.h>
#include <perimorph/coupling/broken_bond_set.h>
#include <perimorph/coupling/cell_part_term.h>
#include <perimorph/coupling/moving_bonds.h>

#include <algorithm>
#include <limits>
#include <map>

namespace Perimorph::Coupling
{
  namespace
  {
    constexpr double never = std::numeric_limits<double>::infinity();

    template <int dim>
    class MovingPairs : public MovingBonds<dim>
    {
    public:
      MovingPairs(const Mesh::DistributedMesh<dim> &mesh,
                  const Mesh::RegionMap            &region,
                  const BodyMaterials<dim>         &materials,
                  const MotionDamage               &damage,
                  CoupledProblem<dim>              &problem)
        : mesh(mesh)
        , region(region)
        , materials(materials)
        , damage(damage)
        , problem(problem)
        , term(*problem.template find_term<BondTerm<dim>>())
        , pairs(term.pairs(problem.partition()))
        , share(pairs.size())
        , critical(pairs.size())
      {
        in_core = nodes_in_core(region.alpha, pairs, mesh.communicator());
        for (std::size_t b = 0; b < pairs.size(); ++b)
          {
            share[b] = damage.broken.share_left(pairs[b][0], pairs[b][1]);
            find_limit(b);
          }
      }

      OverloadedBonds
      overloaded(
        const std::vector<dealii::Tensor<1, dim>> &displacement) override
      {
        const auto                              &nodes = mesh.nodal().nodes;
        std::vector<std::array<unsigned int, 2>> found;
        for (std::size_t b = 0; b < pairs.size(); ++b)
          {
            const auto [i, j]               = pairs[b];
            const dealii::Tensor<1, dim> xi = nodes[j] - nodes[i];
            if (xi * (displacement[j] - displacement[i]) >= critical[b])
              found.push_back({{std::min(i, j), std::max(i, j)}});
          }
        return gather_overloaded(std::move(found),
                                 in_core,
                                 mesh.communicator());
      }

      void
      take_away(const std::vector<std::array<unsigned int, 2>> &nodes) override
      {
        const auto &nodal = mesh.nodal();
        if (place.empty())
          for (std::size_t b = 0; b < pairs.size(); ++b)
            place[{{std::min(pairs[b][0], pairs[b][1]),
                    std::max(pairs[b][0], pairs[b][1])}}] = b;
        std::vector<bool> goes(nodal.n_cells(), false);
        for (const auto &bond : nodes)
          {
            const auto found = place.find(
              {{std::min(bond[0], bond[1]), std::max(bond[0], bond[1])}});
            if (found != place.end())
              {
                const std::size_t b = found->second;
                const double left = damage.broken.share_left(bond[0], bond[1]);
                term.soften(b, share[b] > 0. ? left / share[b] : 0.);
                share[b] = left;
                find_limit(b);
              }
            mark_cells_of_bond(nodal, bond, true, goes);
          }
        if (auto *parts = problem.template find_term<CellPartTerm<dim>>())
          parts->remove([&](const unsigned int               cell,
                            const std::vector<unsigned int> &local_nodes) {
            if (goes[cell])
              return true;
            std::vector<unsigned int> global;
            for (const unsigned int n : local_nodes)
              global.push_back(problem.partition().global(n));
            return std::any_of(nodes.begin(), nodes.end(), [&](const auto &b) {
              return std::find(global.begin(), global.end(), b[0]) !=
                       global.end() &&
                     std::find(global.begin(), global.end(), b[1]) !=
                       global.end();
            });
          });
        problem.remove_cells(goes);
      }

    private:
      /// |xi| times the extension at which a bond loses its next tooth.
      void
      find_limit(const std::size_t b)
      {
        const auto [i, j] = pairs[b];
        critical[b]       = never;
        if (share[b] == 0. || damage.is_protected[i] || damage.is_protected[j])
          return;
        const auto xi   = mesh.nodal().nodes[j] - mesh.nodal().nodes[i];
        auto       bond = bond_state<dim>(mesh.nodal(),
                                    region,
                                    materials.bond_constants,
                                    i,
                                    j,
                                    xi);
        bond.teeth_lost = damage.broken.teeth_lost(i, j);
        critical[b]     = damage.rule.load_factor(bond) * xi.norm_square();
      }

      const Mesh::DistributedMesh<dim>                  &mesh;
      const Mesh::RegionMap                             &region;
      const BodyMaterials<dim>                          &materials;
      const MotionDamage                                 damage;
      CoupledProblem<dim>                               &problem;
      BondTerm<dim>                                     &term;
      std::vector<std::array<unsigned int, 2>>           pairs;
      std::vector<double>                                share, critical;
      std::vector<bool>                                  in_core;
      std::map<std::array<unsigned int, 2>, std::size_t> place; ///< of pairs
    };
  } // namespace

  template <int dim>
  std::unique_ptr<MovingBonds<dim>>
  make_moving_pairs(const Mesh::DistributedMesh<dim> &mesh,
                    const Mesh::RegionMap            &region,
                    const BodyMaterials<dim>         &materials,
                    const MotionDamage               &damage,
                    CoupledProblem<dim>              &problem)
  {
    return std::make_unique<MovingPairs<dim>>(mesh,
                                              region,
                                              materials,
                                              damage,
                                              problem);
  }

#define PERIMORPH_INSTANTIATE(dim)                                   \
  template std::unique_ptr<MovingBonds<dim>> make_moving_pairs<dim>( \
    const Mesh::DistributedMesh<dim> &,                              \
    const Mesh::RegionMap &,                                         \
    const BodyMaterials<dim> &,                                      \
    const MotionDamage &,                                            \
    CoupledProblem<dim> &);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
