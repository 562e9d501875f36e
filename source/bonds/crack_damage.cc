#include <perimorph/base/point_cloud.h>
#include <perimorph/bonds/crack_damage.h>
#include <perimorph/bonds/support_search.h>

namespace Perimorph::Bonds
{
  template <int dim>
  std::vector<double>
  crack_damage(const Mesh::NodalMesh<dim> &mesh,
               const std::vector<double>  &alpha,
               const std::vector<double>  &horizon,
               const CrackSet<dim>        &cracks,
               std::size_t                &n_hidden,
               const BrokenBonds          &broken)
  {
    n_hidden = 0;
    std::vector<double> damage(mesh.n_nodes(), 0.);
    if (cracks.empty() && broken.empty())
      return damage;
    const Base::PointCloud<dim> cloud(mesh.nodes);
    std::vector<unsigned int>   near;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        const double reach = horizon[n] * (1. + horizon_slack);
        if (!(alpha[n] > 0.) ||
            (!cracks.is_within(mesh.nodes[n], reach) && broken.count(n) == 0))
          continue;
        double volume = 0., hidden = 0.;
        cloud.within(mesh.nodes[n], reach, near);
        for (const unsigned int k : near)
          if (k != n)
            {
              volume += mesh.volume[k];
              const double lost = cracks.crosses(mesh.nodes[n], mesh.nodes[k])
                                    ? 1.
                                    : 1. - broken.share_left(n, k);
              hidden += lost * mesh.volume[k];
              n_hidden += lost == 1. ? 1 : 0;
            }
        damage[n] = volume > 0. ? hidden / volume : 0.;
      }
    return damage;
  }

  template std::vector<double>
  crack_damage<2>(const Mesh::NodalMesh<2> &,
                  const std::vector<double> &,
                  const std::vector<double> &,
                  const CrackSet<2> &,
                  std::size_t &,
                  const BrokenBonds &);
  template std::vector<double>
  crack_damage<3>(const Mesh::NodalMesh<3> &,
                  const std::vector<double> &,
                  const std::vector<double> &,
                  const CrackSet<3> &,
                  std::size_t &,
                  const BrokenBonds &);
} // namespace Perimorph::Bonds
