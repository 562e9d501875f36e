#include <perimorph/bonds/crack_points.h>
#include <perimorph/coupling/crack_target.h>

#include <cmath>

namespace Perimorph::Coupling
{
  namespace
  {
    template <int dim>
    void
    add(const Bonds::Trace           &trace,
        const dealii::Tensor<1, dim> &vector,
        NodeVectors<dim>             &target)
    {
      for (unsigned int k = 0; k < trace.nodes.size(); ++k)
        target[trace.nodes[k]] += trace.weights[k] * vector;
    }

    /// A piece of a face of the surface: midpoint, share of the face in unit
    /// coordinates, shape functions.
    template <int dim>
    struct FacePiece
    {
      std::array<double, dim - 1> unit;
      double                      share;
    };

    /// The face cut at the crack (2D), then into quarters; 3D: 8 x 8 pieces.
    std::vector<FacePiece<2>>
    pieces(const Bonds::CrackFacet<2>            &facet,
           const std::array<dealii::Point<2>, 2> &nodes)
    {
      const auto   normal = facet.normal();
      const double a      = (nodes[0] - facet.corners[0]) * normal;
      const double b      = (nodes[1] - facet.corners[0]) * normal;
      const double cut    = a / (a - b);

      constexpr unsigned int    n = 4;
      std::vector<FacePiece<2>> list;
      for (unsigned int k = 0; k < n; ++k)
        {
          list.push_back({{{(k + 0.5) / n * cut}}, cut / n});
          list.push_back(
            {{{cut + (k + 0.5) / n * (1. - cut)}}, (1. - cut) / n});
        }
      return list;
    }

    std::vector<FacePiece<3>>
    pieces(const Bonds::CrackFacet<3> &,
           const std::array<dealii::Point<3>, 4> &)
    {
      constexpr unsigned int    n = 8;
      std::vector<FacePiece<3>> list;
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          list.push_back({{{(k + 0.5) / n, (l + 0.5) / n}}, 1. / (n * n)});
      return list;
    }

    /// Bilinear map of a face: point, vector of the area, shape functions.
    template <int dim>
    struct FacePoint
    {
      dealii::Point<dim>                    position;
      dealii::Tensor<1, dim>                area; ///< not yet outward
      std::array<double, (1u << (dim - 1))> shape;
    };

    template <int dim>
    FacePoint<dim>
    face_point(const std::array<dealii::Point<dim>, (1u << (dim - 1))> &nodes,
               const std::array<double, dim - 1>                       &unit)
    {
      FacePoint<dim>                              result;
      dealii::Tensor<1, dim>                      position;
      std::array<dealii::Tensor<1, dim>, dim - 1> tangents;
      for (unsigned int v = 0; v < nodes.size(); ++v)
        {
          std::array<double, dim - 1> slope;
          result.shape[v] = 1.;
          slope.fill(1.);
          for (int d = 0; d < dim - 1; ++d)
            {
              const bool   upper = (v >> d) & 1u;
              const double value = upper ? unit[d] : 1. - unit[d];
              result.shape[v] *= value;
              for (int e = 0; e < dim - 1; ++e)
                slope[e] *= e == d ? (upper ? 1. : -1.) : value;
            }
          const auto x = nodes[v] - dealii::Point<dim>();
          position += result.shape[v] * x;
          for (int d = 0; d < dim - 1; ++d)
            tangents[d] += slope[d] * x;
        }
      result.position = dealii::Point<dim>(position);
      if constexpr (dim == 2)
        result.area = dealii::Tensor<1, 2>({tangents[0][1], -tangents[0][0]});
      else
        result.area = cross_product_3d(tangents[0], tangents[1]);
      return result;
    }

    template <int dim>
    bool
    face_is_crossed(const Bonds::CrackFacet<dim> &facet,
                    const std::array<dealii::Point<dim>, (1u << (dim - 1))> &x)
    {
      for (unsigned int a = 0; a < x.size(); ++a)
        for (unsigned int b = a + 1; b < x.size(); ++b)
          if (Bonds::crosses(facet, x[a], x[b]))
            return true;
      return false;
    }

    /// Traces instead of shape functions on the faces that a crack crosses.
    template <int dim>
    void
    add_mouths(const Mesh::NodalMesh<dim>              &mesh,
               const Bonds::CrackSet<dim>              &cracks,
               const Bonds::CrackTraces<dim>           &traces,
               const unsigned int                       first_facet,
               const std::function<bool(unsigned int)> &counts,
               NodeVectors<dim>                        &target)
    {
      std::vector<unsigned int> near;
      for (const auto &face : mesh.boundary_faces)
        {
          if (counts && !counts(face.cell))
            continue;
          std::array<dealii::Point<dim>, (1u << (dim - 1))> nodes;
          for (unsigned int v = 0; v < nodes.size(); ++v)
            nodes[v] = mesh.nodes[face.nodes[v]];
          cracks.near(nodes, near);
          for (const unsigned int f : near)
            if (f >= first_facet && face_is_crossed(cracks.facets()[f], nodes))
              {
                for (const auto &piece : pieces(cracks.facets()[f], nodes))
                  {
                    auto point = face_point<dim>(nodes, piece.unit);
                    if (point.area *
                          (point.position - mesh.cell_centroid[face.cell]) <
                        0.)
                      point.area *= -1.;
                    const auto inward = -point.area / point.area.norm();
                    const auto trace  = traces.at(point.position, inward);
                    if (trace.empty())
                      continue;
                    const auto vector = piece.share * point.area;
                    add(trace, vector, target);
                    for (unsigned int v = 0; v < nodes.size(); ++v)
                      target[face.nodes[v]] -= point.shape[v] * vector;
                  }
                break;
              }
        }
    }
  } // namespace

  template <int dim>
  NodeVectors<dim>
  crack_target(const Mesh::NodalMesh<dim>              &mesh,
               const Bonds::CrackSet<dim>              &cracks,
               const Bonds::CrackTraces<dim>           &traces,
               const unsigned int                       first_facet,
               const std::function<bool(unsigned int)> &counts)
  {
    NodeVectors<dim> target;
    for (const auto &point : Bonds::crack_points(mesh, cracks, first_facet))
      {
        if (counts && !counts(point.cell))
          continue;
        const auto normal = cracks.facets()[point.facet].normal();
        const auto plus   = traces.at(point.position, normal);
        const auto minus  = traces.at(point.position, -normal);
        if (plus.empty() || minus.empty())
          continue;
        add(plus, -point.measure * normal, target);
        add(minus, point.measure * normal, target);
      }
    add_mouths(mesh, cracks, traces, first_facet, counts, target);
    return target;
  }

  template NodeVectors<2>
  crack_target<2>(const Mesh::NodalMesh<2> &,
                  const Bonds::CrackSet<2> &,
                  const Bonds::CrackTraces<2> &,
                  unsigned int,
                  const std::function<bool(unsigned int)> &);
  template NodeVectors<3>
  crack_target<3>(const Mesh::NodalMesh<3> &,
                  const Bonds::CrackSet<3> &,
                  const Bonds::CrackTraces<3> &,
                  unsigned int,
                  const std::function<bool(unsigned int)> &);
} // namespace Perimorph::Coupling
