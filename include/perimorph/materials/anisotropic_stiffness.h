#pragma once

#include <perimorph/base/exceptions.h>
#include <perimorph/materials/plane_state.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Perimorph::Materials
{
  /// Constants of a law by their names in the parameter file.
  using NamedConstants = std::map<std::string, double>;

  /// orthotropic, anisotropic: laws of small strain with material axes.
  const std::vector<std::string> &
  anisotropic_law_names();

  bool
  is_anisotropic(const std::string &law);

  /// Names of the constants of one of these laws.
  ///
  /// orthotropic: E1, E2, E3 and G12, G13, G23 [stress], nu12, nu13, nu23 [-],
  /// nu_ij = -e_jj / e_ii in uniaxial stress along i; the same in 2D.
  ///
  /// anisotropic: Cij [stress], i <= j, entries of the stiffness matrix in
  /// the order xx, yy, zz, yz, xz, xy of the material axes, for engineering
  /// shear strains. In 2D those of the plane, and C13, C23, C36, which give
  /// the stress across it in plane strain.
  template <int dim>
  std::vector<std::string>
  constant_names(const std::string &law);

  /// Those that must be given. Plane stress needs E1, E2, nu12, G12; plane
  /// strain E3, nu13, nu23 too; 3D all of them. Of an anisotropic law the
  /// diagonal; others are 0.
  template <int dim>
  std::vector<std::string>
  needed_constants(const std::string &law, PlaneState state);

  /// Adds a message for each constant that is missing or not allowed, and for
  /// a stiffness that is not positive definite.
  /// @param path  where they are given, e.g. "Material / constants"
  /// @param of    for the messages, e.g. " of inclusion"; may be empty
  /// @return      whether all is well
  template <int dim>
  bool
  check_constants(const std::string         &path,
                  const std::string         &of,
                  const std::string         &law,
                  const NamedConstants      &constants,
                  PlaneState                 state,
                  Base::InputErrorCollector &errors);

  /// Stiffness of small strain, of the plane in 2D.
  template <int dim>
  struct LinearStiffness
  {
    /// sigma = stiffness e [stress]
    dealii::SymmetricTensor<4, dim> stiffness;
    /// sigma_33 = out_of_plane_stress : e, 0 in plane stress and 3D
    dealii::SymmetricTensor<2, dim> out_of_plane_stress;
    /// e_33 = out_of_plane_strain : e, 0 unless in plane stress
    dealii::SymmetricTensor<2, dim> out_of_plane_strain;
  };

  /// In material axes, from constants that pass check_constants(). In plane
  /// stress the strain of the thickness is that of nu13 and nu23, which are 0
  /// where they are not given; it is 0 for an anisotropic law.
  template <int dim>
  LinearStiffness<dim>
  make_stiffness(const std::string    &law,
                 const NamedConstants &constants,
                 PlaneState            state);

  /// Material axes in rows: row i is axis i in global components, so that
  /// axes sigma axes^T has the components of the material.
  /// Turns about x, then y, then z (fixed axes), anticlockwise.
  /// @param angles  [degrees]
  dealii::Tensor<2, 3>
  material_axes(const std::array<double, 3> &angles);

  /// From material to global axes; in 2D axis 3 must stay out of the plane.
  template <int dim>
  LinearStiffness<dim>
  rotate(const LinearStiffness<dim> &stiffness,
         const dealii::Tensor<2, 3> &axes);
} // namespace Perimorph::Materials
