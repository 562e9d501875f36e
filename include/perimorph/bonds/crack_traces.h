#pragma once

#include <perimorph/base/point_cloud.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <vector>

namespace Perimorph::Bonds
{
  /// Value of a nodal field at a point as a weighted sum over nodes; exact for
  /// linear fields: the weights add up to 1 and their mean position is the
  /// point. Empty if no admissible set of nodes was found.
  struct Trace
  {
    std::vector<unsigned int> nodes;
    std::vector<double>       weights;

    bool
    empty() const
    {
      return nodes.empty();
    }
  };

  /// One-sided values next to cracks: linear least squares over the nodes that
  /// are seen from the point (numerics-cracks.md, C2).
  template <int dim>
  class CrackTraces
  {
  public:
    /// The mesh must outlive the object; cracks may grow.
    /// @param radius_factor  first radius of the fit over the spacing
    CrackTraces(const Mesh::NodalMesh<dim> &mesh,
                const CrackSet<dim>        &cracks,
                double                      radius_factor = 1.8);

    /// @param point  on a crack or on the surface of the body
    /// @param away   unit vector into the side that is meant; nodes are seen
    ///               from the point moved by 1e-6 of the spacing along it
    Trace
    at(const dealii::Point<dim>     &point,
       const dealii::Tensor<1, dim> &away) const;

    /// Spacing of the mesh at a point: that of the nearest node.
    double
    spacing_at(const dealii::Point<dim> &point) const;

  private:
    const Mesh::NodalMesh<dim> &mesh;
    const CrackSet<dim>        &cracks;
    const double                radius_factor;
    Base::PointCloud<dim>       cloud;
  };
} // namespace Perimorph::Bonds
