#include <perimorph/materials/principal_stretches.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace Perimorph
{
  namespace Materials
  {
    namespace
    {
      void
      decompose(const dealii::SymmetricTensor<2, 2> &S,
                PrincipalStretches<2>               &principal)
      {
        const double mean       = 0.5 * (S[0][0] + S[1][1]);
        const double difference = 0.5 * (S[0][0] - S[1][1]);
        const double shear      = S[0][1];
        const double radius =
          std::sqrt(difference * difference + shear * shear);
        // the larger of two forms of the same direction
        double x = 1., y = 0.;
        if (difference >= 0.)
          {
            x = radius + difference;
            y = shear;
          }
        else
          {
            x = shear;
            y = radius - difference;
          }
        const double length       = std::sqrt(x * x + y * y);
        x                         = length > 0. ? x / length : 1.;
        y                         = length > 0. ? y / length : 0.;
        principal.change          = {{mean - radius, mean + radius}};
        principal.direction[0][0] = -y;
        principal.direction[0][1] = x;
        principal.direction[1][0] = x;
        principal.direction[1][1] = y;
      }

      void
      decompose(const dealii::SymmetricTensor<2, 3> &S,
                PrincipalStretches<3>               &principal)
      {
        Eigen::Matrix3d matrix;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            matrix(a, b) = S[a][b];
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
        for (int a = 0; a < 3; ++a)
          {
            principal.change[a] = solver.eigenvalues()(a);
            for (int i = 0; i < 3; ++i)
              principal.direction[a][i] = solver.eigenvectors()(i, a);
          }
      }
    } // namespace

    template <int dim>
    PrincipalStretches<dim>
    principal_stretches(const dealii::SymmetricTensor<2, dim> &change,
                        const VolumeRatio                     &volume)
    {
      PrincipalStretches<dim> principal;
      decompose(change, principal);
      for (int a = 0; a < dim; ++a)
        {
          principal.squared[a]   = 1. + principal.change[a];
          principal.logarithm[a] = std::log1p(principal.change[a]);
        }
      if (principal.change[0] < -0.5 || principal.change[dim - 1] > 1.)
        {
          double &smallest  = principal.squared[0];
          double &logarithm = principal.logarithm[0];
          smallest          = volume.J * volume.J;
          logarithm         = 2. * volume.log_J;
          for (int a = 1; a < dim; ++a)
            {
              smallest /= principal.squared[a];
              logarithm -= principal.logarithm[a];
            }
          principal.change[0] = smallest - 1.;
        }
      return principal;
    }

    template <int dim>
    dealii::Tensor<4, dim>
    assemble_tangent(const PrincipalTangent<dim> &coefficients,
                     const std::array<dealii::Tensor<1, dim>, dim> &left,
                     const std::array<dealii::Tensor<1, dim>, dim> &right)
    {
      dealii::Tensor<2, dim> dyad[dim][dim];
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          dyad[a][b] = outer_product(left[a], right[b]);

      // A = sum D_ab (x) partner_ab: one product per pair of directions
      dealii::Tensor<4, dim> A;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          {
            dealii::Tensor<2, dim> partner;
            if (a == b)
              for (int c = 0; c < dim; ++c)
                partner += coefficients.normal[a][c] * dyad[c][c];
            else
              partner = coefficients.direct[a][b] * dyad[a][b] +
                        coefficients.crossed[a][b] * dyad[b][a];
            for (int i = 0; i < dim; ++i)
              for (int j = 0; j < dim; ++j)
                A[i][j] += dyad[a][b][i][j] * partner;
          }
      return A;
    }

#define PERIMORPH_INSTANTIATE(dim)                       \
  template PrincipalStretches<dim> principal_stretches(  \
    const dealii::SymmetricTensor<2, dim> &,             \
    const VolumeRatio &);                                \
  template dealii::Tensor<4, dim> assemble_tangent<dim>( \
    const PrincipalTangent<dim> &,                       \
    const std::array<dealii::Tensor<1, dim>, dim> &,     \
    const std::array<dealii::Tensor<1, dim>, dim> &)
    PERIMORPH_INSTANTIATE(2);
    PERIMORPH_INSTANTIATE(3);
#undef PERIMORPH_INSTANTIATE
  } // namespace Materials
} // namespace Perimorph
