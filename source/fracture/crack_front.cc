#include <perimorph/fracture/crack_slits.h>
#include <perimorph/fracture/crack_tips.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace Perimorph::Fracture
{
  namespace
  {
    using Corners = std::array<double, 3>;

    Corners
    key(const dealii::Point<3> &point)
    {
      return {{point[0], point[1], point[2]}};
    }

    /// An edge from begin to end, such that direction of growth, normal of the
    /// crack and the edge are right-handed.
    struct Edge
    {
      dealii::Point<3> begin;
      dealii::Point<3> end;
      bool             used = false;
    };

    /// Edges of the triangles of a crack that lie inside the body, and on no
    /// other triangle.
    std::vector<Edge>
    free_edges(const Mesh::NodalMesh<3>   &mesh,
               const Surface<3>           &surface,
               const Bonds::CrackSet<3>   &cracks,
               const unsigned int          crack,
               const dealii::Tensor<1, 3> &normal)
    {
      const auto       &facets = cracks.facets();
      std::vector<Edge> edges;
      for (unsigned int f = 0; f < facets.size(); ++f)
        for (unsigned int k = 0; k < 3 && facets[f].crack == crack; ++k)
          {
            const auto &a      = facets[f].corners[k];
            const auto &b      = facets[f].corners[(k + 1) % 3];
            const auto &c      = facets[f].corners[(k + 2) % 3];
            const auto  middle = a + 0.5 * (b - a);
            bool        free   = true;
            for (unsigned int g = 0; g < facets.size() && free; ++g)
              {
                const auto &t = facets[g].corners;
                free          = g == f ||
                       middle.distance(
                         Mesh::closest_on_triangle(middle, t[0], t[1], t[2])) >
                         1e-6 * a.distance(b);
              }
            if (!free || !is_inside(mesh, surface, middle))
              continue;
            const bool along =
              cross_product_3d(normal, b - a) * (middle - c) > 0.;
            edges.push_back(along ? Edge{a, b} : Edge{b, a});
          }
      return edges;
    }

    /// Takes the chain through an edge out of the list.
    CrackFront
    take_chain(std::vector<Edge> &edges, const unsigned int first)
    {
      CrackFront front;
      front.vertices    = {edges[first].begin, edges[first].end};
      edges[first].used = true;
      for (bool found = true; found && !front.closed;)
        {
          found = false;
          for (auto &edge : edges)
            if (!edge.used && key(edge.begin) == key(front.vertices.back()))
              {
                edge.used = found = true;
                front.vertices.push_back(edge.end);
                break;
              }
          if (key(front.vertices.front()) == key(front.vertices.back()))
            {
              front.vertices.pop_back();
              front.closed = true;
            }
        }
      return front;
    }

    /// Fills tangents and arc_length.
    void
    measure(CrackFront &front)
    {
      const unsigned int n       = front.vertices.size();
      const unsigned int n_edges = front.closed ? n : n - 1;
      front.arc_length.assign(1, 0.);
      front.tangents.assign(n, dealii::Tensor<1, 3>());
      for (unsigned int k = 0; k < n_edges; ++k)
        {
          const dealii::Tensor<1, 3> edge =
            front.vertices[(k + 1) % n] - front.vertices[k];
          front.arc_length.push_back(front.arc_length.back() + edge.norm());
          front.tangents[k] += edge / edge.norm();
          front.tangents[(k + 1) % n] += edge / edge.norm();
        }
      for (auto &tangent : front.tangents)
        tangent /= tangent.norm();
    }

    CrackFront::Place
    place_on_edge(const CrackFront  &front,
                  const unsigned int edge,
                  const double       fraction)
    {
      const unsigned int   next    = (edge + 1) % front.vertices.size();
      dealii::Tensor<1, 3> tangent = (1. - fraction) * front.tangents[edge] +
                                     fraction * front.tangents[next];
      tangent /= tangent.norm();
      CrackFront::Place place;
      place.frame.origin =
        front.vertices[edge] +
        fraction * (front.vertices[next] - front.vertices[edge]);
      place.frame.axes = {
        {cross_product_3d(front.normal, tangent), front.normal, tangent}};
      place.frame.curvature =
        place.frame.axes[0] * (front.tangents[edge] - front.tangents[next]) /
        (front.arc_length[edge + 1] - front.arc_length[edge]);
      place.arc_length = (1. - fraction) * front.arc_length[edge] +
                         fraction * front.arc_length[edge + 1];
      return place;
    }
  } // namespace

  CrackFront::Place
  CrackFront::nearest(const dealii::Point<3> &point) const
  {
    double       smallest = std::numeric_limits<double>::max();
    unsigned int best     = 0;
    double       fraction = 0.;
    for (unsigned int k = 0; k + 1 < arc_length.size(); ++k)
      {
        const auto &begin = vertices[k];
        const auto &end   = vertices[(k + 1) % vertices.size()];
        const auto  foot  = Mesh::closest_on_segment(point, begin, end);
        if (point.distance_square(foot) < smallest)
          {
            smallest = point.distance_square(foot);
            best     = k;
            fraction = foot.distance(begin) / begin.distance(end);
          }
      }
    return place_on_edge(*this, best, fraction);
  }

  CrackFront::Place
  CrackFront::at(const double position) const
  {
    unsigned int edge = 0;
    while (edge + 2 < arc_length.size() && arc_length[edge + 1] < position)
      ++edge;
    return place_on_edge(*this,
                         edge,
                         (position - arc_length[edge]) /
                           (arc_length[edge + 1] - arc_length[edge]));
  }

  std::vector<double>
  CrackFront::stations(const unsigned int n) const
  {
    std::vector<double> positions;
    for (unsigned int k = 0; k < n; ++k)
      positions.push_back(length() * (k + (closed ? 0. : 0.5)) / n);
    return positions;
  }

  std::vector<CrackFront>
  find_fronts(const Mesh::NodalMesh<3> &mesh,
              const Bonds::CrackSet<3> &cracks,
              const bool                meshed)
  {
    const auto surface =
      meshed ? outer_surface(mesh, cracks) : mesh.boundary_faces;
    std::map<unsigned int, dealii::Tensor<1, 3>> normals;
    for (const auto &facet : cracks.facets())
      normals.emplace(facet.crack, facet.normal());

    std::vector<CrackFront> fronts;
    for (const auto &[crack, normal] : normals)
      {
        auto edges = free_edges(mesh, surface, cracks, crack, normal);
        // Open chains are taken from their beginning, then the closed ones.
        for (const bool open : {true, false})
          for (unsigned int e = 0; e < edges.size(); ++e)
            if (!edges[e].used &&
                !(open &&
                  std::any_of(edges.begin(), edges.end(), [&](const Edge &o) {
                    return key(o.end) == key(edges[e].begin);
                  })))
              {
                auto front   = take_chain(edges, e);
                front.crack  = crack;
                front.normal = normal;
                measure(front);
                front.free_distance = std::numeric_limits<double>::infinity();
                for (unsigned int k = 0; k + 1 < front.arc_length.size(); ++k)
                  {
                    const auto middle = front
                                          .at(0.5 * (front.arc_length[k] +
                                                     front.arc_length[k + 1]))
                                          .frame.origin;
                    double smallest = boundary_distance(mesh, surface, middle);
                    for (const auto &facet : cracks.facets())
                      if (facet.crack != crack)
                        smallest =
                          std::min(smallest,
                                   middle.distance(Mesh::closest_on_triangle(
                                     middle,
                                     facet.corners[0],
                                     facet.corners[1],
                                     facet.corners[2])));
                    front.free_distance =
                      std::min(front.free_distance, smallest);
                  }
                fronts.push_back(front);
              }
      }
    return fronts;
  }
} // namespace Perimorph::Fracture
