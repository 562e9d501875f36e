#pragma once

#include <perimorph/coupling/cell_parts.h>
#include <perimorph/coupling/consistent_families.h>
#include <perimorph/coupling/segment_springs.h>
#include <perimorph/materials/linear_elastic.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <functional>
#include <vector>

namespace Perimorph::Coupling
{
  /// Bonds of the bond-based model that a rank owns, with global nodes.
  struct BondSet
  {
    std::vector<std::array<unsigned int, 2>> nodes;
    std::vector<double>                      stiffness; ///< k_ij [force/length]
    std::size_t n_dropped = 0; ///< bonds that leave the body, of this rank
  };

  /// Elastic constants of one material as the bond-based model needs them.
  struct BondMaterial
  {
    double                youngs_modulus;
    Materials::PlaneState state;
  };

  /// What the elements give up to the bonds that run through them.
  enum class ElementShare
  {
    none,    ///< uncorrected couplings
    tensors, ///< small strain: SegmentResidual
    springs  ///< finite strain: SegmentSprings
  };

  /// Bonds with calibrated stiffness, and what the elements must give up so
  /// that bonds and elements together pass the patch test.
  template <int dim>
  struct BondCoupling
  {
    BondSet                   bonds;
    std::vector<unsigned int> cells; ///< owned cells with tensors
    std::vector<typename SegmentResidual<dim>::PointTensors> tensors;
    std::vector<CellSprings<dim>>                            springs;

    // Of cracks.
    std::vector<bool>          replaced; ///< cells without elements, or empty
    std::vector<CellPart<dim>> parts;    ///< of owned cells instead of elements
    std::vector<FullySymmetricTensor<dim>> part_tensors;
    CrackReport                            cracked;
  };

  /// Finds the bonds, drops those that leave the body or their material,
  /// calibrates them on an ideal lattice, and computes the share of the
  /// elements (numerics-explicit.md, section 3).
  ///
  /// Bonds that cross a crack are left out. Elements at cracks become their
  /// visible parts, corrected so that cracks are free surfaces (CutResidual),
  /// or with the cheap rule are left out where a crack touches them.
  ///
  /// @param alpha  blending weight per node
  /// @param progress  called with the number of bonds done and their total
  template <int dim>
  BondCoupling<dim>
  make_bond_coupling(
    const Mesh::NodalMesh<dim>                          &mesh,
    const std::vector<double>                           &alpha,
    const std::vector<double>                           &horizon,
    const std::vector<BondMaterial>                     &materials,
    ElementShare                                         share,
    const std::function<void(std::size_t, std::size_t)> &progress = {},
    const Bonds::CrackSet<dim>                          &cracks   = {},
    CrackRule rule = CrackRule::consistent);
} // namespace Perimorph::Coupling
