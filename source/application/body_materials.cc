#include <perimorph/application/body_materials.h>
#include <perimorph/materials/material_factory.h>

#include <cmath>

namespace Perimorph::Application
{
  const std::string rest_of_body = "rest";

  template <int dim>
  Coupling::BodyMaterials<dim>
  make_body_materials(Mesh::DistributedMesh<dim>                     &mesh,
                      const MaterialConstants                        &rest,
                      const std::map<std::string, MaterialConstants> &volumes,
                      const Materials::PlaneState                     state)
  {
    auto                                  &nodal = mesh.nodal();
    std::vector<const MaterialConstants *> known = {&rest};
    std::vector<unsigned int>              material_of_cell(nodal.n_cells(), 0);

    Coupling::BodyMaterials<dim> body;
    body.names = {rest_of_body};
    for (const auto &[name, constants] : volumes)
      {
        for (const unsigned int c :
             mesh.volume(name, "parameter 'Material / by volume'"))
          material_of_cell[c] = known.size();
        known.push_back(&constants);
        body.names.push_back(name);
      }

    using Angles = std::array<double, 3>;
    std::map<std::pair<unsigned int, Angles>, unsigned int> law_of;
    Base::InputErrorCollector                               errors;
    for (unsigned int c = 0; c < nodal.n_cells(); ++c)
      {
        const unsigned int material  = material_of_cell[c];
        const auto        &constants = *known[material];
        Angles             angles, rounded;
        for (int d = 0; d < 3; ++d)
          {
            const auto &angle = constants.orientation[d];
            if (!angle.check_finite(nodal.cell_centroid[c], 0., errors))
              errors.throw_if_any();
            angles[d] = angle.value(nodal.cell_centroid[c], 0.);
            // Round-off of the centroid makes no other law.
            rounded[d] = std::round(1e9 * angles[d]);
          }
        const auto [entry, is_new] =
          law_of.emplace(std::make_pair(material, rounded), body.laws.size());
        nodal.cell_material[c] = entry->second;
        if (!is_new)
          continue;
        body.axes.push_back(Materials::material_axes(angles));
        body.material_of_law.push_back(material);
        body.density.push_back(constants.density);
        body.bond_constants.push_back({constants.youngs_modulus, state});
        body.laws.push_back(
          Materials::is_anisotropic(constants.law)
            ? Materials::make_anisotropic_material<dim>(constants.law,
                                                        constants.constants,
                                                        state,
                                                        body.axes.back())
            : Materials::make_material<dim>(constants.law,
                                            constants.youngs_modulus,
                                            constants.poissons_ratio,
                                            state));
      }
    return body;
  }

#define PERIMORPH_INSTANTIATE(dim)                                \
  template Coupling::BodyMaterials<dim> make_body_materials<dim>( \
    Mesh::DistributedMesh<dim> &,                                 \
    const MaterialConstants &,                                    \
    const std::map<std::string, MaterialConstants> &,             \
    Materials::PlaneState);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
