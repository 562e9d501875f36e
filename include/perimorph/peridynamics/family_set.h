#pragma once

#include <deal.II/base/tensor.h>

#include <cstddef>
#include <vector>

namespace Perimorph::Peridynamics
{
  /// Families of the correspondence model as plain arrays (one row per
  /// particle). A particle is a node seen from one material: a node on an
  /// interface carries one particle per material, so that no family averages a
  /// jump.
  ///
  /// The displacement gradient of particle p is the sum over its family of
  /// (u_j - u_i) (x) gradient_weight; its energy is weight times the energy
  /// density plus stabilisation (numerics-explicit.md, section 2).
  template <int dim>
  struct FamilySet
  {
    std::vector<unsigned int> node;          ///< global node of the particle
    std::vector<unsigned int> material;      ///< index into the materials
    std::vector<double>       weight;        ///< a_i [volume]
    std::vector<double>       stabilization; ///< kappa_i [stress / length^2]

    std::vector<std::size_t>            offsets = {0};   ///< row starts
    std::vector<unsigned int>           neighbor;        ///< global node
    std::vector<dealii::Tensor<1, dim>> gradient_weight; ///< g_ij [1 / length]
    std::vector<double>                 bond_weight;     ///< w_ij [volume]

    std::size_t
    n_particles() const
    {
      return node.size();
    }

    std::size_t
    n_bonds() const
    {
      return neighbor.size();
    }
  };
} // namespace Perimorph::Peridynamics
