#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <utility>

namespace Perimorph
{
  namespace Mesh
  {
    template <int dim>
    void
    NodalMesh<dim>::compute_derived()
    {
      cell_centroid.assign(cells.size(), dealii::Point<dim>());
      volume.assign(nodes.size(), 0.);
      std::vector<unsigned int> n_cells_at(nodes.size(), 0);

      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          const CellGeometry<dim> geometry(corners(c));
          for (unsigned int v = 0; v < nodes_per_cell; ++v)
            {
              const unsigned int node = cells[c][v];
              ++n_cells_at[node];
              cell_centroid[c] += nodes[node] / double(nodes_per_cell);
              for (unsigned int q = 0; q < geometry.n_points; ++q)
                volume[node] += geometry.jxw[q] * geometry.shape_value(q, v);
            }
        }

      node_cells.offsets.assign(nodes.size() + 1, 0);
      for (unsigned int n = 0; n < nodes.size(); ++n)
        node_cells.offsets[n + 1] = node_cells.offsets[n] + n_cells_at[n];
      node_cells.entries.resize(node_cells.offsets.back());
      auto next = node_cells.offsets;
      for (unsigned int c = 0; c < cells.size(); ++c)
        for (const unsigned int node : cells[c])
          node_cells.entries[next[node]++] = c;

      // Each edge counts once at its two nodes, however many cells share it.
      std::vector<std::pair<unsigned int, unsigned int>> edges;
      edges.reserve(cells.size() * dealii::GeometryInfo<dim>::lines_per_cell);
      for (const auto &cell : cells)
        for (unsigned int v = 0; v < nodes_per_cell; ++v)
          for (int d = 0; d < dim; ++d)
            if (!((v >> d) & 1u))
              {
                const unsigned int a = cell[v];
                const unsigned int b = cell[v | (1u << d)];
                edges.emplace_back(std::min(a, b), std::max(a, b));
              }
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      spacing.assign(nodes.size(), 0.);
      std::vector<unsigned int> n_edges(nodes.size(), 0);
      for (const auto &edge : edges)
        {
          const double length = nodes[edge.first].distance(nodes[edge.second]);
          for (const unsigned int node : {edge.first, edge.second})
            {
              spacing[node] += length;
              ++n_edges[node];
            }
        }
      for (unsigned int n = 0; n < nodes.size(); ++n)
        spacing[n] /= std::max(1u, n_edges[n]);
    }

    template struct NodalMesh<2>;
    template struct NodalMesh<3>;
  } // namespace Mesh
} // namespace Perimorph
