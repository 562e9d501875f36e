#pragma once

#include <perimorph/mesh/nodal_mesh.h>
#include <perimorph/peridynamics/family_set.h>
#include <perimorph/peridynamics/influence_function.h>

#include <functional>
#include <vector>

namespace Perimorph::Coupling
{
  /// What the zero-energy stabilisation is measured by.
  enum class StabilizationScale
  {
    bending,      ///< the energy of bending fields is exact
    shear_modulus ///< kappa = gamma mu tr(K^-1) / dim
  };

  /// Elastic constants of a material at rest, of its plane in 2D.
  struct ElasticConstants
  {
    double shear_modulus;
    double youngs_modulus; ///< stress over strain in uniaxial stress
    double poissons_ratio; ///< lateral contraction there
  };

  /// What the families of the correspondence model are built from.
  struct FamilyParameters
  {
    Peridynamics::InfluenceFunction influence =
      Peridynamics::InfluenceFunction::gaussian;
    double             gamma = 1.; ///< dimensionless stabilisation
    StabilizationScale scale = StabilizationScale::bending;
    /// Of each material.
    std::vector<ElasticConstants> constants;
    /// Called now and then with the particles done and their number.
    std::function<void(std::size_t, std::size_t)> progress;
  };

  /// Families of the particles of this rank with the consistent, explicit
  /// nonlocal gradient: the average, with weights that sum to alpha at every
  /// quadrature point, of the finite-element gradients in the horizon. Any
  /// affine displacement then gives exactly the finite-element forces, on any
  /// mesh and for any alpha (numerics-explicit.md, section 2).
  ///
  /// Stabilisation by bending: the average over a family of the energy of a
  /// bending field is the energy of its average gradient plus that of its
  /// variance, V. The z-energy is made equal to gamma V in the mean over the
  /// bending fields along the axes. Because the averaging weights sum to alpha,
  /// the energies of all families then add up to that of the field, at
  /// surfaces too.
  ///
  /// @param alpha    blending weight per node, 1 = peridynamics
  /// @param horizon  per node [length]
  template <int dim>
  Peridynamics::FamilySet<dim>
  consistent_families(const Mesh::NodalMesh<dim> &mesh,
                      const std::vector<double>  &alpha,
                      const std::vector<double>  &horizon,
                      const FamilyParameters     &parameters);

  /// Families with the classical gradient w_ij K_i^-1 xi_ij and weight
  /// alpha_i V_i (numerics.md, section 2, uncorrected): bonds are all nodes
  /// within the horizon and in the cells at the node.
  ///
  /// @throws Base::InputError   a particle whose shape tensor is singular
  template <int dim>
  Peridynamics::FamilySet<dim>
  classical_families(const Mesh::NodalMesh<dim> &mesh,
                     const std::vector<double>  &alpha,
                     const std::vector<double>  &horizon,
                     const FamilyParameters     &parameters);
} // namespace Perimorph::Coupling
