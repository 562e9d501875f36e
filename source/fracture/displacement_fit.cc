#include <perimorph/base/point_cloud.h>
#include <perimorph/fracture/displacement_fit.h>
#include <perimorph/fracture/mirrored_nodes.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace Perimorph::Fracture
{
  namespace
  {
    // Columns of unit length whose QR decomposition has a smaller pivot than
    // this do not determine the polynomial.
    constexpr double smallest_pivot = 1e-3;

    // Bound of h * sum |c_i| for the coefficients of a gradient component
    // sum c_i u_i. The one-sided difference of second order, (-3, 4, -1) / (2
    // h), has 4; a fit that lacks a layer of nodes but lives on the curvature
    // of a surface has 5 to 50 and errors of several per cent (spherical
    // cavity).
    constexpr double largest_amplification = 4.5;

    // Enlargements of the radius before the polynomial is made linear; 1.1^14
    // = 3.8 reaches three layers of nodes that are 4.8 spacings apart. Small
    // steps, because the error grows with the square of the radius and
    // neighbouring points may need one step more or less.
    constexpr unsigned int n_enlargements = 14;
    constexpr double       enlargement    = 1.1;
  } // namespace

  template <int dim>
  DisplacementFit<dim>::DisplacementFit(const Mesh::NodalMesh<dim>   &mesh,
                                        std::vector<MirrorPlane<dim>> planes,
                                        const double radius_factor,
                                        const double sharpness)
    : nodal_mesh(mesh)
    , radius_factor(radius_factor)
    , sharpness(sharpness)
    // Two enlargements are served with mirrored copies also where the mesh
    // grows away from the plane.
    , cloud(
        std::make_unique<MirroredNodes<dim>>(mesh, planes, 2. * radius_factor))
    , states(mesh.n_nodes(), NodeState::outside)
  {}

  template <int dim>
  DisplacementFit<dim>::~DisplacementFit() = default;

  template <int dim>
  void
  DisplacementFit<dim>::set_visibility(
    VisibilityTest                  new_visible,
    std::vector<dealii::Point<dim>> new_view_points)
  {
    visible     = std::move(new_visible);
    view_points = std::move(new_view_points);
  }

  template <int dim>
  unsigned int
  DisplacementFit<dim>::nearest_node(const dealii::Point<dim> &point) const
  {
    return cloud->node(cloud->search().nearest(point).first);
  }

  template <int dim>
  double
  DisplacementFit<dim>::length_at(const dealii::Point<dim> &point) const
  {
    return nodal_mesh.spacing[nearest_node(point)];
  }

  template <int dim>
  bool
  DisplacementFit<dim>::touches_material(const unsigned int node,
                                         const int          material) const
  {
    if (material == any_material)
      return true;
    for (const unsigned int cell : nodal_mesh.node_cells.row(node))
      if (nodal_mesh.cell_material[cell] == static_cast<unsigned int>(material))
        return true;
    return false;
  }

  template <int dim>
  unsigned int
  DisplacementFit<dim>::nearest_within(const dealii::Point<dim> &point,
                                       const int                 material) const
  {
    unsigned int best     = nearest;
    double       smallest = std::numeric_limits<double>::max();
    for (const unsigned int index : within)
      {
        const unsigned int n = cloud->node(index);
        const double       distance =
          cloud->search().points()[index].distance_square(point);
        if ((distance < smallest || (distance == smallest && n < best)) &&
            touches_material(n, material) && (!visible || visible(point, n)))
          {
            smallest = distance;
            best     = n;
          }
      }
    return best;
  }

  template <int dim>
  void
  DisplacementFit<dim>::find_nodes(const dealii::Point<dim> &point,
                                   const double              radius,
                                   const int                 material,
                                   unsigned int              seed) const
  {
    found.clear();
    cloud->search().within(point, radius, within);
    auto eye = point;
    if (seed != nearest && !view_points.empty())
      eye += 1e-3 * (view_points[seed] - point);
    if (seed == nearest)
      seed = nearest_within(point, material);
    if (seed == nearest) // no node at all
      return;

    for (const unsigned int index : within)
      states[cloud->node(index)] = NodeState::within;
    states[seed] = NodeState::reached;
    front.assign(1, seed);
    for (std::size_t next = 0; next < front.size(); ++next)
      for (const unsigned int cell : nodal_mesh.node_cells.row(front[next]))
        if (material == any_material || nodal_mesh.cell_material[cell] ==
                                          static_cast<unsigned int>(material))
          for (const unsigned int n : nodal_mesh.cells[cell])
            if (states[n] == NodeState::within)
              {
                states[n] = NodeState::reached;
                front.push_back(n);
              }
    for (const unsigned int index : within)
      if (states[cloud->node(index)] == NodeState::reached)
        found.push_back(index);

    for (const unsigned int index : within)
      states[cloud->node(index)] = NodeState::outside;
    states[seed] = NodeState::outside;

    if (visible)
      found.erase(std::remove_if(found.begin(),
                                 found.end(),
                                 [&](const unsigned int index) {
                                   return !visible(eye, cloud->node(index));
                                 }),
                  found.end());
  }

  template <int dim>
  template <int n_columns>
  bool
  DisplacementFit<dim>::try_fit(
    const dealii::Point<dim>                  &point,
    const double                               length,
    const double                               radius,
    const int                                  material,
    const unsigned int                         seed,
    const std::vector<dealii::Tensor<1, dim>> &displacement,
    FitResult<dim>                            &result) const
  {
    find_nodes(point, radius, material, seed);
    const unsigned int n_rows = found.size();
    if (n_rows < n_columns)
      return false;

    Eigen::Matrix<double, Eigen::Dynamic, n_columns> matrix(n_rows, n_columns);
    std::vector<dealii::Tensor<1, dim>>              values(n_rows);
    std::vector<double>                              roots(n_rows);
    for (unsigned int row = 0; row < n_rows; ++row)
      {
        const unsigned int           index = found[row];
        const dealii::Tensor<1, dim> x =
          (cloud->search().points()[index] - point) / radius;
        const double root = std::exp(-0.5 * sharpness * x.norm_square());

        unsigned int column   = 0;
        matrix(row, column++) = root;
        for (int a = 0; a < dim; ++a)
          matrix(row, column++) = root * x[a];
        if (n_columns > dim + 1)
          for (int a = 0; a < dim; ++a)
            for (int b = a; b < dim; ++b)
              matrix(row, column++) = root * x[a] * x[b];

        values[row] =
          root * (cloud->rotation(index) * displacement[cloud->node(index)]);
        roots[row] = root;
      }

    std::array<double, n_columns> lengths;
    for (int c = 0; c < n_columns; ++c)
      {
        lengths[c] = matrix.col(c).norm();
        if (!(lengths[c] > 0.))
          return false;
        matrix.col(c) /= lengths[c];
      }
    const Eigen::ColPivHouseholderQR<decltype(matrix)> qr(matrix);
    if (std::abs(qr.matrixR()(n_columns - 1, n_columns - 1)) < smallest_pivot)
      return false;
    // Coefficients of the value (column 0) and the gradient: with A P = Q R
    // they are the rows of P R^-1 Q^T for the first dim + 1 monomials.
    Eigen::Matrix<double, n_columns, dim + 1> unit =
      Eigen::Matrix<double, n_columns, dim + 1>::Identity();
    for (int c = 0; c <= dim; ++c)
      unit.col(c) /= lengths[c] * (c == 0 ? 1. : radius);
    const Eigen::Matrix<double, n_columns, dim + 1> reduced =
      qr.matrixR()
        .template topRows<n_columns>()
        .template triangularView<Eigen::Upper>()
        .transpose()
        .solve(qr.colsPermutation().transpose() * unit);
    Eigen::Matrix<double, Eigen::Dynamic, dim + 1> coefficients =
      Eigen::Matrix<double, Eigen::Dynamic, dim + 1>::Zero(n_rows, dim + 1);
    coefficients.template topRows<n_columns>() = reduced;
    coefficients.applyOnTheLeft(qr.householderQ());

    constexpr bool quadratic = n_columns > dim + 1;
    if (quadratic)
      for (int a = 0; a < dim; ++a)
        {
          double sum = 0.;
          for (unsigned int row = 0; row < n_rows; ++row)
            sum += std::abs(coefficients(row, 1 + a)) * roots[row];
          if (sum * length > largest_amplification)
            return false;
        }

    result = FitResult<dim>();
    for (unsigned int row = 0; row < n_rows; ++row)
      {
        result.displacement += coefficients(row, 0) * values[row];
        for (int i = 0; i < dim; ++i)
          for (int a = 0; a < dim; ++a)
            result.gradient[i][a] += coefficients(row, 1 + a) * values[row][i];
      }
    result.n_nodes   = n_rows;
    result.quadratic = quadratic;
    return true;
  }

  template <int dim>
  FitResult<dim>
  DisplacementFit<dim>::fit(
    const dealii::Point<dim>                  &point,
    const double                               length,
    const int                                  material,
    const std::vector<dealii::Tensor<1, dim>> &displacement,
    const unsigned int                         seed) const
  {
    FitResult<dim> result;
    double         radius = radius_factor * length;
    for (unsigned int n = 0; n <= n_enlargements; ++n, radius *= enlargement)
      if (try_fit<n_terms>(point,
                           length,
                           radius,
                           material,
                           seed,
                           displacement,
                           result))
        return result;
    radius = radius_factor * length;
    for (unsigned int n = 0; n <= n_enlargements; ++n, radius *= enlargement)
      if (try_fit<dim + 1>(point,
                           length,
                           radius,
                           material,
                           seed,
                           displacement,
                           result))
        return result;
    return result;
  }

  template class DisplacementFit<2>;
  template class DisplacementFit<3>;
} // namespace Perimorph::Fracture
