#pragma once

#include <perimorph/mesh/gmsh_reader.h>

#include <deal.II/grid/manifold.h>

#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Mesh
{
  /// A part of a named boundary that is not flat.
  template <int dim>
  struct BoundaryCurve
  {
    std::string                                  boundary;
    std::vector<typename GmshMesh<dim>::Face>    faces;
    std::string                                  description;
    std::unique_ptr<const dealii::Manifold<dim>> manifold; ///< none: unknown
  };

  /// Finds the curves behind the boundaries of a mesh: circles (2D), spheres
  /// and cylinders along an axis (3D) that fit all points of a connected part
  /// to 1e-6 of the radius. Boundaries are divided where they turn by more than
  /// 50 degrees, in 2D also at kinks; a part in 2D that is no circle is a cubic
  /// spline through its points. Below five points nothing is found.
  template <int dim>
  std::vector<BoundaryCurve<dim>>
  find_boundary_curves(const GmshMesh<dim> &mesh);
} // namespace Perimorph::Mesh
