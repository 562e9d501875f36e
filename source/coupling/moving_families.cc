#include <perimorph/base/gather.h>
#include <perimorph/coupling/broken_families.h>
#include <perimorph/coupling/correspondence_term.h>
#include <perimorph/coupling/moving_bonds.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace Perimorph::Coupling
{
  namespace
  {
    template <int dim>
    class MovingFamilies : public MovingBonds<dim>
    {
    public:
      MovingFamilies(const Mesh::DistributedMesh<dim> &mesh,
                     const Mesh::RegionMap            &region,
                     const BodyMaterials<dim>         &materials,
                     const FamilyParameters           &parameters,
                     const MotionDamage               &damage,
                     FailurePlanes<dim>               &planes,
                     CoupledProblem<dim>              &problem)
        : mesh(mesh)
        , region(region)
        , materials(materials)
        , parameters(parameters)
        , damage(damage)
        , planes(planes)
        , intact(problem.shared().intact->families)
        , partition(problem.partition())
        , term(*problem.template find_term<CorrespondenceTerm<dim>>())
        , current(term.global_families(partition))
        , is_mixed(mesh.nodal().n_nodes(), false)
        , rows(mesh.nodal().n_nodes())
        , intact_rows(mesh.nodal().n_nodes())
      {
        const auto                              &nodal = mesh.nodal();
        std::vector<std::array<unsigned int, 2>> pairs;
        for (std::size_t p = 0; p < current.n_particles(); ++p)
          for (std::size_t b = current.offsets[p]; b < current.offsets[p + 1];
               ++b)
            pairs.push_back({{current.node[p], current.neighbor[b]}});
        in_core = nodes_in_core(region.alpha, pairs, mesh.communicator());
        for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
          for (const unsigned int c : nodal.node_cells.row(n))
            is_mixed[n] =
              is_mixed[n] ||
              nodal.cell_material[c] !=
                nodal.cell_material[*nodal.node_cells.row(n).begin()];
        for (std::size_t p = 0; p < current.n_particles(); ++p)
          rows[current.node[p]].push_back(p);
        for (std::size_t p = 0; p < intact.n_particles(); ++p)
          intact_rows[intact.node[p]].push_back(p);
        std::vector<std::array<unsigned int, 2>> known;
        for (const auto &bond : damage.broken.list())
          known.push_back(bond.nodes);
        take_away(known);
      }

      OverloadedBonds
      overloaded(
        const std::vector<dealii::Tensor<1, dim>> &displacement) override
      {
        const auto       &nodal = mesh.nodal();
        ParticleStates    states;
        std::vector<bool> may_fail;
        if (damage.sees_particles)
          {
            states = particle_states(nodal,
                                     current,
                                     materials.laws,
                                     displacement,
                                     mesh.communicator());
            may_fail.resize(nodal.n_nodes());
            for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
              may_fail[n] = states.nodes[n].exists && fails_alone(n, states);
          }
        std::vector<std::array<unsigned int, 2>> found; // break alone
        std::vector<OverloadedBond>              openers;
        for (std::size_t p = 0; p < current.n_particles(); ++p)
          {
            const unsigned int i = current.node[p];
            if (damage.is_protected[i])
              continue;
            for (std::size_t b = current.offsets[p]; b < current.offsets[p + 1];
                 ++b)
              {
                const unsigned int j = current.neighbor[b];
                if (j == i || damage.is_protected[j] ||
                    (damage.sees_particles && !may_fail[i] && !may_fail[j]))
                  continue;
                // The same arguments in the families of both ends.
                const unsigned int           first  = std::min(i, j);
                const unsigned int           second = std::max(i, j);
                const dealii::Tensor<1, dim> eta =
                  displacement[second] - displacement[first];
                const dealii::Tensor<1, dim> xi =
                  nodal.nodes[second] - nodal.nodes[first];
                if (!damage.sees_particles && !(xi * eta > 0.))
                  continue;
                auto bond       = bond_state(nodal,
                                       region,
                                       materials.bond_constants,
                                       first,
                                       second,
                                       eta);
                bond.teeth_lost = damage.broken.teeth_lost(first, second);
                if (damage.sees_particles)
                  see_particles(states.nodes[first],
                                states.nodes[second],
                                xi,
                                eta,
                                bond);
                const auto load = load_factor({{first, second}}, states, bond);
                if (!(load.load_factor <= 1.))
                  continue;
                if (load.normal.norm_square() == 0.)
                  found.push_back({{first, second}});
                else
                  openers.push_back(
                    {{{first, second}}, load.load_factor, load.normal});
              }
          }
        if (damage.strengths && damage.strengths->opens_planes)
          {
            planes.open(Base::gather_on_all(mesh.communicator(), openers),
                        nodal.nodes,
                        region.horizon);
            if (!planes.open_planes().empty())
              add_cut_bonds(found);
          }
        return gather_overloaded(std::move(found),
                                 in_core,
                                 mesh.communicator());
      }

      void
      take_away(const std::vector<std::array<unsigned int, 2>> &nodes) override
      {
        std::set<unsigned int> touched;
        for (const auto &bond : nodes)
          touched.insert(bond.begin(), bond.end());
        for (const unsigned int node : touched)
          for (const std::size_t p : rows[node])
            for (const std::size_t k : intact_rows[node])
              if (intact.material[k] == current.material[p])
                replace(p, k);
      }

    private:
      /// Whether a bond between two particles in this state would break.
      bool
      fails_alone(const unsigned int node, const ParticleStates &states) const
      {
        if (is_mixed[node])
          return true;
        Damage::BondState bond;
        bond.length = bond.extension = bond.energy = 1.;
        bond.volume_product = bond.horizon = bond.horizon_ratio = 1.;
        bond.youngs_modulus                                     = 1.;
        dealii::Tensor<1, dim> along;
        along[0] = 1.;
        see_particles(states.nodes[node],
                      states.nodes[node],
                      along,
                      along,
                      bond);
        return load_factor({{node, node}}, states, bond).load_factor <= 1.;
      }

      void
      add_cut_bonds(std::vector<std::array<unsigned int, 2>> &found) const
      {
        // Bonds over horizons; families of cells reach beyond one.
        constexpr double longest = 2.;

        const auto &nodes = mesh.nodal().nodes;
        for (std::size_t p = 0; p < current.n_particles(); ++p)
          {
            const unsigned int i = current.node[p];
            if (damage.is_protected[i] ||
                !planes.is_near(nodes[i], longest * region.horizon[i]))
              continue;
            for (std::size_t b = current.offsets[p]; b < current.offsets[p + 1];
                 ++b)
              {
                const unsigned int j = current.neighbor[b];
                if (j != i && !damage.is_protected[j] &&
                    planes.cut(nodes[i], nodes[j]))
                  found.push_back({{std::min(i, j), std::max(i, j)}});
              }
          }
      }

      StrengthLoad
      load_factor(const std::array<unsigned int, 2> &nodes,
                  const ParticleStates              &states,
                  Damage::BondState                 &bond) const
      {
        if (!damage.strengths)
          return {damage.rule.load_factor(bond), {}};
        return load_factor_by_strength(nodes,
                                       states,
                                       materials,
                                       *damage.strengths,
                                       damage.rule,
                                       bond);
      }

      /// Of the largest eigenvalue of a family alone: that of C times that of
      /// the gradient, and of the stabilisation by |a - b|^2 <= 2 a^2 + 2 b^2.
      double
      eigenvalue_bound(const Peridynamics::FamilySet<dim> &family) const
      {
        const unsigned int node = family.node[0];
        const auto         A =
          materials.laws[family.material[0]]->tangent(dealii::Tensor<2, dim>());
        double                 gradient = 0., stretch = 0.;
        dealii::Tensor<1, dim> sum;
        for (std::size_t b = 0; b < family.n_bonds(); ++b)
          {
            const double mass = damage.mass[family.neighbor[b]];
            gradient += family.gradient_weight[b].norm_square() / mass;
            sum += family.gradient_weight[b];
            stretch +=
              family.bond_weight[b] * (1. / mass + 1. / damage.mass[node]);
          }
        gradient += sum.norm_square() / damage.mass[node];
        return family.weight[0] *
               (A.norm() * gradient + 2. * family.stabilization[0] * stretch);
      }

      void
      replace(const std::size_t p, const std::size_t of_intact)
      {
        Peridynamics::FamilySet<dim> remains;
        const bool                   is_left =
          break_family(mesh.nodal(),
                       region.horizon,
                       parameters,
                       damage.broken,
                       intact,
                       of_intact,
                       remains) &&
          eigenvalue_bound(remains) <= damage.largest_eigenvalue;
        term.replace_family(p, remains, !is_left, partition);
        const std::size_t first = current.offsets[p];
        const std::size_t n     = is_left ? remains.n_bonds() : 0;
        current.weight[p]       = is_left ? remains.weight[0] : 0.;
        for (std::size_t b = first; b < current.offsets[p + 1]; ++b)
          {
            const bool here = b - first < n;
            current.neighbor[b] =
              here ? remains.neighbor[b - first] : current.node[p];
            current.gradient_weight[b] = here
                                           ? remains.gradient_weight[b - first]
                                           : dealii::Tensor<1, dim>();
          }
      }

      const Mesh::DistributedMesh<dim>   &mesh;
      const Mesh::RegionMap              &region;
      const BodyMaterials<dim>           &materials;
      const FamilyParameters              parameters;
      const MotionDamage                  damage;
      FailurePlanes<dim>                 &planes;
      const Peridynamics::FamilySet<dim> &intact;
      const Fem::NodePartition<dim>      &partition;
      CorrespondenceTerm<dim>            &term;
      Peridynamics::FamilySet<dim>        current; ///< with global nodes
      std::vector<bool>                   in_core, is_mixed;
      /// Of each node, in current and intact.
      std::vector<std::vector<std::size_t>> rows, intact_rows;
    };
  } // namespace

  OverloadedBonds
  gather_overloaded(std::vector<std::array<unsigned int, 2>> found,
                    const std::vector<bool>                 &in_core,
                    const MPI_Comm                           communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      found = Base::gather_on_all(communicator, found);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    OverloadedBonds result;
    for (const auto &bond : found)
      if (!in_core[bond[0]] || !in_core[bond[1]])
        result.outside_core.push_back(bond);
    result.nodes = std::move(found);
    return result;
  }

  template <int dim>
  std::unique_ptr<MovingBonds<dim>>
  make_moving_families(const Mesh::DistributedMesh<dim> &mesh,
                       const Mesh::RegionMap            &region,
                       const BodyMaterials<dim>         &materials,
                       const FamilyParameters           &parameters,
                       const MotionDamage               &damage,
                       FailurePlanes<dim>               &planes,
                       CoupledProblem<dim>              &problem)
  {
    return std::make_unique<MovingFamilies<dim>>(mesh,
                                                 region,
                                                 materials,
                                                 parameters,
                                                 damage,
                                                 planes,
                                                 problem);
  }

#define PERIMORPH_INSTANTIATE(dim)                                      \
  template std::unique_ptr<MovingBonds<dim>> make_moving_families<dim>( \
    const Mesh::DistributedMesh<dim> &,                                 \
    const Mesh::RegionMap &,                                            \
    const BodyMaterials<dim> &,                                         \
    const FamilyParameters &,                                           \
    const MotionDamage &,                                               \
    FailurePlanes<dim> &,                                               \
    CoupledProblem<dim> &);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
