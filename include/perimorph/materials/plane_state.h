#pragma once

namespace Perimorph
{
  namespace Materials
  {
    /// What a two-dimensional model assumes of the third direction.
    enum class PlaneState
    {
      plane_stress,
      plane_strain,
      three_dimensional
    };

    /// Constants of an isotropic law, for the directions that the model has.
    struct LameConstants
    {
      /// [stress]; in plane stress 2 lambda mu / (lambda + 2 mu)
      double lambda;
      double mu; ///< shear modulus [stress]
      /// -e33 / (e11 + e22): nu / (1 - nu) in plane stress, otherwise 0
      double contraction;
    };

    /// @param youngs_modulus  E > 0 [stress]
    /// @param poissons_ratio  -1 < nu < 0.5
    LameConstants
    lame_constants(double     youngs_modulus,
                   double     poissons_ratio,
                   PlaneState state);
  } // namespace Materials
} // namespace Perimorph
