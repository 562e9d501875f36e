#pragma once

#include <perimorph/coupling/fully_symmetric_tensor.h>
#include <perimorph/mesh/cell_geometry.h>

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace Perimorph::Coupling
{
  /// Shortest C_q (fully symmetric, one per Gauss point) with
  /// sum_q w_q C_q grad N_l(x_q) = T_l for the nodes l of one cell
  /// (numerics-explicit.md, section 3). It is also the one nearest to a
  /// constant: the constraints fix the mean over the cell.
  ///
  /// C_q = sym sum_l Z_l (x) grad N_l(x_q) with multipliers Z_l, tensors of
  /// rank 3, that solve A A^T Z = T. The matrix is singular for fields Z whose
  /// symmetric gradient vanishes, constants and rotation-like ones, linear in
  /// x: 4 + 3 in 2D, 10 + 15 in 3D. They are known, their squares are added,
  /// and a Cholesky factorisation does it. A cell where that fails (nearly
  /// degenerate) has its pseudo-inverse.
  ///
  /// Components carry the square root of their multiplicity, so that nothing
  /// depends on the orientation of the cell. Keeps work arrays: one object per
  /// thread.
  template <int dim>
  class MomentSystem
  {
  public:
    static constexpr unsigned int n_points = 1u << dim;
    static constexpr unsigned int n_nodes  = 1u << dim;
    static constexpr unsigned int n3       = SymmetricIndices<dim>::n3;
    static constexpr unsigned int n4       = SymmetricIndices<dim>::n4;
    static constexpr int          n_rows   = n_nodes * n3;

    using Moments      = std::array<std::array<double, n3>, n_nodes>;
    using PointTensors = std::array<FullySymmetricTensor<dim>, n_points>;

    // Of the last cell: size of T_l, and by how much it is missed.
    double       moment   = 0.;
    double       residual = 0.;
    unsigned int rank     = 0;

    MomentSystem();

    void
    solve(const typename Mesh::CellGeometry<dim>::Corners &corners,
          const Mesh::CellGeometry<dim>                   &geometry,
          const Moments                                   &moments,
          PointTensors                                    &tensors);

  private:
    using Matrix = Eigen::Matrix<double, n_rows, n_rows>;
    using Vector = Eigen::Matrix<double, n_rows, 1>;

    /// Pair of extensions of the same component: an entry of the products of
    /// two nodes.
    struct Coupling
    {
      unsigned int row_triple, row_axis;
      unsigned int column_triple, column_axis;
      double       factor;      ///< of A A^T
      double       null_factor; ///< of the rotation-like fields
    };

    /// A A^T, and the squares of its null fields (lower triangles).
    void
    fill(const typename Mesh::CellGeometry<dim>::Corners &corners,
         const Mesh::CellGeometry<dim>                   &geometry);

    /// Adds the C_q of multipliers.
    void
    add_tensors(const Mesh::CellGeometry<dim> &geometry,
                const Vector                  &multipliers,
                PointTensors                  &tensors) const;

    /// What the C_q miss of T_l.
    Vector
    rest(const Mesh::CellGeometry<dim> &geometry,
         const Vector                  &right,
         const PointTensors            &tensors) const;

    std::vector<Coupling>  couplings;
    std::array<double, n3> root3; ///< of the multiplicities
    Matrix                 square;
    Matrix                 null_square;
    Eigen::LLT<Matrix>     cholesky;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  };
} // namespace Perimorph::Coupling
