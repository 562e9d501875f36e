#include <perimorph/coupling/segment_springs.h>
#include <perimorph/mesh/cell_geometry.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <cmath>
#include <utility>

namespace Perimorph::Coupling
{
  namespace
  {
    template <int dim>
    using NodeMatrix = std::array<std::array<double, (1u << dim)>, (1u << dim)>;

    /// Stiffness of the springs against motion along a direction, summed over
    /// dim perpendicular directions.
    template <int dim>
    NodeMatrix<dim>
    trace_of_springs(const CellSprings<dim>                          &cell,
                     const typename Mesh::CellGeometry<dim>::Corners &corners)
    {
      NodeMatrix<dim> trace{};
      for (const auto &spring : cell.springs)
        {
          std::array<double, (1u << dim)> jump{};
          dealii::Tensor<1, dim>          xi;
          for (unsigned int v = 1; v < jump.size(); ++v)
            {
              jump[v] = spring.jump[v - 1];
              jump[0] -= jump[v];
              xi += jump[v] * (corners[v] - corners[0]);
            }
          const double stiffness = spring.tension / xi.norm();
          for (unsigned int v = 0; v < jump.size(); ++v)
            for (unsigned int w = 0; w < jump.size(); ++w)
              trace[v][w] += stiffness * jump[v] * jump[w];
        }
      return trace;
    }

    /// The same for the tensors of the Gauss points.
    template <int dim>
    NodeMatrix<dim>
    trace_of_tensors(const typename SegmentResidual<dim>::PointTensors &tensors,
                     const Mesh::CellGeometry<dim> &geometry)
    {
      NodeMatrix<dim> trace{};
      for (unsigned int q = 0; q < geometry.n_points; ++q)
        {
          dealii::Tensor<2, dim> contracted;
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              for (int c = 0; c < dim; ++c)
                contracted[b][c] += geometry.jxw[q] * tensors[q](a, b, a, c);
          for (unsigned int v = 0; v < geometry.n_nodes; ++v)
            for (unsigned int w = 0; w < geometry.n_nodes; ++w)
              trace[v][w] += geometry.gradients[q][v] *
                             (contracted * geometry.gradients[q][w]);
        }
      return trace;
    }

    /// Takes all affine fields out of rows and columns, to round-off.
    template <int dim>
    void
    remove_affine(const typename Mesh::CellGeometry<dim>::Corners &corners,
                  NodeMatrix<dim>                                 &matrix)
    {
      constexpr unsigned int                           n_nodes = 1u << dim;
      std::array<std::array<double, n_nodes>, dim + 1> basis;
      const auto dot = [](const auto &a, const auto &b) {
        double sum = 0.;
        for (unsigned int v = 0; v < n_nodes; ++v)
          sum += a[v] * b[v];
        return sum;
      };
      const auto subtract = [&](const auto &direction, auto &vector) {
        const double part = dot(direction, vector);
        for (unsigned int v = 0; v < n_nodes; ++v)
          vector[v] -= part * direction[v];
      };

      const double size = corners[0].distance(corners[n_nodes - 1]);
      for (unsigned int k = 0; k <= dim; ++k)
        {
          for (unsigned int v = 0; v < n_nodes; ++v)
            basis[k][v] = k == 0 ? 1. : (corners[v] - corners[0])[k - 1] / size;
          // Twice is enough for orthogonality to round-off.
          for (unsigned int pass = 0; pass < 2; ++pass)
            for (unsigned int j = 0; j < k; ++j)
              subtract(basis[j], basis[k]);
          const double norm = std::sqrt(dot(basis[k], basis[k]));
          for (auto &entry : basis[k])
            entry /= norm;
        }
      const auto transpose = [&]() {
        for (unsigned int v = 0; v < n_nodes; ++v)
          for (unsigned int w = 0; w < v; ++w)
            std::swap(matrix[v][w], matrix[w][v]);
      };
      for (unsigned int side = 0; side < 2; ++side)
        {
          for (auto &row : matrix)
            for (unsigned int pass = 0; pass < 2; ++pass)
              for (const auto &direction : basis)
                subtract(direction, row);
          transpose();
        }
      for (unsigned int v = 0; v < n_nodes; ++v)
        for (unsigned int w = 0; w < v; ++w)
          matrix[v][w] = matrix[w][v] = 0.5 * (matrix[v][w] + matrix[w][v]);
    }
  } // namespace

  template <int dim>
  SegmentSprings<dim>::SegmentSprings(const Mesh::NodalMesh<dim> &mesh)
    : mesh(mesh)
    , position_of_cell(mesh.n_cells(), dealii::numbers::invalid_unsigned_int)
  {}

  template <int dim>
  void
  SegmentSprings<dim>::add_bond(
    const double                                 stiffness,
    const double                                 length,
    const std::vector<Bonds::SegmentPiece<dim>> &pieces)
  {
    for (const auto &piece : pieces)
      {
        if (!mesh.owns_cell(piece.cell))
          continue;
        unsigned int &position = position_of_cell[piece.cell];
        if (position == dealii::numbers::invalid_unsigned_int)
          {
            position = cells.size();
            cells.push_back({piece.cell, {}, {}});
          }
        CellSpring<dim> spring;
        for (unsigned int v = 1; v < piece.shape_end.size(); ++v)
          spring.jump[v - 1] = piece.shape_end[v] - piece.shape_begin[v];
        spring.tension = piece.share * stiffness * length;
        cells[position].springs.push_back(spring);
      }
  }

  template <int dim>
  std::vector<CellSprings<dim>>
  SegmentSprings<dim>::finish(const SegmentResidual<dim> &residual)
  {
    AssertDimension(cells.size(), residual.touched_cells().size());
    for (unsigned int k = 0; k < cells.size(); ++k)
      {
        CellSprings<dim> &cell = cells[k];
        Assert(cell.cell == residual.touched_cells()[k],
               dealii::ExcMessage("not the same bonds"));
        cell.springs.shrink_to_fit();
        const auto corners    = mesh.corners(cell.cell);
        const auto of_springs = trace_of_springs<dim>(cell, corners);
        const auto of_tensors =
          trace_of_tensors<dim>(residual.tensors(k),
                                Mesh::CellGeometry<dim>(corners));
        for (unsigned int v = 0; v < cell.n_nodes; ++v)
          for (unsigned int w = 0; w < cell.n_nodes; ++w)
            cell.stabilization[v][w] =
              (of_springs[v][w] - of_tensors[v][w]) / dim;
        remove_affine<dim>(corners, cell.stabilization);
      }
    return std::move(cells);
  }

  template class SegmentSprings<2>;
  template class SegmentSprings<3>;
} // namespace Perimorph::Coupling
