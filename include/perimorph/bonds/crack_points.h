#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Bonds
{
  /// A quadrature point on a crack.
  template <int dim>
  struct CrackPoint
  {
    dealii::Point<dim> position;
    double             measure; ///< length or area
    unsigned int       facet;
    unsigned int       cell; ///< that holds it
  };

  /// Midpoint rule on the parts of the facets in the body: each facet is cut at
  /// the faces of the cells and (2D) at other facets, then into pieces of a
  /// quarter of the spacing (3D: half). A facet in a face of a cell belongs to
  /// the cell into which the infinitesimal motion of CrackSet takes it.
  /// @param first  facets from this index on
  template <int dim>
  std::vector<CrackPoint<dim>>
  crack_points(const Mesh::NodalMesh<dim> &mesh,
               const CrackSet<dim>        &cracks,
               unsigned int                first = 0);
} // namespace Perimorph::Bonds
