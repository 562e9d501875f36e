#include <perimorph/fem/body_force.h>

namespace Perimorph::Fem
{
  template <int dim>
  void
  for_each_body_force(const Mesh::DistributedMesh<dim>  &mesh,
                      const std::vector<BodyForce<dim>> &forces,
                      const double                       time,
                      const bool                         everywhere,
                      const BodyForceVisitor<dim>       &visit)
  {
    const auto &nodal = mesh.nodal();
    for (const auto &force : forces)
      {
        const auto visit_cell = [&](const unsigned int c) {
          if (!everywhere && !nodal.owns_cell(c))
            return;
          const Mesh::CellGeometry<dim> geometry(nodal.corners(c));
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            visit(c,
                  geometry,
                  q,
                  value_of<dim>(force.components, geometry.points[q], time));
        };
        if (force.volume.empty())
          for (unsigned int c = 0; c < nodal.n_cells(); ++c)
            visit_cell(c);
        else
          for (const unsigned int c : mesh.volume(force.volume, "load"))
            visit_cell(c);
      }
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  body_force_density(const Mesh::DistributedMesh<dim>  &mesh,
                     const std::vector<BodyForce<dim>> &forces,
                     const double                       time)
  {
    if (forces.empty())
      return {};
    const auto                         &nodal = mesh.nodal();
    std::vector<dealii::Tensor<1, dim>> density(nodal.n_nodes());
    for_each_body_force<dim>(
      mesh,
      forces,
      time,
      true,
      [&](const unsigned int             c,
          const Mesh::CellGeometry<dim> &geometry,
          const unsigned int             q,
          const dealii::Tensor<1, dim>  &value) {
        for (unsigned int v = 0; v < geometry.n_nodes; ++v)
          density[nodal.cells[c][v]] +=
            geometry.jxw[q] * geometry.shape_value(q, v) * value;
      });
    std::vector<double> volume(nodal.n_nodes(), 0.);
    for (unsigned int c = 0; c < nodal.n_cells(); ++c)
      {
        const Mesh::CellGeometry<dim> geometry(nodal.corners(c));
        for (unsigned int q = 0; q < geometry.n_points; ++q)
          for (unsigned int v = 0; v < geometry.n_nodes; ++v)
            volume[nodal.cells[c][v]] +=
              geometry.jxw[q] * geometry.shape_value(q, v);
      }
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      density[n] /= volume[n];
    return density;
  }

#define INSTANTIATE(dim)                                                      \
  template void for_each_body_force<dim>(const Mesh::DistributedMesh<dim> &,  \
                                         const std::vector<BodyForce<dim>> &, \
                                         double,                              \
                                         bool,                                \
                                         const BodyForceVisitor<dim> &);      \
  template std::vector<dealii::Tensor<1, dim>> body_force_density<dim>(       \
    const Mesh::DistributedMesh<dim> &,                                       \
    const std::vector<BodyForce<dim>> &,                                      \
    double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fem
