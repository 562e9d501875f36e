#include <perimorph/base/exceptions.h>
#include <perimorph/materials/finite_strain.h>

#include <cmath>
#include <sstream>

namespace Perimorph
{
  namespace Materials
  {
    template <int dim>
    VolumeRatio
    volume_ratio(const dealii::Tensor<2, dim> &H, const char *law)
    {
      double second_order = determinant(H);
      if (dim == 3)
        for (int a = 0; a < dim; ++a)
          for (int b = a + 1; b < dim; ++b)
            second_order += H[a][a] * H[b][b] - H[a][b] * H[b][a];
      const double change = trace(H) + second_order;
      // far from rest det F itself loses fewer digits than 1 + (J - 1)
      const double J = std::abs(change) < 0.5
                         ? 1. + change
                         : determinant(deformation_gradient(H));
      if (!(J > 0. && std::isfinite(J)))
        {
          std::ostringstream message;
          message << "the law '" << law
                  << "' has no answer at J = det F = " << J
                  << "; J must be positive and finite";
          throw Base::InadmissibleState(message.str());
        }
      return {J,
              std::abs(change) < 0.5 ? std::log1p(change) : std::log(J),
              change,
              second_order};
    }

    template <int dim>
    dealii::Tensor<2, dim>
    deformation_gradient(const dealii::Tensor<2, dim> &H)
    {
      dealii::Tensor<2, dim> F = H;
      for (int a = 0; a < dim; ++a)
        F[a][a] += 1.;
      return F;
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim>
    left_cauchy_green_change(const dealii::Tensor<2, dim> &H)
    {
      dealii::SymmetricTensor<2, dim> change;
      for (int a = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b)
          {
            change[a][b] = H[a][b] + H[b][a];
            for (int c = 0; c < dim; ++c)
              change[a][b] += H[a][c] * H[b][c];
          }
      return change;
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim>
    right_cauchy_green_change(const dealii::Tensor<2, dim> &H)
    {
      return left_cauchy_green_change<dim>(transpose(H));
    }

    double
    excess_over_logarithm(const double x, const double logarithm)
    {
      if (std::abs(x) > 0.3)
        return x - logarithm;
      // ln(1 + x) = 2 artanh(r) with r = x / (2 + x), and x - 2 r = x r; the
      // terms left out are below 1e-17 of the sum for r < 0.18
      const double r = x / (2. + x), square = r * r;
      double       power = r * square, sum = 0.;
      for (int k = 3; k < 27; k += 2, power *= square)
        sum += power / k;
      return x * r - 2. * sum;
    }

    double
    exponential_excess(const double x)
    {
      if (std::abs(x) > 0.5)
        return std::expm1(x) - x;
      // the terms left out are below 1e-17 of the sum for |x| < 0.5
      double term = 0.5 * x * x, sum = 0.;
      for (int k = 3; k < 16; term *= x / k, ++k)
        sum += term;
      return sum;
    }

#define PERIMORPH_INSTANTIATE(dim)                                             \
  template VolumeRatio            volume_ratio(const dealii::Tensor<2, dim> &, \
                                               const char *);                  \
  template dealii::Tensor<2, dim> deformation_gradient(                        \
    const dealii::Tensor<2, dim> &);                                           \
  template dealii::SymmetricTensor<2, dim> left_cauchy_green_change(           \
    const dealii::Tensor<2, dim> &);                                           \
  template dealii::SymmetricTensor<2, dim> right_cauchy_green_change(          \
    const dealii::Tensor<2, dim> &)
    PERIMORPH_INSTANTIATE(2);
    PERIMORPH_INSTANTIATE(3);
#undef PERIMORPH_INSTANTIATE
  } // namespace Materials
} // namespace Perimorph
