#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/nodal_stress.h>
#include <perimorph/materials/stress_measures.h>
#include <perimorph/mesh/cell_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Perimorph::Fracture
{
  namespace
  {
    template <int dim>
    dealii::SymmetricTensor<2, 3>
    full_tensor(const Stress<dim> &stress)
    {
      dealii::SymmetricTensor<2, 3> tensor;
      if (dim == 2)
        tensor[2][2] = stress.out_of_plane;
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          tensor[i][j] = stress.in_plane[i][j];
      return tensor;
    }

    template <int dim>
    void
    add(Stress<dim> &sum, const double factor, const Stress<dim> &stress)
    {
      sum.in_plane += factor * stress.in_plane;
      sum.out_of_plane += factor * stress.out_of_plane;
      sum.first_piola_kirchhoff += factor * stress.first_piola_kirchhoff;
      sum.kirchhoff += factor * stress.kirchhoff;
      sum.logarithmic_strain += factor * stress.logarithmic_strain;
    }

    template <int dim>
    void
    divide(Stress<dim> &sum, const double divisor)
    {
      Stress<dim> quotient;
      add(quotient, 1. / divisor, sum);
      sum = quotient;
    }
  } // namespace

  template <int dim>
  std::array<double, 3>
  principal_stresses(const Stress<dim> &stress)
  {
    const auto            values = dealii::eigenvalues(full_tensor(stress));
    std::array<double, 3> sorted = {{values[0], values[1], values[2]}};
    std::sort(sorted.rbegin(), sorted.rend());
    return sorted;
  }

  template <int dim>
  double
  von_mises_stress(const Stress<dim> &stress)
  {
    const auto deviator = dealii::deviator(full_tensor(stress));
    return std::sqrt(1.5 * (deviator * deviator));
  }

  template <int dim>
  double
  hoop_stress(const Stress<dim>        &stress,
              const dealii::Point<dim> &point,
              const dealii::Point<dim> &center)
  {
    const double           x = point[0] - center[0];
    const double           y = point[1] - center[1];
    const double           r = std::hypot(x, y);
    dealii::Tensor<1, dim> tangent;
    tangent[0] = r > 0. ? -y / r : 0.;
    tangent[1] = r > 0. ? x / r : 1.;
    return tangent * (stress.in_plane * tangent);
  }

  template <int dim>
  Stress<dim>
  stress_of_gradient(const Materials::Material<dim> &material,
                     const dealii::Tensor<2, dim>   &gradient)
  {
    Stress<dim> stress;
    if (material.is_linear())
      {
        stress.in_plane =
          dealii::symmetrize(material.first_piola_kirchhoff(gradient));
        if (dim == 2)
          stress.out_of_plane = material.out_of_plane_stress(gradient);
        return stress;
      }
    Materials::StressMeasures measures;
    try
      {
        measures = Materials::stress_measures(material, gradient);
      }
    catch (const Base::InadmissibleState &)
      {
        // The fit around a strongly distorted place may turn inside out where
        // the elements do not: there is no stress to report.
        const double none = std::numeric_limits<double>::quiet_NaN();
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            {
              measures.first_piola_kirchhoff[a][b] = none;
              measures.cauchy[a][b] = measures.kirchhoff[a][b] = none;
              measures.strain[a][b]                            = none;
            }
      }
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        stress.in_plane[i][j] = measures.cauchy[i][j];
    if (dim == 2)
      stress.out_of_plane = measures.cauchy[2][2];
    stress.first_piola_kirchhoff = measures.first_piola_kirchhoff;
    stress.kirchhoff             = measures.kirchhoff;
    stress.logarithmic_strain    = measures.strain;
    return stress;
  }

  template <int dim>
  NodalStress<dim>::NodalStress(const DisplacementFit<dim> &fit,
                                const MaterialList<dim>    &materials)
    : displacement_fit(fit)
    , materials(materials)
  {
    const auto &used = fit.mesh().cell_material;
    single_material  = std::all_of(used.begin(), used.end(), [&](const auto m) {
      return m == used.front();
    });
  }

  template <int dim>
  Stress<dim>
  NodalStress<dim>::fitted(
    const dealii::Point<dim>                  &point,
    const double                               length,
    const unsigned int                         material,
    const unsigned int                         seed,
    const std::vector<dealii::Tensor<1, dim>> &displacement) const
  {
    const int restriction = single_material ? DisplacementFit<dim>::any_material
                                            : static_cast<int>(material);
    return stress_of_gradient(
      *materials[material],
      displacement_fit.fit(point, length, restriction, displacement, seed)
        .gradient);
  }

  template <int dim>
  Stress<dim>
  NodalStress<dim>::at_node(
    const unsigned int                         node,
    const std::vector<dealii::Tensor<1, dim>> &displacement) const
  {
    const auto                          &mesh  = displacement_fit.mesh();
    const auto                           cells = mesh.node_cells.row(node);
    std::map<unsigned int, unsigned int> n_cells_of;
    for (const unsigned int cell : cells)
      ++n_cells_of[mesh.cell_material[cell]];

    Stress<dim> mean;
    for (const auto &[material, n_cells] : n_cells_of)
      add(mean,
          double(n_cells) / cells.size(),
          fitted(mesh.nodes[node],
                 mesh.spacing[node],
                 material,
                 node,
                 displacement));
    return mean;
  }

  template <int dim>
  std::vector<Stress<dim>>
  NodalStress<dim>::at_nodes(
    const std::vector<unsigned int>           &nodes,
    const std::vector<dealii::Tensor<1, dim>> &displacement) const
  {
    std::vector<Stress<dim>> stresses;
    stresses.reserve(nodes.size());
    for (const unsigned int node : nodes)
      stresses.push_back(at_node(node, displacement));
    return stresses;
  }

  template <int dim>
  Stress<dim>
  NodalStress<dim>::at_point(
    const dealii::Point<dim>                  &point,
    const unsigned int                         material,
    const std::vector<dealii::Tensor<1, dim>> &displacement,
    const unsigned int                         seed) const
  {
    const double length = seed == DisplacementFit<dim>::nearest
                            ? displacement_fit.length_at(point)
                            : displacement_fit.mesh().spacing[seed];
    return fitted(point, length, material, seed, displacement);
  }

  template <int dim>
  std::vector<Stress<dim>>
  average_element_stress(
    const Mesh::NodalMesh<dim>                &mesh,
    const MaterialList<dim>                   &materials,
    const std::vector<unsigned int>           &nodes,
    const std::vector<dealii::Tensor<1, dim>> &displacement)
  {
    // Each cell at the nodes is worked on once.
    constexpr unsigned int    none = static_cast<unsigned int>(-1);
    std::vector<unsigned int> position(mesh.n_nodes(), none);
    std::vector<unsigned int> cells;
    for (unsigned int n = 0; n < nodes.size(); ++n)
      {
        if (position[nodes[n]] == none)
          position[nodes[n]] = n;
        for (const unsigned int cell : mesh.node_cells.row(nodes[n]))
          cells.push_back(cell);
      }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());

    std::vector<Stress<dim>> stresses(nodes.size());
    std::vector<double>      volumes(nodes.size(), 0.);
    for (const unsigned int c : cells)
      {
        const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
        const auto                   &cell = mesh.cells[c];
        for (unsigned int q = 0; q < geometry.n_points; ++q)
          {
            dealii::Tensor<2, dim> gradient;
            for (unsigned int v = 0; v < cell.size(); ++v)
              gradient += dealii::outer_product(displacement[cell[v]],
                                                geometry.gradients[q][v]);
            const auto stress =
              stress_of_gradient(*materials[mesh.cell_material[c]], gradient);
            for (unsigned int v = 0; v < cell.size(); ++v)
              if (position[cell[v]] != none)
                {
                  const double weight =
                    geometry.jxw[q] * geometry.shape_value(q, v);
                  add(stresses[position[cell[v]]], weight, stress);
                  volumes[position[cell[v]]] += weight;
                }
          }
      }
    for (unsigned int n = 0; n < nodes.size(); ++n)
      if (position[nodes[n]] == n)
        divide(stresses[n], volumes[n]);
      else // listed twice
        stresses[n] = stresses[position[nodes[n]]];
    return stresses;
  }

  template class NodalStress<2>;
  template class NodalStress<3>;
#define INSTANTIATE(dim)                                                       \
  template std::array<double, 3> principal_stresses<dim>(const Stress<dim> &); \
  template double                von_mises_stress<dim>(const Stress<dim> &);   \
  template double                hoop_stress<dim>(const Stress<dim> &,         \
                                   const dealii::Point<dim> &,  \
                                   const dealii::Point<dim> &); \
  template Stress<dim>           stress_of_gradient<dim>(                      \
    const Materials::Material<dim> &,                                \
    const dealii::Tensor<2, dim> &);                                 \
  template std::vector<Stress<dim>> average_element_stress<dim>(               \
    const Mesh::NodalMesh<dim> &,                                              \
    const MaterialList<dim> &,                                                 \
    const std::vector<unsigned int> &,                                         \
    const std::vector<dealii::Tensor<1, dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
