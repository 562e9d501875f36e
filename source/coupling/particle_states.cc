#include <perimorph/coupling/particle_states.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Perimorph::Coupling
{
  template <int dim>
  std::vector<ParticleState>
  particle_states(const Mesh::NodalMesh<dim>                          &mesh,
                  const Peridynamics::FamilySet<dim>                  &families,
                  const typename Fem::ElasticCells<dim>::MaterialList &laws,
                  const std::vector<dealii::Tensor<1, dim>> &displacement,
                  const MPI_Comm                             communicator)
  {
    // Per node: weight, displacement gradient and stress, each times weight.
    constexpr unsigned int width = 1 + 9 + 9;
    std::vector<double>    sums(width * mesh.n_nodes(), 0.);
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
        double      *sum    = sums.data() + width * node;
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

    std::vector<ParticleState> states(mesh.n_nodes());
    for (unsigned int n = 0; n < states.size(); ++n)
      {
        const double *sum = total.data() + width * n;
        if (!(sum[0] > 0.))
          continue;
        dealii::Tensor<2, 3> H, P;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            {
              H[a][b] = sum[1 + 3 * a + b] / sum[0];
              P[a][b] = sum[10 + 3 * a + b] / sum[0];
            }
        states[n].exists   = true;
        states[n].strain   = symmetrize(H);
        states[n].stress   = symmetrize(P);
        states[n].rotation = 0.5 * (H - transpose(H));
      }
    return states;
  }

#define PERIMORPH_INSTANTIATE(dim)                          \
  template std::vector<ParticleState> particle_states<dim>( \
    const Mesh::NodalMesh<dim> &,                           \
    const Peridynamics::FamilySet<dim> &,                   \
    const typename Fem::ElasticCells<dim>::MaterialList &,  \
    const std::vector<dealii::Tensor<1, dim>> &,            \
    MPI_Comm);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
