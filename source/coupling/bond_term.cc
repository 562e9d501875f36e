#include <perimorph/base/keep_where.h>
#include <perimorph/coupling/bond_term.h>
#include <perimorph/peridynamics/bond_based.h>

#include <algorithm>
#include <numeric>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Kernels of one bond, chosen at compile time.
    template <Kinematics kinematics>
    struct Bond
    {
      template <int dim>
      static double
      energy(const double                  k,
             const dealii::Tensor<1, dim> &xi,
             const dealii::Tensor<1, dim> &eta)
      {
        if constexpr (kinematics == Kinematics::finite_strain)
          return Peridynamics::bond_energy(k, xi, eta);
        else
          return Peridynamics::small_bond_energy(k, xi, eta);
      }

      template <int dim>
      static dealii::Tensor<1, dim>
      force(const double                  k,
            const dealii::Tensor<1, dim> &xi,
            const dealii::Tensor<1, dim> &eta)
      {
        if constexpr (kinematics == Kinematics::finite_strain)
          return Peridynamics::bond_force(k, xi, eta);
        else
          return Peridynamics::small_bond_force(k, xi, eta);
      }
    };
  } // namespace

  template <int dim, Kinematics kinematics>
  BondTerm<dim, kinematics>::BondTerm(const BondSet                 &bonds,
                                      const Fem::NodePartition<dim> &partition)
  {
    // Bonds in the order of their first node, so that each node is one block.
    std::vector<std::size_t> order(bonds.nodes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const std::size_t a, const std::size_t b) {
                       return bonds.nodes[a][0] < bonds.nodes[b][0];
                     });
    for (const std::size_t b : order)
      {
        const unsigned int first  = partition.local(bonds.nodes[b][0]);
        const unsigned int second = partition.local(bonds.nodes[b][1]);
        if (stars.empty() || stars.back().node != first)
          stars.push_back({first, neighbor.size(), neighbor.size()});
        neighbor.push_back(second);
        stiffness.push_back(bonds.stiffness[b]);
        xi.push_back(partition.position(second) - partition.position(first));
        stars.back().end = neighbor.size();
      }
  }

  template <int dim, Kinematics kinematics>
  std::vector<std::array<unsigned int, 2>>
  BondTerm<dim, kinematics>::pairs(
    const Fem::NodePartition<dim> &partition) const
  {
    std::vector<std::array<unsigned int, 2>> list;
    list.reserve(neighbor.size());
    for (const Star &star : stars)
      for (std::size_t b = star.begin; b < star.end; ++b)
        list.push_back(
          {{partition.global(star.node), partition.global(neighbor[b])}});
    return list;
  }

  template <int dim, Kinematics kinematics>
  std::string
  BondTerm<dim, kinematics>::name() const
  {
    return "bonds";
  }

  template <int dim, Kinematics kinematics>
  bool
  BondTerm<dim, kinematics>::is_linear() const
  {
    return kinematics == Kinematics::small_strain;
  }

  template <int dim, Kinematics kinematics>
  double
  BondTerm<dim, kinematics>::energy(const Vector &displacement) const
  {
    double sum = 0.;
    for (const Star &star : stars)
      for (std::size_t b = star.begin; b < star.end; ++b)
        sum += Bond<kinematics>::energy(
          stiffness[b],
          xi[b],
          this->value_at(displacement.begin(), neighbor[b]) -
            this->value_at(displacement.begin(), star.node));
    return sum;
  }

  template <int dim, Kinematics kinematics>
  void
  BondTerm<dim, kinematics>::add_residual(const Vector &displacement,
                                          Vector       &residual) const
  {
    for (const Star &star : stars)
      {
        const auto own = this->value_at(displacement.begin(), star.node);
        dealii::Tensor<1, dim> sum;
        for (std::size_t b = star.begin; b < star.end; ++b)
          {
            const auto force = Bond<kinematics>::force(
              stiffness[b],
              xi[b],
              this->value_at(displacement.begin(), neighbor[b]) - own);
            sum += force;
            this->add_at(residual.begin(), neighbor[b], force);
          }
        this->add_at(residual.begin(), star.node, -sum);
      }
  }

  template <int dim, Kinematics kinematics>
  std::vector<Peridynamics::PairForce<dim>>
  BondTerm<dim, kinematics>::pair_forces(
    const Vector                  &displacement,
    const Fem::NodePartition<dim> &partition) const
  {
    std::vector<Peridynamics::PairForce<dim>> pairs;
    pairs.reserve(neighbor.size());
    for (const Star &star : stars)
      for (std::size_t b = star.begin; b < star.end; ++b)
        pairs.push_back({partition.position(star.node),
                         partition.position(neighbor[b]),
                         Bond<kinematics>::force(
                           stiffness[b],
                           xi[b],
                           this->value_at(displacement.begin(), neighbor[b]) -
                             this->value_at(displacement.begin(), star.node))});
    return pairs;
  }

  template <int dim, Kinematics kinematics>
  void
  BondTerm<dim, kinematics>::add_tangent_product(
    [[maybe_unused]] const Vector &displacement,
    const Vector                  &direction,
    Vector                        &product) const
  {
    if constexpr (kinematics == Kinematics::small_strain)
      add_residual(direction, product);
    else
      for (const Star &star : stars)
        {
          const auto own = this->value_at(displacement.begin(), star.node);
          const auto own_change = this->value_at(direction.begin(), star.node);
          dealii::Tensor<1, dim> sum;
          for (std::size_t b = star.begin; b < star.end; ++b)
            {
              const auto force =
                Peridynamics::bond_tangent(
                  stiffness[b],
                  xi[b],
                  this->value_at(displacement.begin(), neighbor[b]) - own) *
                (this->value_at(direction.begin(), neighbor[b]) - own_change);
              sum += force;
              this->add_at(product.begin(), neighbor[b], force);
            }
          this->add_at(product.begin(), star.node, -sum);
        }
  }

  template <int dim, Kinematics kinematics>
  unsigned int
  BondTerm<dim, kinematics>::n_blocks() const
  {
    return stars.size();
  }

  template <int dim, Kinematics kinematics>
  void
  BondTerm<dim, kinematics>::block_nodes(const unsigned int         block,
                                         std::vector<unsigned int> &nodes) const
  {
    nodes.assign(1, stars[block].node);
    nodes.insert(nodes.end(),
                 neighbor.begin() + stars[block].begin,
                 neighbor.begin() + stars[block].end);
  }

  template <int dim, Kinematics kinematics>
  void
  BondTerm<dim, kinematics>::block_tangent(
    const unsigned int             block,
    [[maybe_unused]] const Vector &displacement,
    dealii::FullMatrix<double>    &matrix) const
  {
    const Star        &star = stars[block];
    const unsigned int n    = 1 + star.end - star.begin;
    matrix.reinit(dim * n, dim * n);
    for (unsigned int k = 1; k < n; ++k)
      {
        const std::size_t      b = star.begin + k - 1;
        dealii::Tensor<2, dim> K;
        if constexpr (kinematics == Kinematics::small_strain)
          K = Peridynamics::small_bond_tangent(stiffness[b], xi[b]);
        else
          K = Peridynamics::bond_tangent(
            stiffness[b],
            xi[b],
            this->value_at(displacement.begin(), neighbor[b]) -
              this->value_at(displacement.begin(), star.node));
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              matrix(i, j) += K[i][j];
              matrix(dim * k + i, dim * k + j) += K[i][j];
              matrix(i, dim * k + j) -= K[i][j];
              matrix(dim * k + i, j) -= K[i][j];
            }
      }
  }

  template <int dim>
  SegmentTerm<dim>::SegmentTerm(const Mesh::NodalMesh<dim>    &mesh,
                                const Fem::NodePartition<dim> &partition,
                                const BondCoupling<dim>       &coupling)
    : partition(partition)
    , cells(coupling.cells)
    , tensors(coupling.tensors)
  {
    for (const unsigned int c : coupling.cells)
      {
        nodes.emplace_back();
        for (unsigned int v = 0; v < n_nodes; ++v)
          nodes.back()[v] = partition.local(mesh.cells[c][v]);
      }
  }

  template <int dim>
  void
  SegmentTerm<dim>::remove(const std::vector<bool> &goes)
  {
    const auto stays = [&, all = cells](const std::size_t k) {
      return !goes[all[k]];
    };
    Base::keep_where(cells, stays);
    Base::keep_where(nodes, stays);
    Base::keep_where(tensors, stays);
  }

  template <int dim>
  std::string
  SegmentTerm<dim>::name() const
  {
    return "stiffness carried by bond segments";
  }

  template <int dim>
  bool
  SegmentTerm<dim>::is_linear() const
  {
    return true;
  }

  template <int dim>
  Mesh::CellGeometry<dim>
  SegmentTerm<dim>::geometry(const unsigned int block) const
  {
    typename Mesh::CellGeometry<dim>::Corners corners;
    for (unsigned int v = 0; v < n_nodes; ++v)
      corners[v] = partition.position(nodes[block][v]);
    return Mesh::CellGeometry<dim>(corners);
  }

  template <int dim>
  dealii::SymmetricTensor<2, dim>
  SegmentTerm<dim>::strain(const unsigned int             block,
                           const Mesh::CellGeometry<dim> &geometry,
                           const unsigned int             q,
                           const double                  *vector) const
  {
    dealii::Tensor<2, dim> gradient;
    for (unsigned int v = 0; v < n_nodes; ++v)
      gradient += outer_product(this->value_at(vector, nodes[block][v]),
                                geometry.gradients[q][v]);
    return symmetrize(gradient);
  }

  template <int dim>
  double
  SegmentTerm<dim>::energy(const Vector &displacement) const
  {
    double sum = 0.;
    for (unsigned int b = 0; b < nodes.size(); ++b)
      {
        const auto geometry = this->geometry(b);
        for (unsigned int q = 0; q < n_nodes; ++q)
          {
            const auto e = strain(b, geometry, q, displacement.begin());
            sum -= 0.5 * geometry.jxw[q] * (e * tensors[b][q].contract(e));
          }
      }
    return sum;
  }

  template <int dim>
  void
  SegmentTerm<dim>::add_residual(const Vector &displacement,
                                 Vector       &residual) const
  {
    for (unsigned int b = 0; b < nodes.size(); ++b)
      {
        const auto geometry = this->geometry(b);
        for (unsigned int q = 0; q < n_nodes; ++q)
          {
            const auto stress = -geometry.jxw[q] *
                                tensors[b][q].contract(
                                  strain(b, geometry, q, displacement.begin()));
            for (unsigned int v = 0; v < n_nodes; ++v)
              this->add_at(residual.begin(),
                           nodes[b][v],
                           stress * geometry.gradients[q][v]);
          }
      }
  }

  template <int dim>
  void
  SegmentTerm<dim>::add_tangent_product(const Vector &,
                                        const Vector &direction,
                                        Vector       &product) const
  {
    add_residual(direction, product);
  }

  template <int dim>
  unsigned int
  SegmentTerm<dim>::n_blocks() const
  {
    return nodes.size();
  }

  template <int dim>
  void
  SegmentTerm<dim>::block_nodes(const unsigned int         block,
                                std::vector<unsigned int> &list) const
  {
    list.assign(nodes[block].begin(), nodes[block].end());
  }

  template <int dim>
  void
  SegmentTerm<dim>::block_tangent(const unsigned int block,
                                  const Vector &,
                                  dealii::FullMatrix<double> &matrix) const
  {
    const auto geometry = this->geometry(block);
    matrix.reinit(dim * n_nodes, dim * n_nodes);
    for (unsigned int q = 0; q < n_nodes; ++q)
      for (unsigned int w = 0; w < n_nodes; ++w)
        for (int k = 0; k < dim; ++k)
          {
            dealii::Tensor<2, dim> gradient;
            gradient[k]       = geometry.gradients[q][w];
            const auto stress = geometry.jxw[q] * tensors[block][q].contract(
                                                    symmetrize(gradient));
            for (unsigned int v = 0; v < n_nodes; ++v)
              {
                const auto force = stress * geometry.gradients[q][v];
                for (int i = 0; i < dim; ++i)
                  matrix(dim * v + i, dim * w + k) -= force[i];
              }
          }
  }

  void
  add_bond_nodes(const BondSet &bonds, std::vector<unsigned int> &needed)
  {
    for (const auto &bond : bonds.nodes)
      needed.insert(needed.end(), bond.begin(), bond.end());
  }

  template class BondTerm<2>;
  template class BondTerm<3>;
  template class BondTerm<2, Kinematics::finite_strain>;
  template class BondTerm<3, Kinematics::finite_strain>;
  template class SegmentTerm<2>;
  template class SegmentTerm<3>;
} // namespace Perimorph::Coupling
