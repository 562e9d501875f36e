#include <perimorph/bonds/crack_points.h>
#include <perimorph/coupling/cell_parts.h>
#include <perimorph/mesh/cell_geometry.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Sub-cells per direction: 12 in the plane (numerics-cracks.md, C4); in
    /// space visibility is what costs.
    template <int dim>
    constexpr unsigned int n_sub_cells = dim == 2 ? 12 : 6;

    // Of the fit, as for traces (numerics-cracks.md, C2).
    constexpr double       largest_condition = 1e4;
    constexpr unsigned int n_tries           = 7;
    constexpr double       growth            = 1.3;

    template <int dim>
    struct SubCell
    {
      dealii::Point<dim> center;
      double             volume;
    };

    template <int dim>
    std::vector<SubCell<dim>>
    sub_cells(const std::array<dealii::Point<dim>, (1u << dim)> &corners)
    {
      constexpr unsigned int n        = n_sub_cells<dim>;
      const auto             position = [&](const dealii::Point<dim> &unit) {
        const auto         shape = Mesh::shape_values<dim>(unit);
        dealii::Point<dim> x;
        for (unsigned int v = 0; v < corners.size(); ++v)
          x += shape[v] * dealii::Tensor<1, dim>(corners[v]);
        return x;
      };
      unsigned int n_all = 1;
      for (int d = 0; d < dim; ++d)
        n_all *= n;
      std::vector<SubCell<dim>> list;
      for (unsigned int k = 0; k < n_all; ++k)
        {
          dealii::Point<dim> unit;
          for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= n)
            unit[d] = (rest % n + 0.5) / n;
          dealii::Tensor<2, dim> sides;
          for (int d = 0; d < dim; ++d)
            {
              dealii::Point<dim> lower = unit, upper = unit;
              lower[d] -= 0.5 / n;
              upper[d] += 0.5 / n;
              sides[d] = position(upper) - position(lower);
            }
          list.push_back({position(unit), std::abs(determinant(sides))});
        }
      return list;
    }
  } // namespace

  template <int dim>
  CellParts<dim>::CellParts(const Mesh::NodalMesh<dim> &mesh,
                            const Bonds::CrackSet<dim> &cracks,
                            const double                radius_factor)
    : mesh(mesh)
    , cracks(cracks)
    , cloud(mesh.nodes)
    , first_part(mesh.n_cells(), none)
  {
    std::vector<unsigned int> touched;
    for (const auto &point : Bonds::crack_points(mesh, cracks))
      touched.push_back(point.cell);
    // A crack through a node also cuts the corner off that is there.
    std::vector<unsigned int> near;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto corners = mesh.corners(c);
        cracks.near(corners, near);
        if (near.empty())
          continue;
        for (unsigned int v = 0; v < n_nodes; ++v)
          for (unsigned int w = 0; w < v; ++w)
            if (cracks.crosses(corners[v], corners[w]))
              touched.push_back(c);
      }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const unsigned int cell : touched)
      {
        first_part[cell] = list.size();
        split(cell);
      }
    for (auto &part : list)
      fit_gradient(part, radius_factor);
  }

  template <int dim>
  typename CellParts<dim>::Sight
  CellParts<dim>::sight(const unsigned int        cell,
                        const dealii::Point<dim> &point) const
  {
    Sight seen;
    for (unsigned int v = 0; v < n_nodes; ++v)
      seen[v] = !cracks.crosses(point, mesh.nodes[mesh.cells[cell][v]]);
    return seen;
  }

  template <int dim>
  void
  CellParts<dim>::split(const unsigned int cell)
  {
    const auto corners = mesh.corners(cell);
    std::map<unsigned long, std::vector<SubCell<dim>>> groups;
    double                                             sum = 0.;
    for (const auto &sub : sub_cells<dim>(corners))
      {
        groups[sight(cell, sub.center).to_ulong()].push_back(sub);
        sum += sub.volume;
      }
    double volume = 0.;
    for (const double weight : Mesh::CellGeometry<dim>(corners).jxw)
      volume += weight;
    for (const auto &[seen, members] : groups)
      {
        CellPart<dim>          part{cell, 0., {}, {}, {}};
        dealii::Tensor<1, dim> moment;
        for (const auto &sub : members)
          {
            part.volume += sub.volume;
            moment += sub.volume * (sub.center - corners[0]);
          }
        const auto centroid = corners[0] + moment / part.volume;
        // The centroid may lie beyond the crack.
        part.center = std::min_element(members.begin(),
                                       members.end(),
                                       [&](const auto &a, const auto &b) {
                                         return a.center.distance(centroid) <
                                                b.center.distance(centroid);
                                       })
                        ->center;
        part.volume *= volume / sum;
        list.push_back(part);
        sights.emplace_back(seen);
      }
  }

  template <int dim>
  void
  CellParts<dim>::fit_gradient(CellPart<dim> &part,
                               const double   radius_factor) const
  {
    using Moments = Eigen::Matrix<double, dim + 1, dim + 1>;
    using Row     = Eigen::Matrix<double, dim + 1, 1>;

    double spacing = 0.;
    for (const unsigned int n : mesh.cells[part.cell])
      spacing += mesh.spacing[n] / n_nodes;
    std::vector<unsigned int> near;
    double                    radius = radius_factor * spacing;
    for (unsigned int attempt = 0; attempt < n_tries;
         ++attempt, radius *= growth)
      {
        std::vector<Row>    rows;
        std::vector<double> weights;
        Moments             moments = Moments::Zero();
        part.nodes.clear();
        cloud.within(part.center, radius, near);
        for (const unsigned int n : near)
          if (!cracks.crosses(part.center, mesh.nodes[n]))
            {
              Row row;
              row[0]        = 1.;
              const auto xi = mesh.nodes[n] - part.center;
              for (int d = 0; d < dim; ++d)
                row[d + 1] = xi[d] / radius;
              weights.push_back(
                std::exp(-4. * xi.norm_square() / (radius * radius)));
              moments += weights.back() * row * row.transpose();
              rows.push_back(row);
              part.nodes.push_back(n);
            }
        const Eigen::SelfAdjointEigenSolver<Moments> eigen(moments);
        if (part.nodes.size() < dim + 1 ||
            !(eigen.eigenvalues()[0] * largest_condition >
              eigen.eigenvalues()[dim]))
          continue;
        const Moments inverse =
          eigen.eigenvectors() *
          eigen.eigenvalues().cwiseInverse().asDiagonal() *
          eigen.eigenvectors().transpose();
        part.gradients.resize(rows.size());
        for (unsigned int k = 0; k < rows.size(); ++k)
          {
            const Row coefficients = weights[k] * (inverse * rows[k]);
            for (int d = 0; d < dim; ++d)
              part.gradients[k][d] = coefficients[d + 1] / radius;
          }
        return;
      }
    part.nodes.clear();
  }

  template <int dim>
  unsigned int
  CellParts<dim>::part_at(const unsigned int        cell,
                          const dealii::Point<dim> &point) const
  {
    const Sight  seen          = sight(cell, point);
    unsigned int best          = first_part[cell];
    std::size_t  best_mismatch = n_nodes + 1;
    double       best_distance = std::numeric_limits<double>::max();
    for (unsigned int p = first_part[cell];
         p < list.size() && list[p].cell == cell;
         ++p)
      {
        // The sub-cells may have missed a thin part.
        const std::size_t mismatch = (sights[p] ^ seen).count();
        const double      distance = list[p].center.distance(point);
        if (mismatch < best_mismatch ||
            (mismatch == best_mismatch && distance < best_distance))
          {
            best          = p;
            best_mismatch = mismatch;
            best_distance = distance;
          }
      }
    return best;
  }

  template class CellParts<2>;
  template class CellParts<3>;
} // namespace Perimorph::Coupling
