#pragma once

#include <perimorph/materials/finite_strain.h>

#include <array>

namespace Perimorph
{
  namespace Materials
  {
    /// Principal values of B = F F^T (or C = F^T F), rising.
    template <int dim>
    struct PrincipalStretches
    {
      std::array<double, dim>                 squared;   ///< w, of B
      std::array<double, dim>                 change;    ///< w - 1
      std::array<double, dim>                 logarithm; ///< ln w
      std::array<dealii::Tensor<1, dim>, dim> direction; ///< orthonormal
    };

    /// @param change  B - I or C - I, see finite_strain.h
    /// Closed form in 2D, iterative in 3D. Errors are round-off of |change|;
    /// far from rest the smallest w comes from J, the product of all, so that a
    /// small stretch beside a large one keeps its digits.
    template <int dim>
    PrincipalStretches<dim>
    principal_stretches(const dealii::SymmetricTensor<2, dim> &change,
                        const VolumeRatio                     &volume);

    /// Coefficients of the derivative dP/dF of an isotropic law in principal
    /// directions; the only entries that are not zero.
    template <int dim>
    struct PrincipalTangent
    {
      using Coefficients = std::array<std::array<double, dim>, dim>;
      Coefficients normal;  ///< (a, b) multiplies D_aa D_bb
      Coefficients direct;  ///< (a, b) multiplies D_ab D_ab, a != b
      Coefficients crossed; ///< (a, b) multiplies D_ab D_ba, a != b; symmetric
    };

    /// A[i][J][k][L] of PrincipalTangent with the dyads
    /// D_ab = left[a] (x) right[b].
    template <int dim>
    dealii::Tensor<4, dim>
    assemble_tangent(const PrincipalTangent<dim> &coefficients,
                     const std::array<dealii::Tensor<1, dim>, dim> &left,
                     const std::array<dealii::Tensor<1, dim>, dim> &right);
  } // namespace Materials
} // namespace Perimorph
