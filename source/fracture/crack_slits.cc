#include <perimorph/fracture/crack_slits.h>

#include <algorithm>
#include <map>

namespace Perimorph::Fracture
{
  namespace
  {
    // Of faces from the crack, over their length: coordinates in a parameter
    // file have few digits.
    constexpr double tolerance = 1e-4;
    // Of view points from their nodes, in spacings: more than that.
    constexpr double shift = 1e-3;

    template <int dim>
    dealii::Point<dim>
    middle_of(const Mesh::NodalMesh<dim>    &mesh,
              const Mesh::BoundaryFace<dim> &face)
    {
      dealii::Point<dim> middle;
      for (const unsigned int n : face.nodes)
        middle += mesh.nodes[n] / double(face.nodes.size());
      return middle;
    }

    /// True if a crack passes between two cells of the node: those around a
    /// tip, but also beside a sharp kink.
    template <int dim>
    bool
    is_between_cells(const Mesh::NodalMesh<dim> &mesh,
                     const Bonds::CrackSet<dim> &cracks,
                     const unsigned int          node)
    {
      const auto cells = mesh.node_cells.row(node);
      for (const unsigned int a : cells)
        for (const unsigned int b : cells)
          if (a < b &&
              cracks.crosses(mesh.cell_centroid[a], mesh.cell_centroid[b]))
            return true;
      return false;
    }
  } // namespace

  template <int dim>
  std::vector<bool>
  faces_on_cracks(const Mesh::NodalMesh<dim> &mesh,
                  const Bonds::CrackSet<dim> &cracks)
  {
    std::vector<bool> on;
    for (const auto &face : mesh.boundary_faces)
      {
        const double reach =
          tolerance * mesh.nodes[face.nodes.front()].distance(
                        mesh.nodes[face.nodes.back()]);
        on.push_back(cracks.is_within(middle_of(mesh, face), reach) &&
                     std::all_of(face.nodes.begin(),
                                 face.nodes.end(),
                                 [&](const unsigned int n) {
                                   return cracks.is_within(mesh.nodes[n],
                                                           reach);
                                 }));
      }
    return on;
  }

  template <int dim>
  std::vector<Mesh::BoundaryFace<dim>>
  outer_surface(const Mesh::NodalMesh<dim> &mesh,
                const Bonds::CrackSet<dim> &cracks)
  {
    const auto                           on = faces_on_cracks(mesh, cracks);
    std::vector<Mesh::BoundaryFace<dim>> surface;
    for (unsigned int f = 0; f < on.size(); ++f)
      if (!on[f])
        surface.push_back(mesh.boundary_faces[f]);
    return surface;
  }

  template <int dim>
  std::vector<unsigned int>
  nodes_of_both_sides(const Mesh::NodalMesh<dim> &mesh,
                      const Bonds::CrackSet<dim> &cracks)
  {
    // Directions along and out of the faces at each node of a slit.
    struct Side
    {
      dealii::Tensor<1, dim> along, outwards;
    };
    std::map<unsigned int, std::vector<Side>> sides;
    const auto on = faces_on_cracks(mesh, cracks);
    for (unsigned int f = 0; f < on.size(); ++f)
      if (on[f])
        {
          const auto &face   = mesh.boundary_faces[f];
          const auto  middle = middle_of(mesh, face);
          const auto  corner = [&](const unsigned int v) {
            return mesh.nodes[face.nodes[v]];
          };
          Bonds::CrackFacet<dim> facet;
          for (unsigned int v = 0; v < dim; ++v)
            facet.corners[v] = corner(v);
          auto outwards = facet.normal();
          if (outwards * (middle - mesh.cell_centroid[face.cell]) < 0.)
            outwards *= -1.;
          for (const unsigned int n : face.nodes)
            sides[n].push_back(
              {(middle - mesh.nodes[n]) / middle.distance(mesh.nodes[n]),
               outwards});
        }
    const auto are_opposite = [](const Side &a, const Side &b) {
      return a.along * b.along > 0.9 && a.outwards * b.outwards < -0.9;
    };
    std::vector<unsigned int> nodes;
    for (const auto &[node, list] : sides)
      for (const auto &side : list)
        if (std::any_of(list.begin(), list.end(), [&](const Side &other) {
              return are_opposite(side, other);
            }))
          {
            nodes.push_back(node);
            break;
          }
    return nodes;
  }

  template <int dim>
  std::vector<dealii::Point<dim>>
  view_points(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::CrackSet<dim> &cracks)
  {
    const auto on = faces_on_cracks(mesh, cracks);
    // Away from the faces of the slit, by node.
    std::map<unsigned int, dealii::Tensor<1, dim>> away;
    for (unsigned int f = 0; f < on.size(); ++f)
      if (on[f])
        for (const unsigned int n : mesh.boundary_faces[f].nodes)
          away[n] += mesh.nodes[n] - middle_of(mesh, mesh.boundary_faces[f]);
    auto points = mesh.nodes;
    for (const auto &[node, ahead] : away)
      {
        auto inwards = ahead;
        if (!is_between_cells(mesh, cracks, node))
          {
            inwards = 0.;
            for (const unsigned int cell : mesh.node_cells.row(node))
              inwards += mesh.cell_centroid[cell] - mesh.nodes[node];
          }
        if (inwards.norm() > 0.)
          points[node] += shift * mesh.spacing[node] / inwards.norm() * inwards;
      }
    return points;
  }

#define INSTANTIATE(dim)                                            \
  template std::vector<bool> faces_on_cracks<dim>(                  \
    const Mesh::NodalMesh<dim> &,                                   \
    const Bonds::CrackSet<dim> &);                                  \
  template std::vector<Mesh::BoundaryFace<dim>> outer_surface<dim>( \
    const Mesh::NodalMesh<dim> &,                                   \
    const Bonds::CrackSet<dim> &);                                  \
  template std::vector<unsigned int> nodes_of_both_sides<dim>(      \
    const Mesh::NodalMesh<dim> &,                                   \
    const Bonds::CrackSet<dim> &);                                  \
  template std::vector<dealii::Point<dim>> view_points<dim>(        \
    const Mesh::NodalMesh<dim> &,                                   \
    const Bonds::CrackSet<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
