#pragma once

#include <perimorph/materials/plane_state.h>

namespace Perimorph::Damage
{
  // What a bond bears, from the fracture energy G_c [stress length]; bodies of
  // unit thickness in 2D. A plane crack has to break every bond across it.
  // Source: numerics-damage.md, section 3.

  /// s_c of bonds of one micromodulus c: s_c^2 = 4 G_c / (c delta^4) in 2D, 10
  /// G_c / (pi c delta^5) in 3D.
  /// @param horizon  delta [length]
  /// @return         [-]
  double
  critical_stretch(double                fracture_energy,
                   double                youngs_modulus,
                   double                horizon,
                   Materials::PlaneState state);

  /// s_c from the bonds of one node: s_c^2 = 2 pi G_c / M in 2D, 8 G_c / M in
  /// 3D.
  /// @param moment  M = sum_j k_ij |xi|^3 / V_i, k_ij stiffness of the bond
  ///                [force / length]
  template <int dim>
  double
  critical_stretch_of_node(double fracture_energy, double moment);

  /// The same for the calibrated bonds of an interior node of a uniform
  /// lattice, which irregular meshes have on average.
  /// @param horizon_ratio  m = delta / spacing [-]
  template <int dim>
  double
  critical_stretch_of_lattice(double                fracture_energy,
                              double                youngs_modulus,
                              double                horizon,
                              double                horizon_ratio,
                              Materials::PlaneState state);

  /// w_0, energy of a bond over the volumes of both its ends: 3 G_c / (2
  /// delta^3) in 2D, 4 G_c / (pi delta^4) in 3D.
  /// @return  [stress / length^dim]
  template <int dim>
  double
  critical_energy_density(double fracture_energy, double horizon);

  /// Which nodes the families of the correspondence model have.
  enum class FamilyShape
  {
    ball, ///< within the horizon (Coupling::classical_families())
    cells ///< of the cells within it (Coupling::consistent_families())
  };

  /// kappa, the energy release rate over G_c at which a crack grows whose bonds
  /// break at w_0: measured with the correspondence model in 2D (edge crack,
  /// plane stress, Poisson's ratio 1/3, stabilisation gamma = 1) for horizon
  /// ratios of 2 and 3. Ball: 1.75 and 1.26 (+-11 % between meshes;
  /// numerics-damage.md, section 1). Cells: 3.04 and 2.0, means of a uniform
  /// and an unstructured mesh (3.04, 2.14 and 3.04, 1.90; same specimen): more
  /// bonds cross the crack, each has to break. Linear between the ratios,
  /// constant beyond.
  double
  lattice_trapping(double horizon_ratio, FamilyShape shape);
} // namespace Perimorph::Damage
