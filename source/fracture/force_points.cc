#include <perimorph/fracture/cells_at_cracks.h>
#include <perimorph/fracture/force_points.h>
#include <perimorph/mesh/cell_geometry.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

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

  void
  smooth_towards_tip(const TipFrame<2>      &tip,
                     const NearTipConstants &constants,
                     const double            reach,
                     const MPI_Comm          communicator,
                     StressPointSet<2>      &set)
  {
    constexpr unsigned int n            = 4;
    const auto             displacement = [&](const NearTipField      field,
                                  const dealii::Point<2> &place) {
      return near_tip_state(field, constants, tip, place).displacement;
    };
    // All fields of about one size
    const double size =
      displacement(NearTipField::opening, tip.origin + reach * tip.axes[1])
        .norm();
    const auto fields_at = [&](const ForcePoint<2> &point) {
      const double factor = point.branch / size;
      return std::array<dealii::Tensor<1, 2>, n>{
        {tip.axes[0],
         tip.axes[1],
         factor * displacement(NearTipField::opening, point.owner),
         factor * displacement(NearTipField::sliding, point.owner)}};
    };

    std::array<double, n *(n + 1)> sums = {}, all;
    for (const auto &point : set.force_points)
      {
        const double distance = point.owner.distance(tip.origin);
        if (distance < reach || distance >= 2. * reach)
          continue;
        const auto fields = fields_at(point);
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int j = 0; j < n; ++j)
              sums[n * i + j] += point.volume * fields[i] * fields[j];
            sums[n * n + i] +=
              point.volume * fields[i] * point.stress_divergence;
          }
      }
    dealii::Utilities::MPI::sum(
      dealii::ArrayView<const double>(sums.data(), sums.size()),
      communicator,
      dealii::ArrayView<double>(all.data(), all.size()));
    dealii::LAPACKFullMatrix<double> matrix(n, n);
    dealii::Vector<double>           side(n), factors(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int j = 0; j < n; ++j)
          matrix(i, j) = all[n * i + j];
        side[i] = all[n * n + i];
      }
    // Few points may leave some of the factors open: those are zero.
    matrix.compute_inverse_svd(1e-8);
    matrix.vmult(factors, side);

    for (auto &point : set.force_points)
      {
        const double share =
          1. - point.owner.distance(tip.origin) / (2. * reach);
        if (share <= 0.)
          continue;
        const auto           fields = fields_at(point);
        dealii::Tensor<1, 2> smooth;
        for (unsigned int i = 0; i < n; ++i)
          smooth += factors[i] * fields[i];
        point.stress_divergence += share * (smooth - point.stress_divergence);
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
