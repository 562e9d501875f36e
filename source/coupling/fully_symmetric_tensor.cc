#include <perimorph/coupling/fully_symmetric_tensor.h>

#include <cmath>

namespace Perimorph::Coupling
{
  template <int dim>
  FullySymmetricTensor<dim>
  FullySymmetricTensor<dim>::dyad(const dealii::Tensor<1, dim> &direction)
  {
    FullySymmetricTensor result;
    for (unsigned int c = 0; c < n_components; ++c)
      {
        const auto &abcd     = symmetric_indices<dim>.quadruples[c];
        result.components[c] = direction[abcd[0]] * direction[abcd[1]] *
                               direction[abcd[2]] * direction[abcd[3]];
      }
    return result;
  }

  template <int dim>
  void
  FullySymmetricTensor<dim>::add(const double                factor,
                                 const FullySymmetricTensor &other)
  {
    for (unsigned int c = 0; c < n_components; ++c)
      components[c] += factor * other.components[c];
  }

  template <int dim>
  dealii::SymmetricTensor<2, dim>
  FullySymmetricTensor<dim>::contract(
    const dealii::SymmetricTensor<2, dim> &strain) const
  {
    dealii::SymmetricTensor<2, dim> stress;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a; b < dim; ++b)
        {
          double sum = 0.;
          for (unsigned int c = 0; c < dim; ++c)
            {
              sum += (*this)(a, b, c, c) * strain[c][c];
              for (unsigned int d = c + 1; d < dim; ++d)
                sum += 2. * (*this)(a, b, c, d) * strain[c][d];
            }
          stress[a][b] = sum;
        }
    return stress;
  }

  template <int dim>
  dealii::Tensor<4, dim>
  FullySymmetricTensor<dim>::full() const
  {
    dealii::Tensor<4, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            result[a][b][c][d] = (*this)(a, b, c, d);
    return result;
  }

  template <int dim>
  double
  FullySymmetricTensor<dim>::norm() const
  {
    double square = 0.;
    for (unsigned int c = 0; c < n_components; ++c)
      square += multiplicity(c) * components[c] * components[c];
    return std::sqrt(square);
  }

  template struct FullySymmetricTensor<2>;
  template struct FullySymmetricTensor<3>;
} // namespace Perimorph::Coupling
