#pragma once

#include <perimorph/materials/anisotropic_stiffness.h>
#include <perimorph/materials/material.h>
#include <perimorph/materials/plane_state.h>

#include <memory>
#include <string>
#include <vector>

namespace Perimorph
{
  namespace Materials
  {
    /// Names of the isotropic laws, as in the parameter file and
    /// Material::name.
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

    /// @param law        one of anisotropic_law_names()
    /// @param constants  that pass check_constants()
    /// @param axes       material_axes(); axis 3 along z in 2D
    template <int dim>
    std::unique_ptr<Material<dim>>
    make_anisotropic_material(const std::string          &law,
                              const NamedConstants       &constants,
                              PlaneState                  state,
                              const dealii::Tensor<2, 3> &axes);
  } // namespace Materials
} // namespace Perimorph
