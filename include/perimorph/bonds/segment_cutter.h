#pragma once

#include <perimorph/bonds/segment_piece.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <memory>
#include <vector>

namespace Perimorph::Bonds
{
  /// Cuts the straight segment between two nodes at the faces of the cells:
  /// edges in 2D, bilinear faces in 3D (numerics-explicit.md, section 3).
  ///
  /// Most segments are cut by SegmentWalk, those along faces or through corners
  /// by SegmentSearch. Both look only at cells near the segment, so the cost
  /// does not depend on the mesh or on its grading. Keeps work arrays: one
  /// object per thread. The mesh must outlive the object.
  template <int dim>
  class SegmentCutter
  {
  public:
    explicit SegmentCutter(const Mesh::NodalMesh<dim> &mesh);
    ~SegmentCutter();
    SegmentCutter(SegmentCutter &&) noexcept;

    /// @param[out] pieces  in the order of the segment
    /// @return false when the pieces do not add up to the length (1e-8): the
    ///         segment leaves the body, and the bond has to be dropped
    bool
    cut(unsigned int                    first_node,
        unsigned int                    second_node,
        std::vector<SegmentPiece<dim>> &pieces);

  private:
    struct Ways;
    std::unique_ptr<Ways> ways;
  };
} // namespace Perimorph::Bonds
