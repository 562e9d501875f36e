#include <perimorph/coupling/softened_elements.h>

#include <algorithm>

namespace Perimorph::Coupling
{
  template <int dim>
  std::shared_ptr<Fem::ElasticCells<dim>>
  softened_elements(const Mesh::NodalMesh<dim>                    &mesh,
                    const std::vector<double>                     &alpha,
                    const Bonds::CrackSet<dim>                    &cracks,
                    const Bonds::BrokenBonds                      &broken,
                    const std::shared_ptr<Fem::ElasticCells<dim>> &all_cells)
  {
    constexpr double left = 1e-2;
    if (cracks.empty() && broken.empty())
      return all_cells;
    std::vector<double>       factors;
    std::vector<unsigned int> near;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        if (!mesh.owns_cell(c))
          continue;
        const auto                                 &nodes = mesh.cells[c];
        std::array<dealii::Point<dim>, (1u << dim)> corners;
        bool                                        has_particles = false;
        for (unsigned int v = 0; v < nodes.size(); ++v)
          {
            corners[v]    = mesh.nodes[nodes[v]];
            has_particles = has_particles || alpha[nodes[v]] > 0.;
          }
        near.clear();
        if (has_particles)
          cracks.near(corners, near);
        bool cut = false;
        for (unsigned int v = 0; has_particles && v < nodes.size(); ++v)
          for (unsigned int w = v + 1; w < nodes.size() && !cut; ++w)
            cut = broken.contains(nodes[v], nodes[w]) ||
                  std::any_of(near.begin(), near.end(), [&](const auto k) {
                    return Bonds::crosses(cracks.facets()[k],
                                          corners[v],
                                          corners[w]);
                  });
        factors.push_back(cut ? left : 1.);
      }
    if (std::count(factors.begin(), factors.end(), left) == 0)
      return all_cells;
    auto softened = std::make_shared<Fem::ElasticCells<dim>>(*all_cells);
    softened->scale(factors);
    return softened;
  }

#define PERIMORPH_INSTANTIATE(dim)                                         \
  template std::shared_ptr<Fem::ElasticCells<dim>> softened_elements<dim>( \
    const Mesh::NodalMesh<dim> &,                                          \
    const std::vector<double> &,                                           \
    const Bonds::CrackSet<dim> &,                                          \
    const Bonds::BrokenBonds &,                                            \
    const std::shared_ptr<Fem::ElasticCells<dim>> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
