#include <perimorph/base/exceptions.h>
#include <perimorph/fem/face_geometry.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <sstream>

namespace Perimorph::Fem
{
  template <int dim>
  FaceGeometry<dim>::FaceGeometry(const Mesh::NodalMesh<dim>    &mesh,
                                  const Mesh::BoundaryFace<dim> &face)
  {
    static const dealii::QGauss<dim - 1> quadrature(3);
    using Info = dealii::GeometryInfo<dim - 1>;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        std::array<dealii::Tensor<1, dim>, dim - 1> tangents;
        points[q] = dealii::Point<dim>();
        for (unsigned int v = 0; v < n_nodes; ++v)
          {
            const auto &unit     = quadrature.point(q);
            const auto &position = mesh.nodes[face.nodes[v]];
            shape[q][v]          = Info::d_linear_shape_function(unit, v);
            points[q] += shape[q][v] * position;
            const auto gradient =
              Info::d_linear_shape_function_gradient(unit, v);
            for (int d = 0; d < dim - 1; ++d)
              tangents[d] += gradient[d] * position;
          }
        dealii::Tensor<1, dim> normal;
        if constexpr (dim == 2)
          normal = cross_product_2d(tangents[0]);
        else
          normal = cross_product_3d(tangents[0], tangents[1]);
        if (normal * (points[q] - mesh.cell_centroid[face.cell]) < 0.)
          normal = -normal;
        normal_jxw[q] = quadrature.weight(q) * normal;
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
