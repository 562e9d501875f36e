#include <perimorph/materials/plane_state.h>

namespace Perimorph
{
  namespace Materials
  {
    LameConstants
    lame_constants(const double     youngs_modulus,
                   const double     poissons_ratio,
                   const PlaneState state)
    {
      const double mu = youngs_modulus / (2. * (1. + poissons_ratio));
      if (state == PlaneState::plane_stress)
        return {youngs_modulus * poissons_ratio /
                  (1. - poissons_ratio * poissons_ratio),
                mu,
                poissons_ratio / (1. - poissons_ratio)};
      return {youngs_modulus * poissons_ratio /
                ((1. + poissons_ratio) * (1. - 2. * poissons_ratio)),
              mu,
              0.};
    }
  } // namespace Materials
} // namespace Perimorph
