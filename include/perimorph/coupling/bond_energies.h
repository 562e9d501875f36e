#pragma once

#include <perimorph/coupling/bond_set.h>
#include <perimorph/fem/elastic_cells.h>
#include <perimorph/peridynamics/family_set.h>

#include <array>
#include <vector>

namespace Perimorph::Coupling
{
  struct BondEnergy
  {
    std::array<unsigned int, 2> nodes; ///< global, the smaller one first
    double                      energy;
  };

  /// Energy of each bond of the correspondence model,
  ///   w_ij = 1/2 a_i q_ij . eta_ij + 1/2 a_j q_ji . eta_ji,
  /// q the force of family_forces() with its stabilisation. In linear problems
  /// the energies add up to that of the families; the half of a bond may be
  /// negative (numerics-damage.md, section 3).
  ///
  /// @param families      of this rank, with global nodes
  /// @param displacement  of all nodes
  /// @return  of all ranks, sorted by nodes
  template <int dim>
  std::vector<BondEnergy>
  bond_energies(const Mesh::NodalMesh<dim>                          &mesh,
                const Peridynamics::FamilySet<dim>                  &families,
                const typename Fem::ElasticCells<dim>::MaterialList &laws,
                const std::vector<dealii::Tensor<1, dim>> &displacement,
                MPI_Comm                                   communicator);

  /// Energy of each bond of the bond-based model at small strain,
  /// k (e . eta)^2 / 2.
  /// @param bonds  of this rank
  /// @return  of all ranks, sorted by nodes
  template <int dim>
  std::vector<BondEnergy>
  bond_energies(const Mesh::NodalMesh<dim>                &mesh,
                const BondSet                             &bonds,
                const std::vector<dealii::Tensor<1, dim>> &displacement,
                MPI_Comm                                   communicator);
} // namespace Perimorph::Coupling
