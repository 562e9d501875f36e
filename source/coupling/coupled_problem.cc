#include <perimorph/base/collective.h>
#include <perimorph/coupling/bond_term.h>
#include <perimorph/coupling/broken_families.h>
#include <perimorph/coupling/correspondence_term.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/coupling/virial_field.h>
#include <perimorph/fem/nodal_values.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Coupling
{
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
  CoupledProblem<dim>::particle_terms() const
  {
    return of_particles;
  }

  template <int dim>
  std::vector<const Fem::Contribution<dim> *>
  CoupledProblem<dim>::assembled_terms() const
  {
    std::vector<const Term *> list;
    for (const auto &term : contributions)
      if (std::find(of_particles.begin(), of_particles.end(), term.get()) ==
          of_particles.end())
        list.push_back(term.get());
    return list;
  }

  template <int dim>
  std::vector<const Fem::Contribution<dim> *>
  CoupledProblem<dim>::preconditioner_terms() const
  {
    std::vector<const Term *> list = {preconditioner.get()};
    if (inertia)
      list.push_back(inertia.get());
    return list;
  }

  template <int dim>
  std::shared_ptr<const Fem::Contribution<dim>>
  CoupledProblem<dim>::elements() const
  {
    for (const auto &term : contributions)
      if (term == parts_to_share.elements)
        return term;
    return nullptr;
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
  CoupledProblem<dim>::keep_cell_stiffness()
  {
    if (cell_stiffness)
      return;
    std::vector<const Term *> cells;
    for (const auto &term : contributions)
      if (Fem::CellStiffness<dim>::can_hold(*term))
        cells.push_back(term.get());
    Vector at_rest;
    partition().initialize(at_rest);
    cell_stiffness = std::make_unique<Fem::CellStiffness<dim>>(cells, at_rest);
  }

  template <int dim>
  void
  CoupledProblem<dim>::remove_cells(const std::vector<bool> &goes)
  {
    if (auto *cells = find_term<Fem::ElasticCells<dim>>())
      cells->remove(goes);
    if (auto *segments = find_term<SegmentTerm<dim>>())
      segments->remove(goes);
    if (cell_stiffness)
      cell_stiffness->remove(goes);
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
        if (!is_kept(*term))
          term->add_residual(displacement, forces);
      if (cell_stiffness)
        cell_stiffness->add_product(displacement, forces);
    });
    forces.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void
  CoupledProblem<dim>::add_tangent_product(const Vector &displacement,
                                           const Vector &direction,
                                           Vector       &product) const
  {
    for (const auto &term : contributions)
      if (!is_kept(*term))
        term->add_tangent_product(displacement, direction, product);
    if (cell_stiffness)
      cell_stiffness->add_product(direction, product);
  }

  template <int dim>
  void
  CoupledProblem<dim>::extrapolate_stress(const Vector &displacement,
                                          const Vector &step,
                                          const bool    of_preconditioner) const
  {
    Base::collectively(mesh.communicator(), [&]() {
      for (const auto &term : contributions)
        term->extrapolate_stress(displacement, step);
      if (of_preconditioner)
        preconditioner->extrapolate_stress(displacement, step);
    });
  }

  template <int dim>
  void
  CoupledProblem<dim>::forget_stress() const
  {
    for (const auto &term : contributions)
      term->forget_stress();
    preconditioner->forget_stress();
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
      if (term != inertia)
        energy += term->energy(displacement);
    return dealii::Utilities::MPI::sum(energy, mesh.communicator());
  }

  template <int dim>
  Peridynamics::FamilySet<dim>
  CoupledProblem<dim>::correspondence_families() const
  {
    if (const auto *families = find_term<CorrespondenceTerm<dim>>())
      return families->global_families(partition());
    return {};
  }

  template <int dim>
  std::vector<unsigned int>
  CoupledProblem<dim>::parts(const Mesh::RegionMap &region) const
  {
    return families_exist ? find_parts(mesh.nodal(),
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
    if (const auto *bonds = find_term<BondForces<dim>>())
      return nodal_virial_stress(mesh.nodal(),
                                 region,
                                 bonds->pair_forces(displacement, partition()),
                                 mesh.communicator());
    return {};
  }

  template <int dim>
  double
  CoupledProblem<dim>::ghost_force(
    const std::function<bool(unsigned int)> &excluded) const
  {
    double worst = cracked.residual;
    if (parts_to_share.all_cells == parts_to_share.elements)
      return worst; // elements alone are their own reference

    const auto &nodal = mesh.nodal();
    Vector      displacement, forces, reference;
    partition().initialize(displacement);
    partition().initialize(forces);
    partition().initialize(reference);
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
          parts_to_share.all_cells->add_residual(displacement, reference);
          reference.compress(dealii::VectorOperation::add);
          Fem::condense_hanging(nodal.hanging, partition(), forces);
          Fem::condense_hanging(nodal.hanging, partition(), reference);

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

  template class CoupledProblem<2>;
  template class CoupledProblem<3>;
} // namespace Perimorph::Coupling
