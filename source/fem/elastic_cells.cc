#include <perimorph/fem/elastic_cells.h>
#include <perimorph/materials/extrapolated_stress.h>

#include <algorithm>

namespace Perimorph::Fem
{
  template <int dim>
  ElasticCells<dim>::ElasticCells(const Mesh::NodalMesh<dim> &mesh,
                                  const NodePartition<dim>   &partition,
                                  const MaterialList         &materials,
                                  const std::vector<double>  &element_weight,
                                  const std::vector<bool>    &skip)
    : partition(partition)
    , materials(materials)
  {
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        if (!mesh.owns_cell(c) || (!skip.empty() && skip[c]))
          continue;
        Cell cell;
        cell.material   = mesh.cell_material[c];
        cell.number     = c;
        bool has_weight = false;
        for (unsigned int q = 0; q < n_nodes; ++q)
          {
            cell.weights[q] = element_weight.empty() ? 1. : 0.;
            if (!element_weight.empty())
              for (unsigned int v = 0; v < n_nodes; ++v)
                cell.weights[q] += element_weight[mesh.cells[c][v]] *
                                   Mesh::CellGeometry<dim>::shape_value(q, v);
            has_weight = has_weight || cell.weights[q] != 0.;
          }
        if (!has_weight)
          continue;
        for (unsigned int v = 0; v < n_nodes; ++v)
          cell.nodes[v] = partition.local(mesh.cells[c][v]);
        cells.push_back(cell);
      }
  }

  template <int dim>
  void
  ElasticCells<dim>::remove(const std::vector<bool> &goes)
  {
    cells.erase(
      std::remove_if(cells.begin(),
                     cells.end(),
                     [&](const Cell &cell) { return goes[cell.number]; }),
      cells.end());
    forget_stress();
  }

  template <int dim>
  void
  ElasticCells<dim>::scale(const std::vector<double> &factors)
  {
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (double &weight : cells[c].weights)
        weight *= factors[c];
  }

  template <int dim>
  std::string
  ElasticCells<dim>::name() const
  {
    return "finite elements";
  }

  template <int dim>
  bool
  ElasticCells<dim>::is_linear() const
  {
    for (const auto &material : materials)
      if (!material->is_linear())
        return false;
    return true;
  }

  template <int dim>
  Mesh::CellGeometry<dim>
  ElasticCells<dim>::geometry(const Cell &cell) const
  {
    typename Mesh::CellGeometry<dim>::Corners corners;
    for (unsigned int v = 0; v < n_nodes; ++v)
      corners[v] = partition.position(cell.nodes[v]);
    return Mesh::CellGeometry<dim>(corners);
  }

  template <int dim>
  dealii::Tensor<2, dim>
  ElasticCells<dim>::gradient(const Cell                    &cell,
                              const Mesh::CellGeometry<dim> &geometry,
                              const unsigned int             q,
                              const double                  *vector) const
  {
    dealii::Tensor<2, dim> result;
    for (unsigned int v = 0; v < n_nodes; ++v)
      result += outer_product(this->value_at(vector, cell.nodes[v]),
                              geometry.gradients[q][v]);
    return result;
  }

  template <int dim>
  double
  ElasticCells<dim>::energy(const Vector &displacement) const
  {
    double sum = 0.;
    for (const Cell &cell : cells)
      {
        const auto geometry = this->geometry(cell);
        for (unsigned int q = 0; q < n_nodes; ++q)
          sum += geometry.jxw[q] * cell.weights[q] *
                 materials[cell.material]->energy_density(
                   gradient(cell, geometry, q, displacement.begin()));
      }
    return sum;
  }

  template <int dim>
  void
  ElasticCells<dim>::add_residual(const Vector &displacement,
                                  Vector       &residual) const
  {
    for (const Cell &cell : cells)
      {
        const auto geometry = this->geometry(cell);
        for (unsigned int q = 0; q < n_nodes; ++q)
          {
            dealii::Tensor<2, dim> P;
            this->at_place(geometry.points[q], [&]() {
              P = geometry.jxw[q] * cell.weights[q] *
                  materials[cell.material]->first_piola_kirchhoff(
                    gradient(cell, geometry, q, displacement.begin()));
            });
            for (unsigned int v = 0; v < n_nodes; ++v)
              this->add_at(residual.begin(),
                           cell.nodes[v],
                           P * geometry.gradients[q][v]);
          }
      }
  }

  template <int dim>
  void
  ElasticCells<dim>::add_tangent_product(const Vector &displacement,
                                         const Vector &direction,
                                         Vector       &product) const
  {
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const Cell &cell     = cells[c];
        const auto  geometry = this->geometry(cell);
        for (unsigned int q = 0; q < n_nodes; ++q)
          {
            const auto A  = point_tangent(c, geometry, q, displacement.begin());
            const auto dP = geometry.jxw[q] * cell.weights[q] *
                            dealii::double_contract<2, 0, 3, 1>(
                              A,
                              gradient(cell, geometry, q, direction.begin()));
            for (unsigned int v = 0; v < n_nodes; ++v)
              this->add_at(product.begin(),
                           cell.nodes[v],
                           dP * geometry.gradients[q][v]);
          }
      }
  }

  template <int dim>
  unsigned int
  ElasticCells<dim>::n_blocks() const
  {
    return cells.size();
  }

  template <int dim>
  void
  ElasticCells<dim>::block_nodes(const unsigned int         block,
                                 std::vector<unsigned int> &nodes) const
  {
    nodes.assign(cells[block].nodes.begin(), cells[block].nodes.end());
  }

  template <int dim>
  void
  ElasticCells<dim>::block_tangent(const unsigned int          block,
                                   const Vector               &displacement,
                                   dealii::FullMatrix<double> &matrix) const
  {
    const Cell &cell     = cells[block];
    const auto  geometry = this->geometry(cell);
    matrix.reinit(dim * n_nodes, dim * n_nodes);
    for (unsigned int q = 0; q < n_nodes; ++q)
      {
        const auto A = geometry.jxw[q] * cell.weights[q] *
                       point_tangent(block, geometry, q, displacement.begin());
        for (unsigned int w = 0; w < n_nodes; ++w)
          {
            // A contracted with one gradient serves all rows.
            dealii::Tensor<3, dim> A_gradient;
            for (int i = 0; i < dim; ++i)
              for (int j = 0; j < dim; ++j)
                for (int k = 0; k < dim; ++k)
                  A_gradient[i][j][k] = A[i][j][k] * geometry.gradients[q][w];
            for (unsigned int v = 0; v < n_nodes; ++v)
              for (int i = 0; i < dim; ++i)
                for (int k = 0; k < dim; ++k)
                  {
                    double sum = 0.;
                    for (int j = 0; j < dim; ++j)
                      sum += geometry.gradients[q][v][j] * A_gradient[i][j][k];
                    matrix(dim * v + i, dim * w + k) += sum;
                  }
          }
      }
  }

  template <int dim>
  dealii::Tensor<4, dim>
  ElasticCells<dim>::point_tangent(const unsigned int             cell,
                                   const Mesh::CellGeometry<dim> &geometry,
                                   const unsigned int             q,
                                   const double *displacement) const
  {
    const auto &law = *materials[cells[cell].material];
    const auto  H   = gradient(cells[cell], geometry, q, displacement);
    return extrapolated.empty()
             ? law.tangent(H)
             : Materials::tangent_with_stress(law,
                                              H,
                                              extrapolated[n_nodes * cell + q]);
  }

  template <int dim>
  void
  ElasticCells<dim>::extrapolate_stress(const Vector &displacement,
                                        const Vector &step)
  {
    extrapolated.clear();
    if (is_linear())
      return;
    extrapolated.reserve(n_nodes * cells.size());
    for (const Cell &cell : cells)
      {
        const auto geometry = this->geometry(cell);
        for (unsigned int q = 0; q < n_nodes; ++q)
          extrapolated.push_back(Materials::extrapolated_stress(
            *materials[cell.material],
            gradient(cell, geometry, q, displacement.begin()),
            gradient(cell, geometry, q, step.begin())));
      }
  }

  template <int dim>
  void
  ElasticCells<dim>::forget_stress()
  {
    extrapolated.clear();
  }

  template <int dim>
  void
  add_cell_nodes(const Mesh::NodalMesh<dim> &mesh,
                 std::vector<unsigned int>  &needed)
  {
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.owns_cell(c))
        needed.insert(needed.end(), mesh.cells[c].begin(), mesh.cells[c].end());
    if (mesh.hanging.empty())
      return;
    for (std::size_t k = 0, n = needed.size(); k < n; ++k)
      {
        const auto found = mesh.hanging.find(needed[k]);
        if (found != mesh.hanging.end())
          for (const auto &parent : found->second)
            needed.push_back(parent.first);
      }
  }

  template class ElasticCells<2>;
  template class ElasticCells<3>;
  template void
  add_cell_nodes<2>(const Mesh::NodalMesh<2> &, std::vector<unsigned int> &);
  template void
  add_cell_nodes<3>(const Mesh::NodalMesh<3> &, std::vector<unsigned int> &);
} // namespace Perimorph::Fem
