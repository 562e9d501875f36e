#pragma once

#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/materials/anisotropic_stiffness.h>
#include <perimorph/parameters/expression.h>

#include <array>
#include <map>
#include <string>

namespace Perimorph::Application
{
  /// What is known of one material, before laws are made of it.
  struct MaterialConstants
  {
    std::string law;
    double      youngs_modulus = 0.; ///< [stress], of isotropic laws
    double      poissons_ratio = 0.;
    /// Of anisotropic laws.
    Materials::NamedConstants constants;
    /// Turns of the material axes about x, y, z [degrees], in this order.
    std::array<Parameters::Expression, 3> orientation;
    double density = 0.; ///< [mass / volume], 0: not given
  };

  /// Name of what is in no volume of 'Material / by volume'.
  extern const std::string rest_of_body;

  /// Makes a law for every material and orientation, and says in
  /// NodalMesh::cell_material which cell has which. The orientation of a cell
  /// is that of its centroid, in the order of the cells: the same on all ranks.
  /// @param rest     of all cells that are in none of the volumes
  /// @param volumes  by the name of the volume
  /// @throws Base::InputError  unknown volumes, angles that are no numbers
  template <int dim>
  Coupling::BodyMaterials<dim>
  make_body_materials(Mesh::DistributedMesh<dim>                     &mesh,
                      const MaterialConstants                        &rest,
                      const std::map<std::string, MaterialConstants> &volumes,
                      Materials::PlaneState                           state);
} // namespace Perimorph::Application
