#include <perimorph/fracture/cells_at_cracks.h>
#include <perimorph/mesh/cell_geometry.h>

#include <algorithm>

namespace Perimorph::Fracture
{
  template <int dim>
  bool
  is_touched(const Mesh::NodalMesh<dim> &mesh,
             const unsigned int          cell,
             const Bonds::CrackSet<dim> &cracks,
             std::vector<unsigned int>  &facets)
  {
    const auto corners = mesh.corners(cell);
    cracks.near(corners, facets);
    if (facets.empty())
      return false;
    const Mesh::CellGeometry<dim> geometry(corners);
    for (unsigned int v = 0; v < corners.size(); ++v)
      {
        for (unsigned int w = 0; w < v; ++w)
          if (cracks.crosses(corners[w], corners[v]))
            return true;
        for (const auto &point : geometry.points)
          if (cracks.crosses(point, corners[v]))
            return true;
      }
    return false;
  }

  template <int dim>
  bool
  in_region(const Mesh::NodalMesh<dim> &mesh,
            const unsigned int          cell,
            const std::vector<bool>    &region)
  {
    return std::any_of(mesh.cells[cell].begin(),
                       mesh.cells[cell].end(),
                       [&](const unsigned int n) { return region[n]; });
  }

  template <int dim>
  dealii::Point<dim>
  place_beside(const Mesh::NodalMesh<dim> &mesh,
               const Bonds::CrackSet<dim> &cracks,
               const unsigned int          node)
  {
    const auto               &x = mesh.nodes[node];
    std::vector<unsigned int> facets;
    cracks.near(std::array<dealii::Point<dim>, 1>{{x}}, facets);
    for (const unsigned int facet : facets)
      for (const double side : {-1., 1.})
        {
          const auto step =
            side * 1e-6 * mesh.spacing[node] * cracks.facets()[facet].normal();
          if (cracks.crosses(x, x + step))
            return x - step;
        }
    return x;
  }

#define INSTANTIATE(dim)                                                      \
  template bool               is_touched<dim>(const Mesh::NodalMesh<dim> &,   \
                                unsigned int,                   \
                                const Bonds::CrackSet<dim> &,   \
                                std::vector<unsigned int> &);   \
  template bool               in_region<dim>(const Mesh::NodalMesh<dim> &,    \
                               unsigned int,                    \
                               const std::vector<bool> &);      \
  template dealii::Point<dim> place_beside<dim>(const Mesh::NodalMesh<dim> &, \
                                                const Bonds::CrackSet<dim> &, \
                                                unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
