#pragma once

#include <perimorph/bonds/support_search.h>
#include <perimorph/coupling/consistent_families.h>

#include <algorithm>

namespace Perimorph::Coupling
{
  /// Nodes of one family while it is built, with their sums; clears in
  /// O(size).
  template <int dim>
  class FamilyScratch
  {
  public:
    explicit FamilyScratch(const unsigned int n_nodes)
      : sums(n_nodes)
      , seen(n_nodes, false)
    {}

    dealii::Tensor<1, dim> &
    at(const unsigned int node)
    {
      if (!seen[node])
        {
          seen[node] = true;
          nodes.push_back(node);
          sums[node] = dealii::Tensor<1, dim>();
        }
      return sums[node];
    }

    const std::vector<unsigned int> &
    sorted_nodes()
    {
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    }

    void
    clear()
    {
      for (const unsigned int n : nodes)
        seen[n] = false;
      nodes.clear();
    }

  private:
    std::vector<dealii::Tensor<1, dim>> sums;
    std::vector<bool>                   seen;
    std::vector<unsigned int>           nodes;
  };

  /// Nodes of the family of a particle, its own included, in rising order: of
  /// the cells of its support those within reach, and all of the cells at the
  /// particle.
  template <int dim, typename Cells>
  void
  find_family_nodes(const Mesh::NodalMesh<dim> &mesh,
                    const unsigned int          node,
                    const Cells                &cells,
                    const double                horizon,
                    std::vector<unsigned int>  &nodes)
  {
    const double reach = horizon * (1. + Bonds::horizon_slack);
    nodes.clear();
    for (const unsigned int c : cells)
      {
        const auto &corners = mesh.cells[c];
        const bool  all =
          std::find(corners.begin(), corners.end(), node) != corners.end();
        for (const unsigned int n : corners)
          if (all || mesh.nodes[n].distance(mesh.nodes[node]) <= reach)
            nodes.push_back(n);
      }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }

  /// Weight of a bond before it is scaled by the stabilisation: volume times
  /// influence, which falls no further than Peridynamics::smallest_influence.
  template <int dim>
  double
  bond_weight(const Mesh::NodalMesh<dim>     &mesh,
              unsigned int                    node,
              unsigned int                    neighbor,
              double                          horizon,
              Peridynamics::InfluenceFunction influence);

  /// Adds a bond from `node` to the row that is being written to the set.
  template <int dim>
  void
  append_bond(const Mesh::NodalMesh<dim>     &mesh,
              unsigned int                    node,
              unsigned int                    neighbor,
              const dealii::Tensor<1, dim>   &gradient_weight,
              double                          horizon,
              Peridynamics::InfluenceFunction influence,
              Peridynamics::FamilySet<dim>   &set);

  /// Inverse of the shape tensor of the row that is being written.
  /// @throws Base::InputError  it is singular
  template <int dim>
  dealii::Tensor<2, dim>
  inverse_shape_tensor(const Mesh::NodalMesh<dim>         &mesh,
                       const Peridynamics::FamilySet<dim> &set,
                       unsigned int                        node);

  /// Gives the row that is being written the gradient w_ij K_i^-1 xi_ij.
  template <int dim>
  void
  use_shape_tensor(const Mesh::NodalMesh<dim>   &mesh,
                   unsigned int                  node,
                   const dealii::Tensor<2, dim> &inverse,
                   Peridynamics::FamilySet<dim> &set);

  /// Completes the row that is being written, stabilised by the shear modulus
  /// (numerics.md, D3).
  template <int dim>
  void
  close_row(const Bonds::ParticleSeed    &particle,
            double                        weight,
            const FamilyParameters       &parameters,
            const dealii::Tensor<2, dim> &inverse_shape_tensor,
            Peridynamics::FamilySet<dim> &set);

  /// Completes the row that is being written, stabilised by the energy of
  /// bending: weighs its bonds so that the z-energy is the variance of the
  /// energy of every bending field along the axes, for kappa = gamma:
  /// w_ij sum_d kappa_d (xi_d / |xi|)^2.
  /// @param variance  of the position over the averaging weights
  template <int dim>
  void
  close_row_by_bending(const Mesh::NodalMesh<dim>   &mesh,
                       const Bonds::ParticleSeed    &particle,
                       double                        weight,
                       const FamilyParameters       &parameters,
                       const dealii::Tensor<1, dim> &variance,
                       Peridynamics::FamilySet<dim> &set);
} // namespace Perimorph::Coupling
