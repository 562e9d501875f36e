#pragma once

#include <perimorph/fem/supports.h>
#include <perimorph/mesh/distributed_mesh.h>

namespace Perimorph::Fem
{
  /// Shape functions at the quadrature points of a unit face (three Gauss
  /// points per direction: exact for loads up to degree 4 on straight faces).
  template <int dim>
  struct FaceQuadrature
  {
    static constexpr unsigned int n_nodes  = 1u << (dim - 1);
    static constexpr unsigned int n_points = dim == 2 ? 3 : 9;

    using Tangents = std::array<dealii::Tensor<1, dim>, dim - 1>;

    std::array<double, n_points>                      weight;
    std::array<std::array<double, n_nodes>, n_points> shape;
    std::array<std::array<dealii::Tensor<1, dim - 1>, n_nodes>, n_points>
      gradient;

    static const FaceQuadrature &
    instance();

    /// Derivatives of a field along the face at a point.
    Tangents
    tangents(unsigned int                                       point,
             const std::array<dealii::Tensor<1, dim>, n_nodes> &values) const;

  private:
    FaceQuadrature();
  };

  /// Normal times area of a surface element from its tangent vectors.
  template <int dim>
  dealii::Tensor<1, dim>
  area_vector(const typename FaceQuadrature<dim>::Tangents &tangents);

  /// Quadrature on one face of the body's surface.
  template <int dim>
  struct FaceGeometry
  {
    static constexpr unsigned int n_nodes  = FaceQuadrature<dim>::n_nodes;
    static constexpr unsigned int n_points = FaceQuadrature<dim>::n_points;

    std::array<dealii::Point<dim>, n_points> points;
    /// Outward normal times the area weight.
    std::array<dealii::Tensor<1, dim>, n_points>      normal_jxw;
    std::array<std::array<double, n_nodes>, n_points> shape;

    FaceGeometry(const Mesh::NodalMesh<dim>    &mesh,
                 const Mesh::BoundaryFace<dim> &face);
  };

  /// The plane of a boundary that is used as a symmetry support.
  /// @throws Base::InputError  it is not a plane normal to an axis
  template <int dim>
  SymmetryPlane<dim>
  symmetry_plane(const Mesh::DistributedMesh<dim> &mesh,
                 const std::string                &boundary,
                 const std::string                &used_by);

  /// Area of a named boundary (length in 2D).
  template <int dim>
  double
  boundary_area(const Mesh::DistributedMesh<dim> &mesh,
                const std::string                &boundary,
                const std::string                &used_by);
} // namespace Perimorph::Fem
