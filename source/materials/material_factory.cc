#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/materials/anisotropic_elastic.h>
#include <perimorph/materials/hencky.h>
#include <perimorph/materials/linear_elastic.h>
#include <perimorph/materials/material_factory.h>
#include <perimorph/materials/neo_hookean.h>
#include <perimorph/materials/prototype_microelastic.h>
#include <perimorph/materials/saint_venant_kirchhoff.h>

#include <deal.II/base/exceptions.h>

namespace Perimorph
{
  namespace Materials
  {
    const std::vector<std::string> &
    law_names()
    {
      static const std::vector<std::string> names = {"linear elastic",
                                                     "hencky",
                                                     "saint venant-kirchhoff",
                                                     "neo-hookean",
                                                     "prototype microelastic"};
      return names;
    }

    template <int dim>
    std::unique_ptr<Material<dim>>
    make_material(const std::string &law,
                  const double       youngs_modulus,
                  const double       poissons_ratio,
                  const PlaneState   state)
    {
      Assert((dim == 3) == (state == PlaneState::three_dimensional),
             dealii::ExcMessage("plane state of another dimension"));
      const double E = youngs_modulus, nu = poissons_ratio;
      if (law == "linear elastic")
        return std::make_unique<LinearElastic<dim>>(E, nu, state);
      if (law == "hencky")
        return std::make_unique<Hencky<dim>>(E, nu, state);
      if (law == "saint venant-kirchhoff")
        return std::make_unique<SaintVenantKirchhoff<dim>>(E, nu, state);
      if (law == "neo-hookean")
        return std::make_unique<NeoHookean<dim>>(E, nu, state);
      if (law == "prototype microelastic")
        return std::make_unique<PrototypeMicroelastic<dim>>(E, state);
      throw Base::InputError(Base::InputMessage{
        "material law",
        "'" + law + "'" + Base::did_you_mean(law, law_names()),
        "",
        ""});
    }

    template <int dim>
    std::unique_ptr<Material<dim>>
    make_anisotropic_material(const std::string          &law,
                              const NamedConstants       &constants,
                              const PlaneState            state,
                              const dealii::Tensor<2, 3> &axes)
    {
      return std::make_unique<AnisotropicElastic<dim>>(
        law,
        rotate(make_stiffness<dim>(law, constants, state), axes));
    }

    template std::unique_ptr<Material<2>>
    make_anisotropic_material<2>(const std::string &,
                                 const NamedConstants &,
                                 PlaneState,
                                 const dealii::Tensor<2, 3> &);
    template std::unique_ptr<Material<3>>
    make_anisotropic_material<3>(const std::string &,
                                 const NamedConstants &,
                                 PlaneState,
                                 const dealii::Tensor<2, 3> &);
    template std::unique_ptr<Material<2>>
    make_material<2>(const std::string &, double, double, PlaneState);
    template std::unique_ptr<Material<3>>
    make_material<3>(const std::string &, double, double, PlaneState);
  } // namespace Materials
} // namespace Perimorph
