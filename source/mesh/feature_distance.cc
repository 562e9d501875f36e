#include <perimorph/base/point_cloud.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Perimorph::Mesh
{
  template <int dim>
  dealii::Point<dim>
  closest_on_segment(const dealii::Point<dim> &point,
                     const dealii::Point<dim> &a,
                     const dealii::Point<dim> &b)
  {
    const auto   direction = b - a;
    const double length2   = direction.norm_square();
    const double s         = length2 > 0.
                               ? std::clamp(((point - a) * direction) / length2, 0., 1.)
                               : 0.;
    return a + s * direction;
  }

  dealii::Point<3>
  closest_on_triangle(const dealii::Point<3> &point,
                      const dealii::Point<3> &a,
                      const dealii::Point<3> &b,
                      const dealii::Point<3> &c)
  {
    const dealii::Tensor<1, 3> ab = b - a, ac = c - a, ap = point - a;
    const auto                 normal = cross_product_3d(ab, ac);
    const double               area2  = normal.norm_square();
    if (area2 > 0.)
      {
        // Barycentric coordinates of the projection.
        const double v = (cross_product_3d(ap, ac) * normal) / area2;
        const double w = (cross_product_3d(ab, ap) * normal) / area2;
        if (v >= 0. && w >= 0. && v + w <= 1.)
          return a + v * ab + w * ac;
      }
    const std::array<dealii::Point<3>, 3> candidates = {
      {closest_on_segment(point, a, b),
       closest_on_segment(point, b, c),
       closest_on_segment(point, c, a)}};
    return *std::min_element(candidates.begin(),
                             candidates.end(),
                             [&](const auto &p, const auto &q) {
                               return p.distance_square(point) <
                                      q.distance_square(point);
                             });
  }

  /// Faces of a boundary, or the outer faces of a set of cells, with search
  /// trees of their corners and centres.
  template <int dim>
  class FeatureDistance<dim>::Facets
  {
  public:
    static constexpr unsigned int n = 1u << (dim - 1);
    using Facet                     = std::array<dealii::Point<dim>, n>;

    explicit Facets(std::vector<Facet> list)
      : facets(std::move(list))
      , corners(corner_points())
      , centers(center_points())
    {
      for (unsigned int k = 0; k < facets.size(); ++k)
        for (const auto &corner : facets[k])
          radius = std::max(radius, centers.points()[k].distance(corner));
    }

    ClosestPoint<dim>
    closest(const dealii::Point<dim> &point, const RangeOf &range_of) const
    {
      const auto        nearest = corners.nearest(point);
      ClosestPoint<dim> best{nearest.second, corners.points()[nearest.first]};
      const auto        range = range_of(best.point);
      if (best.distance <= range.lower ||
          best.distance - 2. * radius > range.upper)
        return best;
      const auto look_at = [&](const unsigned int k) {
        const auto   on_facet = closest_on(facets[k], point);
        const double distance = on_facet.distance(point);
        if (distance < best.distance)
          best = {distance, on_facet};
      };
      // A good bound first: a facet that is nearer has its centre within the
      // bound plus the radius.
      look_at(centers.nearest(point).first);
      std::vector<unsigned int> near;
      centers.within(point, best.distance + radius, near);
      for (const unsigned int k : near)
        if (centers.points()[k].distance(point) - radius < best.distance)
          look_at(k);
      return best;
    }

  private:
    std::vector<Facet>    facets;
    Base::PointCloud<dim> corners, centers;
    double                radius = 0.; ///< largest, of a facet from its centre

    std::vector<dealii::Point<dim>>
    corner_points() const
    {
      std::vector<dealii::Point<dim>> points;
      for (const auto &facet : facets)
        points.insert(points.end(), facet.begin(), facet.end());
      return points;
    }

    std::vector<dealii::Point<dim>>
    center_points() const
    {
      std::vector<dealii::Point<dim>> points;
      for (const auto &facet : facets)
        {
          dealii::Tensor<1, dim> sum;
          for (const auto &corner : facet)
            sum += corner;
          points.emplace_back(sum / double(n));
        }
      return points;
    }

    static dealii::Point<dim>
    closest_on(const Facet &facet, const dealii::Point<dim> &point)
    {
      if constexpr (dim == 2)
        return closest_on_segment(point, facet[0], facet[1]);
      else
        {
          const auto p =
            closest_on_triangle(point, facet[0], facet[1], facet[2]);
          const auto q =
            closest_on_triangle(point, facet[3], facet[1], facet[2]);
          return p.distance(point) <= q.distance(point) ? p : q;
        }
    }
  };

  namespace
  {
    /// Outer faces of a set of cells: those that occur once.
    template <int dim>
    std::vector<std::array<dealii::Point<dim>, (1u << (dim - 1))>>
    skin_of_cells(const NodalMesh<dim>            &mesh,
                  const std::vector<unsigned int> &cells)
    {
      using Face = std::array<unsigned int, (1u << (dim - 1))>;
      std::map<Face, std::pair<Face, unsigned int>> count;
      for (const unsigned int c : cells)
        for (unsigned int f = 0; f < 2 * dim; ++f)
          {
            Face         face;
            unsigned int k = 0;
            for (unsigned int v = 0; v < mesh.nodes_per_cell; ++v)
              if (((v >> (f / 2)) & 1u) == f % 2)
                face[k++] = mesh.cells[c][v];
            Face sorted = face;
            std::sort(sorted.begin(), sorted.end());
            auto &entry = count[sorted];
            entry.first = face;
            ++entry.second;
          }
      std::vector<std::array<dealii::Point<dim>, (1u << (dim - 1))>> skin;
      for (const auto &entry : count)
        if (entry.second.second == 1)
          {
            skin.emplace_back();
            for (unsigned int v = 0; v < skin.back().size(); ++v)
              skin.back()[v] = mesh.nodes[entry.second.first[v]];
          }
      return skin;
    }

    template <int dim>
    dealii::Point<dim>
    read_point(const std::vector<double> &numbers, const unsigned int first)
    {
      dealii::Point<dim> point;
      for (int d = 0; d < dim; ++d)
        point[d] = numbers[first + d];
      return point;
    }
  } // namespace

  template <int dim>
  FeatureDistance<dim>::FeatureDistance(const Parameters::Feature  &feature,
                                        const DistributedMesh<dim> &mesh,
                                        const std::string          &used_by)
    : feature(feature)
  {
    const auto &nodal = mesh.nodal();
    if (feature.kind == Parameters::FeatureKind::boundary)
      {
        std::vector<typename Facets::Facet> list;
        for (const unsigned int f : mesh.boundary(feature.name, used_by))
          {
            list.emplace_back();
            for (unsigned int v = 0; v < Facets::n; ++v)
              list.back()[v] = nodal.nodes[nodal.boundary_faces[f].nodes[v]];
          }
        facets = std::make_unique<Facets>(std::move(list));
      }
    else if (feature.kind == Parameters::FeatureKind::volume)
      {
        const auto &cells = mesh.volume(feature.name, used_by);
        facets = std::make_unique<Facets>(skin_of_cells(nodal, cells));
        inside.assign(nodal.n_nodes(), false);
        for (const unsigned int c : cells)
          for (const unsigned int n : nodal.cells[c])
            inside[n] = true;
      }
  }

  template <int dim>
  FeatureDistance<dim>::~FeatureDistance() = default;
  template <int dim>
  FeatureDistance<dim>::FeatureDistance(FeatureDistance &&) noexcept = default;

  template <int dim>
  ClosestPoint<dim>
  FeatureDistance<dim>::closest_to_node(const NodalMesh<dim> &mesh,
                                        const unsigned int    node,
                                        const RangeOf        &range) const
  {
    if (!inside.empty() && inside[node])
      return {0., mesh.nodes[node]};
    return closest(mesh.nodes[node], range);
  }

  template <int dim>
  ClosestPoint<dim>
  FeatureDistance<dim>::closest_to_cell(const NodalMesh<dim> &mesh,
                                        const unsigned int    cell,
                                        const RangeOf        &range) const
  {
    const auto &nodes = mesh.cells[cell];
    const auto  is_in = [this](const unsigned int n) { return inside[n]; };
    if (!inside.empty() && std::all_of(nodes.begin(), nodes.end(), is_in))
      return {0., mesh.cell_centroid[cell]};
    return closest(mesh.cell_centroid[cell], range);
  }

  template <int dim>
  ClosestPoint<dim>
  FeatureDistance<dim>::closest(const dealii::Point<dim> &point,
                                const RangeOf            &range) const
  {
    using Parameters::FeatureKind;
    const auto &x = feature.numbers;
    switch (feature.kind)
      {
        case FeatureKind::boundary:
        case FeatureKind::volume:
          return facets->closest(point, range);
        case FeatureKind::point:
          {
            const auto p = read_point<dim>(x, 0);
            return {p.distance(point), p};
          }
        case FeatureKind::segment:
          {
            const auto p = closest_on_segment(point,
                                              read_point<dim>(x, 0),
                                              read_point<dim>(x, dim));
            return {p.distance(point), p};
          }
        case FeatureKind::plane:
          {
            const auto                   base = read_point<dim>(x, 0);
            const dealii::Tensor<1, dim> normal(read_point<dim>(x, dim));
            const auto                   p =
              point - ((point - base) * normal / normal.norm_square()) * normal;
            return {p.distance(point), p};
          }
        case FeatureKind::triangle:
          if constexpr (dim == 3)
            {
              const auto p = closest_on_triangle(point,
                                                 read_point<dim>(x, 0),
                                                 read_point<dim>(x, 3),
                                                 read_point<dim>(x, 6));
              return {p.distance(point), p};
            }
          break;
        case FeatureKind::box:
          {
            const auto         lower = read_point<dim>(x, 0);
            const auto         upper = read_point<dim>(x, dim);
            dealii::Point<dim> p;
            for (int d = 0; d < dim; ++d)
              p[d] = std::clamp(point[d], lower[d], upper[d]);
            return {p.distance(point), p};
          }
        case FeatureKind::ball:
          {
            const auto   center   = read_point<dim>(x, 0);
            const double radius   = x[dim];
            const double distance = center.distance(point);
            if (distance <= radius)
              return {0., point};
            return {distance - radius,
                    center + (radius / distance) * (point - center)};
          }
      }
    return {};
  }

  template class FeatureDistance<2>;
  template class FeatureDistance<3>;
  template dealii::Point<2>
  closest_on_segment<2>(const dealii::Point<2> &,
                        const dealii::Point<2> &,
                        const dealii::Point<2> &);
  template dealii::Point<3>
  closest_on_segment<3>(const dealii::Point<3> &,
                        const dealii::Point<3> &,
                        const dealii::Point<3> &);
} // namespace Perimorph::Mesh
