#include <perimorph/fem/nodal_springs.h>

namespace Perimorph::Fem
{
  template <int dim>
  NodalSprings<dim>::NodalSprings(std::string               name,
                                  std::vector<unsigned int> nodes,
                                  std::vector<double>       stiffness)
    : spring_name(std::move(name))
    , nodes(std::move(nodes))
    , stiffness(std::move(stiffness))
  {}

  template <int dim>
  void
  NodalSprings<dim>::set_rest(const Vector &displacement)
  {
    rest.clear();
    for (const unsigned int n : nodes)
      rest.push_back(this->value_at(displacement.begin(), n));
  }

  template <int dim>
  std::string
  NodalSprings<dim>::name() const
  {
    return spring_name;
  }

  template <int dim>
  bool
  NodalSprings<dim>::is_linear() const
  {
    return true;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  NodalSprings<dim>::extension(const unsigned int spring,
                               const Vector      &displacement) const
  {
    const auto u = this->value_at(displacement.begin(), nodes[spring]);
    return rest.empty() ? u : u - rest[spring];
  }

  template <int dim>
  double
  NodalSprings<dim>::energy(const Vector &displacement) const
  {
    double sum = 0.;
    for (unsigned int s = 0; s < nodes.size(); ++s)
      sum +=
        0.5 * factor * stiffness[s] * extension(s, displacement).norm_square();
    return sum;
  }

  template <int dim>
  void
  NodalSprings<dim>::add_residual(const Vector &displacement,
                                  Vector       &residual) const
  {
    for (unsigned int s = 0; s < nodes.size(); ++s)
      this->add_at(residual.begin(),
                   nodes[s],
                   factor * stiffness[s] * extension(s, displacement));
  }

  template <int dim>
  void
  NodalSprings<dim>::add_tangent_product(const Vector &,
                                         const Vector &direction,
                                         Vector       &product) const
  {
    for (unsigned int s = 0; s < nodes.size(); ++s)
      this->add_at(product.begin(),
                   nodes[s],
                   factor * stiffness[s] *
                     this->value_at(direction.begin(), nodes[s]));
  }

  template <int dim>
  unsigned int
  NodalSprings<dim>::n_blocks() const
  {
    return nodes.size();
  }

  template <int dim>
  void
  NodalSprings<dim>::block_nodes(const unsigned int         block,
                                 std::vector<unsigned int> &list) const
  {
    list.assign(1, nodes[block]);
  }

  template <int dim>
  void
  NodalSprings<dim>::block_tangent(const unsigned int block,
                                   const Vector &,
                                   dealii::FullMatrix<double> &matrix) const
  {
    matrix.reinit(dim, dim);
    for (int d = 0; d < dim; ++d)
      matrix(d, d) = factor * stiffness[block];
  }

  template class NodalSprings<2>;
  template class NodalSprings<3>;
} // namespace Perimorph::Fem
