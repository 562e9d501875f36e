#pragma once

#include <perimorph/base/exceptions.h>
#include <perimorph/fem/node_partition.h>

#include <deal.II/lac/full_matrix.h>

#include <sstream>
#include <string>
#include <vector>

namespace Perimorph::Fem
{
  /// One term of the internal energy: elements, families, bonds or a
  /// correction.
  ///
  /// A contribution is a list of blocks (a cell, a family, the bonds of a
  /// node); each block couples a few nodes. Blocks belong to one rank; their
  /// nodes may be owned by others. Every node argument is a local node of the
  /// partition, every vector must have its ghosts up to date.
  template <int dim>
  class Contribution
  {
  public:
    virtual ~Contribution() = default;

    virtual std::string
    name() const = 0;

    /// True when the force is linear in the displacement.
    virtual bool
    is_linear() const = 0;

    /// Stored energy of the blocks of this rank.
    virtual double
    energy(const Vector &displacement) const = 0;

    /// Adds the internal force dE/du, also into ghost entries.
    virtual void
    add_residual(const Vector &displacement, Vector &residual) const = 0;

    /// Adds the tangent at `displacement` times `direction` without a matrix.
    virtual void
    add_tangent_product(const Vector &displacement,
                        const Vector &direction,
                        Vector       &product) const = 0;

    virtual unsigned int
    n_blocks() const = 0;

    virtual void
    block_nodes(unsigned int block, std::vector<unsigned int> &nodes) const = 0;

    /// Blocks couple their first node with each of the others, but not the
    /// others among each other.
    virtual bool
    has_stars() const
    {
      return false;
    }

    /// Blocks are cells of the mesh, each at most once, with the nodes in their
    /// order there.
    virtual bool
    has_cells() const
    {
      return false;
    }

    /// Number in the mesh of the cell of a block, if it has_cells().
    virtual unsigned int
    block_cell(const unsigned int /*block*/) const
    {
      AssertThrow(false, dealii::ExcInternalError());
      return 0;
    }

    /// Tangent of one block, rows and columns dim * (position in block_nodes) +
    /// component; row weights are applied by the caller.
    virtual void
    block_tangent(unsigned int                block,
                  const Vector               &displacement,
                  dealii::FullMatrix<double> &matrix) const = 0;

    /// Until forget_stress() the tangent has the stress extrapolated linearly
    /// from a displacement along a step (Materials::tangent_with_stress), where
    /// a term has stresses.
    virtual void
    extrapolate_stress(const Vector &, const Vector &)
    {}
    virtual void
    forget_stress()
    {}

    /// Weight of the equations of each local node, for force blending; empty
    /// means one everywhere (then the term is the gradient of its energy).
    void
    set_row_weights(std::vector<double> weights)
    {
      row_weights = std::move(weights);
    }

    double
    row_weight(const unsigned int local_node) const
    {
      return row_weights.empty() ? 1. : row_weights[local_node];
    }

    virtual bool
    is_symmetric() const
    {
      return row_weights.empty();
    }

  protected:
    std::vector<double> row_weights;

    /// Calls an action for the block at a point; says where a law gave up.
    template <typename Action>
    static void
    at_place(const dealii::Point<dim> &point, const Action &action)
    {
      try
        {
          action();
        }
      catch (const Base::InadmissibleState &error)
        {
          std::ostringstream text;
          text << error.what() << " at the point (" << point << ")";
          throw Base::InadmissibleState(text.str());
        }
    }

    static dealii::Tensor<1, dim>
    value_at(const double *vector, const unsigned int local_node)
    {
      dealii::Tensor<1, dim> value;
      for (int d = 0; d < dim; ++d)
        value[d] = vector[dim * local_node + d];
      return value;
    }

    void
    add_at(double                       *vector,
           const unsigned int            local_node,
           const dealii::Tensor<1, dim> &value) const
    {
      const double weight = row_weight(local_node);
      for (int d = 0; d < dim; ++d)
        vector[dim * local_node + d] += weight * value[d];
    }
  };
} // namespace Perimorph::Fem
