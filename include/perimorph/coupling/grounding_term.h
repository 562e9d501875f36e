#pragma once

#include <perimorph/fem/contribution.h>

namespace Perimorph::Coupling
{
  /// Springs to the ground, so weak that they only keep parts of the body that
  /// broke off from making the problem singular: E = k / 2 sum |u|^2.
  template <int dim>
  class GroundingTerm : public Fem::Contribution<dim>
  {
  public:
    using Vector = Fem::Vector;

    /// @param nodes      owned local nodes
    /// @param stiffness  k of each node [force / length]
    GroundingTerm(std::vector<unsigned int> nodes, double stiffness);

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
    std::vector<unsigned int> nodes;
    double                    stiffness;
  };
} // namespace Perimorph::Coupling
