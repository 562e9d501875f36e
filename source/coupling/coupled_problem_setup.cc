#include <perimorph/base/collective.h>
#include <perimorph/base/label_sizes.h>
#include <perimorph/base/point_cloud.h>
#include <perimorph/coupling/bond_term.h>
#include <perimorph/coupling/broken_bond_set.h>
#include <perimorph/coupling/broken_families.h>
#include <perimorph/coupling/cell_part_term.h>
#include <perimorph/coupling/correspondence_term.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/coupling/segment_piece_term.h>
#include <perimorph/coupling/softened_elements.h>
#include <perimorph/fem/nodal_springs.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Coupling
{
  const std::vector<std::string> &
  model_names()
  {
    static const std::vector<std::string> names = {"correspondence",
                                                   "bond based"};
    return names;
  }

  const std::vector<std::string> &
  scheme_names()
  {
    static const std::vector<std::string> names = {"consistent",
                                                   "energy blending",
                                                   "force blending"};
    return names;
  }

  template <int dim>
  Peridynamics::InfluenceFunction
  influence_function_of(const CouplingParameters   &parameters,
                        const Mesh::NodalMesh<dim> &mesh,
                        const Mesh::RegionMap      &region)
  {
    if (parameters.influence)
      return *parameters.influence;
    if (dim == 3)
      return Peridynamics::InfluenceFunction::gaussian;
    double       sum         = 0.;
    unsigned int n_particles = 0;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (region.alpha[n] > 0.)
        {
          sum += region.horizon[n] / mesh.spacing[n];
          ++n_particles;
        }
    return sum > 2.5 * n_particles
             ? Peridynamics::InfluenceFunction::cubic_spline
             : Peridynamics::InfluenceFunction::gaussian;
  }

  namespace
  {
    /// One at every node whose family reaches a peridynamic node: force
    /// blending weights equations, not families, so these families are
    /// complete.
    template <int dim>
    std::vector<double>
    extended_weight(const Mesh::NodalMesh<dim> &mesh,
                    const Mesh::RegionMap      &region)
    {
      std::vector<double>         extended(mesh.n_nodes(), 0.);
      const Base::PointCloud<dim> cloud(mesh.nodes);
      std::vector<unsigned int>   near;
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        if (region.alpha[n] > 0.)
          {
            cloud.within(mesh.nodes[n],
                         1.5 * region.horizon[n] + mesh.spacing[n],
                         near);
            for (const unsigned int k : near)
              extended[k] = 1.;
          }
      return extended;
    }

    /// Cells whose nodes are all purely peridynamic.
    template <int dim>
    std::vector<bool>
    core_cells(const Mesh::NodalMesh<dim> &mesh,
               const std::vector<double>  &alpha)
    {
      std::vector<bool> core(mesh.n_cells(), true);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (const unsigned int n : mesh.cells[c])
          core[c] = core[c] && alpha[n] == 1.;
      return core;
    }

    template <int dim>
    std::vector<double>
    local_weights(const Fem::NodePartition<dim> &partition,
                  const std::vector<double>     &alpha,
                  const bool                     of_elements)
    {
      std::vector<double> weights(partition.n_local());
      for (unsigned int n = 0; n < partition.n_local(); ++n)
        {
          const double a = alpha[partition.global(n)];
          weights[n]     = of_elements ? 1. - a : a;
        }
      return weights;
    }

    std::vector<double>
    complement(const std::vector<double> &alpha)
    {
      std::vector<double> result;
      for (const double a : alpha)
        result.push_back(1. - a);
      return result;
    }
  } // namespace

  template <int dim>
  FamilyParameters
  family_parameters(const CouplingParameters   &parameters,
                    const Mesh::NodalMesh<dim> &mesh,
                    const Mesh::RegionMap      &region,
                    const typename Fem::ElasticCells<dim>::MaterialList &laws)
  {
    FamilyParameters options{
      influence_function_of(parameters, mesh, region),
      parameters.gamma,
      parameters.scale.value_or(dim == 3 && has_wide_gradients(parameters)
                                  ? StabilizationScale::shear_modulus
                                  : StabilizationScale::bending),
      parameters.support,
      parameters.crack_rule,
      {},
      {}};
    for (const auto &law : laws)
      options.constants.push_back(elastic_constants(*law));
    return options;
  }

  template <int dim>
  CoupledProblem<dim>::CoupledProblem(const Mesh::DistributedMesh<dim> &mesh,
                                      const Mesh::RegionMap            &region,
                                      const BodyMaterials<dim>   &materials,
                                      const CouplingParameters   &parameters,
                                      const Progress             &progress,
                                      std::vector<unsigned int>   more_nodes,
                                      const Bonds::CrackSet<dim> &cracks,
                                      const Bonds::BrokenBonds   &broken,
                                      SharedParts<dim>            shared,
                                      const std::vector<unsigned int> &loose)
    : mesh(mesh)
    , materials(materials)
    , more_nodes(std::move(more_nodes))
    , parts_to_share(std::move(shared))
  {
    if (region.n_core + region.n_blending == 0)
      {
        make_partition({});
        make_elements({}, {});
        contributions.push_back(parts_to_share.elements);
      }
    else if (parameters.model == Model::correspondence)
      make_correspondence(region, parameters, cracks, broken, progress);
    else
      make_bonds(region, parameters, cracks, broken, progress);

    if (!loose.empty())
      ground(loose);
    if (region.n_core + region.n_blending == 0)
      parts_to_share.all_cells = parts_to_share.elements;
    else if (!parts_to_share.all_cells ||
             !parts_to_share.all_cells->is_linear())
      parts_to_share.all_cells =
        std::make_shared<Fem::ElasticCells<dim>>(mesh.nodal(),
                                                 partition(),
                                                 materials.laws,
                                                 std::vector<double>());
    preconditioner = of_particles.empty()
                       ? parts_to_share.all_cells
                       : softened_elements(mesh.nodal(),
                                           region.alpha,
                                           cracks,
                                           broken,
                                           parts_to_share.all_cells);
    for (const auto &term : contributions)
      if (dynamic_cast<const Fem::ElasticCells<dim> *>(term.get()))
        local_counts.active_cells += term->n_blocks();
  }

  template <int dim>
  void
  CoupledProblem<dim>::make_correspondence(const Mesh::RegionMap    &region,
                                           const CouplingParameters &parameters,
                                           const Bonds::CrackSet<dim> &cracks,
                                           const Bonds::BrokenBonds   &broken,
                                           const Progress             &progress)
  {
    const auto &nodal  = mesh.nodal();
    const bool  forces = parameters.scheme == Scheme::force_blending;
    auto options = family_parameters(parameters, nodal, region, materials.laws);
    options.progress = progress;

    IntactBonds<dim>             found;
    const bool                   is_known = parts_to_share.intact != nullptr;
    Peridynamics::FamilySet<dim> set;
    Base::collectively(mesh.communicator(), [&]() {
      if (!is_known)
        found.families =
          parameters.scheme == Scheme::consistent
            ? consistent_families(nodal,
                                  region.alpha,
                                  region.horizon,
                                  options,
                                  cracks,
                                  &found.cracked)
            : classical_families(nodal,
                                 forces ? extended_weight(nodal, region)
                                        : region.alpha,
                                 region.horizon,
                                 options,
                                 cracks);
      cracked = is_known ? parts_to_share.intact->cracked : found.cracked;
      if (!is_known && parameters.bonds_may_break)
        parts_to_share.intact =
          std::make_shared<const IntactBonds<dim>>(std::move(found));
      const auto &intact = parts_to_share.intact;
      if (!broken.empty())
        set = break_bonds(nodal,
                          region.horizon,
                          options,
                          broken,
                          intact ? intact->families : found.families,
                          local_counts.isolated);
      else if (intact)
        set = intact->families;
      else
        set = std::move(found.families);
    });
    std::vector<unsigned int> parts;
    if (!broken.empty())
      parts = find_parts(nodal, region.alpha, set, mesh.communicator());
    local_counts.particles = set.n_particles();
    local_counts.bonds     = set.n_bonds();

    std::vector<unsigned int> needed;
    add_family_nodes(set, needed);
    make_partition(needed);
    auto term = std::make_unique<CorrespondenceTerm<dim>>(std::move(set),
                                                          partition(),
                                                          materials.laws);
    of_particles.push_back(term.get());
    families_exist = true;
    add_terms(region,
              parameters.scheme,
              complement(region.alpha),
              {},
              std::move(term));
    if (!broken.empty() && !parameters.is_in_motion)
      ground_loose_parts(parts);
  }

  template <int dim>
  void
  CoupledProblem<dim>::ground_loose_parts(
    const std::vector<unsigned int> &parts,
    const std::vector<bool>         &more)
  {
    const auto size = Base::label_sizes(parts);
    if (size.size() == 1 && more.empty())
      return;
    const unsigned int largest =
      std::max_element(size.begin(), size.end()) - size.begin();
    std::vector<unsigned int> loose;
    for (unsigned int n = 0; n < parts.size(); ++n)
      // A part of one node has no stiffness, not even if none is larger.
      if (parts[n] != largest || size[largest] == 1 ||
          (!more.empty() && more[n]))
        loose.push_back(n);
    ground(loose);
  }

  template <int dim>
  void
  CoupledProblem<dim>::ground(const std::vector<unsigned int> &nodes)
  {
    // 1e-11 of the diagonal of the stiffness (numerics-damage.md, section 5).
    constexpr double share = 1e-11;
    const auto      &nodal = mesh.nodal();
    const double     spacing =
      std::accumulate(nodal.spacing.begin(), nodal.spacing.end(), 0.) /
      nodal.n_nodes();
    std::vector<unsigned int> owned;
    for (const unsigned int n : nodes)
      if (nodal.owns_node(n))
        owned.push_back(partition().local(n));
    std::vector<double> stiffness(
      owned.size(),
      share * elastic_constants(*materials.laws[0]).along[0].youngs_modulus *
        std::pow(spacing, dim - 2));
    contributions.push_back(
      std::make_unique<Fem::NodalSprings<dim>>("springs of loose parts",
                                               std::move(owned),
                                               std::move(stiffness)));
  }

  template <int dim>
  void
  CoupledProblem<dim>::make_bonds(const Mesh::RegionMap      &region,
                                  const CouplingParameters   &parameters,
                                  const Bonds::CrackSet<dim> &cracks,
                                  const Bonds::BrokenBonds   &broken,
                                  const Progress             &progress)
  {
    const auto &nodal      = mesh.nodal();
    const bool  forces     = parameters.scheme == Scheme::force_blending;
    const bool  consistent = parameters.scheme == Scheme::consistent;
    const bool  finite_strain =
      std::any_of(materials.laws.begin(),
                  materials.laws.end(),
                  [](const auto &law) { return !law->is_linear(); });
    BondCoupling<dim> coupling;
    Base::collectively(mesh.communicator(), [&]() {
      if (parts_to_share.intact)
        coupling = parts_to_share.intact->coupling;
      else
        coupling = make_bond_coupling(nodal,
                                      forces ? extended_weight(nodal, region)
                                             : region.alpha,
                                      region.horizon,
                                      materials.bond_constants,
                                      !consistent      ? ElementShare::none
                                      : !finite_strain ? ElementShare::tensors
                                                       : ElementShare::springs,
                                      progress,
                                      cracks,
                                      parameters.crack_rule);
      if (!parts_to_share.intact && parameters.bonds_may_break)
        {
          IntactBonds<dim> found;
          found.coupling = coupling;
          parts_to_share.intact =
            std::make_shared<const IntactBonds<dim>>(found);
        }
      if (!broken.empty())
        break_bonds(nodal, broken, parameters.is_in_motion, coupling);
    });
    bond_set             = coupling.bonds;
    cracked              = coupling.cracked;
    local_counts.bonds   = coupling.bonds.nodes.size();
    local_counts.dropped = coupling.bonds.n_dropped;
    for (unsigned int n = nodal.owned_begin; n < nodal.owned_end; ++n)
      local_counts.particles += region.alpha[n] > 0. ? 1 : 0;

    std::vector<unsigned int> needed;
    add_bond_nodes(coupling.bonds, needed);
    add_part_nodes(coupling.parts, needed);
    make_partition(needed);
    std::unique_ptr<Term> bonds;
    if (finite_strain)
      bonds =
        std::make_unique<FiniteBondTerm<dim>>(coupling.bonds, partition());
    else
      bonds = std::make_unique<BondTerm<dim>>(coupling.bonds, partition());
    of_particles.push_back(bonds.get());
    add_terms(region,
              parameters.scheme,
              consistent ? std::vector<double>() : complement(region.alpha),
              coupling.replaced,
              std::move(bonds));
    if (consistent && finite_strain)
      contributions.push_back(
        std::make_unique<SegmentPieceTerm<dim>>(nodal,
                                                partition(),
                                                std::move(coupling.springs)));
    else if (consistent)
      contributions.push_back(
        std::make_unique<SegmentTerm<dim>>(nodal, partition(), coupling));
    if (!coupling.replaced.empty())
      contributions.push_back(
        std::make_unique<CellPartTerm<dim>>(partition(),
                                            std::move(coupling.parts),
                                            std::move(coupling.part_tensors)));
    if (broken.empty() || parameters.is_in_motion)
      return;
    std::vector<bool> lost(nodal.n_nodes(), false);
    for (const auto &bond : broken.list())
      if (bond.teeth == broken.n_teeth())
        lost[bond.nodes[0]] = lost[bond.nodes[1]] = true;
    ground_loose_parts(parts(region), lost);
  }

  template <int dim>
  void
  CoupledProblem<dim>::make_partition(std::vector<unsigned int> needed)
  {
    Fem::add_cell_nodes(mesh.nodal(), needed);
    needed.insert(needed.end(), more_nodes.begin(), more_nodes.end());
    const bool fits =
      parts_to_share.partition && parts_to_share.partition->sees(needed);
    if (dealii::Utilities::MPI::min(fits ? 1 : 0, mesh.communicator()) == 1)
      return;
    parts_to_share.partition =
      std::make_shared<const Fem::NodePartition<dim>>(mesh.nodal(),
                                                      needed,
                                                      mesh.communicator());
    parts_to_share.all_cells.reset();
    parts_to_share.elements.reset();
  }

  template <int dim>
  void
  CoupledProblem<dim>::make_elements(std::vector<double> weight,
                                     std::vector<bool>   skip)
  {
    auto &known = parts_to_share;
    // Terms that are not linear remember stresses.
    const bool fits = known.elements && known.elements->is_linear() &&
                      known.element_weight == weight && known.replaced == skip;
    if (dealii::Utilities::MPI::min(fits ? 1 : 0, mesh.communicator()) == 1)
      return;
    known.elements = std::make_shared<Fem::ElasticCells<dim>>(mesh.nodal(),
                                                              partition(),
                                                              materials.laws,
                                                              weight,
                                                              skip);
    known.element_weight = std::move(weight);
    known.replaced       = std::move(skip);
  }

  template <int dim>
  void
  CoupledProblem<dim>::add_terms(const Mesh::RegionMap &region,
                                 const Scheme           scheme,
                                 std::vector<double>    element_weight,
                                 std::vector<bool>      replaced,
                                 std::unique_ptr<Term>  particles)
  {
    const bool forces = scheme == Scheme::force_blending;
    if (forces)
      {
        element_weight.clear();
        replaced = core_cells(mesh.nodal(), region.alpha);
        // Weights of equations are theirs alone.
        parts_to_share.elements.reset();
      }
    make_elements(std::move(element_weight), std::move(replaced));
    const auto &elements = parts_to_share.elements;
    if (forces)
      {
        elements->set_row_weights(
          local_weights(partition(), region.alpha, true));
        particles->set_row_weights(
          local_weights(partition(), region.alpha, false));
      }
    if (dealii::Utilities::MPI::max(elements->n_blocks(), mesh.communicator()) >
        0)
      contributions.push_back(elements);
    contributions.push_back(std::move(particles));
  }

  template Peridynamics::InfluenceFunction
  influence_function_of<2>(const CouplingParameters &,
                           const Mesh::NodalMesh<2> &,
                           const Mesh::RegionMap &);
  template Peridynamics::InfluenceFunction
  influence_function_of<3>(const CouplingParameters &,
                           const Mesh::NodalMesh<3> &,
                           const Mesh::RegionMap &);

#define PERIMORPH_INSTANTIATE(dim)                          \
  template FamilyParameters family_parameters<dim>(         \
    const CouplingParameters &,                             \
    const Mesh::NodalMesh<dim> &,                           \
    const Mesh::RegionMap &,                                \
    const typename Fem::ElasticCells<dim>::MaterialList &); \
  template CoupledProblem<dim>::CoupledProblem(             \
    const Mesh::DistributedMesh<dim> &,                     \
    const Mesh::RegionMap &,                                \
    const BodyMaterials<dim> &,                             \
    const CouplingParameters &,                             \
    const Progress &,                                       \
    std::vector<unsigned int>,                              \
    const Bonds::CrackSet<dim> &,                           \
    const Bonds::BrokenBonds &,                             \
    SharedParts<dim>,                                       \
    const std::vector<unsigned int> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
