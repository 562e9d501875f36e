#pragma once

#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/coupling/particle_states.h>
#include <perimorph/damage/breaking_rule.h>

#include <array>
#include <map>
#include <vector>

namespace Perimorph::Coupling
{
  /// Strengths of the materials of a body and of interfaces between them.
  struct StrengthTable
  {
    /// Of each material, as BodyMaterials::names.
    std::vector<Damage::Strengths> materials;
    /// Of pairs of materials, the smaller index first; those that are not
    /// there are as strong as the materials.
    std::map<std::array<unsigned int, 2>, Damage::Strengths> interfaces;
    /// Whether overloaded bonds open planes (FailurePlanes).
    bool opens_planes = true;
  };

  struct StrengthLoad
  {
    double load_factor;
    /// Of the plane that opens (Damage::failure_plane_normal()); zero: the bond
    /// breaks alone, as at interfaces with strengths of their own.
    dealii::Tensor<1, 3> normal;
  };

  /// Applies a rule with strengths to a bond. A bond lies in one material, or
  /// in two along their interface (families end at interfaces): its stress is
  /// the mean of its two particles in this material, in the axes and with the
  /// strengths of the material. Where an end is on an interface that has
  /// strengths of its own, these count instead, in the axes of both sides. The
  /// lowest load factor of all counts.
  /// A plane along the bond cannot cut it: such bonds do not break.
  /// Source of the mean: Hattori et al. (2017), Eq. (27).
  /// @param nodes  of the bond
  /// @param bond   length, extension; stress, axes, strengths are set here
  template <int dim>
  StrengthLoad
  load_factor_by_strength(const std::array<unsigned int, 2> &nodes,
                          const ParticleStates              &states,
                          const BodyMaterials<dim>          &materials,
                          const StrengthTable               &table,
                          const Damage::BreakingRule        &rule,
                          Damage::BondState                 &bond);
} // namespace Perimorph::Coupling
