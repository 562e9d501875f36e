#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/multilinear_map.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>

namespace Perimorph
{
  namespace Mesh
  {
    namespace
    {
      template <int dim>
      dealii::Point<dim>
      gauss_point(const unsigned int q)
      {
        const double       offset = 0.5 / std::sqrt(3.);
        dealii::Point<dim> p;
        for (int d = 0; d < dim; ++d)
          p[d] = 0.5 + ((q >> d) & 1u ? offset : -offset);
        return p;
      }

      template <int dim>
      struct ReferenceCell
      {
        static constexpr unsigned int                        n = 1u << dim;
        std::array<std::array<double, n>, n>                 values;
        std::array<std::array<dealii::Tensor<1, dim>, n>, n> gradients;

        ReferenceCell()
        {
          for (unsigned int q = 0; q < n; ++q)
            for (unsigned int v = 0; v < n; ++v)
              {
                const auto p = gauss_point<dim>(q);
                values[q][v] =
                  dealii::GeometryInfo<dim>::d_linear_shape_function(p, v);
                gradients[q][v] =
                  dealii::GeometryInfo<dim>::d_linear_shape_function_gradient(
                    p,
                    v);
              }
        }
      };

      template <int dim>
      const ReferenceCell<dim> &
      reference_cell()
      {
        static const ReferenceCell<dim> cell;
        return cell;
      }

      template <int dim>
      dealii::Tensor<2, dim>
      jacobian_at(const std::array<dealii::Point<dim>, (1u << dim)> &corners,
                  const dealii::Point<dim>                          &unit_point)
      {
        dealii::Tensor<2, dim> jacobian;
        for (unsigned int v = 0; v < corners.size(); ++v)
          jacobian += dealii::outer_product(
            dealii::Tensor<1, dim>(corners[v]),
            dealii::Tensor<1, dim>(
              dealii::GeometryInfo<dim>::d_linear_shape_function_gradient(
                unit_point,
                v)));
        return jacobian;
      }
    } // namespace

    template <int dim>
    CellGeometry<dim>::CellGeometry(const Corners &corners)
    {
      const auto &reference = reference_cell<dim>();
      for (unsigned int q = 0; q < n_points; ++q)
        {
          dealii::Tensor<2, dim> jacobian;
          points[q] = dealii::Point<dim>();
          for (unsigned int v = 0; v < n_nodes; ++v)
            {
              for (int a = 0; a < dim; ++a)
                for (int b = 0; b < dim; ++b)
                  jacobian[a][b] +=
                    corners[v][a] * reference.gradients[q][v][b];
              points[q] += reference.values[q][v] * corners[v];
            }
          const auto inverse_transposed = transpose(invert(jacobian));
          jxw[q]                        = determinant(jacobian) / n_points;
          for (unsigned int v = 0; v < n_nodes; ++v)
            gradients[q][v] = inverse_transposed * reference.gradients[q][v];
        }
    }

    template <int dim>
    double
    CellGeometry<dim>::shape_value(const unsigned int q, const unsigned int v)
    {
      return reference_cell<dim>().values[q][v];
    }

    template <int dim>
    std::array<double, (1u << dim)>
    shape_values(const dealii::Point<dim> &unit_point)
    {
      std::array<double, (1u << dim)> values;
      values[0] = 1.;
      for (int d = 0; d < dim; ++d)
        for (unsigned int v = 0; v < (1u << d); ++v)
          {
            values[v | (1u << d)] = values[v] * unit_point[d];
            values[v] *= 1. - unit_point[d];
          }
      return values;
    }

    template <int dim>
    bool
    map_to_unit_cell(const std::array<dealii::Point<dim>, (1u << dim)> &corners,
                     const dealii::Point<dim>                          &point,
                     dealii::Point<dim> &unit_point)
    {
      // Relative to the first corner: far from the origin absolute coordinates
      // have no digits left for a small cell.
      std::array<dealii::Point<dim>, (1u << dim)> relative;
      for (unsigned int v = 0; v < corners.size(); ++v)
        relative[v] = dealii::Point<dim>(corners[v] - corners[0]);
      return MultilinearMap<dim>(relative).to_unit(
        dealii::Point<dim>(point - corners[0]),
        unit_point);
    }

    template <int dim>
    double
    smallest_relative_jacobian(
      const std::array<dealii::Point<dim>, (1u << dim)> &corners)
    {
      double smallest = std::numeric_limits<double>::max();
      double sum      = 0.;
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          const double at_corner = determinant(
            jacobian_at<dim>(corners,
                             dealii::GeometryInfo<dim>::unit_cell_vertex(v)));
          const double at_point =
            determinant(jacobian_at<dim>(corners, gauss_point<dim>(v)));
          smallest = std::min({smallest, at_corner, at_point});
          sum += std::abs(at_corner);
        }
      return smallest * corners.size() / std::max(sum, 1e-300);
    }

    template struct CellGeometry<2>;
    template struct CellGeometry<3>;
    template std::array<double, 4>
    shape_values<2>(const dealii::Point<2> &);
    template std::array<double, 8>
    shape_values<3>(const dealii::Point<3> &);
    template bool
    map_to_unit_cell<2>(const std::array<dealii::Point<2>, 4> &,
                        const dealii::Point<2> &,
                        dealii::Point<2> &);
    template bool
    map_to_unit_cell<3>(const std::array<dealii::Point<3>, 8> &,
                        const dealii::Point<3> &,
                        dealii::Point<3> &);
    template double
    smallest_relative_jacobian<2>(const std::array<dealii::Point<2>, 4> &);
    template double
    smallest_relative_jacobian<3>(const std::array<dealii::Point<3>, 8> &);
  } // namespace Mesh
} // namespace Perimorph
