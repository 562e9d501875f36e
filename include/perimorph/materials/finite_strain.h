#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>


namespace Perimorph
{
  namespace Materials
  {
    // Kinematics of H = grad u without the cancellation that F = I + H brings
    // at small strain: differences from the state of rest are formed from H.

    /// Volume ratio J = det F and ln J, to round-off in ln J also where J is
    /// close to 1.
    struct VolumeRatio
    {
      double J;
      double log_J;
      double change;       ///< J - 1
      double second_order; ///< J - 1 - tr H
    };

    /// @param law  name of the law, for the message
    /// @throws Base::InadmissibleState  J <= 0 or not finite
    template <int dim>
    VolumeRatio
    volume_ratio(const dealii::Tensor<2, dim> &H, const char *law);

    /// F = I + H.
    template <int dim>
    dealii::Tensor<2, dim>
    deformation_gradient(const dealii::Tensor<2, dim> &H);

    /// B - I = F F^T - I = H + H^T + H H^T.
    template <int dim>
    dealii::SymmetricTensor<2, dim>
    left_cauchy_green_change(const dealii::Tensor<2, dim> &H);

    /// C - I = F^T F - I = H + H^T + H^T H, twice the Green-Lagrange strain.
    template <int dim>
    dealii::SymmetricTensor<2, dim>
    right_cauchy_green_change(const dealii::Tensor<2, dim> &H);

    /// x - ln(1 + x), to round-off also where x is small.
    /// @param logarithm  ln(1 + x), taken where x is not small
    double
    excess_over_logarithm(double x, double logarithm);

    /// exp(x) - 1 - x, to round-off also where x is small.
    double
    exponential_excess(double x);
  } // namespace Materials
} // namespace Perimorph
