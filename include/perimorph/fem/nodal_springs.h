#pragma once

#include <perimorph/fem/contribution.h>

namespace Perimorph::Fem
{
  /// Springs from nodes to points of their own: E = sum k / 2 |u - r|^2. Weak
  /// ones keep parts of the body that broke off from making a problem singular;
  /// those of the inertia of a time step end where the nodes would be without
  /// forces.
  template <int dim>
  class NodalSprings : public Contribution<dim>
  {
  public:
    /// @param name       for reports
    /// @param nodes      owned local nodes
    /// @param stiffness  k of each node [force / length]
    NodalSprings(std::string               name,
                 std::vector<unsigned int> nodes,
                 std::vector<double>       stiffness);

    /// Multiplies the stiffness of all springs, as given, with a factor.
    void
    set_factor(double value)
    {
      factor = value;
    }

    /// Displacements r of all owned entries; zero until then.
    void
    set_rest(const Vector &displacement);

    std::string
    name() const override;
    bool
    is_linear() const override;
    double
    energy(const Vector &displacement) const override;
    void
    add_residual(const Vector &displacement, Vector &residual) const override;
    void
    add_tangent_product(const Vector &displacement,
                        const Vector &direction,
                        Vector       &product) const override;
    unsigned int
    n_blocks() const override;
    void
    block_nodes(unsigned int               block,
                std::vector<unsigned int> &nodes) const override;
    void
    block_tangent(unsigned int                block,
                  const Vector               &displacement,
                  dealii::FullMatrix<double> &matrix) const override;

  private:
    /// u - r of a spring.
    dealii::Tensor<1, dim>
    extension(unsigned int spring, const Vector &displacement) const;

    std::string                         spring_name;
    std::vector<unsigned int>           nodes;
    std::vector<double>                 stiffness;
    double                              factor = 1.;
    std::vector<dealii::Tensor<1, dim>> rest; ///< or none
  };
} // namespace Perimorph::Fem
