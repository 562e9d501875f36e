#include <perimorph/bonds/crack_traces.h>

#include <Eigen/Dense>

#include <cmath>

namespace Perimorph::Bonds
{
  namespace
  {
    // Limits of an admissible fit: condition of the moments in units of the
    // radius, and sum of the absolute weights. The latter matters where a crack
    // grazes nodes (numerics-cracks.md, C2).
    constexpr double       largest_condition = 1e4;
    constexpr double       largest_sum       = 3.;
    constexpr unsigned int n_tries           = 7;
    constexpr double       growth            = 1.3;
  } // namespace

  template <int dim>
  CrackTraces<dim>::CrackTraces(const Mesh::NodalMesh<dim> &mesh,
                                const CrackSet<dim>        &cracks,
                                const double                radius_factor)
    : mesh(mesh)
    , cracks(cracks)
    , radius_factor(radius_factor)
    , cloud(mesh.nodes)
  {}

  template <int dim>
  double
  CrackTraces<dim>::spacing_at(const dealii::Point<dim> &point) const
  {
    return mesh.spacing[cloud.nearest(point).first];
  }

  template <int dim>
  Trace
  CrackTraces<dim>::at(const dealii::Point<dim>     &point,
                       const dealii::Tensor<1, dim> &away) const
  {
    using Moments        = Eigen::Matrix<double, dim + 1, dim + 1>;
    using Row            = Eigen::Matrix<double, dim + 1, 1>;
    const double spacing = spacing_at(point);
    const auto   eye     = point + 1e-6 * spacing * away;

    std::vector<unsigned int> near;
    std::vector<Row>          rows;
    double                    radius = radius_factor * spacing;
    for (unsigned int attempt = 0; attempt < n_tries;
         ++attempt, radius *= growth)
      {
        cloud.within(point, radius, near);
        Trace   trace;
        Moments moments = Moments::Zero();
        rows.clear();
        for (const unsigned int n : near)
          if (!cracks.crosses(eye, mesh.nodes[n]))
            {
              Row row;
              row[0]        = 1.;
              const auto xi = mesh.nodes[n] - point;
              for (int d = 0; d < dim; ++d)
                row[d + 1] = xi[d] / radius;
              const double weight =
                std::exp(-4. * xi.norm_square() / (radius * radius));
              moments += weight * row * row.transpose();
              rows.push_back(row);
              trace.nodes.push_back(n);
              trace.weights.push_back(weight);
            }
        if (trace.nodes.size() < dim + 1)
          continue;
        const Eigen::SelfAdjointEigenSolver<Moments> eigen(moments);
        const auto &values = eigen.eigenvalues();
        if (!(values[0] * largest_condition > values[dim]))
          continue;
        Row first = Row::Zero();
        first[0]  = 1.;
        const Row coefficients =
          eigen.eigenvectors() *
          (eigen.eigenvectors().transpose() * first).cwiseQuotient(values);
        double sum = 0.;
        for (unsigned int k = 0; k < rows.size(); ++k)
          {
            trace.weights[k] *= rows[k].dot(coefficients);
            sum += std::abs(trace.weights[k]);
          }
        if (sum <= largest_sum)
          return trace;
      }
    return {};
  }

  template class CrackTraces<2>;
  template class CrackTraces<3>;
} // namespace Perimorph::Bonds
