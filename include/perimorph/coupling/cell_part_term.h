#pragma once

#include <perimorph/coupling/cell_parts.h>
#include <perimorph/coupling/segment_residual.h>
#include <perimorph/fem/contribution.h>

#include <functional>

namespace Perimorph::Coupling
{
  /// Energy of the parts of cells that cracks touch, at small strain:
  /// E = 1/2 sum over parts of volume strain : C : strain.
  template <int dim>
  class CellPartTerm : public Fem::Contribution<dim>
  {
  public:
    using Vector = Fem::Vector;

    /// @param parts    of this rank
    /// @param tensors  C of each part [stress]
    CellPartTerm(const Fem::NodePartition<dim>         &partition,
                 std::vector<CellPart<dim>>             parts,
                 std::vector<FullySymmetricTensor<dim>> tensors);

    /// Leaves out parts.
    /// @param goes  by number of the cell in the mesh and local nodes
    void
    remove(const std::function<bool(unsigned int,
                                    const std::vector<unsigned int> &)> &goes);

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
    dealii::SymmetricTensor<2, dim>
    strain(const CellPart<dim> &part, const double *vector) const;

    std::vector<CellPart<dim>>             parts; ///< with local nodes
    std::vector<FullySymmetricTensor<dim>> tensors;
  };

  /// Nodes a rank needs for its parts.
  template <int dim>
  void
  add_part_nodes(const std::vector<CellPart<dim>> &parts,
                 std::vector<unsigned int>        &needed);
} // namespace Perimorph::Coupling
