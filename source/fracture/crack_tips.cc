#include <perimorph/fracture/crack_slits.h>
#include <perimorph/fracture/crack_tips.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace Perimorph::Fracture
{
  namespace
  {
    // What counts as touching, relative to the size of a facet or face.
    constexpr double touch = 1e-6;

    // Largest angle at the tip between a crack that bends and the line behind
    // the tip, as a cosine.
    const double largest_bend = std::cos(75. / 180. * std::acos(-1.));

    // Deviation over distance from the tip of what counts as straight.
    constexpr double straight = 0.1;

    double
    distance(const Bonds::CrackFacet<2> &facet, const dealii::Point<2> &point)
    {
      return point.distance(
        Mesh::closest_on_segment(point, facet.corners[0], facet.corners[1]));
    }

    /// A facet and the number of its corner that is the free end.
    struct End
    {
      unsigned int facet;
      unsigned int corner;
    };

    /// The end that a tip has grown from: back along the facets of later steps.
    End
    first_end(const std::vector<Bonds::CrackFacet<2>> &facets, End end)
    {
      while (facets[end.facet].step > 0)
        {
          const auto  &facet = facets[end.facet];
          const auto  &back  = facet.corners[1 - end.corner];
          const double reach = touch * facet.measure();
          bool         found = false;
          for (unsigned int g = 0; g < facets.size() && !found; ++g)
            if (g != end.facet &&
                std::tie(facets[g].step, g) < std::tie(facet.step, end.facet))
              for (unsigned int corner = 0; corner < 2 && !found; ++corner)
                if (facets[g].corners[corner].distance(back) <= reach)
                  {
                    end   = {g, corner};
                    found = true;
                  }
          if (!found)
            break;
        }
      return end;
    }

    /// The facets of CrackTip::path, which begins with the tip.
    std::vector<unsigned int>
    follow_back(const std::vector<Bonds::CrackFacet<2>> &facets, CrackTip &tip)
    {
      std::vector<unsigned int> chain;
      tip.path          = {tip.frame.origin};
      unsigned int next = tip.facet;
      for (bool goes_on = true; goes_on;)
        {
          const auto &corners = facets[next].corners;
          const auto  begin   = tip.path.back();
          const auto  end =
            corners[corners[0].distance(begin) < corners[1].distance(begin)
                      ? 1
                      : 0];
          const double from = begin.distance(tip.frame.origin);
          const auto   away = end - tip.frame.origin;
          // Distances along a segment are smallest at an end or at the foot.
          if (distance(facets[next], tip.frame.origin) <
                from - touch * facets[next].measure() ||
              -(away * tip.frame.axes[0]) < largest_bend * away.norm())
            break;
          chain.push_back(next);
          tip.path.push_back(end);
          goes_on = false;
          for (unsigned int g = 0; g < facets.size() && !goes_on; ++g)
            if (std::find(chain.begin(), chain.end(), g) == chain.end())
              for (const auto &corner : facets[g].corners)
                if (corner.distance(end) <= touch * facets[g].measure())
                  {
                    next    = g;
                    goes_on = true;
                  }
        }
      return chain;
    }

    /// Distance to the nearest boundary, to the end of the path, and to facets
    /// that are not on it.
    double
    free_distance(const Mesh::NodalMesh<2>                &mesh,
                  const Surface<2>                        &surface,
                  const std::vector<Bonds::CrackFacet<2>> &facets,
                  CrackTip                                &tip)
    {
      const auto chain = follow_back(facets, tip);
      double     smallest =
        std::min(boundary_distance(mesh, surface, tip.frame.origin),
                 tip.path.back().distance(tip.frame.origin));
      for (unsigned int f = 0; f < facets.size(); ++f)
        if (std::find(chain.begin(), chain.end(), f) == chain.end())
          smallest = std::min(smallest, distance(facets[f], tip.frame.origin));
      return smallest;
    }

    /// Distance to the nearest boundary or facet that leaves the line behind
    /// the tip.
    double
    straight_distance(const Mesh::NodalMesh<2>                &mesh,
                      const Surface<2>                        &surface,
                      const std::vector<Bonds::CrackFacet<2>> &facets,
                      const TipFrame<2>                       &tip)
    {
      double smallest = boundary_distance(mesh, surface, tip.origin);
      for (const auto &facet : facets)
        {
          bool aside = false;
          for (const auto &corner : facet.corners)
            {
              const auto away = corner - tip.origin;
              if (std::abs(away * tip.axes[1]) > straight * away.norm() ||
                  away * tip.axes[0] > straight * away.norm())
                aside = true;
            }
          if (aside)
            smallest = std::min(smallest, distance(facet, tip.origin));
        }
      return smallest;
    }
  } // namespace

  template <int dim>
  double
  face_distance(const Mesh::NodalMesh<dim>    &mesh,
                const Mesh::BoundaryFace<dim> &face,
                const dealii::Point<dim>      &point)
  {
    const auto corner = [&](const unsigned int v) {
      return mesh.nodes[face.nodes[v]];
    };
    if constexpr (dim == 2)
      return point.distance(
        Mesh::closest_on_segment(point, corner(0), corner(1)));
    else
      return std::min(
        point.distance(
          Mesh::closest_on_triangle(point, corner(0), corner(1), corner(2))),
        point.distance(
          Mesh::closest_on_triangle(point, corner(3), corner(1), corner(2))));
  }

  template <int dim>
  double
  boundary_distance(const Mesh::NodalMesh<dim> &mesh,
                    const Surface<dim>         &surface,
                    const dealii::Point<dim>   &point)
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto &face : surface)
      smallest = std::min(smallest, face_distance(mesh, face, point));
    return smallest;
  }

  template <int dim>
  bool
  is_inside(const Mesh::NodalMesh<dim> &mesh,
            const Surface<dim>         &surface,
            const dealii::Point<dim>   &point)
  {
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto                     corners = mesh.corners(c);
        const dealii::BoundingBox<dim> box(
          std::vector<dealii::Point<dim>>(corners.begin(), corners.end()));
        if (!box.point_inside(point))
          continue;
        dealii::Point<dim> unit;
        if (!Mesh::map_to_unit_cell<dim>(corners, point, unit))
          continue;
        bool inside = true;
        for (int d = 0; d < dim; ++d)
          inside = inside && unit[d] > -touch && unit[d] < 1. + touch;
        if (inside)
          return boundary_distance(mesh, surface, point) >
                 touch * corners.front().distance(corners.back());
      }
    return false;
  }

  template <int dim>
  dealii::Point<dim>
  place_behind(const TipFrame<dim>                   &tip,
               const std::vector<dealii::Point<dim>> &path,
               const double                           distance)
  {
    for (std::size_t k = 1; k < path.size(); ++k)
      {
        const auto end = path[k] - tip.origin;
        if (end.norm() < distance && k + 1 < path.size())
          continue;
        // Where the piece meets the circle around the tip.
        const auto   begin = path[k - 1] - tip.origin;
        const auto   along = end - begin;
        const double a     = along.norm_square();
        const double b     = begin * along;
        const double c     = begin.norm_square() - distance * distance;
        const double s     = (std::sqrt(b * b - a * c) - b) / a;
        return path[k - 1] + std::min(s, 1.) * along;
      }
    return tip.origin - distance * tip.axes[0];
  }

  template dealii::Point<2>
  place_behind(const TipFrame<2> &,
               const std::vector<dealii::Point<2>> &,
               double);
  template dealii::Point<3>
  place_behind(const TipFrame<3> &,
               const std::vector<dealii::Point<3>> &,
               double);

  std::vector<CrackTip>
  find_tips(const Mesh::NodalMesh<2> &mesh,
            const Bonds::CrackSet<2> &cracks,
            const bool                meshed)
  {
    const auto &facets = cracks.facets();
    const auto  surface =
      meshed ? outer_surface(mesh, cracks) : mesh.boundary_faces;

    using Key = std::tuple<unsigned int, unsigned int, unsigned int, unsigned>;
    std::vector<std::pair<Key, CrackTip>> found;
    std::map<unsigned int, double>        lengths;
    std::map<unsigned int, unsigned int>  n_tips;
    for (unsigned int f = 0; f < facets.size(); ++f)
      {
        lengths[facets[f].crack] += facets[f].measure();
        for (unsigned int corner = 0; corner < 2; ++corner)
          {
            const auto  &end   = facets[f].corners[corner];
            const double reach = touch * facets[f].measure();
            bool         free  = true;
            for (unsigned int g = 0; g < facets.size() && free; ++g)
              free = g == f || distance(facets[g], end) > reach;
            if (!free || !is_inside(mesh, surface, end))
              continue;
            CrackTip tip;
            tip.frame = tip_frame(end, end - facets[f].corners[1 - corner]);
            tip.crack = facets[f].crack;
            tip.facet = f;
            tip.crack_length  = 0.;
            tip.free_distance = free_distance(mesh, surface, facets, tip);
            tip.straight_distance =
              std::min(tip.free_distance,
                       straight_distance(mesh, surface, facets, tip.frame));
            const End root = first_end(facets, {f, corner});
            tip.root       = {{root.facet, root.corner}};
            found.emplace_back(Key(tip.crack, root.facet, root.corner, f), tip);
            ++n_tips[tip.crack];
          }
      }
    std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) {
      return a.first < b.first;
    });
    std::vector<CrackTip> tips;
    for (const auto &[key, tip] : found)
      {
        tips.push_back(tip);
        tips.back().crack_length = lengths[tip.crack] / n_tips[tip.crack];
      }
    return tips;
  }

#define INSTANTIATE(dim)                                               \
  template bool   is_inside<dim>(const Mesh::NodalMesh<dim> &,         \
                               const Surface<dim> &,                 \
                               const dealii::Point<dim> &);          \
  template double face_distance<dim>(const Mesh::NodalMesh<dim> &,     \
                                     const Mesh::BoundaryFace<dim> &,  \
                                     const dealii::Point<dim> &);      \
  template double boundary_distance<dim>(const Mesh::NodalMesh<dim> &, \
                                         const Surface<dim> &,         \
                                         const dealii::Point<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
