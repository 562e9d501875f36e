#include <perimorph/coupling/moment_system.h>

#include <cmath>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Smallest eigenvalue or pivot over the largest (numerics-explicit.md,
    /// section 3).
    constexpr double relative_cut = 1e-10;

    template <int dim>
    constexpr unsigned int rank_of_cell = dim == 2 ? 9 : 55;
  } // namespace

  template <int dim>
  MomentSystem<dim>::MomentSystem()
  {
    const auto &table = symmetric_indices<dim>;
    for (unsigned int t = 0; t < n3; ++t)
      root3[t] = std::sqrt(table.multiplicity3[t]);
    // K_(abc)d x_d has no symmetric gradient when the extensions of each
    // component, weighted by the multiplicity of their triples, add up to
    // zero: the projector on these K.
    std::array<double, n4> length_square{};
    for (const auto &extension : table.extensions)
      length_square[extension.component] +=
        table.multiplicity3[extension.triple];
    for (const auto &row : table.extensions)
      for (const auto &column : table.extensions)
        if (row.component == column.component)
          {
            const double roots = root3[row.triple] * root3[column.triple];
            couplings.push_back({row.triple,
                                 row.axis,
                                 column.triple,
                                 column.axis,
                                 roots / table.multiplicity4[row.component],
                                 (row.axis == column.axis ? 1. : 0.) -
                                   roots / length_square[row.component]});
          }
  }

  template <int dim>
  void
  MomentSystem<dim>::fill(
    const typename Mesh::CellGeometry<dim>::Corners &corners,
    const Mesh::CellGeometry<dim>                   &geometry)
  {
    dealii::Tensor<1, dim> centre;
    for (const auto &corner : corners)
      centre += dealii::Tensor<1, dim>(corner) / n_nodes;
    std::array<dealii::Tensor<1, dim>, n_nodes> x;
    double                                      size_square = 0.;
    for (unsigned int l = 0; l < n_nodes; ++l)
      {
        x[l] = corners[l] - centre;
        size_square += x[l].norm_square();
      }
    square.setZero();
    null_square.setZero();
    for (unsigned int l = 0; l < n_nodes; ++l)
      for (unsigned int m = 0; m <= l; ++m)
        {
          std::array<double, dim * dim> products{}, positions{};
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e < dim; ++e)
              {
                for (unsigned int q = 0; q < n_points; ++q)
                  products[dim * d + e] += geometry.jxw[q] *
                                           geometry.gradients[q][l][d] *
                                           geometry.gradients[q][m][e];
                positions[dim * d + e] = x[l][d] * x[m][e] / size_square;
              }
          for (const auto &c : couplings)
            {
              const unsigned int row    = l * n3 + c.row_triple;
              const unsigned int column = m * n3 + c.column_triple;
              const unsigned int axes   = dim * c.row_axis + c.column_axis;
              square(row, column) += c.factor * products[axes];
              null_square(row, column) += c.null_factor * positions[axes];
            }
          for (unsigned int t = 0; t < n3; ++t)
            null_square(l * n3 + t, m * n3 + t) += 1. / n_nodes;
        }
  }

  template <int dim>
  void
  MomentSystem<dim>::add_tensors(const Mesh::CellGeometry<dim> &geometry,
                                 const Vector                  &multipliers,
                                 PointTensors                  &tensors) const
  {
    const auto &table = symmetric_indices<dim>;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        std::array<double, dim * n3> gradient{};
        for (unsigned int l = 0; l < n_nodes; ++l)
          for (unsigned int t = 0; t < n3; ++t)
            for (unsigned int d = 0; d < dim; ++d)
              gradient[dim * t + d] +=
                multipliers[l * n3 + t] * geometry.gradients[q][l][d];
        for (unsigned int k = 0; k < gradient.size(); ++k)
          {
            const auto &[t, d, c] = table.extensions[k];
            tensors[q].components[c] +=
              gradient[k] * root3[t] / table.multiplicity4[c];
          }
      }
  }

  template <int dim>
  typename MomentSystem<dim>::Vector
  MomentSystem<dim>::rest(const Mesh::CellGeometry<dim> &geometry,
                          const Vector                  &right,
                          const PointTensors            &tensors) const
  {
    const auto &table  = symmetric_indices<dim>;
    Vector      result = right;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        std::array<double, dim * n3> full;
        for (unsigned int k = 0; k < full.size(); ++k)
          {
            const auto &[t, d, c] = table.extensions[k];
            full[k] = geometry.jxw[q] * root3[t] * tensors[q].components[c];
          }
        for (unsigned int l = 0; l < n_nodes; ++l)
          for (unsigned int t = 0; t < n3; ++t)
            for (unsigned int d = 0; d < dim; ++d)
              result[l * n3 + t] -=
                full[dim * t + d] * geometry.gradients[q][l][d];
      }
    return result;
  }

  template <int dim>
  void
  MomentSystem<dim>::solve(
    const typename Mesh::CellGeometry<dim>::Corners &corners,
    const Mesh::CellGeometry<dim>                   &geometry,
    const Moments                                   &moments,
    PointTensors                                    &tensors)
  {
    Vector right;
    for (unsigned int l = 0; l < n_nodes; ++l)
      for (unsigned int t = 0; t < n3; ++t)
        right[l * n3 + t] = root3[t] * moments[l][t];

    fill(corners, geometry);
    const double largest = square.diagonal().maxCoeff();
    // Null fields of the size of the matrix.
    null_square *= square.diagonal().mean();
    null_square += square;
    cholesky.compute(null_square);
    const auto &pivots = cholesky.matrixLLT().diagonal();
    const bool  is_regular =
      cholesky.info() == Eigen::Success &&
      pivots.minCoeff() * pivots.minCoeff() > relative_cut * largest;
    Eigen::VectorXd inverse;
    if (is_regular)
      // Regular although the null fields add no more than they are.
      rank = rank_of_cell<dim>;
    else
      {
        eigen.compute(square); // reads the lower triangle
        inverse = eigen.eigenvalues();
        rank    = 0;
        for (double &value : inverse)
          {
            const bool keep =
              value > relative_cut * eigen.eigenvalues()[n_rows - 1];
            value = keep ? 1. / value : 0.;
            rank += keep;
          }
      }
    tensors        = {};
    Vector missing = right;
    // The second pass restores the digits that the square A A^T has cost.
    for (unsigned int pass = 0; pass < 2; ++pass)
      {
        Vector multipliers;
        if (is_regular)
          multipliers = cholesky.solve(missing);
        else
          multipliers =
            eigen.eigenvectors() *
            inverse.cwiseProduct(eigen.eigenvectors().transpose() * missing);
        add_tensors(geometry, multipliers, tensors);
        missing = rest(geometry, right, tensors);
      }
    moment   = right.norm();
    residual = missing.norm();
  }

  template class MomentSystem<2>;
  template class MomentSystem<3>;
} // namespace Perimorph::Coupling
