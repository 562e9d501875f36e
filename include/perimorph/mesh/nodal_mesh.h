#pragma once

#include <perimorph/base/csr.h>
#include <perimorph/mesh/hanging_points.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace Perimorph
{
  namespace Mesh
  {
    /// A face of a cell on the surface of the body.
    template <int dim>
    struct BoundaryFace
    {
      unsigned int cell;
      unsigned int face; ///< number of the face in its cell (deal.II numbering)
      unsigned int boundary; ///< boundary id, index into MeshNames::boundaries
      std::array<unsigned int, (1u << (dim - 1))> nodes; ///< lexicographic
    };

    /// The mesh as plain arrays, complete and identical on every rank up to the
    /// node numbering. Everything that needs geometry (families, bond segments,
    /// stress recovery, distances) reads it; nothing changes it.
    ///
    /// Nodes are numbered like the degrees of freedom: node n carries the
    /// unknowns dim * n, ..., dim * n + dim - 1, and each rank owns a
    /// contiguous range. Units: any consistent units of length.
    template <int dim>
    struct NodalMesh
    {
      static constexpr unsigned int nodes_per_cell = 1u << dim;

      using Cell = std::array<unsigned int, nodes_per_cell>;

      std::vector<dealii::Point<dim>> nodes;
      /// Nodes of each cell in lexicographic order (x fastest), deal.II's
      /// order.
      std::vector<Cell>         cells;
      std::vector<unsigned int> cell_material; ///< index into the materials
      std::vector<unsigned int> cell_owner;    ///< rank that owns the cell
      std::vector<dealii::Point<dim>> cell_centroid; ///< mean of the vertices
      Base::Csr<unsigned int>         node_cells;    ///< cells around each node
      std::vector<BoundaryFace<dim>>  boundary_faces;
      HangingPoints                   hanging; ///< nodes without unknowns

      std::vector<double> volume; ///< V_i = integral of the shape function
      std::vector<double>
        spacing; ///< h_i = mean length of the edges at the node

      unsigned int rank        = 0;
      unsigned int owned_begin = 0; ///< first node owned by this rank
      unsigned int owned_end   = 0; ///< one past the last node owned

      unsigned int
      n_nodes() const
      {
        return nodes.size();
      }

      unsigned int
      n_cells() const
      {
        return cells.size();
      }

      bool
      owns_node(const unsigned int node) const
      {
        return node >= owned_begin && node < owned_end;
      }

      bool
      hangs(const unsigned int node) const
      {
        return !hanging.empty() && hanging.count(node) > 0;
      }

      bool
      owns_cell(const unsigned int cell) const
      {
        return cell_owner[cell] == rank;
      }

      std::array<dealii::Point<dim>, nodes_per_cell>
      corners(const unsigned int cell) const
      {
        std::array<dealii::Point<dim>, nodes_per_cell> points;
        for (unsigned int v = 0; v < nodes_per_cell; ++v)
          points[v] = nodes[cells[cell][v]];
        return points;
      }

      /// Fills cell_centroid, node_cells, volume and spacing from nodes and
      /// cells.
      void
      compute_derived();
    };
  } // namespace Mesh
} // namespace Perimorph
