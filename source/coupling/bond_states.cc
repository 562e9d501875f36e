#include <perimorph/coupling/bond_states.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Perimorph::Coupling
{
  template <int dim>
  Damage::BondState
  bond_state(const Mesh::NodalMesh<dim>      &mesh,
             const Mesh::RegionMap           &region,
             const std::vector<BondMaterial> &materials,
             const unsigned int               first,
             const unsigned int               second,
             const dealii::Tensor<1, dim>    &eta)
  {
    const auto mean = [&](const auto &value) {
      return 0.5 * (value(first) + value(second));
    };
    const auto        xi = mesh.nodes[second] - mesh.nodes[first];
    Damage::BondState bond;
    bond.length         = xi.norm();
    bond.extension      = xi * eta / bond.length;
    bond.energy         = 0.;
    bond.volume_product = mesh.volume[first] * mesh.volume[second];
    bond.horizon =
      mean([&](const unsigned int n) { return region.horizon[n]; });
    bond.horizon_ratio  = mean([&](const unsigned int n) {
      return region.horizon[n] / mesh.spacing[n];
    });
    bond.youngs_modulus = mean([&](const unsigned int n) {
      const unsigned int cell = *mesh.node_cells.row(n).begin();
      return materials[mesh.cell_material[cell]].youngs_modulus;
    });
    return bond;
  }

  template <int dim>
  void
  see_particles(const ParticleState          &first,
                const ParticleState          &second,
                const dealii::Tensor<1, dim> &xi,
                const dealii::Tensor<1, dim> &eta,
                Damage::BondState            &bond)
  {
    const auto &a = first.exists ? first : second;
    const auto &b = second.exists ? second : first;
    bond.strain   = 0.5 * (a.strain + b.strain);
    bond.stress   = 0.5 * (a.stress + b.stress);
    for (int d = 0; d < dim; ++d)
      {
        bond.direction[d] = xi[d] / bond.length;
        bond.relative[d]  = eta[d] / bond.length;
      }
    bond.relative -= 0.5 * (a.rotation + b.rotation) * bond.direction;
    bond.largest_dilatation = std::max(trace(a.strain), trace(b.strain));
  }

  std::vector<bool>
  nodes_in_core(const std::vector<double>                      &alpha,
                const std::vector<std::array<unsigned int, 2>> &pairs,
                const MPI_Comm                                  communicator)
  {
    std::vector<unsigned int> here(alpha.size(), 1u);
    for (const auto &[first, second] : pairs)
      if (alpha[first] < 1. || alpha[second] < 1.)
        here[first] = here[second] = 0u;
    // Families of other ranks know more.
    auto everywhere = here;
    dealii::Utilities::MPI::min(here, communicator, everywhere);
    return std::vector<bool>(everywhere.begin(), everywhere.end());
  }

#define PERIMORPH_INSTANTIATE(dim)                                 \
  template Damage::BondState bond_state<dim>(                      \
    const Mesh::NodalMesh<dim> &,                                  \
    const Mesh::RegionMap &,                                       \
    const std::vector<BondMaterial> &,                             \
    unsigned int,                                                  \
    unsigned int,                                                  \
    const dealii::Tensor<1, dim> &);                               \
  template void see_particles<dim>(const ParticleState &,          \
                                   const ParticleState &,          \
                                   const dealii::Tensor<1, dim> &, \
                                   const dealii::Tensor<1, dim> &, \
                                   Damage::BondState &);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
