#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/coupling/consistent_families.h>

#include <mpi.h>

namespace Perimorph::Coupling
{
  /// Families after bonds broke. A family that lost none stays as it was. The
  /// others keep their weight and the gradients of their intact bonds, to which
  /// the shape tensor of these adds what linear exactness misses,
  ///   g_j += w_j C K^-1 xi_j,  C = I - sum_k g_k (x) xi_k,
  /// and are stabilised by the shear modulus with kappa from K
  /// (numerics-damage.md, section 5). Families whose K is singular (condition
  /// above 1e8) lose their weight and their bonds; they never fail. Softened
  /// bonds keep a share of g and w and are corrected in the same way.
  ///
  /// Broken bonds are free surfaces only as far as families no longer see
  /// across: unlike at cracks the patch test is not exact there.
  ///
  /// @param families    with global nodes, before any bond broke
  /// @param n_isolated  families that lost their weight, of this rank
  template <int dim>
  Peridynamics::FamilySet<dim>
  break_bonds(const Mesh::NodalMesh<dim>         &mesh,
              const std::vector<double>          &horizon,
              const FamilyParameters             &parameters,
              const Bonds::BrokenBonds           &broken,
              const Peridynamics::FamilySet<dim> &families,
              std::size_t                        &n_isolated);

  /// The same for one family.
  /// @param particle  of the families
  /// @param set       gets it as its last row
  /// @return  false, and no row, if it loses its weight
  template <int dim>
  bool
  break_family(const Mesh::NodalMesh<dim>         &mesh,
               const std::vector<double>          &horizon,
               const FamilyParameters             &parameters,
               const Bonds::BrokenBonds           &broken,
               const Peridynamics::FamilySet<dim> &families,
               std::size_t                         particle,
               Peridynamics::FamilySet<dim>       &set);

  /// Parts of the body that nothing holds together: number of the part of each
  /// node, the part of node 0 first; the same on all ranks.
  /// @param families  of this rank with global nodes
  template <int dim>
  std::vector<unsigned int>
  find_parts(const Mesh::NodalMesh<dim>         &mesh,
             const std::vector<double>          &alpha,
             const Peridynamics::FamilySet<dim> &families,
             MPI_Comm                            communicator);

  /// The same with bonds in the place of families.
  /// @param bonds  of this rank
  template <int dim>
  std::vector<unsigned int>
  find_parts(const Mesh::NodalMesh<dim>                     &mesh,
             const std::vector<double>                      &alpha,
             const std::vector<std::array<unsigned int, 2>> &bonds,
             MPI_Comm                                        communicator);
} // namespace Perimorph::Coupling
