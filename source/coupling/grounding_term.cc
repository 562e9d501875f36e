#include <perimorph/coupling/grounding_term.h>

namespace Perimorph::Coupling
{
  template <int dim>
  GroundingTerm<dim>::GroundingTerm(std::vector<unsigned int> nodes,
                                    const double              stiffness)
    : nodes(std::move(nodes))
    , stiffness(stiffness)
  {}

  template <int dim>
  std::string
  GroundingTerm<dim>::name() const
  {
    return "springs of loose parts";
  }

  template <int dim>
  bool
  GroundingTerm<dim>::is_linear() const
  {
    return true;
  }

  template <int dim>
  double
  GroundingTerm<dim>::energy(const Vector &displacement) const
  {
    double sum = 0.;
    for (const unsigned int n : nodes)
      sum += this->value_at(displacement.begin(), n).norm_square();
    return 0.5 * stiffness * sum;
  }

  template <int dim>
  void
  GroundingTerm<dim>::add_residual(const Vector &displacement,
                                   Vector       &residual) const
  {
    for (const unsigned int n : nodes)
      this->add_at(residual.begin(),
                   n,
                   stiffness * this->value_at(displacement.begin(), n));
  }

  template <int dim>
  void
  GroundingTerm<dim>::add_tangent_product(const Vector &,
                                          const Vector &direction,
                                          Vector       &product) const
  {
    add_residual(direction, product);
  }

  template <int dim>
  unsigned int
  GroundingTerm<dim>::n_blocks() const
  {
    return nodes.size();
  }

  template <int dim>
  void
  GroundingTerm<dim>::block_nodes(const unsigned int         block,
                                  std::vector<unsigned int> &list) const
  {
    list.assign(1, nodes[block]);
  }

  template <int dim>
  void
  GroundingTerm<dim>::block_tangent(const unsigned int,
                                    const Vector &,
                                    dealii::FullMatrix<double> &matrix) const
  {
    matrix.reinit(dim, dim);
    for (int d = 0; d < dim; ++d)
      matrix(d, d) = stiffness;
  }

  template class GroundingTerm<2>;
  template class GroundingTerm<3>;
} // namespace Perimorph::Coupling
