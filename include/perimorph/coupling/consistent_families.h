#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/coupling/elastic_constants.h>
#include <perimorph/mesh/nodal_mesh.h>
#include <perimorph/peridynamics/family_set.h>
#include <perimorph/peridynamics/influence_function.h>

#include <functional>
#include <string>
#include <vector>

namespace Perimorph::Coupling
{
  /// What the zero-energy stabilisation is measured by.
  enum class StabilizationScale
  {
    bending,      ///< the energy of bending fields is exact
    shear_modulus ///< kappa = gamma mu tr(K^-1) / dim
  };

  /// What the gradient of a family is averaged over. The stabilisation always
  /// reaches over the horizon.
  enum class GradientSupport
  {
    adjacent_cells, ///< the cells at the particle
    horizon         ///< the cells with their centroid in the horizon too
  };

  /// In the order of GradientSupport.
  const std::vector<std::string> &
  gradient_support_names();

  /// What is done for families that a crack cuts.
  enum class CrackRule
  {
    consistent,  ///< exact cracked patch test (numerics-cracks.md, section 8)
    shape_tensor ///< intact bonds and their shape tensor only
  };

  /// What the families of the correspondence model are built from.
  struct FamilyParameters
  {
    Peridynamics::InfluenceFunction influence =
      Peridynamics::InfluenceFunction::gaussian;
    double             gamma      = 1.; ///< dimensionless stabilisation
    StabilizationScale scale      = StabilizationScale::bending;
    GradientSupport    support    = GradientSupport::horizon;
    CrackRule          crack_rule = CrackRule::consistent;
    /// Of each material.
    std::vector<ElasticConstants> constants;
    /// Called now and then with the particles done and their number.
    std::function<void(std::size_t, std::size_t)> progress;
  };

  /// What cracks did to the families of all ranks.
  struct CrackReport
  {
    std::size_t n_cut  = 0; ///< families that lost bonds or sight
    std::size_t n_dead = 0; ///< of them those with too few bonds
    /// Largest component of the consistency condition, relative to the spacing
    /// to the power dim - 1.
    double residual = 0.;
    /// Nodes whose target the cracks change, in rising order.
    std::vector<unsigned int> nodes;
  };

  /// Families of the particles of this rank with the consistent, explicit
  /// nonlocal gradient: the average, with weights that sum to alpha at every
  /// quadrature point, of the finite-element gradients in the horizon. Any
  /// affine displacement then gives exactly the finite-element forces, on any
  /// mesh and for any alpha (numerics-explicit.md, section 2).
  ///
  /// Averages over the horizon reach the nodes of all cells there. Those over
  /// the cells at a particle (the ring form) fall off over 1.5 spacings; bonds
  /// to other nodes within the horizon have no gradient weight.
  ///
  /// Stabilisation by bending: the average over a family of the energy of a
  /// bending field is the energy of its average gradient plus that of its
  /// variance, V. The z-energy is made equal to gamma V in the mean over the
  /// bending fields along the axes. Because the averaging weights sum to alpha,
  /// the energies of all families then add up to that of the field, at
  /// surfaces too.
  ///
  /// Cracks are free surfaces: families that one cuts keep their intact bonds,
  /// with the shear modulus as scale of the stabilisation, and gradients near
  /// cracks are corrected (CutFamilies). alpha must be 1 there.
  ///
  /// @param alpha    blending weight per node, 1 = peridynamics
  /// @param horizon  per node [length]
  /// @param report   filled if there are cracks
  template <int dim>
  Peridynamics::FamilySet<dim>
  consistent_families(const Mesh::NodalMesh<dim> &mesh,
                      const std::vector<double>  &alpha,
                      const std::vector<double>  &horizon,
                      const FamilyParameters     &parameters,
                      const Bonds::CrackSet<dim> &cracks = {},
                      CrackReport                *report = nullptr);

  /// Families with the classical gradient w_ij K_i^-1 xi_ij and weight
  /// alpha_i V_i (numerics.md, section 2, uncorrected): bonds are all nodes
  /// within the horizon and in the cells at the node that no crack hides.
  ///
  /// @throws Base::InputError   a particle whose shape tensor is singular
  template <int dim>
  Peridynamics::FamilySet<dim>
  classical_families(const Mesh::NodalMesh<dim> &mesh,
                     const std::vector<double>  &alpha,
                     const std::vector<double>  &horizon,
                     const FamilyParameters     &parameters,
                     const Bonds::CrackSet<dim> &cracks = {});
} // namespace Perimorph::Coupling
