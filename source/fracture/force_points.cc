#include <perimorph/fracture/cells_at_cracks.h>
#include <perimorph/fracture/force_points.h>
#include <perimorph/mesh/cell_geometry.h>

#include <cmath>

namespace Perimorph::Fracture
{
  namespace
  {
    /// A point of the cell without what is special to it.
    template <int dim>
    ForcePoint<dim>
    point_of(const Mesh::NodalMesh<dim>    &mesh,
             const unsigned int             cell,
             const Mesh::CellGeometry<dim> &geometry,
             const unsigned int             q)
    {
      ForcePoint<dim> point = {};
      point.x               = geometry.points[q];
      point.owner           = point.x;
      point.volume          = geometry.jxw[q];
      point.width           = std::pow(point.volume, 1. / dim);
      point.nodes           = mesh.cells[cell];
      for (unsigned int v = 0; v < point.nodes.size(); ++v)
        point.weights[v] = geometry.shape_value(q, v);
      return point;
    }

    template <int dim>
    void
    add_interpolated(const DeformedBody<dim>      &body,
                     const unsigned int            cell,
                     std::vector<ForcePoint<dim>> &points)
    {
      const Mesh::CellGeometry<dim> geometry(body.mesh.corners(cell));
      for (unsigned int q = 0; q < geometry.n_points; ++q)
        {
          auto point = point_of(body.mesh, cell, geometry, q);
          for (unsigned int v = 0; v < point.nodes.size(); ++v)
            {
              const unsigned int n = point.nodes[v];
              point.stress_divergence +=
                point.weights[v] * body.stress_divergence(cell, n);
              point.displacement_gradient +=
                dealii::outer_product(body.displacement[n],
                                      geometry.gradients[q][v]);
            }
          points.push_back(point);
        }
    }

    /// Each node of a touched cell with its share of it.
    template <int dim>
    void
    add_shares(const DeformedBody<dim>      &body,
               const unsigned int            cell,
               const Bonds::CrackSet<dim>   &cracks,
               const DisplacementFit<dim>   &fit,
               std::vector<ForcePoint<dim>> &points,
               unsigned int                 &n_without_stress)
    {
      const Mesh::CellGeometry<dim> geometry(body.mesh.corners(cell));
      for (unsigned int v = 0; v < body.mesh.nodes_per_cell; ++v)
        {
          const unsigned int n      = body.mesh.cells[cell][v];
          const auto         owner  = place_beside(body.mesh, cracks, n);
          const auto         fitted = fit.fit(owner,
                                      body.mesh.spacing[n],
                                      body.mesh.cell_material[cell],
                                      body.displacement);
          if (fitted.n_nodes == 0)
            {
              ++n_without_stress;
              continue;
            }
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            {
              auto point  = point_of(body.mesh, cell, geometry, q);
              point.owner = owner;
              point.volume *= point.weights[v];
              point.stress_divergence     = body.stress_divergence(cell, n);
              point.displacement_gradient = fitted.gradient;
              points.push_back(point);
            }
        }
    }
  } // namespace

  template <int dim>
  void
  add_force_points(const DeformedBody<dim>    &body,
                   const Bonds::CrackSet<dim> &cracks,
                   const DisplacementFit<dim> &fit,
                   const std::vector<bool>    &region,
                   StressPointSet<dim>        &set)
  {
    if (body.body_force.empty() && body.acceleration.empty())
      return;
    std::vector<unsigned int> facets;
    for (unsigned int c = 0; c < body.mesh.n_cells(); ++c)
      if (body.mesh.owns_cell(c) && in_region(body.mesh, c, region))
        {
          if (is_touched(body.mesh, c, cracks, facets))
            add_shares(body,
                       c,
                       cracks,
                       fit,
                       set.force_points,
                       set.n_without_stress);
          else
            add_interpolated(body, c, set.force_points);
        }
  }

#define INSTANTIATE(dim)                                            \
  template void add_force_points<dim>(const DeformedBody<dim> &,    \
                                      const Bonds::CrackSet<dim> &, \
                                      const DisplacementFit<dim> &, \
                                      const std::vector<bool> &,    \
                                      StressPointSet<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
