#include <perimorph/fem/lumped_mass.h>
#include <perimorph/mesh/cell_geometry.h>

namespace Perimorph::Fem
{
  template <int dim>
  std::vector<double>
  lumped_mass(const Mesh::NodalMesh<dim> &mesh,
              const std::vector<double>  &density)
  {
    std::vector<double> mass(mesh.n_nodes(), 0.);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
        for (unsigned int q = 0; q < geometry.n_points; ++q)
          for (unsigned int v = 0; v < geometry.n_nodes; ++v)
            mass[mesh.cells[c][v]] += density[mesh.cell_material[c]] *
                                      geometry.jxw[q] *
                                      geometry.shape_value(q, v);
      }
    for (const auto &[node, parents] : mesh.hanging)
      {
        for (const auto &[parent, weight] : parents)
          mass[parent] += weight * mass[node];
        mass[node] = 0.;
      }
    return mass;
  }

  template std::vector<double>
  lumped_mass<2>(const Mesh::NodalMesh<2> &, const std::vector<double> &);
  template std::vector<double>
  lumped_mass<3>(const Mesh::NodalMesh<3> &, const std::vector<double> &);
} // namespace Perimorph::Fem
