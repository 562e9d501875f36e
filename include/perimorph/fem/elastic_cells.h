#pragma once

#include <perimorph/fem/contribution.h>
#include <perimorph/materials/material.h>
#include <perimorph/mesh/cell_geometry.h>

#include <memory>

namespace Perimorph::Fem
{
  /// Finite-element elasticity of the cells of this rank, each quadrature point
  /// weighted: E = sum over cells and points of jxw weight W(I + grad u).
  /// Cells whose weights are all zero are not in the list.
  template <int dim>
  class ElasticCells : public Contribution<dim>
  {
  public:
    using MaterialList = std::vector<std::unique_ptr<Materials::Material<dim>>>;

    /// @param element_weight  nodal weight, interpolated to the quadrature
    ///        points: 1 - alpha for energy blending, empty for one everywhere
    /// @param skip  cells that do no work although their weight is not zero;
    ///        empty for none
    ElasticCells(const Mesh::NodalMesh<dim> &mesh,
                 const NodePartition<dim>   &partition,
                 const MaterialList         &materials,
                 const std::vector<double>  &element_weight,
                 const std::vector<bool>    &skip = {});

    /// Leaves out cells, by their numbers in the mesh.
    void
    remove(const std::vector<bool> &goes);

    /// Weights the energy of the cells once more.
    /// @param factors  one per block
    void
    scale(const std::vector<double> &factors);

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
    bool
    has_cells() const override
    {
      return true;
    }
    unsigned int
    block_cell(const unsigned int block) const override
    {
      return cells[block].number;
    }
    void
    block_tangent(unsigned int                block,
                  const Vector               &displacement,
                  dealii::FullMatrix<double> &matrix) const override;

    void
    extrapolate_stress(const Vector &displacement, const Vector &step) override;
    void
    forget_stress() override;

  private:
    static constexpr unsigned int n_nodes = 1u << dim;

    struct Cell
    {
      std::array<unsigned int, n_nodes> nodes;   ///< local nodes
      std::array<double, n_nodes>       weights; ///< at the quadrature points
      unsigned int                      material;
      unsigned int                      number; ///< in the mesh
    };

    Mesh::CellGeometry<dim>
    geometry(const Cell &cell) const;

    dealii::Tensor<2, dim>
    gradient(const Cell                    &cell,
             const Mesh::CellGeometry<dim> &geometry,
             unsigned int                   q,
             const double                  *vector) const;

    /// Tangent of the law at a quadrature point.
    dealii::Tensor<4, dim>
    point_tangent(unsigned int                   cell,
                  const Mesh::CellGeometry<dim> &geometry,
                  unsigned int                   q,
                  const double                  *displacement) const;

    const NodePartition<dim> &partition;
    const MaterialList       &materials;
    std::vector<Cell>         cells;
    /// Per cell and quadrature point; empty: none.
    std::vector<dealii::Tensor<2, dim>> extrapolated;
  };

  /// Nodes a rank needs for the elements it owns.
  template <int dim>
  void
  add_cell_nodes(const Mesh::NodalMesh<dim> &mesh,
                 std::vector<unsigned int>  &needed);
} // namespace Perimorph::Fem
