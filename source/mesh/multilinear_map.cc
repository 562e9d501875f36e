#include <perimorph/mesh/multilinear_map.h>

#include <cmath>

namespace Perimorph::Mesh
{
  template <int dim>
  MultilinearMap<dim>::MultilinearMap(
    const std::array<dealii::Point<dim>, (1u << dim)> &corners)
  {
    for (unsigned int v = 0; v < n_terms; ++v)
      terms[v] = corners[v];
    for (int d = 0; d < dim; ++d)
      for (unsigned int v = 0; v < n_terms; ++v)
        if (!((v >> d) & 1u))
          {
            const unsigned int           w          = v | (1u << d);
            const dealii::Tensor<1, dim> difference = terms[w] - terms[v];
            terms[v] = 0.5 * (terms[v] + terms[w]);
            terms[w] = difference;
          }
    dealii::Tensor<2, dim> jacobian;
    for (int d = 0; d < dim; ++d)
      for (int a = 0; a < dim; ++a)
        jacobian[a][d] = terms[1u << d][a];
    is_regular = std::abs(determinant(jacobian)) > 0.;
    if (is_regular)
      inverse = invert(jacobian);
  }

  template <int dim>
  std::array<double, MultilinearMap<dim>::n_terms>
  MultilinearMap<dim>::products(const dealii::Tensor<1, dim> &t)
  {
    std::array<double, n_terms> result;
    result[0] = 1.;
    for (int d = 0; d < dim; ++d)
      for (unsigned int k = 0; k < (1u << d); ++k)
        result[k | (1u << d)] = result[k] * t[d];
    return result;
  }

  template <int dim>
  bool
  MultilinearMap<dim>::to_unit(const dealii::Point<dim> &point,
                               dealii::Point<dim>       &unit_point) const
  {
    // The first step from the middle of the cell; all there is to do in a
    // parallelogram.
    const dealii::Tensor<1, dim> t = inverse * (point - terms[0]);
    for (int d = 0; d < dim; ++d)
      unit_point[d] = 0.5 + t[d];
    return refine(point, unit_point);
  }

  template <int dim>
  bool
  MultilinearMap<dim>::refine(const dealii::Point<dim> &point,
                              dealii::Point<dim>       &unit_point) const
  {
    if (!is_regular)
      return false;
    dealii::Tensor<1, dim> t;
    for (int d = 0; d < dim; ++d)
      t[d] = unit_point[d] - 0.5;
    const auto error_at = [&](const std::array<double, n_terms> &factors) {
      dealii::Tensor<1, dim> error = point;
      for (unsigned int k = 0; k < n_terms; ++k)
        error -= factors[k] * terms[k];
      return error;
    };
    auto factors = products(t);
    auto error   = error_at(factors);
    auto step    = inverse * error;
    bool found   = step.norm_square() < 1e-28;
    for (unsigned int iteration = 0; !found && iteration < 30; ++iteration)
      {
        dealii::Tensor<2, dim> jacobian;
        for (int d = 0; d < dim; ++d)
          for (unsigned int k = 0; k < n_terms; ++k)
            if ((k >> d) & 1u)
              for (int a = 0; a < dim; ++a)
                jacobian[a][d] += factors[k ^ (1u << d)] * terms[k][a];
        if (!(std::abs(determinant(jacobian)) > 0.))
          return false;
        step = invert(jacobian) * error;
        t += step;
        if (!(t.norm_square() < 1e6))
          return false;
        found   = step.norm_square() < 1e-26;
        factors = products(t);
        error   = error_at(factors);
      }
    for (int d = 0; d < dim; ++d)
      unit_point[d] = 0.5 + t[d];
    // Stagnation at round-off level is convergence too.
    return found || (inverse * error).norm() <= 1e-11;
  }

  template class MultilinearMap<2>;
  template class MultilinearMap<3>;
} // namespace Perimorph::Mesh
