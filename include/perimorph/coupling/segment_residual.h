#pragma once

#include <perimorph/bonds/segment_piece.h>
#include <perimorph/coupling/fully_symmetric_tensor.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Perimorph
{
  namespace Coupling
  {
    /// What the cells must subtract from their stiffness so that bonds and
    /// elements together pass the patch test: a tensor C_q per Gauss point (in
    /// the order of Mesh::CellGeometry), found cell by cell from the pieces of
    /// the bonds. The residual stiffness of the element is C_0 - C_q. Source:
    /// numerics-explicit.md, section 3.
    template <int dim>
    class SegmentResidual
    {
    public:
      static constexpr unsigned int n_points = 1u << dim;

      using PointTensors = std::array<FullySymmetricTensor<dim>, n_points>;

      /// Outcome of solve() over all cells, and what to warn about.
      struct Report
      {
        /// Largest violation of the constraints, relative to their largest
        /// size among all cells.
        double       largest_residual = 0.;
        unsigned int smallest_rank    = 0; ///< of the local system
        unsigned int largest_rank     = 0;
      };

      /// @param owned_cells_only  ignore pieces in cells of other ranks
      /// The mesh must outlive the object.
      explicit SegmentResidual(const Mesh::NodalMesh<dim> &mesh,
                               bool owned_cells_only = true);

      /// @param direction  unit vector along the bond
      /// @param stiffness  pair stiffness k [force / length]
      /// @param length     |xi|
      void
      add_bond(const dealii::Tensor<1, dim>                &direction,
               double                                       stiffness,
               double                                       length,
               const std::vector<Bonds::SegmentPiece<dim>> &pieces);

      /// Computes C_q of all touched cells, once, and frees what add_bond()
      /// stored.
      Report
      solve();

      /// Cells with a piece of a bond, in the order they were met.
      const std::vector<unsigned int> &
      touched_cells() const
      {
        return cells;
      }

      /// C_q of touched_cells()[k], after solve() [stress].
      const PointTensors &
      tensors(const std::size_t k) const
      {
        return solution[k];
      }

    private:
      /// Rank 3, fully symmetric: 000, 001, 011, 111 in 2D, 10 in 3D.
      static constexpr unsigned int n_force_components = dim == 2 ? 4 : 10;
      static constexpr unsigned int n_nodes            = 1u << dim;

      /// T_l of the nodes of a cell.
      using Moments =
        std::array<std::array<double, n_force_components>, n_nodes>;

      const Mesh::NodalMesh<dim> &mesh;
      bool                        owned_cells_only;
      std::vector<unsigned int>   position_of_cell; ///< in cells
      std::vector<unsigned int>   cells;
      std::vector<Moments>        sums;
      std::vector<PointTensors>   solution;
    };
  } // namespace Coupling
} // namespace Perimorph
