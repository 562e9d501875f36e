#pragma once

#include <perimorph/bonds/segment_crossings.h>
#include <perimorph/bonds/segment_piece.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <vector>

namespace Perimorph::Bonds
{
  /// Cuts the straight segment between two nodes at the faces of the cells
  /// where that is simple: along an edge, or through the inside of cells and of
  /// faces. Then it walks from each cell to the one behind the face where the
  /// segment leaves; no search, no inverse map.
  ///
  /// Keeps work arrays: one object per thread. The mesh must outlive the
  /// object.
  template <int dim>
  class SegmentWalk
  {
  public:
    explicit SegmentWalk(const Mesh::NodalMesh<dim> &mesh);

    /// @param[out] pieces  in the order of the segment
    /// @return false when the segment runs along a face, through a corner or an
    ///         edge, or out of the body: pieces are of no use then
    bool
    cut(unsigned int                    first_node,
        unsigned int                    second_node,
        std::vector<SegmentPiece<dim>> &pieces);

  private:
    static constexpr unsigned int n_corners = 1u << dim;

    using Crossing = typename SegmentCrossings<dim>::Crossing;
    using Corners  = typename SegmentCrossings<dim>::Corners;

    /// The pieces when the nodes are the ends of an edge.
    bool
    cut_edge(unsigned int                    first_node,
             unsigned int                    second_node,
             double                          length,
             std::vector<SegmentPiece<dim>> &pieces) const;

    /// Cell at the node that the segment runs into, inside of its faces.
    unsigned int
    first_cell(unsigned int node, const dealii::Tensor<1, dim> &segment) const;

    /// Cell behind a face, or none.
    unsigned int
    neighbour(unsigned int cell, unsigned int face);

    const Mesh::NodalMesh<dim> &mesh;
    /// Of each cell behind each face, as far as they were asked for.
    std::vector<std::array<unsigned int, 2 * dim>> neighbours;
    std::vector<Crossing>                          crossings;
  };
} // namespace Perimorph::Bonds
