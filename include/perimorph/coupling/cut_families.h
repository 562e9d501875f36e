#pragma once

#include <perimorph/base/csr.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/bonds/support_search.h>
#include <perimorph/coupling/consistent_families.h>
#include <perimorph/coupling/crack_target.h>

namespace Perimorph::Coupling
{
  /// Adds to the list of particles those that decide about families near
  /// cracks, whoever owns them, so that every rank can compute these families.
  template <int dim>
  void
  add_particles_near_cracks(const Mesh::NodalMesh<dim>       &mesh,
                            const std::vector<double>        &alpha,
                            const std::vector<double>        &horizon,
                            const Bonds::CrackSet<dim>       &cracks,
                            std::vector<Bonds::ParticleSeed> &particles);

  /// A family in a set.
  template <int dim>
  struct FamilyReference
  {
    unsigned int                  particle; ///< index in the list of particles
    Peridynamics::FamilySet<dim> *set;
    std::size_t                   row;
  };

  /// What cracks do to the consistent families: who sees what, which bonds are
  /// left, and the correction of the gradients near cracks that makes the
  /// cracked patch test exact (numerics-cracks.md, section 8: F1 to F7).
  ///
  /// The same on every rank: each computes all families of the system near the
  /// cracks.
  template <int dim>
  class CutFamilies
  {
  public:
    /// All references must outlive the object.
    /// @param particles  see add_particles_near_cracks()
    /// @param supports   of these particles
    CutFamilies(const Mesh::NodalMesh<dim>             &mesh,
                const std::vector<double>              &horizon,
                const FamilyParameters                 &parameters,
                const Bonds::CrackSet<dim>             &cracks,
                const std::vector<Bonds::ParticleSeed> &particles,
                const Base::Csr<unsigned int>          &supports);

    /// F2: a crack touches a cell of the support or crosses a bond.
    bool
    is_cut(const unsigned int particle) const
    {
      return slot[particle] != none;
    }

    /// Too few intact bonds: the particle carries no energy.
    bool
    is_dead(const unsigned int particle) const
    {
      return is_cut(particle) && cut[slot[particle]].dead;
    }

    /// F5: takes part in the correction.
    bool
    in_system(const unsigned int particle) const
    {
      return near[particle] && !is_dead(particle);
    }

    /// F1: no crack between a particle and a quadrature point.
    bool
    sees(const unsigned int particle, const dealii::Point<dim> &point) const
    {
      return !is_cut(particle) ||
             !cracks.crosses(mesh.nodes[particles[particle].node], point);
    }

    /// Intact bonds of a cut family.
    const std::vector<unsigned int> &
    neighbors(const unsigned int particle) const
    {
      return cut[slot[particle]].neighbors;
    }

    /// Notes what a cut family lost when its average gradient was replaced by
    /// the row.
    /// @param average  node and gradient weight, the own node included
    void
    add_mismatch(
      const FamilyReference<dim> &family,
      const std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>
        &average);

    /// F4 to F7: corrects the gradients (and volumes) of the families.
    /// @param families  all of the system
    void
    correct(const std::vector<FamilyReference<dim>> &families);

    /// Of all ranks.
    std::size_t
    n_cut() const
    {
      return cut.size();
    }
    std::size_t
    n_dead() const;

    /// Largest component of the consistency condition after correct(),
    /// relative to the spacing to the power dim - 1.
    double
    residual() const
    {
      return largest_residual;
    }

    /// Nodes whose target the cracks change, in rising order.
    std::vector<unsigned int>
    target_nodes() const
    {
      std::vector<unsigned int> nodes;
      for (const auto &entry : target)
        nodes.push_back(entry.first);
      return nodes;
    }

  private:
    struct CutFamily
    {
      std::vector<unsigned int> neighbors;
      bool                      dead         = false;
      bool                      broken_bonds = false;
    };

    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    void
    find_bonds(unsigned int particle, CutFamily &family) const;

    /// Smallest and largest eigenvalue of the shape tensor.
    std::pair<double, double>
    shape_eigenvalues(unsigned int                     node,
                      const std::vector<unsigned int> &neighbors) const;

    /// F6: volumes of pieces of the body that cracks separate.
    void
    fit_volumes(const std::vector<FamilyReference<dim>> &families);

    const Mesh::NodalMesh<dim>             &mesh;
    const std::vector<double>              &horizon;
    const FamilyParameters                 &parameters;
    const Bonds::CrackSet<dim>             &cracks;
    const std::vector<Bonds::ParticleSeed> &particles;
    const Base::Csr<unsigned int>          &supports;

    std::vector<unsigned int> slot; ///< index into cut per particle, or none
    std::vector<CutFamily>    cut;
    std::vector<bool>         near; ///< within two horizons of a crack, or cut
    NodeVectors<dim>          target; ///< crack_target()
    NodeVectors<dim>          defect; ///< b_j
    double                    largest_residual = 0.;
  };
} // namespace Perimorph::Coupling
