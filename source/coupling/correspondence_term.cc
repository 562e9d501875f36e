#include <perimorph/base/lanes.h>
#include <perimorph/coupling/correspondence_term.h>
#include <perimorph/materials/extrapolated_stress.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace Perimorph::Coupling
{
  template <int dim>
  CorrespondenceTerm<dim>::CorrespondenceTerm(
    Peridynamics::FamilySet<dim>   families_,
    const Fem::NodePartition<dim> &partition,
    const MaterialList            &materials)
    : families(std::move(families_))
    , materials(materials)
  {
    const std::size_t n_bonds = families.n_bonds();
    gradient_weight =
      Peridynamics::by_components(families.gradient_weight.data(), n_bonds);
    families.gradient_weight = {};
    n_gradient_bonds.resize(families.n_particles());
    for (unsigned int p = 0; p < families.n_particles(); ++p)
      sort_bonds(p);
    for (auto &node : families.node)
      node = partition.local(node);
    for (auto &node : families.neighbor)
      node = partition.local(node);
    xi.resize(dim * n_bonds);
    for (std::size_t p = 0; p < families.n_particles(); ++p)
      {
        position.push_back(partition.position(families.node[p]));
        largest_family =
          std::max<unsigned int>(largest_family,
                                 families.offsets[p + 1] - families.offsets[p]);
        find_bond_vectors(p, partition);
      }
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::find_bond_vectors(
    const unsigned int             particle,
    const Fem::NodePartition<dim> &partition)
  {
    for (std::size_t b = families.offsets[particle];
         b < families.offsets[particle + 1];
         ++b)
      for (int d = 0; d < dim; ++d)
        xi[d * families.n_bonds() + b] =
          partition.position(families.neighbor[b])[d] - position[particle][d];
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::sort_bonds(const unsigned int particle)
  {
    const std::size_t        first = families.offsets[particle];
    std::vector<std::size_t> order(families.offsets[particle + 1] - first);
    std::iota(order.begin(), order.end(), 0);
    const auto has_gradient = [&](const std::size_t k) {
      for (int d = 0; d < dim; ++d)
        if (gradient_weight[d * families.n_bonds() + first + k] != 0.)
          return true;
      return false;
    };
    n_gradient_bonds[particle] =
      std::count_if(order.begin(), order.end(), has_gradient);
    // Gradients over the horizon have nothing to move.
    if (std::is_partitioned(order.begin(), order.end(), has_gradient))
      return;
    std::stable_partition(order.begin(), order.end(), has_gradient);
    const auto reorder = [&](auto begin) {
      const auto row = std::vector(begin, begin + order.size());
      for (std::size_t k = 0; k < order.size(); ++k)
        begin[k] = row[order[k]];
    };
    reorder(families.neighbor.begin() + first);
    reorder(families.bond_weight.begin() + first);
    for (int d = 0; d < dim; ++d)
      reorder(gradient_weight.begin() + d * families.n_bonds() + first);
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::replace_family(
    const unsigned int                  particle,
    const Peridynamics::FamilySet<dim> &remains,
    const bool                          is_isolated,
    const Fem::NodePartition<dim>      &partition)
  {
    const std::size_t last = remains.n_particles() - 1;
    const std::size_t from = is_isolated ? 0 : remains.offsets[last];
    const std::size_t n    = is_isolated ? 0 : remains.offsets[last + 1] - from;
    const std::size_t first   = families.offsets[particle];
    families.weight[particle] = is_isolated ? 0. : remains.weight[last];
    if (!is_isolated)
      families.stabilization[particle] = remains.stabilization[last];
    // Bonds to itself without weights fill the places of the broken ones.
    for (std::size_t b = first; b < families.offsets[particle + 1]; ++b)
      {
        const bool is_left      = b - first < n;
        const auto k            = from + (b - first);
        families.neighbor[b]    = is_left ? partition.local(remains.neighbor[k])
                                          : families.node[particle];
        families.bond_weight[b] = is_left ? remains.bond_weight[k] : 0.;
        for (int d = 0; d < dim; ++d)
          gradient_weight[d * families.n_bonds() + b] =
            is_left ? remains.gradient_weight[k][d] : 0.;
      }
    sort_bonds(particle);
    find_bond_vectors(particle, partition);
  }

  template <int dim>
  Peridynamics::FamilySet<dim>
  CorrespondenceTerm<dim>::global_families(
    const Fem::NodePartition<dim> &partition) const
  {
    auto result = families;
    for (auto *list : {&result.node, &result.neighbor})
      for (unsigned int &node : *list)
        node = partition.global(node);
    result.gradient_weight.resize(families.n_bonds());
    for (std::size_t b = 0; b < families.n_bonds(); ++b)
      for (int d = 0; d < dim; ++d)
        result.gradient_weight[b][d] =
          gradient_weight[d * families.n_bonds() + b];
    return result;
  }

  template <int dim>
  std::string
  CorrespondenceTerm<dim>::name() const
  {
    return "correspondence families";
  }

  template <int dim>
  bool
  CorrespondenceTerm<dim>::is_linear() const
  {
    for (const auto &material : materials)
      if (!material->is_linear())
        return false;
    return true;
  }

  template <int dim>
  Peridynamics::Family<dim>
  CorrespondenceTerm<dim>::family(const unsigned int particle) const
  {
    const std::size_t first = families.offsets[particle];
    return {static_cast<unsigned int>(families.offsets[particle + 1] - first),
            n_gradient_bonds[particle],
            families.n_bonds(),
            xi.data() + first,
            gradient_weight.data() + first,
            families.bond_weight.data() + first,
            families.stabilization[particle]};
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::relative_displacements(const unsigned int particle,
                                                  const double      *vector,
                                                  double            *eta) const
  {
    const auto        own   = this->value_at(vector, families.node[particle]);
    const std::size_t first = families.offsets[particle];
    const std::size_t n     = families.offsets[particle + 1] - first;
    for (std::size_t b = 0; b < n; ++b)
      {
        const double *value = vector + dim * families.neighbor[first + b];
        for (int d = 0; d < dim; ++d)
          eta[d * n + b] = value[d] - own[d];
      }
  }

  template <int dim>
  template <typename Action>
  void
  CorrespondenceTerm<dim>::for_families(const Vector &vector,
                                        const Action &action) const
  {
    std::vector<double> eta(dim * largest_family), next_eta(eta);
    if (families.n_particles() > 0)
      relative_displacements(0, vector.begin(), next_eta.data());
    for (unsigned int p = 0; p < families.n_particles(); ++p)
      {
        eta.swap(next_eta);
        if (p + 1 < families.n_particles())
          relative_displacements(p + 1, vector.begin(), next_eta.data());
        action(p, eta.data());
      }
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::scatter(const unsigned int   particle,
                                   std::vector<double> &forces,
                                   double              *vector) const
  {
    const double           weight = families.weight[particle];
    const std::size_t      first  = families.offsets[particle];
    const unsigned int     n      = families.offsets[particle + 1] - first;
    dealii::Tensor<1, dim> sum;
    for (int d = 0; d < dim; ++d)
      {
        double          *row      = forces.data() + d * n;
        Base::EightLanes of_eight = {};
        Base::FourLanes  of_four  = {};
        Base::for_lanes(
          n,
          [&](const unsigned int b, const auto zero) DEAL_II_ALWAYS_INLINE {
            using Lanes       = std::decay_t<decltype(zero)>;
            const Lanes force = weight * Base::load_lanes<Lanes>(row + b);
            Base::store_lanes(force, row + b);
            if constexpr (std::is_same_v<Lanes, Base::EightLanes>)
              of_eight += force;
            else if constexpr (std::is_same_v<Lanes, Base::FourLanes>)
              of_four += force;
            else
              sum[d] += force;
          });
        sum[d] += Base::sum_of_lanes(of_four + Base::fold_lanes(of_eight));
      }
    for (unsigned int b = 0; b < n; ++b)
      {
        const unsigned int neighbor   = families.neighbor[first + b];
        const double       row_weight = this->row_weight(neighbor);
        for (int d = 0; d < dim; ++d)
          vector[dim * neighbor + d] += row_weight * forces[d * n + b];
      }
    this->add_at(vector, families.node[particle], -sum);
  }

  template <int dim>
  double
  CorrespondenceTerm<dim>::energy(const Vector &displacement) const
  {
    std::vector<double> eta(dim * largest_family);
    double              sum = 0.;
    for (unsigned int p = 0; p < families.n_particles(); ++p)
      {
        relative_displacements(p, displacement.begin(), eta.data());
        const auto one = family(p);
        const auto H   = displacement_gradient(one, eta.data());
        sum += families.weight[p] *
               (materials[families.material[p]]->energy_density(H) +
                stabilization_energy(one, eta.data(), H));
      }
    return sum;
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::add_residual(const Vector &displacement,
                                        Vector       &residual) const
  {
    std::vector<double> forces(dim * largest_family);
    for_families(displacement, [&](const unsigned int p, const double *eta) {
      const auto             one = family(p);
      const auto             H   = displacement_gradient(one, eta);
      dealii::Tensor<2, dim> P;
      this->at_place(position[p], [&]() {
        P = materials[families.material[p]]->first_piola_kirchhoff(H);
      });
      family_forces(one, eta, H, P, forces.data());
      scatter(p, forces, residual.begin());
    });
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::add_tangent_product(const Vector &displacement,
                                               const Vector &direction,
                                               Vector       &product) const
  {
    const bool          linear = is_linear();
    std::vector<double> of_state(linear ? 0 : dim * largest_family);
    std::vector<double> forces(dim * largest_family);
    std::vector<dealii::Tensor<4, dim>> constant_tangent;
    if (linear)
      for (const auto &material : materials)
        constant_tangent.push_back(material->tangent(dealii::Tensor<2, dim>()));

    for_families(direction, [&](const unsigned int p, const double *eta) {
      const auto one      = family(p);
      const auto material = families.material[p];

      dealii::Tensor<4, dim> A;
      if (linear)
        A = constant_tangent[material];
      else
        {
          relative_displacements(p, displacement.begin(), of_state.data());
          A = particle_tangent(p, displacement_gradient(one, of_state.data()));
        }
      const auto dH = displacement_gradient(one, eta);
      const auto dP = dealii::double_contract<2, 0, 3, 1>(A, dH);
      family_forces(one, eta, dH, dP, forces.data());
      scatter(p, forces, product.begin());
    });
  }

  template <int dim>
  unsigned int
  CorrespondenceTerm<dim>::n_blocks() const
  {
    return families.n_particles();
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::block_nodes(const unsigned int         block,
                                       std::vector<unsigned int> &nodes) const
  {
    nodes.assign(1, families.node[block]);
    nodes.insert(nodes.end(),
                 families.neighbor.begin() + families.offsets[block],
                 families.neighbor.begin() + families.offsets[block + 1]);
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::block_tangent(
    const unsigned int          block,
    const Vector               &displacement,
    dealii::FullMatrix<double> &matrix) const
  {
    std::vector<double> eta(dim * largest_family);
    relative_displacements(block, displacement.begin(), eta.data());
    const auto one = family(block);
    const auto H   = displacement_gradient(one, eta.data());
    family_tangent(one, particle_tangent(block, H), matrix);
    matrix *= families.weight[block];
  }

  template <int dim>
  dealii::Tensor<4, dim>
  CorrespondenceTerm<dim>::particle_tangent(
    const unsigned int            particle,
    const dealii::Tensor<2, dim> &H) const
  {
    const auto &law = *materials[families.material[particle]];
    return extrapolated.empty()
             ? law.tangent(H)
             : Materials::tangent_with_stress(law, H, extrapolated[particle]);
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::extrapolate_stress(const Vector &displacement,
                                              const Vector &step)
  {
    extrapolated.clear();
    if (is_linear())
      return;
    std::vector<double> eta(dim * largest_family);
    for (unsigned int p = 0; p < families.n_particles(); ++p)
      {
        const auto one = family(p);
        relative_displacements(p, displacement.begin(), eta.data());
        const auto H = displacement_gradient(one, eta.data());
        relative_displacements(p, step.begin(), eta.data());
        extrapolated.push_back(Materials::extrapolated_stress(
          *materials[families.material[p]],
          H,
          displacement_gradient(one, eta.data())));
      }
  }

  template <int dim>
  void
  CorrespondenceTerm<dim>::forget_stress()
  {
    extrapolated.clear();
  }

  template <int dim>
  void
  add_family_nodes(const Peridynamics::FamilySet<dim> &families,
                   std::vector<unsigned int>          &needed)
  {
    needed.insert(needed.end(), families.node.begin(), families.node.end());
    needed.insert(needed.end(),
                  families.neighbor.begin(),
                  families.neighbor.end());
  }

  template class CorrespondenceTerm<2>;
  template class CorrespondenceTerm<3>;
  template void
  add_family_nodes<2>(const Peridynamics::FamilySet<2> &,
                      std::vector<unsigned int> &);
  template void
  add_family_nodes<3>(const Peridynamics::FamilySet<3> &,
                      std::vector<unsigned int> &);
} // namespace Perimorph::Coupling
