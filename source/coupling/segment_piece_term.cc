#include <perimorph/coupling/segment_piece_term.h>
#include <perimorph/peridynamics/bond_based.h>

#include <utility>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Difference of a field between the ends of a spring.
    template <int dim>
    dealii::Tensor<1, dim>
    jump(const CellSpring<dim>                                 &spring,
         const std::array<dealii::Tensor<1, dim>, (1u << dim)> &values)
    {
      dealii::Tensor<1, dim> sum;
      for (unsigned int v = 1; v < values.size(); ++v)
        sum += spring.jump[v - 1] * values[v];
      return sum;
    }

    /// Subtracts a force at the end of a spring, and its opposite at the
    /// beginning, from the nodes of the cell except node 0.
    template <int dim>
    void
    subtract(const CellSpring<dim>                           &spring,
             const dealii::Tensor<1, dim>                    &force,
             std::array<dealii::Tensor<1, dim>, (1u << dim)> &forces)
    {
      for (unsigned int v = 1; v < forces.size(); ++v)
        forces[v] -= spring.jump[v - 1] * force;
    }
  } // namespace

  template <int dim>
  SegmentPieceTerm<dim>::SegmentPieceTerm(
    const Mesh::NodalMesh<dim>    &mesh,
    const Fem::NodePartition<dim> &partition,
    std::vector<CellSprings<dim>>  cells)
    : partition(partition)
    , cells(std::move(cells))
  {
    for (const auto &cell : this->cells)
      {
        nodes.emplace_back();
        for (unsigned int v = 0; v < n_nodes; ++v)
          nodes.back()[v] = partition.local(mesh.cells[cell.cell][v]);
      }
  }

  template <int dim>
  std::string
  SegmentPieceTerm<dim>::name() const
  {
    return "springs of bond segments";
  }

  template <int dim>
  bool
  SegmentPieceTerm<dim>::is_linear() const
  {
    return false;
  }

  template <int dim>
  typename SegmentPieceTerm<dim>::NodeVectors
  SegmentPieceTerm<dim>::relative_values(const unsigned int block,
                                         const double      *vector) const
  {
    NodeVectors values;
    const auto  first = this->value_at(vector, nodes[block][0]);
    for (unsigned int v = 1; v < n_nodes; ++v)
      values[v] = this->value_at(vector, nodes[block][v]) - first;
    return values;
  }

  template <int dim>
  typename SegmentPieceTerm<dim>::NodeVectors
  SegmentPieceTerm<dim>::relative_positions(const unsigned int block) const
  {
    NodeVectors positions;
    for (unsigned int v = 1; v < n_nodes; ++v)
      positions[v] = partition.position(nodes[block][v]) -
                     partition.position(nodes[block][0]);
    return positions;
  }

  template <int dim>
  typename SegmentPieceTerm<dim>::NodeVectors
  SegmentPieceTerm<dim>::stabilization_forces(const unsigned int block,
                                              const NodeVectors &values) const
  {
    NodeVectors forces;
    for (unsigned int v = 1; v < n_nodes; ++v)
      for (unsigned int w = 1; w < n_nodes; ++w)
        forces[v] += cells[block].stabilization[v][w] * values[w];
    return forces;
  }

  template <int dim>
  void
  SegmentPieceTerm<dim>::scatter(const unsigned int block,
                                 const NodeVectors &forces,
                                 double            *vector) const
  {
    // Node 0 balances the others: a translation does no work.
    dealii::Tensor<1, dim> sum;
    for (unsigned int v = 1; v < n_nodes; ++v)
      {
        sum += forces[v];
        this->add_at(vector, nodes[block][v], forces[v]);
      }
    this->add_at(vector, nodes[block][0], -sum);
  }

  template <int dim>
  double
  SegmentPieceTerm<dim>::energy(const Vector &displacement) const
  {
    double sum = 0.;
    for (unsigned int b = 0; b < cells.size(); ++b)
      {
        const auto u      = relative_values(b, displacement.begin());
        const auto X      = relative_positions(b);
        const auto forces = stabilization_forces(b, u);
        for (unsigned int v = 1; v < n_nodes; ++v)
          sum += 0.5 * (forces[v] * u[v]);
        for (const auto &spring : cells[b].springs)
          {
            const auto xi = jump(spring, X);
            sum -= Peridynamics::bond_energy(spring.tension / xi.norm(),
                                             xi,
                                             jump(spring, u));
          }
      }
    return sum;
  }

  template <int dim>
  void
  SegmentPieceTerm<dim>::add_residual(const Vector &displacement,
                                      Vector       &residual) const
  {
    for (unsigned int b = 0; b < cells.size(); ++b)
      {
        const auto u      = relative_values(b, displacement.begin());
        const auto X      = relative_positions(b);
        auto       forces = stabilization_forces(b, u);
        for (const auto &spring : cells[b].springs)
          {
            const auto xi = jump(spring, X);
            subtract(spring,
                     Peridynamics::bond_force(spring.tension / xi.norm(),
                                              xi,
                                              jump(spring, u)),
                     forces);
          }
        scatter(b, forces, residual.begin());
      }
  }

  template <int dim>
  void
  SegmentPieceTerm<dim>::add_tangent_product(const Vector &displacement,
                                             const Vector &direction,
                                             Vector       &product) const
  {
    for (unsigned int b = 0; b < cells.size(); ++b)
      {
        const auto u      = relative_values(b, displacement.begin());
        const auto du     = relative_values(b, direction.begin());
        const auto X      = relative_positions(b);
        auto       forces = stabilization_forces(b, du);
        for (const auto &spring : cells[b].springs)
          {
            const auto xi = jump(spring, X);
            subtract(spring,
                     Peridynamics::bond_tangent(spring.tension / xi.norm(),
                                                xi,
                                                jump(spring, u)) *
                       jump(spring, du),
                     forces);
          }
        scatter(b, forces, product.begin());
      }
  }

  template <int dim>
  unsigned int
  SegmentPieceTerm<dim>::n_blocks() const
  {
    return cells.size();
  }

  template <int dim>
  void
  SegmentPieceTerm<dim>::block_nodes(const unsigned int         block,
                                     std::vector<unsigned int> &list) const
  {
    list.assign(nodes[block].begin(), nodes[block].end());
  }

  template <int dim>
  void
  SegmentPieceTerm<dim>::block_tangent(const unsigned int          block,
                                       const Vector               &displacement,
                                       dealii::FullMatrix<double> &matrix) const
  {
    const auto &cell = cells[block];
    const auto  u    = relative_values(block, displacement.begin());
    const auto  X    = relative_positions(block);
    // Rows and columns of node 0 follow from the others, and each pair of
    // nodes from its transpose: a good third of the work.
    std::array<std::array<dealii::Tensor<2, dim>, n_nodes>, n_nodes> sums;
    for (const auto &spring : cell.springs)
      {
        const auto xi = jump(spring, X);
        const auto K  = Peridynamics::bond_tangent(spring.tension / xi.norm(),
                                                  xi,
                                                  jump(spring, u));
        for (unsigned int v = 1; v < n_nodes; ++v)
          for (unsigned int w = v; w < n_nodes; ++w)
            sums[v][w] -= (spring.jump[v - 1] * spring.jump[w - 1]) * K;
      }
    for (unsigned int v = 1; v < n_nodes; ++v)
      for (unsigned int w = v; w < n_nodes; ++w)
        {
          for (int i = 0; i < dim; ++i)
            sums[v][w][i][i] += cell.stabilization[v][w];
          if (w > v)
            sums[w][v] = sums[v][w];
        }
    for (unsigned int v = 1; v < n_nodes; ++v)
      for (unsigned int w = 1; w < n_nodes; ++w)
        {
          sums[v][0] -= sums[v][w];
          sums[0][w] -= sums[v][w];
          sums[0][0] += sums[v][w];
        }
    matrix.reinit(dim * n_nodes, dim * n_nodes);
    for (unsigned int v = 0; v < n_nodes; ++v)
      for (unsigned int w = 0; w < n_nodes; ++w)
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            matrix(dim * v + i, dim * w + j) = sums[v][w][i][j];
  }

  template class SegmentPieceTerm<2>;
  template class SegmentPieceTerm<3>;
} // namespace Perimorph::Coupling
