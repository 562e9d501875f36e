#pragma once

#include <perimorph/mesh/nodal_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <vector>

namespace Perimorph::Base
{
  template <int dim>
  class PointCloud;
}

namespace Perimorph::Fracture
{
  /// A plane of symmetry: the body ends there and is held normally.
  template <int dim>
  struct MirrorPlane
  {
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> normal; ///< unit length
    /// Nodes that are held. Only the part of the plane beside them mirrors (a
    /// crack face in the same plane does not); empty: the whole plane.
    std::vector<unsigned int> nodes;
  };


  /// The nodes of a mesh, and copies of those near planes of symmetry, mirrored
  /// at each plane and at products of several planes. The first points are the
  /// nodes themselves.
  template <int dim>
  class MirroredNodes
  {
  public:
    /// @param reach_factor  nodes within this many spacings of a plane are
    /// copied
    MirroredNodes(const Mesh::NodalMesh<dim>          &mesh,
                  const std::vector<MirrorPlane<dim>> &planes,
                  double                               reach_factor);
    ~MirroredNodes();

    /// All points, to be searched.
    const Base::PointCloud<dim> &
    search() const;

    /// The node a point is, or is a copy of.
    unsigned int
    node(const unsigned int point) const
    {
      return nodes[point];
    }

    /// Displacement of a point = rotation times that of its node.
    const dealii::Tensor<2, dim> &
    rotation(const unsigned int point) const
    {
      return rotations[images_of_points[point]];
    }

  private:
    std::vector<unsigned int>              nodes;
    std::vector<unsigned int>              images_of_points;
    std::vector<dealii::Tensor<2, dim>>    rotations; ///< of each image
    std::unique_ptr<Base::PointCloud<dim>> tree;

    void
    add_copies(const Mesh::NodalMesh<dim>          &mesh,
               const std::vector<MirrorPlane<dim>> &planes,
               double                               reach_factor,
               std::vector<dealii::Point<dim>>     &points);
  };
} // namespace Perimorph::Fracture
