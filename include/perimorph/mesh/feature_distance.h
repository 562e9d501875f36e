#pragma once

#include <perimorph/mesh/distributed_mesh.h>
#include <perimorph/parameters/features.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Mesh
{
  /// Nearest place on a feature.
  template <int dim>
  struct ClosestPoint
  {
    double             distance;
    dealii::Point<dim> point;
  };

  /// Distance from points to one feature: a named boundary or volume of the
  /// mesh, a point, segment, plane, triangle, box or ball. In a volume, box or
  /// ball it is zero.
  template <int dim>
  class FeatureDistance
  {
  public:
    /// @param used_by  entry of the feature, for messages
    /// @throws Base::InputError  a boundary or volume that is not in the mesh
    FeatureDistance(
      const Parameters::Feature  &feature,
      const DistributedMesh<dim> &mesh,
      const std::string &used_by = "parameter 'Peridynamics / around'");
    ~FeatureDistance();
    FeatureDistance(FeatureDistance &&) noexcept;

    /// Between which distances from a place on the feature anything depends on
    /// the distance.
    struct Range
    {
      double lower, upper;
    };
    using RangeOf = std::function<Range(const dealii::Point<dim> &)>;

    /// For a node of the mesh; zero for the nodes of a named volume.
    /// @param range  a node that is certainly nearer or farther gets the
    /// nearest
    ///        corner of the feature instead of the nearest point
    ClosestPoint<dim>
    closest_to_node(const NodalMesh<dim> &mesh,
                    unsigned int          node,
                    const RangeOf        &range) const;

    /// For the centroid of a cell; zero for the cells of a named volume.
    ClosestPoint<dim>
    closest_to_cell(const NodalMesh<dim> &mesh,
                    unsigned int          cell,
                    const RangeOf        &range) const;

  private:
    ClosestPoint<dim>
    closest(const dealii::Point<dim> &point, const RangeOf &range) const;

    class Facets;
    Parameters::Feature     feature;
    std::unique_ptr<Facets> facets; ///< of a boundary or volume
    std::vector<bool>       inside; ///< nodes of a named volume
  };

  /// Closest point of the segment from a to b.
  template <int dim>
  dealii::Point<dim>
  closest_on_segment(const dealii::Point<dim> &point,
                     const dealii::Point<dim> &a,
                     const dealii::Point<dim> &b);

  /// Closest point of the triangle a, b, c in space.
  dealii::Point<3>
  closest_on_triangle(const dealii::Point<3> &point,
                      const dealii::Point<3> &a,
                      const dealii::Point<3> &b,
                      const dealii::Point<3> &c);
} // namespace Perimorph::Mesh
