#include <perimorph/bonds/crack_points.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Bonds
{
  namespace
  {
    /// All points x with normal * (x - point) <= 0.
    template <int dim>
    struct HalfSpace
    {
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> normal; ///< of length one
    };

    /// A convex cell as half-spaces; bent faces of hexahedra by their mean
    /// planes.
    template <int dim>
    std::array<HalfSpace<dim>, 2 * dim>
    half_spaces(const std::array<dealii::Point<dim>, (1u << dim)> &corners)
    {
      std::array<HalfSpace<dim>, 2 * dim> list;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        {
          const unsigned int normal_axis = f / 2, side = f % 2;
          const unsigned int s    = 1u << ((normal_axis + 1) % dim);
          const unsigned int base = side << normal_axis;
          auto              &half = list[f];
          half.point              = corners[base];
          if constexpr (dim == 2)
            {
              const auto along = corners[base + s] - corners[base];
              half.normal[0]   = along[1];
              half.normal[1]   = -along[0];
            }
          else
            {
              const unsigned int t = 1u << ((normal_axis + 2) % dim);
              half.normal =
                cross_product_3d(corners[base + s + t] - corners[base],
                                 corners[base + t] - corners[base + s]);
              dealii::Tensor<1, dim> middle;
              for (const unsigned int k : {0u, s, t, s + t})
                middle += 0.25 * (corners[base + k] - dealii::Point<dim>());
              half.point = dealii::Point<dim>(middle);
            }
          half.normal /= half.normal.norm();
          // Outward: away from the opposite face.
          const auto inward = corners[base ^ (1u << normal_axis)] - half.point;
          if (half.normal * inward > 0.)
            half.normal *= -1.;
        }
      return list;
    }

    /// The part of a segment or convex polygon in a half-space.
    template <int dim>
    std::vector<dealii::Point<dim>>
    clip(const std::vector<dealii::Point<dim>> &polygon,
         const HalfSpace<dim>                  &half,
         const double                           tolerance)
    {
      const unsigned int  n = polygon.size();
      std::vector<double> height(n);
      double              highest = 0., lowest = 0.;
      for (unsigned int k = 0; k < n; ++k)
        {
          height[k] = (polygon[k] - half.point) * half.normal;
          if (std::abs(height[k]) <= tolerance)
            height[k] = 0.;
          highest = std::max(highest, height[k]);
          lowest  = std::min(lowest, height[k]);
        }
      if (highest == 0. && lowest == 0.)
        {
          for (int d = 0; d < dim; ++d)
            if (std::abs(half.normal[d]) > 1e-12)
              return half.normal[d] < 0. ? polygon
                                         : std::vector<dealii::Point<dim>>();
        }
      if (highest == 0.)
        return polygon;
      if (lowest == 0.)
        return {};
      std::vector<dealii::Point<dim>> part;
      const unsigned int              n_edges = dim == 2 ? n - 1 : n;
      for (unsigned int k = 0; k < n; ++k)
        {
          if (height[k] <= 0.)
            part.push_back(polygon[k]);
          if (k == n_edges)
            break;
          const unsigned int next = (k + 1) % n;
          if (height[k] * height[next] < 0.)
            part.push_back(polygon[k] + height[k] / (height[k] - height[next]) *
                                          (polygon[next] - polygon[k]));
        }
      return part;
    }

    /// Ends of the segment and where other facets cross it, in order.
    std::vector<dealii::Point<2>>
    split_at_crossings(const std::vector<dealii::Point<2>> &segment,
                       const CrackSet<2>                   &cracks,
                       const unsigned int                   own)
    {
      const auto               &a = segment[0], &b = segment[1];
      std::vector<double>       places = {0., 1.};
      std::vector<unsigned int> near;
      cracks.near(dealii::BoundingBox<2>(segment), near);
      for (const unsigned int other : near)
        if (other != own && crosses(cracks.facets()[other], a, b))
          {
            const auto  &c  = cracks.facets()[other].corners;
            const auto   n  = cracks.facets()[other].normal();
            const double ha = (a - c[0]) * n, hb = (b - c[0]) * n;
            if (ha != hb)
              places.push_back(std::clamp(ha / (ha - hb), 0., 1.));
          }
      std::sort(places.begin(), places.end());
      std::vector<dealii::Point<2>> points;
      for (const double s : places)
        points.push_back(a + s * (b - a));
      return points;
    }

    void
    add_points(const std::vector<dealii::Point<2>> &segment,
               const CrackSet<2>                   &cracks,
               const unsigned int                   facet,
               const unsigned int                   cell,
               const double                         spacing,
               std::vector<CrackPoint<2>>          &points)
    {
      const auto breaks = split_at_crossings(segment, cracks, facet);
      for (unsigned int k = 0; k + 1 < breaks.size(); ++k)
        {
          const dealii::Tensor<1, 2> along  = breaks[k + 1] - breaks[k];
          const double               length = along.norm();
          if (!(length > 1e-12 * spacing))
            continue;
          const unsigned int n = std::ceil(length / (0.25 * spacing) - 1e-9);
          for (unsigned int p = 0; p < n; ++p)
            points.push_back(
              {breaks[k] + (p + 0.5) / n * along, length / n, facet, cell});
        }
    }

    void
    add_triangle(const std::array<dealii::Point<3>, 3> &t,
                 const unsigned int                     facet,
                 const unsigned int                     cell,
                 const double                           spacing,
                 std::vector<CrackPoint<3>>            &points)
    {
      unsigned int longest = 0;
      double       length  = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        if (t[k].distance(t[(k + 1) % 3]) > length)
          {
            length  = t[k].distance(t[(k + 1) % 3]);
            longest = k;
          }
      const auto &a = t[longest], &b = t[(longest + 1) % 3],
                 &c = t[(longest + 2) % 3];
      if (length > 0.5 * spacing)
        {
          const dealii::Point<3> middle = a + 0.5 * (b - a);
          add_triangle({{a, middle, c}}, facet, cell, spacing, points);
          add_triangle({{middle, b, c}}, facet, cell, spacing, points);
          return;
        }
      const double area = CrackFacet<3>{t, 0, 0}.measure();
      if (area > 1e-14 * spacing * spacing)
        points.push_back(
          {a + (1. / 3.) * ((b - a) + (c - a)), area, facet, cell});
    }

    void
    add_points(const std::vector<dealii::Point<3>> &polygon,
               const CrackSet<3> &,
               const unsigned int          facet,
               const unsigned int          cell,
               const double                spacing,
               std::vector<CrackPoint<3>> &points)
    {
      for (unsigned int k = 1; k + 1 < polygon.size(); ++k)
        add_triangle({{polygon[0], polygon[k], polygon[k + 1]}},
                     facet,
                     cell,
                     spacing,
                     points);
    }
  } // namespace

  template <int dim>
  std::vector<CrackPoint<dim>>
  crack_points(const Mesh::NodalMesh<dim> &mesh,
               const CrackSet<dim>        &cracks,
               const unsigned int          first)
  {
    std::vector<CrackPoint<dim>> points;
    std::vector<unsigned int>    near;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto corners = mesh.corners(c);
        cracks.near(corners, near);
        if (near.empty() || near.back() < first)
          continue;
        double spacing = 0.;
        for (const unsigned int n : mesh.cells[c])
          spacing += mesh.spacing[n] / mesh.nodes_per_cell;
        const auto halves = half_spaces<dim>(corners);
        for (const unsigned int facet : near)
          if (facet >= first)
            {
              const auto &ends = cracks.facets()[facet].corners;
              std::vector<dealii::Point<dim>> part(ends.begin(), ends.end());
              for (const auto &half : halves)
                if (part.size() >= dim)
                  part = clip(part, half, 1e-12 * spacing);
              if (part.size() >= dim)
                add_points(part, cracks, facet, c, spacing, points);
            }
      }
    return points;
  }

  template std::vector<CrackPoint<2>>
  crack_points<2>(const Mesh::NodalMesh<2> &,
                  const CrackSet<2> &,
                  unsigned int);
  template std::vector<CrackPoint<3>>
  crack_points<3>(const Mesh::NodalMesh<3> &,
                  const CrackSet<3> &,
                  unsigned int);
} // namespace Perimorph::Bonds
