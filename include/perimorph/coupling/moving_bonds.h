#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/coupling/bond_states.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/coupling/failure_planes.h>

#include <memory>

namespace Perimorph::Coupling
{
  /// Bonds that a state of motion breaks.
  struct OverloadedBonds
  {
    std::vector<std::array<unsigned int, 2>> nodes; ///< global, sorted
    /// Of them those where elements carry a part: the core must grow first.
    std::vector<std::array<unsigned int, 2>> outside_core;
  };

  /// Of what the ranks found, each bond perhaps more than once.
  OverloadedBonds
  gather_overloaded(std::vector<std::array<unsigned int, 2>> found,
                    const std::vector<bool>                 &in_core,
                    MPI_Comm                                 communicator);

  /// Bonds of a body that moves, which break in place: only families that lose
  /// a bond are built anew.
  template <int dim>
  class MovingBonds
  {
  public:
    virtual ~MovingBonds() = default;

    /// The bonds that break at a displacement; the same on all ranks.
    /// @param displacement  of all nodes
    virtual OverloadedBonds
    overloaded(const std::vector<dealii::Tensor<1, dim>> &displacement) = 0;

    /// Takes away what the list of broken bonds has more than before.
    /// @param nodes  of the bonds that are new there
    virtual void
    take_away(const std::vector<std::array<unsigned int, 2>> &nodes) = 0;
  };

  /// What decides which bonds of a motion break.
  struct MotionDamage
  {
    const Damage::BreakingRule &rule;
    bool                        sees_particles;
    const StrengthTable        *strengths;    ///< null: the rule has none
    const std::vector<bool>    &is_protected; ///< nodes
    const Bonds::BrokenBonds   &broken;
    const std::vector<double>  &mass; ///< of nodes
    /// Families that would vibrate faster than this lose their weight, as those
    /// do whose bonds do not span space: few bonds make stiff levers that
    /// explicit steps cannot follow. Squared frequency; infinity: any.
    double largest_eigenvalue;
  };

  /// Of the correspondence model. Stretches are checked bond by bond; stresses
  /// and strains of particles first, since a mean of two states that are safe
  /// is safe (all criteria of particles are convex), but for bonds between
  /// materials.
  /// @param planes   those of the bonds that overloaded() gives are open in it
  /// @param problem  with the bonds broken so far; is changed
  template <int dim>
  std::unique_ptr<MovingBonds<dim>>
  make_moving_families(const Mesh::DistributedMesh<dim> &mesh,
                       const Mesh::RegionMap            &region,
                       const BodyMaterials<dim>         &materials,
                       const FamilyParameters           &parameters,
                       const MotionDamage               &damage,
                       FailurePlanes<dim>               &planes,
                       CoupledProblem<dim>              &problem);

  /// Of the bond-based model, whose bonds break by their stretch.
  template <int dim>
  std::unique_ptr<MovingBonds<dim>>
  make_moving_pairs(const Mesh::DistributedMesh<dim> &mesh,
                    const Mesh::RegionMap            &region,
                    const BodyMaterials<dim>         &materials,
                    const MotionDamage               &damage,
                    CoupledProblem<dim>              &problem);
} // namespace Perimorph::Coupling
