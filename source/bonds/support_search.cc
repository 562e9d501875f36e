#include <perimorph/base/point_cloud.h>
#include <perimorph/bonds/support_search.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>

namespace Perimorph::Bonds
{
  template <int dim>
  std::vector<ParticleSeed>
  relevant_particles(const Mesh::NodalMesh<dim> &mesh,
                     const std::vector<double>  &weight,
                     const std::vector<double>  &horizon)
  {
    std::vector<dealii::Point<dim>> owned;
    double                          reach = 0.;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (weight[n] > 0.)
        {
          // A support reaches one horizon or the cells at the node.
          reach = std::max({reach, horizon[n], 4. * mesh.spacing[n]});
          if (mesh.owns_node(n))
            owned.push_back(mesh.nodes[n]);
        }
    std::vector<ParticleSeed> particles;
    if (owned.empty())
      return particles;
    dealii::BoundingBox<dim> box(owned);
    box.extend(2.5 * reach);
    std::vector<unsigned int> materials;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (weight[n] > 0. && box.point_inside(mesh.nodes[n]))
        {
          materials.clear();
          for (const unsigned int c : mesh.node_cells.row(n))
            materials.push_back(mesh.cell_material[c]);
          std::sort(materials.begin(), materials.end());
          materials.erase(std::unique(materials.begin(), materials.end()),
                          materials.end());
          for (const unsigned int m : materials)
            particles.push_back({n, m});
        }
    return particles;
  }

  template <int dim>
  void
  find_adjacent_cells(const Mesh::NodalMesh<dim> &mesh,
                      const ParticleSeed         &particle,
                      std::vector<unsigned int>  &cells)
  {
    cells.clear();
    for (const unsigned int c : mesh.node_cells.row(particle.node))
      if (mesh.cell_material[c] == particle.material)
        cells.push_back(c);
  }

  template <int dim>
  Base::Csr<unsigned int>
  find_supports(const Mesh::NodalMesh<dim>      &mesh,
                const std::vector<ParticleSeed> &particles,
                const std::vector<double>       &horizon)
  {
    Base::Csr<unsigned int>     supports;
    const Base::PointCloud<dim> centroids(mesh.cell_centroid);
    std::vector<unsigned int>   near;
    std::vector<unsigned int>   reached;
    constexpr unsigned char     unknown = 0, inside = 1, done = 2;
    std::vector<unsigned char>  state(mesh.n_cells(), unknown);

    for (const auto &particle : particles)
      {
        centroids.within(mesh.nodes[particle.node],
                         horizon[particle.node] * (1. + horizon_slack),
                         near);
        for (const unsigned int c : near)
          if (mesh.cell_material[c] == particle.material)
            state[c] = inside;
        find_adjacent_cells(mesh, particle, reached);
        for (const unsigned int c : reached)
          state[c] = done;
        for (std::size_t k = 0; k < reached.size(); ++k)
          for (const unsigned int n : mesh.cells[reached[k]])
            for (const unsigned int c : mesh.node_cells.row(n))
              if (state[c] == inside)
                {
                  state[c] = done;
                  reached.push_back(c);
                }
        for (const unsigned int c : near)
          state[c] = unknown;
        for (const unsigned int c : reached)
          state[c] = unknown;
        std::sort(reached.begin(), reached.end());
        supports.entries.insert(supports.entries.end(),
                                reached.begin(),
                                reached.end());
        supports.close_row();
      }
    return supports;
  }

  template std::vector<ParticleSeed>
  relevant_particles<2>(const Mesh::NodalMesh<2> &,
                        const std::vector<double> &,
                        const std::vector<double> &);
  template std::vector<ParticleSeed>
  relevant_particles<3>(const Mesh::NodalMesh<3> &,
                        const std::vector<double> &,
                        const std::vector<double> &);
  template void
  find_adjacent_cells<2>(const Mesh::NodalMesh<2> &,
                         const ParticleSeed &,
                         std::vector<unsigned int> &);
  template void
  find_adjacent_cells<3>(const Mesh::NodalMesh<3> &,
                         const ParticleSeed &,
                         std::vector<unsigned int> &);
  template Base::Csr<unsigned int>
  find_supports<2>(const Mesh::NodalMesh<2> &,
                   const std::vector<ParticleSeed> &,
                   const std::vector<double> &);
  template Base::Csr<unsigned int>
  find_supports<3>(const Mesh::NodalMesh<3> &,
                   const std::vector<ParticleSeed> &,
                   const std::vector<double> &);
} // namespace Perimorph::Bonds
