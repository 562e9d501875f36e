#include <perimorph/coupling/moment_system.h>
#include <perimorph/coupling/segment_residual.h>
#include <perimorph/mesh/cell_geometry.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Perimorph
{
  namespace Coupling
  {
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
      const auto &triples = symmetric_indices<dim>.triples;
      std::array<double, n_force_components> triad;
      for (unsigned int t = 0; t < n_force_components; ++t)
        triad[t] = direction[triples[t][0]] * direction[triples[t][1]] *
                   direction[triples[t][2]];

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
      Report            report;
      MomentSystem<dim> system;
      solution.resize(cells.size());
      double largest_moment = 0.;
      for (unsigned int k = 0; k < cells.size(); ++k)
        {
          const auto                    corners = mesh.corners(cells[k]);
          const Mesh::CellGeometry<dim> geometry(corners);
          system.solve(corners, geometry, sums[k], solution[k]);

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

    template class SegmentResidual<2>;
    template class SegmentResidual<3>;
  } // namespace Coupling
} // namespace Perimorph
