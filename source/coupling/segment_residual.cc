#include <perimorph/coupling/segment_residual.h>
#include <perimorph/mesh/cell_geometry.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace Perimorph
{
  namespace Coupling
  {
    namespace
    {
      /// Components of fully symmetric tensors of rank 3 and 4: which one an
      /// index belongs to, how many indices it has.
      template <int dim>
      struct Numbering
      {
        static constexpr unsigned int n3 = dim == 2 ? 4 : 10;
        static constexpr unsigned int n4 =
          FullySymmetricTensor<dim>::n_components;

        std::array<unsigned int, dim * dim * dim * dim> of_index4;
        std::array<unsigned int, n4>                    multiplicity4{};
        std::array<unsigned int, n3>                    multiplicity3{};
        std::array<std::array<unsigned int, 3>, n3>     sorted3;
        std::array<std::array<unsigned int, 4>, n4>     sorted4;

        Numbering()
        {
          unsigned int n = 0;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = a; b < dim; ++b)
              for (unsigned int c = b; c < dim; ++c)
                for (unsigned int d = c; d < dim; ++d)
                  sorted4[n++] = {{a, b, c, d}};
          n = 0;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = a; b < dim; ++b)
              for (unsigned int c = b; c < dim; ++c)
                sorted3[n++] = {{a, b, c}};

          for (unsigned int index = 0; index < of_index4.size(); ++index)
            {
              std::array<unsigned int, 4> digits;
              for (unsigned int k = 0, rest = index; k < 4; ++k, rest /= dim)
                digits[k] = rest % dim;
              std::sort(digits.begin(), digits.end());
              of_index4[index] =
                std::find(sorted4.begin(), sorted4.end(), digits) -
                sorted4.begin();
              ++multiplicity4[of_index4[index]];
            }
          for (unsigned int index = 0; index < dim * dim * dim; ++index)
            {
              std::array<unsigned int, 3> digits{
                {index % dim, index / dim % dim, index / (dim * dim)}};
              std::sort(digits.begin(), digits.end());
              ++multiplicity3[std::find(sorted3.begin(),
                                        sorted3.end(),
                                        digits) -
                              sorted3.begin()];
            }
        }
      };

      template <int dim>
      const Numbering<dim> &
      numbering()
      {
        static const Numbering<dim> instance;
        return instance;
      }

      /// Shortest C_q that meets the constraints of one cell. It is also the
      /// one nearest to a constant: the constraints fix the mean over the cell.
      ///
      /// With y = sqrt(w_q multiplicity) C_q the problem is: shortest y with
      /// A y = b. The rows are scaled by the square root of their multiplicity
      /// too, so that the rank does not depend on the orientation of the cell.
      template <int dim>
      class CellSystem
      {
      public:
        static constexpr unsigned int n_points = 1u << dim;
        static constexpr unsigned int n3       = Numbering<dim>::n3;
        static constexpr unsigned int n4       = Numbering<dim>::n4;
        static constexpr int          n_rows   = n_points * n3;
        static constexpr int          n_cols   = n_points * n4;

        using Moments      = std::array<std::array<double, n3>, n_points>;
        using PointTensors = std::array<FullySymmetricTensor<dim>, n_points>;

        // Of the last cell: size of T_l, and by how much it is missed.
        double       moment   = 0.;
        double       residual = 0.;
        unsigned int rank     = 0;

        CellSystem()
          : A(n_rows, n_cols)
          , b(n_rows)
          , eigen(n_rows)
        {}

        void
        solve(const Mesh::CellGeometry<dim> &geometry,
              const Moments                 &moments,
              PointTensors                  &tensors)
        {
          const auto &table = numbering<dim>();
          fill(geometry);

          for (unsigned int l = 0; l < n_points; ++l)
            for (unsigned int t = 0; t < n3; ++t)
              b[l * n3 + t] = std::sqrt(table.multiplicity3[t]) * moments[l][t];

          eigen.compute(A * A.transpose());
          const double    largest = eigen.eigenvalues()[n_rows - 1];
          Eigen::VectorXd inverse(n_rows);
          rank = 0;
          for (int r = 0; r < n_rows; ++r)
            {
              // 1e-10: numerics-explicit.md, section 3.
              const bool keep = eigen.eigenvalues()[r] > 1e-10 * largest;
              inverse[r]      = keep ? 1. / eigen.eigenvalues()[r] : 0.;
              rank += keep;
            }
          // The second pass restores the digits that the square A A^T has cost.
          Eigen::VectorXd y = Eigen::VectorXd::Zero(n_cols);
          for (unsigned int pass = 0; pass < 2; ++pass)
            y += A.transpose() *
                 (eigen.eigenvectors() *
                  inverse.cwiseProduct(eigen.eigenvectors().transpose() *
                                       (b - A * y)));
          moment   = b.norm();
          residual = (b - A * y).norm();

          for (unsigned int q = 0; q < n_points; ++q)
            for (unsigned int c = 0; c < n4; ++c)
              tensors[q].components[c] =
                y[q * n4 + c] /
                std::sqrt(geometry.jxw[q] * table.multiplicity4[c]);
        }

      private:
        /// Row (l, abc), column (q, abcd) of sum_q w_q C_q grad N_l(x_q) = T_l.
        void
        fill(const Mesh::CellGeometry<dim> &geometry)
        {
          const auto &table = numbering<dim>();
          A.setZero();
          for (unsigned int l = 0; l < n_points; ++l)
            for (unsigned int q = 0; q < n_points; ++q)
              for (unsigned int t = 0; t < n3; ++t)
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    const auto        &abc = table.sorted3[t];
                    const unsigned int c =
                      FullySymmetricTensor<dim>::component(abc[0],
                                                           abc[1],
                                                           abc[2],
                                                           d);
                    A(l * n3 + t, q * n4 + c) +=
                      geometry.gradients[q][l][d] *
                      std::sqrt(geometry.jxw[q] * table.multiplicity3[t] /
                                table.multiplicity4[c]);
                  }
        }

        Eigen::MatrixXd                                A;
        Eigen::VectorXd                                b;
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
      };
    } // namespace

    template <int dim>
    FullySymmetricTensor<dim>
    FullySymmetricTensor<dim>::dyad(const dealii::Tensor<1, dim> &direction)
    {
      const auto          &sorted = numbering<dim>().sorted4;
      FullySymmetricTensor result;
      for (unsigned int c = 0; c < n_components; ++c)
        result.components[c] =
          direction[sorted[c][0]] * direction[sorted[c][1]] *
          direction[sorted[c][2]] * direction[sorted[c][3]];
      return result;
    }

    template <int dim>
    unsigned int
    FullySymmetricTensor<dim>::component(const unsigned int a,
                                         const unsigned int b,
                                         const unsigned int c,
                                         const unsigned int d)
    {
      return numbering<dim>().of_index4[a + dim * (b + dim * (c + dim * d))];
    }

    template <int dim>
    unsigned int
    FullySymmetricTensor<dim>::multiplicity(const unsigned int component)
    {
      return numbering<dim>().multiplicity4[component];
    }

    template <int dim>
    void
    FullySymmetricTensor<dim>::add(const double                factor,
                                   const FullySymmetricTensor &other)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        components[c] += factor * other.components[c];
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim>
    FullySymmetricTensor<dim>::contract(
      const dealii::SymmetricTensor<2, dim> &strain) const
    {
      dealii::SymmetricTensor<2, dim> stress;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = a; b < dim; ++b)
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              stress[a][b] += (*this)(a, b, c, d) * strain[c][d];
      return stress;
    }

    template <int dim>
    dealii::Tensor<4, dim>
    FullySymmetricTensor<dim>::full() const
    {
      dealii::Tensor<4, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              result[a][b][c][d] = (*this)(a, b, c, d);
      return result;
    }

    template <int dim>
    double
    FullySymmetricTensor<dim>::norm() const
    {
      double square = 0.;
      for (unsigned int c = 0; c < n_components; ++c)
        square += multiplicity(c) * components[c] * components[c];
      return std::sqrt(square);
    }

    template <int dim>
    SegmentResidual<dim>::SegmentResidual(const Mesh::NodalMesh<dim> &mesh,
                                          const bool owned_cells_only)
      : mesh(mesh)
      , owned_cells_only(owned_cells_only)
      , position_of_cell(mesh.n_cells(), dealii::numbers::invalid_unsigned_int)
    {}

    template <int dim>
    void
    SegmentResidual<dim>::add_bond(
      const dealii::Tensor<1, dim>                &direction,
      const double                                 stiffness,
      const double                                 length,
      const std::vector<Bonds::SegmentPiece<dim>> &pieces)
    {
      const auto                            &sorted3 = numbering<dim>().sorted3;
      std::array<double, n_force_components> triad;
      for (unsigned int t = 0; t < n_force_components; ++t)
        triad[t] = direction[sorted3[t][0]] * direction[sorted3[t][1]] *
                   direction[sorted3[t][2]];

      Assert(solution.empty(), dealii::ExcMessage("add_bond() after solve()"));
      for (const auto &piece : pieces)
        {
          if (owned_cells_only && !mesh.owns_cell(piece.cell))
            continue;
          unsigned int &position = position_of_cell[piece.cell];
          if (position == dealii::numbers::invalid_unsigned_int)
            {
              position = cells.size();
              cells.push_back(piece.cell);
              sums.emplace_back();
            }
          const double factor = piece.share * stiffness * length;
          for (unsigned int l = 0; l < n_nodes; ++l)
            {
              const double jump = piece.shape_end[l] - piece.shape_begin[l];
              for (unsigned int t = 0; t < n_force_components; ++t)
                sums[position][l][t] += factor * jump * triad[t];
            }
        }
    }

    template <int dim>
    typename SegmentResidual<dim>::Report
    SegmentResidual<dim>::solve()
    {
      AssertDimension(sums.size(), cells.size());
      Report          report;
      CellSystem<dim> system;
      solution.resize(cells.size());
      double largest_moment = 0.;
      for (unsigned int k = 0; k < cells.size(); ++k)
        {
          const Mesh::CellGeometry<dim> geometry(mesh.corners(cells[k]));
          system.solve(geometry, sums[k], solution[k]);

          // Moments are stiffness times area.
          double volume = 0.;
          for (const double weight : geometry.jxw)
            volume += weight;
          const double area = std::pow(volume, 1. - 1. / dim);
          report.largest_residual =
            std::max(report.largest_residual, system.residual / area);
          largest_moment      = std::max(largest_moment, system.moment / area);
          report.largest_rank = std::max(report.largest_rank, system.rank);
          report.smallest_rank =
            k == 0 ? system.rank : std::min(report.smallest_rank, system.rank);
        }
      if (largest_moment > 0.)
        report.largest_residual /= largest_moment;
      std::vector<Moments>().swap(sums);
      return report;
    }

    template struct FullySymmetricTensor<2>;
    template struct FullySymmetricTensor<3>;
    template class SegmentResidual<2>;
    template class SegmentResidual<3>;
  } // namespace Coupling
} // namespace Perimorph
