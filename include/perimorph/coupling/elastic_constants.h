#pragma once

#include <perimorph/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>

namespace Perimorph::Coupling
{
  /// Uniaxial stress along a coordinate axis.
  struct UniaxialStress
  {
    double youngs_modulus; ///< stress over strain along the axis
    /// Strain, 1 along the axis: lateral contraction and, off the axes of an
    /// anisotropic law, shear. Of the plane in 2D.
    dealii::SymmetricTensor<2, 3> strain;
  };

  /// Elastic constants of a material at rest, of its plane in 2D.
  struct ElasticConstants
  {
    /// Scale of zero-energy stabilisation, Materials::mean_shear_modulus().
    double                        shear_modulus;
    std::array<UniaxialStress, 3> along; ///< the axes
  };

  template <int dim>
  ElasticConstants
  elastic_constants(const Materials::Material<dim> &law);
} // namespace Perimorph::Coupling
