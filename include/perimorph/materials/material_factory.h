#pragma once

#include <perimorph/materials/material.h>
#include <perimorph/materials/plane_state.h>

#include <memory>
#include <string>
#include <vector>

namespace Perimorph
{
  namespace Materials
  {
    /// Names of all laws, as in the parameter file and Material::name.
    const std::vector<std::string> &
    law_names();

    /// @param law             one of law_names()
    /// @param youngs_modulus  E > 0 [stress]
    /// @param poissons_ratio  -1 < nu < 0.5; the prototype microelastic law has
    ///                        its own and does not read it
    /// @param state           three_dimensional in 3D, otherwise one of a plane
    template <int dim>
    std::unique_ptr<Material<dim>>
    make_material(const std::string &law,
                  double             youngs_modulus,
                  double             poissons_ratio,
                  PlaneState         state);
  } // namespace Materials
} // namespace Perimorph
