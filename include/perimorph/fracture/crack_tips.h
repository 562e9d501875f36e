#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/fracture/williams_field.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <vector>

namespace Perimorph::Fracture
{
  /// An end of a plane crack inside the body.
  struct CrackTip
  {
    TipFrame<2>  frame;
    unsigned int crack; ///< CrackFacet::crack
    unsigned int facet; ///< index of the facet that ends here
    /// Facet and its corner that the tip has grown from: a name that advances
    /// do not change.
    std::array<unsigned int, 2> root;
    /// Length of the crack over its number of tips: the half length of a crack
    /// inside the body, the length of an edge crack.
    double crack_length;
    /// Distance to the nearest boundary, other crack or other end of this one:
    /// within, there is this crack only, and each circle around the tip crosses
    /// it once.
    double free_distance;
    /// The same with the nearest kink. Growth that turns by less than 6 degrees
    /// counts as straight.
    double straight_distance;
    /// Corners from the tip backwards, at growing distances from the tip and
    /// within 75 degrees of the line behind it; none: a straight crack.
    std::vector<dealii::Point<2>> path = {};
  };

  /// Where the crack is at a distance from its tip.
  /// @param path  CrackTip::path; none: a straight crack
  template <int dim>
  dealii::Point<dim>
  place_behind(const TipFrame<dim>                   &tip,
               const std::vector<dealii::Point<dim>> &path,
               double                                 distance);

  /// All tips: ends that touch no other facet and lie inside the body. In the
  /// order of the cracks, of one crack in the order of the first ends that they
  /// grew from, so that an advance does not change the order.
  /// @param meshed  the cracks lie on slits of the mesh, whose faces are not
  ///                the surface of the body (crack_slits.h)
  std::vector<CrackTip>
  find_tips(const Mesh::NodalMesh<2> &mesh,
            const Bonds::CrackSet<2> &cracks,
            bool                      meshed = false);

  /// The part of the edge of a plane crack in space that lies inside the body.
  struct CrackFront
  {
    unsigned int                  crack = 0;
    std::vector<dealii::Point<3>> vertices;
    bool                          closed = false;
    dealii::Tensor<1, 3>          normal; ///< of the crack
    /// Of the front at the vertices, along rising arc length; the direction of
    /// growth is normal x tangent.
    std::vector<dealii::Tensor<1, 3>> tangents;
    /// Arc length at each vertex; the last entry is the whole length.
    std::vector<double> arc_length;
    double              free_distance = 0.; ///< smallest along the front

    double
    length() const
    {
      return arc_length.back();
    }

    /// Axes at the nearest point of the front, tangents interpolated between
    /// the vertices, and the arc length there.
    struct Place
    {
      TipFrame<3> frame;
      double      arc_length;
    };

    Place
    nearest(const dealii::Point<3> &point) const;

    Place
    at(double arc_length) const;

    /// Arc lengths of points at equal distances, the ends left out.
    std::vector<double>
    stations(unsigned int n) const;
  };

  /// All fronts, in the order of the cracks: chains of edges that belong to one
  /// triangle only, inside the body and not on another crack. Corners that
  /// triangles share must agree exactly.
  /// @param meshed  as for tips
  std::vector<CrackFront>
  find_fronts(const Mesh::NodalMesh<3> &mesh,
              const Bonds::CrackSet<3> &cracks,
              bool                      meshed = false);

  template <int dim>
  using Surface = std::vector<Mesh::BoundaryFace<dim>>;

  /// True in a cell of the mesh and not on the surface of the body.
  template <int dim>
  bool
  is_inside(const Mesh::NodalMesh<dim> &mesh,
            const Surface<dim>         &surface,
            const dealii::Point<dim>   &point);

  /// Distance to a face (in space as two triangles).
  template <int dim>
  double
  face_distance(const Mesh::NodalMesh<dim>    &mesh,
                const Mesh::BoundaryFace<dim> &face,
                const dealii::Point<dim>      &point);

  /// Distance to the surface of the body.
  template <int dim>
  double
  boundary_distance(const Mesh::NodalMesh<dim> &mesh,
                    const Surface<dim>         &surface,
                    const dealii::Point<dim>   &point);
} // namespace Perimorph::Fracture
