#include <perimorph/base/point_cloud.h>
#include <perimorph/coupling/virial_field.h>

#include <algorithm>

namespace Perimorph::Coupling
{
  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  nodal_virial_stress(const Mesh::NodalMesh<dim>                      &mesh,
                      const Mesh::RegionMap                           &region,
                      const std::vector<Peridynamics::PairForce<dim>> &pairs,
                      MPI_Comm communicator)
  {
    std::vector<unsigned int>       particles;
    std::vector<dealii::Point<dim>> positions;
    double                          largest_horizon = 0.;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (region.alpha[n] > 0.)
        {
          particles.push_back(n);
          positions.push_back(mesh.nodes[n]);
          largest_horizon = std::max(largest_horizon, region.horizon[n]);
        }
    constexpr unsigned int      n_components = dim * dim;
    std::vector<double>         sums(n_components * mesh.n_nodes(), 0.);
    const Base::PointCloud<dim> cloud(positions);
    std::vector<unsigned int>   near;
    for (const auto &pair : pairs)
      {
        const dealii::Tensor<1, dim> xi = pair.end - pair.begin;
        cloud.within(pair.begin + 0.5 * xi,
                     largest_horizon + 0.5 * xi.norm(),
                     near);
        const auto moment = outer_product(pair.force, xi);
        for (const unsigned int p : near)
          {
            const unsigned int n      = particles[p];
            const double       radius = region.horizon[n];
            const double share = Peridynamics::fraction_in_ball(pair.begin,
                                                                pair.end,
                                                                mesh.nodes[n],
                                                                radius) /
                                 Peridynamics::ball_volume<dim>(radius);
            for (unsigned int c = 0; c < n_components; ++c)
              sums[n_components * n + c] += share * moment[c / dim][c % dim];
          }
      }
    dealii::Utilities::MPI::sum(sums, communicator, sums);
    std::vector<dealii::Tensor<2, dim>> stress(mesh.n_nodes());
    for (std::size_t k = 0; k < sums.size(); ++k)
      stress[k / n_components][k % n_components / dim][k % dim] = sums[k];
    return stress;
  }

  template std::vector<dealii::Tensor<2, 2>>
  nodal_virial_stress<2>(const Mesh::NodalMesh<2> &,
                         const Mesh::RegionMap &,
                         const std::vector<Peridynamics::PairForce<2>> &,
                         MPI_Comm);
  template std::vector<dealii::Tensor<2, 3>>
  nodal_virial_stress<3>(const Mesh::NodalMesh<3> &,
                         const Mesh::RegionMap &,
                         const std::vector<Peridynamics::PairForce<3>> &,
                         MPI_Comm);
} // namespace Perimorph::Coupling
