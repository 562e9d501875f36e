#pragma once

#include <perimorph/coupling/segment_springs.h>
#include <perimorph/fem/contribution.h>

namespace Perimorph::Coupling
{
  /// What the elements give up at finite strain to the bonds that run through
  /// them, cell by cell:
  /// E = - sum over springs of k_p (|xi_p + eta_p| - |xi_p|)^2 / 2
  ///     + 1/2 sum over nodes of G_lm u_l . u_m.
  template <int dim>
  class SegmentPieceTerm : public Fem::Contribution<dim>
  {
  public:
    using Vector = Fem::Vector;

    SegmentPieceTerm(const Mesh::NodalMesh<dim>    &mesh,
                     const Fem::NodePartition<dim> &partition,
                     std::vector<CellSprings<dim>>  cells);

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
    static constexpr unsigned int n_nodes = 1u << dim;
    using NodeVectors = std::array<dealii::Tensor<1, dim>, n_nodes>;

    /// Values of the nodes of a cell relative to node 0, whose entry is zero:
    /// springs and stabilisation do not feel a translation.
    NodeVectors
    relative_values(unsigned int block, const double *vector) const;
    NodeVectors
    relative_positions(unsigned int block) const;

    /// G u.
    NodeVectors
    stabilization_forces(unsigned int block, const NodeVectors &values) const;

    void
    scatter(unsigned int       block,
            const NodeVectors &forces,
            double            *vector) const;

    const Fem::NodePartition<dim>                 &partition;
    std::vector<CellSprings<dim>>                  cells;
    std::vector<std::array<unsigned int, n_nodes>> nodes; ///< local
  };
} // namespace Perimorph::Coupling
