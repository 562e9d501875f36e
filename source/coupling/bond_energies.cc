#include <perimorph/base/gather.h>
#include <perimorph/coupling/bond_energies.h>
#include <perimorph/peridynamics/bond_based.h>
#include <perimorph/peridynamics/correspondence.h>

#include <algorithm>
#include <tuple>

namespace Perimorph::Coupling
{
  namespace
  {
    struct Half
    {
      std::array<unsigned int, 2> nodes;
      double                      energy;
    };

    /// Sorts by nodes and adds up what belongs to the same bond, in an order
    /// that does not depend on who sent it.
    void
    merge(std::vector<Half> &halves)
    {
      std::sort(halves.begin(), halves.end(), [](const auto &a, const auto &b) {
        return std::tie(a.nodes, a.energy) < std::tie(b.nodes, b.energy);
      });
      std::size_t last = 0;
      for (std::size_t k = 1; k < halves.size(); ++k)
        if (halves[k].nodes == halves[last].nodes)
          halves[last].energy += halves[k].energy;
        else
          halves[++last] = halves[k];
      halves.resize(std::min(halves.size(), last + 1));
    }

    std::vector<BondEnergy>
    of_all_ranks(const std::vector<Half> &halves, const MPI_Comm communicator)
    {
      auto all = Base::gather_on_all(communicator, halves);
      merge(all);
      std::vector<BondEnergy> result;
      result.reserve(all.size());
      for (const auto &half : all)
        result.push_back({half.nodes, half.energy});
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<BondEnergy>
  bond_energies(const Mesh::NodalMesh<dim>                          &mesh,
                const Peridynamics::FamilySet<dim>                  &families,
                const typename Fem::ElasticCells<dim>::MaterialList &laws,
                const std::vector<dealii::Tensor<1, dim>> &displacement,
                const MPI_Comm                             communicator)
  {
    std::vector<Half>   halves;
    std::vector<double> xi, eta, forces;
    for (std::size_t p = 0; p < families.n_particles(); ++p)
      {
        const unsigned int node  = families.node[p];
        const std::size_t  begin = families.offsets[p];
        const std::size_t  n     = families.offsets[p + 1] - begin;
        for (auto *list : {&xi, &eta, &forces})
          list->resize(dim * n);
        for (std::size_t b = 0; b < n; ++b)
          {
            const unsigned int other = families.neighbor[begin + b];
            for (int d = 0; d < dim; ++d)
              {
                xi[d * n + b]  = mesh.nodes[other][d] - mesh.nodes[node][d];
                eta[d * n + b] = displacement[other][d] - displacement[node][d];
              }
          }
        const auto gradient_weight =
          Peridynamics::by_components(families.gradient_weight.data() + begin,
                                      n);
        const Peridynamics::Family<dim> family{static_cast<unsigned int>(n),
                                               static_cast<unsigned int>(n),
                                               n,
                                               xi.data(),
                                               gradient_weight.data(),
                                               families.bond_weight.data() +
                                                 begin,
                                               families.stabilization[p]};
        const auto H = displacement_gradient(family, eta.data());
        family_forces(family,
                      eta.data(),
                      H,
                      laws[families.material[p]]->first_piola_kirchhoff(H),
                      forces.data());
        for (std::size_t b = 0; b < n; ++b)
          {
            const unsigned int other = families.neighbor[begin + b];
            double             work  = 0.;
            for (int d = 0; d < dim; ++d)
              work += forces[d * n + b] * eta[d * n + b];
            halves.push_back({{{std::min(node, other), std::max(node, other)}},
                              0.5 * families.weight[p] * work});
          }
      }
    return of_all_ranks(halves, communicator);
  }

  template <int dim>
  std::vector<BondEnergy>
  bond_energies(const Mesh::NodalMesh<dim>                &mesh,
                const BondSet                             &bonds,
                const std::vector<dealii::Tensor<1, dim>> &displacement,
                const MPI_Comm                             communicator)
  {
    std::vector<Half> all;
    for (std::size_t b = 0; b < bonds.nodes.size(); ++b)
      {
        const auto [i, j]               = bonds.nodes[b];
        const dealii::Tensor<1, dim> xi = mesh.nodes[j] - mesh.nodes[i];
        all.push_back(
          {{{std::min(i, j), std::max(i, j)}},
           Peridynamics::small_bond_energy(bonds.stiffness[b],
                                           xi,
                                           displacement[j] - displacement[i])});
      }
    return of_all_ranks(all, communicator);
  }

#define PERIMORPH_INSTANTIATE(dim)                         \
  template std::vector<BondEnergy> bond_energies<dim>(     \
    const Mesh::NodalMesh<dim> &,                          \
    const Peridynamics::FamilySet<dim> &,                  \
    const typename Fem::ElasticCells<dim>::MaterialList &, \
    const std::vector<dealii::Tensor<1, dim>> &,           \
    MPI_Comm);                                             \
  template std::vector<BondEnergy> bond_energies<dim>(     \
    const Mesh::NodalMesh<dim> &,                          \
    const BondSet &,                                       \
    const std::vector<dealii::Tensor<1, dim>> &,           \
    MPI_Comm);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
