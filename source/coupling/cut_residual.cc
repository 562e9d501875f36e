#include <perimorph/coupling/cut_residual.h>
#include <perimorph/mesh/cell_geometry.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Points within this many horizons of a crack share the correction
    /// (numerics-cracks.md, section 8).
    constexpr double system_reach = 2.;

    /// What dC costs in elements, relative to parts. The one gradient of a part
    /// is smooth, elements feel each zigzag of their nodes: with equal prices
    /// 2 of 12 random cracks at m = 3 in perturbed meshes had an indefinite
    /// stiffness, from a price of 3 on none.
    constexpr double price_in_elements = 10.;

    template <int dim>
    constexpr unsigned int n3 = dim == 2 ? 4 : 10;

    /// Component of rank 3.
    template <int dim>
    unsigned int
    component3(const unsigned int a, const unsigned int b, const unsigned int c)
    {
      return FullySymmetricTensor<dim>::component(0, a, b, c);
    }

    /// One of the index triples of a component of rank 3.
    template <int dim>
    struct Triples
    {
      std::array<std::array<unsigned int, 3>, n3<dim>> index;
      std::array<unsigned int, n3<dim>>                multiplicity{};

      Triples()
      {
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            for (unsigned int c = 0; c < dim; ++c)
              {
                const unsigned int t = component3<dim>(a, b, c);
                index[t]             = {{a, b, c}};
                ++multiplicity[t];
              }
      }
    };

    template <int dim>
    const Triples<dim> &
    triples()
    {
      static const Triples<dim> instance;
      return instance;
    }

    /// Rows (l, abc) and columns abcd of w C . grad N_l at one point, in
    /// variables whose Euclidean norms are those of the tensors: the matrix
    /// acts on sqrt(w multiplicity) C.
    template <int dim, typename Gradients>
    void
    fill_columns(const Gradients            &gradients,
                 const double                weight,
                 const unsigned int          first_column,
                 Eigen::Ref<Eigen::MatrixXd> columns)
    {
      const auto &table = triples<dim>();
      for (unsigned int l = 0; l < gradients.size(); ++l)
        for (unsigned int t = 0; t < n3<dim>; ++t)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const auto        &abc = table.index[t];
              const unsigned int c =
                FullySymmetricTensor<dim>::component(abc[0], abc[1], abc[2], d);
              columns(l * n3<dim> + t, first_column + c) +=
                gradients[l][d] *
                std::sqrt(weight * table.multiplicity[t] /
                          FullySymmetricTensor<dim>::multiplicity(c));
            }
    }

    /// Points of a cell or the point of a part.
    template <int dim>
    struct Block
    {
      std::vector<unsigned int> nodes;
      std::vector<double>       weights;
      Eigen::MatrixXd           columns;
      double                    price = 1.;
    };

    template <int dim>
    Block<dim>
    block_of_cell(const Mesh::NodalMesh<dim> &mesh, const unsigned int cell)
    {
      constexpr unsigned int n4 = FullySymmetricTensor<dim>::n_components;
      const Mesh::CellGeometry<dim> geometry(mesh.corners(cell));
      Block<dim>                    block;
      block.nodes.assign(mesh.cells[cell].begin(), mesh.cells[cell].end());
      block.weights.assign(geometry.jxw.begin(), geometry.jxw.end());
      block.columns = Eigen::MatrixXd::Zero(block.nodes.size() * n3<dim>,
                                            block.weights.size() * n4);
      for (unsigned int q = 0; q < block.weights.size(); ++q)
        fill_columns<dim>(geometry.gradients[q],
                          geometry.jxw[q],
                          q * n4,
                          block.columns);
      block.price = price_in_elements;
      block.columns /= std::sqrt(block.price);
      return block;
    }

    template <int dim>
    Block<dim>
    block_of_part(const CellPart<dim> &part)
    {
      Block<dim> block{part.nodes, {part.volume}, {}, 1.};
      block.columns =
        Eigen::MatrixXd::Zero(part.nodes.size() * n3<dim>,
                              FullySymmetricTensor<dim>::n_components);
      fill_columns<dim>(part.gradients, part.volume, 0, block.columns);
      return block;
    }

    /// Solves M x = right for a symmetric M with affine fields in its kernel
    /// and right orthogonal to it.
    Eigen::VectorXd
    solve_semidefinite(const Eigen::SparseMatrix<double> &M,
                       const Eigen::VectorXd             &right)
    {
      // A tiny diagonal keeps the factorisation regular; iteration takes its
      // effect away. (Conjugate gradients stagnate at 3e-7 in space.)
      Eigen::SparseMatrix<double> regular = M;
      const double                scale   = M.diagonal().maxCoeff();
      for (int k = 0; k < M.rows(); ++k)
        regular.coeffRef(k, k) += 1e-11 * scale;
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(regular);
      Eigen::VectorXd x = Eigen::VectorXd::Zero(right.size());
      for (unsigned int iteration = 0; iteration < 4; ++iteration)
        x += factor.solve(right - M * x);
      return x;
    }
  } // namespace

  template <int dim>
  FullySymmetricTensor<dim>
  isotropic_tensor(const double shear_modulus)
  {
    FullySymmetricTensor<dim> C;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        C.components[C.component(a, a, b, b)] =
          (a == b ? 3. : 1.) * shear_modulus;
    return C;
  }

  template <int dim>
  CutResidual<dim>::CutResidual(const Mesh::NodalMesh<dim> &mesh,
                                const std::vector<double>  &horizon,
                                const Bonds::CrackSet<dim> &cracks,
                                const CellParts<dim>       &parts,
                                const std::vector<Tensor4> &stiffness,
                                const double                trace_radius_factor)
    : mesh(mesh)
    , cracks(cracks)
    , parts(parts)
    , stiffness(stiffness)
    , has_cell(mesh.n_cells(), false)
  {
    add_target(Bonds::CrackTraces<dim>(mesh, cracks, trace_radius_factor));
    find_cells(horizon);
  }

  template <int dim>
  void
  CutResidual<dim>::add_missing(const unsigned int            node,
                                const double                  factor,
                                const Tensor4                &C,
                                const dealii::Tensor<1, dim> &gradient)
  {
    Force &force = missing[node];
    for (unsigned int t = 0; t < n3; ++t)
      {
        const auto &abc = triples<dim>().index[t];
        for (unsigned int d = 0; d < dim; ++d)
          force[t] += factor * C(abc[0], abc[1], abc[2], d) * gradient[d];
      }
  }

  template <int dim>
  void
  CutResidual<dim>::add_target(const Bonds::CrackTraces<dim> &traces)
  {
    std::set<unsigned int> materials;
    for (const auto &part : parts.parts())
      materials.insert(mesh.cell_material[part.cell]);
    for (const unsigned int m : materials)
      for (const auto &[node, change] :
           crack_target<dim>(mesh, cracks, traces, 0, [&](const auto cell) {
             return mesh.cell_material[cell] == m;
           }))
        add_missing(node, 1., stiffness[m], change);
    for (const auto &entry : missing)
      changed_nodes.push_back(entry.first);
  }

  template <int dim>
  void
  CutResidual<dim>::find_cells(const std::vector<double> &horizon)
  {
    const auto take = [&](const unsigned int node) {
      for (const unsigned int c : mesh.node_cells.row(node))
        has_cell[c] = true;
    };
    for (const unsigned int n : changed_nodes)
      take(n);
    for (const auto &part : parts.parts())
      {
        has_cell[part.cell] = true;
        for (const unsigned int n : part.nodes)
          take(n);
      }
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (cracks.is_within(mesh.nodes[n], system_reach * horizon[n]))
        take(n);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (has_cell[c])
        all_cells.push_back(c);
  }

  template <int dim>
  void
  CutResidual<dim>::add_bond(
    const std::array<unsigned int, 2>           &nodes,
    const dealii::Tensor<1, dim>                &direction,
    const double                                 stiffness,
    const double                                 length,
    const std::vector<Bonds::SegmentPiece<dim>> &pieces)
  {
    const Tensor4 dyad = Tensor4::dyad(direction);
    for (const unsigned int n : nodes)
      of_node[n].add(0.5 * stiffness * length * length / mesh.volume[n], dyad);
    // The force of the bond, cell by cell.
    for (const auto &piece : pieces)
      if (has_cell[piece.cell])
        for (unsigned int v = 0; v < piece.shape_end.size(); ++v)
          add_missing(mesh.cells[piece.cell][v],
                      piece.share * stiffness * length *
                        (piece.shape_begin[v] - piece.shape_end[v]),
                      dyad,
                      direction);
  }

  template <int dim>
  void
  CutResidual<dim>::start()
  {
    for (const unsigned int c : all_cells)
      {
        const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
        const Tensor4                &C0 = stiffness[mesh.cell_material[c]];
        for (unsigned int q = 0; q < n_points; ++q)
          {
            // Without a crack the cell should have C_0, and an element has
            // C_0 - C_q.
            Tensor4 C = C0;
            if (!parts.is_touched(c))
              {
                C = Tensor4();
                for (unsigned int v = 0; v < geometry.n_nodes; ++v)
                  C.add(geometry.shape_value(q, v), of_node[mesh.cells[c][v]]);
                subtracted[c][q] = C;
              }
            for (unsigned int v = 0; v < geometry.n_nodes; ++v)
              add_missing(mesh.cells[c][v],
                          geometry.jxw[q],
                          C,
                          geometry.gradients[q][v]);
          }
      }
    for (const auto &part : parts.parts())
      {
        Tensor4 C = stiffness[mesh.cell_material[part.cell]];
        for (const unsigned int n : part.nodes)
          C.add(-1. / part.nodes.size(), of_node[n]);
        tensors.push_back(C);
        for (unsigned int k = 0; k < part.nodes.size(); ++k)
          add_missing(part.nodes[k], -part.volume, C, part.gradients[k]);
      }
  }

  template <int dim>
  void
  CutResidual<dim>::solve()
  {
    start();
    std::unordered_map<unsigned int, unsigned int> number;
    const auto for_all_blocks = [&](const auto &action) {
      for (auto &[cell, of_points] : subtracted)
        {
          const auto block = block_of_cell(mesh, cell);
          action(block, -1., of_points.data());
        }
      for (unsigned int p = 0; p < tensors.size(); ++p)
        action(block_of_part(parts.parts()[p]), 1., &tensors[p]);
    };

    std::vector<Eigen::Triplet<double>> entries;
    for_all_blocks([&](const auto &block, double, const Tensor4 *) {
      const Eigen::MatrixXd product = block.columns * block.columns.transpose();
      std::vector<unsigned int> rows;
      for (const unsigned int n : block.nodes)
        {
          const unsigned int row =
            number.emplace(n, number.size()).first->second * n3;
          for (unsigned int t = 0; t < n3; ++t)
            rows.push_back(row + t);
        }
      for (unsigned int r = 0; r < rows.size(); ++r)
        for (unsigned int c = 0; c < rows.size(); ++c)
          entries.emplace_back(rows[r], rows[c], product(r, c));
    });
    Eigen::SparseMatrix<double> matrix(number.size() * n3, number.size() * n3);
    matrix.setFromTriplets(entries.begin(), entries.end());
    std::vector<Eigen::Triplet<double>>().swap(entries);

    Eigen::VectorXd right = Eigen::VectorXd::Zero(matrix.rows());
    for (const auto &[node, force] : missing)
      if (const auto known = number.find(node); known != number.end())
        for (unsigned int t = 0; t < n3; ++t)
          right[known->second * n3 + t] =
            std::sqrt(triples<dim>().multiplicity[t]) * force[t];
    const Eigen::VectorXd lambda = solve_semidefinite(matrix, right);

    const Eigen::VectorXd rest  = right - matrix * lambda;
    double                scale = 0.;
    for (const auto &C : stiffness)
      scale = std::max(scale, C.norm());
    largest_residual = 0.;
    for (const auto &[node, k] : number)
      largest_residual =
        std::max(largest_residual,
                 rest.segment(k * n3, n3).norm() /
                   (scale * std::pow(mesh.spacing[node], dim - 1)));

    for_all_blocks([&](const auto &block, const double sign, Tensor4 *C) {
      Eigen::VectorXd mine(block.nodes.size() * n3);
      for (unsigned int l = 0; l < block.nodes.size(); ++l)
        mine.segment(l * n3, n3) =
          lambda.segment(number.at(block.nodes[l]) * n3, n3);
      const Eigen::VectorXd y = block.columns.transpose() * mine;
      for (unsigned int q = 0; q < block.weights.size(); ++q)
        for (unsigned int c = 0; c < n4; ++c)
          C[q].components[c] += sign * y[q * n4 + c] /
                                std::sqrt(block.price * block.weights[q] *
                                          Tensor4::multiplicity(c));
    });
  }

#define PERIMORPH_INSTANTIATE(dim)                                  \
  template FullySymmetricTensor<dim> isotropic_tensor<dim>(double); \
  template class CutResidual<dim>;

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
