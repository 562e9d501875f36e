#include <perimorph/base/collective.h>
#include <perimorph/base/point_cloud.h>
#include <perimorph/coupling/bond_term.h>
#include <perimorph/coupling/broken_bond_set.h>
#include <perimorph/coupling/broken_families.h>
#include <perimorph/coupling/cell_part_term.h>
#include <perimorph/coupling/correspondence_term.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/coupling/grounding_term.h>
#include <perimorph/coupling/segment_piece_term.h>
#include <perimorph/coupling/virial_field.h>

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

    template <int dim>
    ElasticConstants
    constants_at_rest(const Materials::Material<dim> &law)
    {
      const auto   A      = law.tangent(dealii::Tensor<2, dim>());
      const double lambda = A[0][0][1][1];
      const double mu     = A[0][1][0][1];
      if (dim == 2)
        return {mu,
                4. * mu * (lambda + mu) / (lambda + 2. * mu),
                lambda / (lambda + 2. * mu)};
      return {mu,
              mu * (3. * lambda + 2. * mu) / (lambda + mu),
              0.5 * lambda / (lambda + mu)};
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
  CoupledProblem<dim>::CoupledProblem(
    const Mesh::DistributedMesh<dim>       &mesh,
    const Mesh::RegionMap                  &region,
    const BodyMaterials<dim>               &materials,
    const CouplingParameters               &parameters,
    const Progress                         &progress,
    std::vector<unsigned int>               more_nodes,
    const Bonds::CrackSet<dim>             &cracks,
    const Bonds::BrokenBonds               &broken,
    std::shared_ptr<const IntactBonds<dim>> intact)
    : mesh(mesh)
    , materials(materials)
    , more_nodes(std::move(more_nodes))
    , intact_bonds(std::move(intact))
  {
    if (region.n_core + region.n_blending == 0)
      {
        make_partition({});
        contributions.push_back(
          std::make_unique<Fem::ElasticCells<dim>>(mesh.nodal(),
                                                   *node_partition,
                                                   materials.laws,
                                                   std::vector<double>()));
      }
    else if (parameters.model == Model::correspondence)
      make_correspondence(region, parameters, cracks, broken, progress);
    else
      make_bonds(region, parameters, cracks, broken, progress);

    all_cells = std::make_unique<Fem::ElasticCells<dim>>(mesh.nodal(),
                                                         *node_partition,
                                                         materials.laws,
                                                         std::vector<double>());
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
    const auto      &nodal  = mesh.nodal();
    const bool       forces = parameters.scheme == Scheme::force_blending;
    FamilyParameters options{
      influence_function_of(parameters, nodal, region),
      parameters.gamma,
      parameters.scale.value_or(dim == 2 ? StabilizationScale::bending
                                         : StabilizationScale::shear_modulus),
      parameters.crack_rule,
      {},
      progress};
    for (const auto &law : materials.laws)
      options.constants.push_back(constants_at_rest(*law));

    IntactBonds<dim> found;
    const bool       is_known = intact_bonds != nullptr;
    auto            &set      = found.families;
    Base::collectively(mesh.communicator(), [&]() {
      if (is_known)
        set = intact_bonds->families;
      else
        set = parameters.scheme == Scheme::consistent
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
      if (!is_known && parameters.bonds_may_break)
        intact_bonds = std::make_shared<const IntactBonds<dim>>(found);
      if (!broken.empty())
        set = break_bonds(nodal,
                          region.horizon,
                          options,
                          broken,
                          set,
                          local_counts.isolated);
    });
    cracked = is_known ? intact_bonds->cracked : found.cracked;
    std::vector<unsigned int> parts;
    if (!broken.empty())
      parts = find_parts(nodal, region.alpha, set, mesh.communicator());
    local_counts.particles = set.n_particles();
    local_counts.bonds     = set.n_bonds();

    std::vector<unsigned int> needed;
    add_family_nodes(set, needed);
    make_partition(needed);
    auto term = std::make_unique<CorrespondenceTerm<dim>>(std::move(set),
                                                          *node_partition,
                                                          materials.laws);
    families.push_back(term.get());
    add_terms(region,
              parameters.scheme,
              complement(region.alpha),
              {},
              std::move(term));
    if (!broken.empty())
      ground_loose_parts(parts);
  }

  template <int dim>
  void
  CoupledProblem<dim>::ground_loose_parts(
    const std::vector<unsigned int> &parts,
    const std::vector<bool>         &more)
  {
    std::vector<unsigned int> size;
    for (const unsigned int part : parts)
      {
        size.resize(std::max<std::size_t>(size.size(), part + 1), 0);
        ++size[part];
      }
    if (size.size() == 1 && more.empty())
      return;
    const unsigned int largest =
      std::max_element(size.begin(), size.end()) - size.begin();
    // 1e-11 of the diagonal of the stiffness (numerics-damage.md, section 5).
    double                    mean_spacing = 0.;
    std::vector<unsigned int> loose;
    for (unsigned int n = 0; n < parts.size(); ++n)
      {
        mean_spacing += mesh.nodal().spacing[n] / parts.size();
        // A part of one node has no stiffness, not even if none is larger.
        if ((parts[n] != largest || size[largest] == 1 ||
             (!more.empty() && more[n])) &&
            mesh.nodal().owns_node(n))
          loose.push_back(node_partition->local(n));
      }
    contributions.push_back(std::make_unique<GroundingTerm<dim>>(
      std::move(loose),
      1e-11 * constants_at_rest(*materials.laws[0]).youngs_modulus *
        std::pow(mean_spacing, dim - 2)));
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
      if (intact_bonds)
        coupling = intact_bonds->coupling;
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
      if (!intact_bonds && parameters.bonds_may_break)
        {
          IntactBonds<dim> found;
          found.coupling = coupling;
          intact_bonds   = std::make_shared<const IntactBonds<dim>>(found);
        }
      if (!broken.empty())
        break_bonds(nodal, broken, coupling);
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
        std::make_unique<FiniteBondTerm<dim>>(coupling.bonds, *node_partition);
    else
      bonds = std::make_unique<BondTerm<dim>>(coupling.bonds, *node_partition);
    add_terms(region,
              parameters.scheme,
              consistent ? std::vector<double>() : complement(region.alpha),
              coupling.replaced,
              std::move(bonds));
    if (consistent && finite_strain)
      contributions.push_back(
        std::make_unique<SegmentPieceTerm<dim>>(nodal,
                                                *node_partition,
                                                std::move(coupling.springs)));
    else if (consistent)
      contributions.push_back(
        std::make_unique<SegmentTerm<dim>>(nodal, *node_partition, coupling));
    if (!coupling.replaced.empty())
      contributions.push_back(
        std::make_unique<CellPartTerm<dim>>(*node_partition,
                                            std::move(coupling.parts),
                                            std::move(coupling.part_tensors)));
    if (broken.empty())
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
    node_partition =
      std::make_unique<Fem::NodePartition<dim>>(mesh.nodal(),
                                                needed,
                                                mesh.communicator());
  }

  template <int dim>
  void
  CoupledProblem<dim>::add_terms(const Mesh::RegionMap     &region,
                                 const Scheme               scheme,
                                 const std::vector<double> &element_weight,
                                 const std::vector<bool>   &replaced,
                                 std::unique_ptr<Term>      particles)
  {
    const bool forces   = scheme == Scheme::force_blending;
    auto       elements = std::make_unique<Fem::ElasticCells<dim>>(
      mesh.nodal(),
      *node_partition,
      materials.laws,
      forces ? std::vector<double>() : element_weight,
      forces ? core_cells(mesh.nodal(), region.alpha) : replaced);
    if (forces)
      {
        elements->set_row_weights(
          local_weights(*node_partition, region.alpha, true));
        particles->set_row_weights(
          local_weights(*node_partition, region.alpha, false));
      }
    if (dealii::Utilities::MPI::max(elements->n_blocks(), mesh.communicator()) >
        0)
      contributions.push_back(std::move(elements));
    contributions.push_back(std::move(particles));
  }

  template <int dim>
  std::vector<const Fem::Contribution<dim> *>
  CoupledProblem<dim>::terms() const
  {
    std::vector<const Term *> list;
    for (const auto &term : contributions)
      list.push_back(term.get());
    return list;
  }

  template <int dim>
  std::vector<const Fem::Contribution<dim> *>
  CoupledProblem<dim>::family_terms() const
  {
    return families;
  }

  template <int dim>
  std::vector<const Fem::Contribution<dim> *>
  CoupledProblem<dim>::assembled_terms() const
  {
    std::vector<const Term *> list;
    for (const auto &term : contributions)
      if (std::find(families.begin(), families.end(), term.get()) ==
          families.end())
        list.push_back(term.get());
    return list;
  }

  template <int dim>
  bool
  CoupledProblem<dim>::is_linear() const
  {
    return std::all_of(contributions.begin(),
                       contributions.end(),
                       [](const auto &term) { return term->is_linear(); });
  }

  template <int dim>
  bool
  CoupledProblem<dim>::is_symmetric() const
  {
    return std::all_of(contributions.begin(),
                       contributions.end(),
                       [](const auto &term) { return term->is_symmetric(); });
  }

  template <int dim>
  void
  CoupledProblem<dim>::internal_forces(const Vector &displacement,
                                       Vector       &forces) const
  {
    forces.zero_out_ghost_values();
    forces = 0.;
    Base::collectively(mesh.communicator(), [&]() {
      for (const auto &term : contributions)
        term->add_residual(displacement, forces);
    });
    forces.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void
  CoupledProblem<dim>::extrapolate_stress(const Vector &displacement,
                                          const Vector &step,
                                          const bool    of_full_elements) const
  {
    Base::collectively(mesh.communicator(), [&]() {
      for (const auto &term : contributions)
        term->extrapolate_stress(displacement, step);
      if (of_full_elements)
        all_cells->extrapolate_stress(displacement, step);
    });
  }

  template <int dim>
  void
  CoupledProblem<dim>::forget_stress() const
  {
    for (const auto &term : contributions)
      term->forget_stress();
    all_cells->forget_stress();
  }

  template <int dim>
  double
  CoupledProblem<dim>::strain_energy(const Vector &displacement) const
  {
    if (!is_symmetric())
      {
        // Blended equations have no energy; the work of the forces stands in.
        Vector forces;
        partition().initialize(forces);
        internal_forces(displacement, forces);
        return 0.5 * (forces * displacement);
      }
    double energy = 0.;
    for (const auto &term : contributions)
      energy += term->energy(displacement);
    return dealii::Utilities::MPI::sum(energy, mesh.communicator());
  }

  template <int dim>
  Peridynamics::FamilySet<dim>
  CoupledProblem<dim>::correspondence_families() const
  {
    for (const auto &term : contributions)
      if (const auto families =
            dynamic_cast<const CorrespondenceTerm<dim> *>(term.get()))
        return families->global_families(*node_partition);
    return {};
  }

  template <int dim>
  std::vector<unsigned int>
  CoupledProblem<dim>::parts(const Mesh::RegionMap &region) const
  {
    return bond_set.nodes.empty() && !families.empty()
             ? find_parts(mesh.nodal(),
                          region.alpha,
                          correspondence_families(),
                          mesh.communicator())
             : find_parts(mesh.nodal(),
                          region.alpha,
                          bond_set.nodes,
                          mesh.communicator());
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  CoupledProblem<dim>::virial_stress(const Vector          &displacement,
                                     const Mesh::RegionMap &region) const
  {
    for (const auto &term : contributions)
      if (const auto bonds = dynamic_cast<const BondForces<dim> *>(term.get()))
        return nodal_virial_stress(
          mesh.nodal(),
          region,
          bonds->pair_forces(displacement, *node_partition),
          mesh.communicator());
    return {};
  }

  template <int dim>
  double
  CoupledProblem<dim>::ghost_force(
    const std::function<bool(unsigned int)> &excluded) const
  {
    const auto &nodal = mesh.nodal();
    Vector      displacement, forces, reference;
    partition().initialize(displacement);
    partition().initialize(forces);
    partition().initialize(reference);
    double     worst    = cracked.residual;
    const auto at_crack = [&](const unsigned int node) {
      return std::binary_search(cracked.nodes.begin(),
                                cracked.nodes.end(),
                                node);
    };
    // Finite strain: an amplitude that every law bears.
    const double amplitude = is_linear() ? 1. : 0.1;
    for (int a = 0; a < dim; ++a)
      for (int b = a; b < dim; ++b)
        {
          dealii::Tensor<2, dim> strain;
          strain[a][b] = strain[b][a] = amplitude * (a == b ? 1. : 0.5);
          displacement.zero_out_ghost_values();
          for (unsigned int n = 0; n < partition().n_owned(); ++n)
            {
              const auto value =
                strain * dealii::Tensor<1, dim>(partition().position(n));
              for (int d = 0; d < dim; ++d)
                displacement.local_element(dim * n + d) = value[d];
            }
          displacement.update_ghost_values();
          internal_forces(displacement, forces);
          reference = 0.;
          all_cells->add_residual(displacement, reference);
          reference.compress(dealii::VectorOperation::add);

          // Relative to the stiffest material at the node.
          std::vector<double> stress;
          for (const auto &law : materials.laws)
            stress.push_back(law->first_piola_kirchhoff(strain).norm());
          for (unsigned int n = 0; n < partition().n_owned(); ++n)
            {
              const unsigned int node  = partition().global(n);
              double             scale = 0.;
              for (const unsigned int c : nodal.node_cells.row(node))
                scale = std::max(scale, stress[nodal.cell_material[c]]);
              scale *= std::pow(nodal.spacing[node], dim - 1);
              for (int d = 0; d < dim; ++d)
                if (!excluded(dim * node + d) && !at_crack(node))
                  worst =
                    std::max(worst,
                             std::abs(forces.local_element(dim * n + d) -
                                      reference.local_element(dim * n + d)) /
                               scale);
            }
        }
    return dealii::Utilities::MPI::max(worst, mesh.communicator());
  }

  template <int dim>
  typename CoupledProblem<dim>::Counts
  CoupledProblem<dim>::counts() const
  {
    Counts     total;
    const auto sum = [&](const std::size_t value) {
      return static_cast<std::size_t>(
        dealii::Utilities::MPI::sum(static_cast<unsigned long long>(value),
                                    mesh.communicator()));
    };
    total.particles    = sum(local_counts.particles);
    total.bonds        = sum(local_counts.bonds);
    total.dropped      = sum(local_counts.dropped);
    total.active_cells = sum(local_counts.active_cells);
    total.isolated     = sum(local_counts.isolated);
    return total;
  }

  template Peridynamics::InfluenceFunction
  influence_function_of<2>(const CouplingParameters &,
                           const Mesh::NodalMesh<2> &,
                           const Mesh::RegionMap &);
  template Peridynamics::InfluenceFunction
  influence_function_of<3>(const CouplingParameters &,
                           const Mesh::NodalMesh<3> &,
                           const Mesh::RegionMap &);
  template class CoupledProblem<2>;
  template class CoupledProblem<3>;
} // namespace Perimorph::Coupling
