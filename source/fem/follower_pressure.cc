#include <perimorph/fem/face_geometry.h>
#include <perimorph/fem/follower_pressure.h>

namespace Perimorph::Fem
{
  namespace
  {
    template <int dim>
    using Tangents = typename FaceQuadrature<dim>::Tangents;

    /// Change of the area vector when the tangent vectors change.
    template <int dim>
    dealii::Tensor<1, dim>
    area_vector_change(const Tangents<dim> &tangents,
                       const Tangents<dim> &changes)
    {
      if constexpr (dim == 2)
        {
          (void)tangents;
          return cross_product_2d(changes[0]);
        }
      else
        return cross_product_3d(changes[0], tangents[1]) +
               cross_product_3d(tangents[0], changes[1]);
    }
  } // namespace

  template <int dim>
  FollowerPressure<dim>::FollowerPressure(
    const Mesh::DistributedMesh<dim>    &mesh,
    const NodePartition<dim>            &partition,
    const std::vector<SurfaceLoad<dim>> &loads)
    : partition(partition)
  {
    const auto &nodal      = mesh.nodal();
    const auto &quadrature = FaceQuadrature<dim>::instance();
    for (const auto &load : loads)
      {
        if (!load.follows)
          continue;
        acts_somewhere = true;
        pressures.push_back(*load.pressure);
        for (const unsigned int f :
             mesh.boundary(load.boundary, "follower pressure"))
          {
            const auto &boundary_face = nodal.boundary_faces[f];
            if (!nodal.owns_cell(boundary_face.cell))
              continue;
            Face face;
            face.load = pressures.size() - 1;
            std::array<dealii::Tensor<1, dim>, n_nodes> positions;
            for (unsigned int v = 0; v < n_nodes; ++v)
              {
                positions[v]  = nodal.nodes[boundary_face.nodes[v]];
                face.nodes[v] = partition.local(boundary_face.nodes[v]);
              }
            constexpr unsigned int  middle = FaceGeometry<dim>::n_points / 2;
            const FaceGeometry<dim> outward(nodal, boundary_face);
            const auto              normal =
              area_vector<dim>(quadrature.tangents(middle, positions));
            face.side = normal * outward.normal_jxw[middle] > 0. ? 1. : -1.;
            faces.push_back(face);
          }
      }
  }

  template <int dim>
  void
  FollowerPressure<dim>::set_time(const double new_time)
  {
    time = new_time;
  }

  template <int dim>
  std::string
  FollowerPressure<dim>::name() const
  {
    return "follower pressure";
  }

  template <int dim>
  bool
  FollowerPressure<dim>::is_linear() const
  {
    return false;
  }

  template <int dim>
  bool
  FollowerPressure<dim>::is_symmetric() const
  {
    return false;
  }

  template <int dim>
  double
  FollowerPressure<dim>::energy(const Vector &) const
  {
    return 0.;
  }

  template <int dim>
  void
  FollowerPressure<dim>::add_residual(const Vector &displacement,
                                      Vector       &residual) const
  {
    const auto &quadrature = FaceQuadrature<dim>::instance();
    for (const Face &face : faces)
      {
        const auto positions = deformed_positions(face, displacement.begin());
        for (unsigned int q = 0; q < FaceQuadrature<dim>::n_points; ++q)
          {
            const auto force =
              pressure_weight(face, q) *
              area_vector<dim>(quadrature.tangents(q, positions));
            for (unsigned int v = 0; v < n_nodes; ++v)
              this->add_at(residual.begin(),
                           face.nodes[v],
                           quadrature.shape[q][v] * force);
          }
      }
  }

  template <int dim>
  std::array<dealii::Tensor<1, dim>, FollowerPressure<dim>::n_nodes>
  FollowerPressure<dim>::deformed_positions(const Face   &face,
                                            const double *displacement) const
  {
    std::array<dealii::Tensor<1, dim>, n_nodes> positions;
    for (unsigned int v = 0; v < n_nodes; ++v)
      positions[v] = partition.position(face.nodes[v]) +
                     this->value_at(displacement, face.nodes[v]);
    return positions;
  }

  template <int dim>
  double
  FollowerPressure<dim>::pressure_weight(const Face        &face,
                                         const unsigned int q) const
  {
    const auto        &quadrature = FaceQuadrature<dim>::instance();
    dealii::Point<dim> reference;
    for (unsigned int v = 0; v < n_nodes; ++v)
      reference += quadrature.shape[q][v] * partition.position(face.nodes[v]);
    return quadrature.weight[q] * face.side *
           pressures[face.load].value(reference, time);
  }

  template <int dim>
  void
  FollowerPressure<dim>::add_tangent_product(const Vector &displacement,
                                             const Vector &direction,
                                             Vector       &product) const
  {
    dealii::FullMatrix<double> matrix;
    for (unsigned int block = 0; block < faces.size(); ++block)
      {
        block_tangent(block, displacement, matrix);
        for (unsigned int v = 0; v < n_nodes; ++v)
          {
            dealii::Tensor<1, dim> force;
            for (unsigned int w = 0; w < n_nodes; ++w)
              {
                const auto change =
                  this->value_at(direction.begin(), faces[block].nodes[w]);
                for (int i = 0; i < dim; ++i)
                  for (int k = 0; k < dim; ++k)
                    force[i] += matrix(dim * v + i, dim * w + k) * change[k];
              }
            this->add_at(product.begin(), faces[block].nodes[v], force);
          }
      }
  }

  template <int dim>
  unsigned int
  FollowerPressure<dim>::n_blocks() const
  {
    return faces.size();
  }

  template <int dim>
  void
  FollowerPressure<dim>::block_nodes(const unsigned int         block,
                                     std::vector<unsigned int> &nodes) const
  {
    nodes.assign(faces[block].nodes.begin(), faces[block].nodes.end());
  }

  template <int dim>
  void
  FollowerPressure<dim>::block_tangent(const unsigned int          block,
                                       const Vector               &displacement,
                                       dealii::FullMatrix<double> &matrix) const
  {
    const auto &quadrature = FaceQuadrature<dim>::instance();
    const Face &face       = faces[block];
    matrix.reinit(dim * n_nodes, dim * n_nodes);
    const auto positions = deformed_positions(face, displacement.begin());
    for (unsigned int q = 0; q < FaceQuadrature<dim>::n_points; ++q)
      {
        const auto   tangents = quadrature.tangents(q, positions);
        const double factor   = pressure_weight(face, q);
        for (unsigned int w = 0; w < n_nodes; ++w)
          for (int k = 0; k < dim; ++k)
            {
              Tangents<dim> changes;
              for (int d = 0; d < dim - 1; ++d)
                changes[d][k] = quadrature.gradient[q][w][d];
              const auto change = area_vector_change<dim>(tangents, changes);
              for (unsigned int v = 0; v < n_nodes; ++v)
                for (int i = 0; i < dim; ++i)
                  matrix(dim * v + i, dim * w + k) +=
                    factor * quadrature.shape[q][v] * change[i];
            }
      }
  }

  template class FollowerPressure<2>;
  template class FollowerPressure<3>;
} // namespace Perimorph::Fem
