#include <perimorph/coupling/particle_states.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace Perimorph::Coupling
{
  namespace
  {
    // Of a particle: weight, displacement gradient and stress, each times
    // weight.
    constexpr unsigned int width = 1 + 9 + 9;

    ParticleState
    state_of_sums(const double *sum)
    {
      ParticleState state;
      if (!(sum[0] > 0.))
        return state;
      dealii::Tensor<2, 3> H, P;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          {
            H[a][b] = sum[1 + 3 * a + b] / sum[0];
            P[a][b] = sum[10 + 3 * a + b] / sum[0];
          }
      state.exists   = true;
      state.strain   = symmetrize(H);
      state.stress   = symmetrize(P);
      state.rotation = 0.5 * (H - transpose(H));
      return state;
    }

    template <int dim>
    Base::Csr<unsigned int>
    laws_at_nodes(const Mesh::NodalMesh<dim> &mesh)
    {
      Base::Csr<unsigned int>   laws;
      std::vector<unsigned int> list;
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        {
          list.clear();
          for (const unsigned int c : mesh.node_cells.row(n))
            list.push_back(mesh.cell_material[c]);
          std::sort(list.begin(), list.end());
          list.erase(std::unique(list.begin(), list.end()), list.end());
          laws.entries.insert(laws.entries.end(), list.begin(), list.end());
          laws.close_row();
        }
      return laws;
    }
  } // namespace

  const ParticleState *
  ParticleStates::find(const unsigned int node, const unsigned int law) const
  {
    const auto  row   = laws.row(node);
    const auto *place = std::lower_bound(row.begin(), row.end(), law);
    return place == row.end() || *place != law
             ? nullptr
             : &particles[place - laws.entries.data()];
  }

  template <int dim>
  ParticleStates
  particle_states(const Mesh::NodalMesh<dim>                          &mesh,
                  const Peridynamics::FamilySet<dim>                  &families,
                  const typename Fem::ElasticCells<dim>::MaterialList &laws,
                  const std::vector<dealii::Tensor<1, dim>> &displacement,
                  const MPI_Comm                             communicator)
  {
    ParticleStates states;
    states.laws = laws_at_nodes(mesh);
    std::vector<double> sums(width * states.laws.entries.size(), 0.);
    for (std::size_t p = 0; p < families.n_particles(); ++p)
      {
        const unsigned int     node = families.node[p];
        dealii::Tensor<2, dim> H;
        for (std::size_t b = families.offsets[p]; b < families.offsets[p + 1];
             ++b)
          H += outer_product(displacement[families.neighbor[b]] -
                               displacement[node],
                             families.gradient_weight[b]);
        const auto  &law    = *laws[families.material[p]];
        const auto   P      = law.first_piola_kirchhoff(H);
        const double weight = families.weight[p];
        const auto   row    = states.laws.row(node);
        const auto  *place =
          std::lower_bound(row.begin(), row.end(), families.material[p]);
        double *sum =
          sums.data() + width * (place - states.laws.entries.data());
        sum[0] += weight;
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            {
              sum[1 + 3 * a + b] += weight * H[a][b];
              sum[10 + 3 * a + b] += weight * P[a][b];
            }
        if (dim == 2)
          {
            sum[1 + 8] += weight * (law.out_of_plane_stretch(H) - 1.);
            sum[10 + 8] += weight * law.out_of_plane_stress(H);
          }
      }
    auto total = sums;
    dealii::Utilities::MPI::sum(sums, communicator, total);

    for (std::size_t p = 0; p < states.laws.entries.size(); ++p)
      states.particles.push_back(state_of_sums(total.data() + width * p));
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        std::array<double, width> sum{};
        for (std::size_t p = states.laws.offsets[n];
             p < states.laws.offsets[n + 1];
             ++p)
          for (unsigned int k = 0; k < width; ++k)
            sum[k] += total[width * p + k];
        states.nodes.push_back(state_of_sums(sum.data()));
      }
    return states;
  }

#define PERIMORPH_INSTANTIATE(dim)                         \
  template ParticleStates particle_states<dim>(            \
    const Mesh::NodalMesh<dim> &,                          \
    const Peridynamics::FamilySet<dim> &,                  \
    const typename Fem::ElasticCells<dim>::MaterialList &, \
    const std::vector<dealii::Tensor<1, dim>> &,           \
    MPI_Comm);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
