#include <perimorph/base/exceptions.h>
#include <perimorph/fem/face_geometry.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <sstream>

namespace Perimorph::Fem
{
  template <int dim>
  FaceQuadrature<dim>::FaceQuadrature()
  {
    const dealii::QGauss<dim - 1> quadrature(3);
    using Info = dealii::GeometryInfo<dim - 1>;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        weight[q] = quadrature.weight(q);
        for (unsigned int v = 0; v < n_nodes; ++v)
          {
            const auto &unit = quadrature.point(q);
            shape[q][v]      = Info::d_linear_shape_function(unit, v);
            gradient[q][v]   = Info::d_linear_shape_function_gradient(unit, v);
          }
      }
  }

  template <int dim>
  const FaceQuadrature<dim> &
  FaceQuadrature<dim>::instance()
  {
    static const FaceQuadrature<dim> quadrature;
    return quadrature;
  }

  template <int dim>
  typename FaceQuadrature<dim>::Tangents
  FaceQuadrature<dim>::tangents(
    const unsigned int                                 point,
    const std::array<dealii::Tensor<1, dim>, n_nodes> &values) const
  {
    Tangents result;
    for (unsigned int v = 0; v < n_nodes; ++v)
      for (int d = 0; d < dim - 1; ++d)
        result[d] += gradient[point][v][d] * values[v];
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  area_vector(const typename FaceQuadrature<dim>::Tangents &tangents)
  {
    if constexpr (dim == 2)
      return cross_product_2d(tangents[0]);
    else
      return cross_product_3d(tangents[0], tangents[1]);
  }

  template <int dim>
  FaceGeometry<dim>::FaceGeometry(const Mesh::NodalMesh<dim>    &mesh,
                                  const Mesh::BoundaryFace<dim> &face)
  {
    const auto &quadrature = FaceQuadrature<dim>::instance();
    shape                  = quadrature.shape;
    std::array<dealii::Tensor<1, dim>, n_nodes> positions;
    for (unsigned int v = 0; v < n_nodes; ++v)
      positions[v] = mesh.nodes[face.nodes[v]];
    for (unsigned int q = 0; q < n_points; ++q)
      {
        points[q] = dealii::Point<dim>();
        for (unsigned int v = 0; v < n_nodes; ++v)
          points[q] += shape[q][v] * positions[v];
        auto normal = area_vector<dim>(quadrature.tangents(q, positions));
        if (normal * (points[q] - mesh.cell_centroid[face.cell]) < 0.)
          normal = -normal;
        normal_jxw[q] = quadrature.weight[q] * normal;
      }
  }

  template <int dim>
  SymmetryPlane<dim>
  symmetry_plane(const Mesh::DistributedMesh<dim> &mesh,
                 const std::string                &boundary,
                 const std::string                &used_by)
  {
    const auto            &nodal = mesh.nodal();
    dealii::Tensor<1, dim> area;
    double                 total = 0.;
    SymmetryPlane<dim>     plane;
    const auto            &faces = mesh.boundary(boundary, used_by);
    for (const unsigned int f : faces)
      {
        const FaceGeometry<dim> geometry(nodal, nodal.boundary_faces[f]);
        for (const auto &normal : geometry.normal_jxw)
          {
            area += normal;
            total += normal.norm();
          }
      }
    plane.point    = nodal.nodes[nodal.boundary_faces[faces[0]].nodes[0]];
    plane.normal   = area / total;
    double largest = 0.;
    for (int d = 0; d < dim; ++d)
      largest = std::max(largest, std::abs(plane.normal[d]));
    if (std::abs(largest - 1.) > 1e-8)
      {
        std::ostringstream found;
        found << "boundary '" << boundary << "' with the mean normal ("
              << plane.normal << ")";
        throw Base::InputError(
          Base::InputMessage{used_by,
                             found.str(),
                             "a plane boundary normal to a coordinate axis",
                             "Use 'displacement' for other supports."});
      }
    plane.normal /= plane.normal.norm();
    plane.nodes = mesh.boundary_nodes(boundary, used_by);
    return plane;
  }

  template <int dim>
  double
  boundary_area(const Mesh::DistributedMesh<dim> &mesh,
                const std::string                &boundary,
                const std::string                &used_by)
  {
    const auto &nodal = mesh.nodal();
    double      area  = 0.;
    for (const unsigned int f : mesh.boundary(boundary, used_by))
      for (const auto &normal :
           FaceGeometry<dim>(nodal, nodal.boundary_faces[f]).normal_jxw)
        area += normal.norm();
    return area;
  }

  template struct FaceQuadrature<2>;
  template struct FaceQuadrature<3>;
  template dealii::Tensor<1, 2>
  area_vector<2>(const FaceQuadrature<2>::Tangents &);
  template dealii::Tensor<1, 3>
  area_vector<3>(const FaceQuadrature<3>::Tangents &);
  template struct FaceGeometry<2>;
  template struct FaceGeometry<3>;
  template SymmetryPlane<2>
  symmetry_plane<2>(const Mesh::DistributedMesh<2> &,
                    const std::string &,
                    const std::string &);
  template SymmetryPlane<3>
  symmetry_plane<3>(const Mesh::DistributedMesh<3> &,
                    const std::string &,
                    const std::string &);
  template double
  boundary_area<2>(const Mesh::DistributedMesh<2> &,
                   const std::string &,
                   const std::string &);
  template double
  boundary_area<3>(const Mesh::DistributedMesh<3> &,
                   const std::string &,
                   const std::string &);
} // namespace Perimorph::Fem
