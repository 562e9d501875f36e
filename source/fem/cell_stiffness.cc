#include <perimorph/fem/cell_stiffness.h>

#include <algorithm>
#include <tuple>

namespace Perimorph::Fem
{
  template <int dim>
  bool
  CellStiffness<dim>::can_hold(const Contribution<dim> &term)
  {
    return term.has_cells() && term.is_linear() && term.is_symmetric();
  }

  template <int dim>
  CellStiffness<dim>::CellStiffness(
    const std::vector<const Contribution<dim> *> &terms,
    const Vector                                 &at_rest)
  {
    // (cell, term, block)
    std::vector<std::tuple<unsigned int, unsigned int, unsigned int>> blocks;
    for (unsigned int t = 0; t < terms.size(); ++t)
      for (unsigned int block = 0; block < terms[t]->n_blocks(); ++block)
        blocks.emplace_back(terms[t]->block_cell(block), t, block);
    std::sort(blocks.begin(), blocks.end());

    std::vector<unsigned int>  nodes;
    dealii::FullMatrix<double> matrix;
    for (std::size_t k = 0; k < blocks.size(); ++k)
      {
        const auto [cell, t, block] = blocks[k];
        if (k == 0 || cell != std::get<0>(blocks[k - 1]))
          {
            terms[t]->block_nodes(block, nodes);
            if (n_cells % n_lanes == 0)
              {
                groups.emplace_back();
                for (Lanes &entry : groups.back().stiffness)
                  entry.fill(0.);
                for (auto &lane : groups.back().nodes)
                  std::copy_n(nodes.begin(), n_nodes, lane.begin());
                groups.back().cells.fill(cell);
              }
            const unsigned int lane = n_cells++ % n_lanes;
            std::copy_n(nodes.begin(),
                        n_nodes,
                        groups.back().nodes[lane].begin());
            groups.back().cells[lane] = cell;
          }
        const unsigned int lane = (n_cells - 1) % n_lanes;
        terms[t]->block_tangent(block, at_rest, matrix);
        Lanes *entry = groups.back().stiffness.data();
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = r; c < n_rows; ++c)
            (*entry++)[lane] += matrix(dim + r, dim + c);
      }
  }

  template <int dim>
  void
  CellStiffness<dim>::remove(const std::vector<bool> &goes)
  {
    for (Group &group : groups)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        if (goes[group.cells[lane]])
          for (Lanes &entry : group.stiffness)
            entry[lane] = 0.;
  }

  template <int dim>
  void
  CellStiffness<dim>::add_product(const Vector &displacement,
                                  Vector       &forces) const
  {
    const double *u = displacement.begin();
    double       *f = forces.begin();
    for (const Group &group : groups)
      {
        std::array<Lanes, n_rows> relative, force;
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const auto   &nodes = group.nodes[lane];
            const double *first = u + dim * nodes[0];
            for (unsigned int v = 1; v < n_nodes; ++v)
              for (unsigned int d = 0; d < dim; ++d)
                relative[dim * (v - 1) + d][lane] =
                  u[dim * nodes[v] + d] - first[d];
          }
        for (Lanes &row : force)
          row.fill(0.);
        const Lanes *entry = group.stiffness.data();
        for (unsigned int r = 0; r < n_rows; ++r)
          {
            Lanes sum = force[r];
            for (unsigned int lane = 0; lane < n_lanes; ++lane)
              sum[lane] += (*entry)[lane] * relative[r][lane];
            ++entry;
            for (unsigned int c = r + 1; c < n_rows; ++c, ++entry)
              for (unsigned int lane = 0; lane < n_lanes; ++lane)
                {
                  sum[lane] += (*entry)[lane] * relative[c][lane];
                  force[c][lane] += (*entry)[lane] * relative[r][lane];
                }
            force[r] = sum;
          }
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const auto &nodes = group.nodes[lane];
            for (unsigned int d = 0; d < dim; ++d)
              {
                double sum = 0.;
                for (unsigned int v = 1; v < n_nodes; ++v)
                  {
                    const double value = force[dim * (v - 1) + d][lane];
                    f[dim * nodes[v] + d] += value;
                    sum += value;
                  }
                f[dim * nodes[0] + d] -= sum;
              }
          }
      }
  }

  template class CellStiffness<2>;
  template class CellStiffness<3>;
} // namespace Perimorph::Fem
