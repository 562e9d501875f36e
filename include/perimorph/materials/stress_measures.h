#pragma once

#include <perimorph/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Perimorph
{
  namespace Materials
  {
    /// Deformation and stress of one point in three dimensions, with what the
    /// model assumes of the thickness. Stresses in the units of Young's
    /// modulus.
    struct StressMeasures
    {
      dealii::Tensor<2, 3>          deformation_gradient;  ///< F [-]
      dealii::Tensor<2, 3>          first_piola_kirchhoff; ///< P = dW/dF
      dealii::SymmetricTensor<2, 3> kirchhoff;             ///< tau = P F^T
      dealii::SymmetricTensor<2, 3> cauchy;                ///< tau / det F
      dealii::SymmetricTensor<2, 3> strain; ///< 1/2 ln(F F^T) [-]
    };

    /// All measures at the displacement gradient H. For a law of small strain
    /// (is_linear()) the three stresses are its one stress and the strain is
    /// sym(H); F has the thickness stretch in both cases. The strain of the
    /// thickness in plane stress carries the round-off of F33, 1e-16.
    /// @throws Base::InadmissibleState
    template <int dim>
    StressMeasures
    stress_measures(const Material<dim> &law, const dealii::Tensor<2, dim> &H);
  } // namespace Materials
} // namespace Perimorph
