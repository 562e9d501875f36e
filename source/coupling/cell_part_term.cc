#include <perimorph/base/keep_where.h>
#include <perimorph/coupling/cell_part_term.h>

#include <utility>

namespace Perimorph::Coupling
{
  template <int dim>
  CellPartTerm<dim>::CellPartTerm(
    const Fem::NodePartition<dim>         &partition,
    std::vector<CellPart<dim>>             parts,
    std::vector<FullySymmetricTensor<dim>> tensors)
    : parts(std::move(parts))
    , tensors(std::move(tensors))
  {
    for (auto &part : this->parts)
      for (unsigned int &node : part.nodes)
        node = partition.local(node);
  }

  template <int dim>
  void
  CellPartTerm<dim>::remove(
    const std::function<bool(unsigned int, const std::vector<unsigned int> &)>
      &goes)
  {
    std::vector<bool> stays;
    for (const auto &part : parts)
      stays.push_back(!goes(part.cell, part.nodes));
    const auto keeps = [&](const std::size_t p) { return stays[p]; };
    Base::keep_where(parts, keeps);
    Base::keep_where(tensors, keeps);
  }

  template <int dim>
  std::string
  CellPartTerm<dim>::name() const
  {
    return "parts of cells at cracks";
  }

  template <int dim>
  bool
  CellPartTerm<dim>::is_linear() const
  {
    return true;
  }

  template <int dim>
  dealii::SymmetricTensor<2, dim>
  CellPartTerm<dim>::strain(const CellPart<dim> &part,
                            const double        *vector) const
  {
    dealii::Tensor<2, dim> gradient;
    for (unsigned int k = 0; k < part.nodes.size(); ++k)
      gradient +=
        outer_product(this->value_at(vector, part.nodes[k]), part.gradients[k]);
    return symmetrize(gradient);
  }

  template <int dim>
  double
  CellPartTerm<dim>::energy(const Vector &displacement) const
  {
    double sum = 0.;
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        const auto e = strain(parts[p], displacement.begin());
        sum += 0.5 * parts[p].volume * (e * tensors[p].contract(e));
      }
    return sum;
  }

  template <int dim>
  void
  CellPartTerm<dim>::add_residual(const Vector &displacement,
                                  Vector       &residual) const
  {
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        const auto &part = parts[p];
        const auto  stress =
          part.volume * tensors[p].contract(strain(part, displacement.begin()));
        for (unsigned int k = 0; k < part.nodes.size(); ++k)
          this->add_at(residual.begin(),
                       part.nodes[k],
                       stress * part.gradients[k]);
      }
  }

  template <int dim>
  void
  CellPartTerm<dim>::add_tangent_product(const Vector &,
                                         const Vector &direction,
                                         Vector       &product) const
  {
    add_residual(direction, product);
  }

  template <int dim>
  unsigned int
  CellPartTerm<dim>::n_blocks() const
  {
    return parts.size();
  }

  template <int dim>
  void
  CellPartTerm<dim>::block_nodes(const unsigned int         block,
                                 std::vector<unsigned int> &list) const
  {
    list = parts[block].nodes;
  }

  template <int dim>
  void
  CellPartTerm<dim>::block_tangent(const unsigned int block,
                                   const Vector &,
                                   dealii::FullMatrix<double> &matrix) const
  {
    const auto        &part = parts[block];
    const unsigned int n    = part.nodes.size();
    matrix.reinit(dim * n, dim * n);
    for (unsigned int w = 0; w < n; ++w)
      for (int k = 0; k < dim; ++k)
        {
          dealii::Tensor<2, dim> gradient;
          gradient[k] = part.gradients[w];
          const auto stress =
            part.volume * tensors[block].contract(symmetrize(gradient));
          for (unsigned int v = 0; v < n; ++v)
            {
              const auto force = stress * part.gradients[v];
              for (int i = 0; i < dim; ++i)
                matrix(dim * v + i, dim * w + k) = force[i];
            }
        }
  }

  template <int dim>
  void
  add_part_nodes(const std::vector<CellPart<dim>> &parts,
                 std::vector<unsigned int>        &needed)
  {
    for (const auto &part : parts)
      needed.insert(needed.end(), part.nodes.begin(), part.nodes.end());
  }

#define PERIMORPH_INSTANTIATE(dim)                                      \
  template class CellPartTerm<dim>;                                     \
  template void add_part_nodes<dim>(const std::vector<CellPart<dim>> &, \
                                    std::vector<unsigned int> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
