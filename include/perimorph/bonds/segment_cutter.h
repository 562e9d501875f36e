#pragma once

#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <vector>

namespace Perimorph
{
  namespace Bonds
  {
    /// The part of a bond inside one cell.
    template <int dim>
    struct SegmentPiece
    {
      unsigned int cell;
      /// 1 / number of cells that hold this part (a bond may run along a face).
      double share;
      double length;
      /// Shape functions of the cell where the piece begins and ends.
      std::array<double, (1u << dim)> shape_begin;
      std::array<double, (1u << dim)> shape_end;
    };

    /// Cuts the straight segment between two nodes at the faces of the cells:
    /// edges in 2D, bilinear faces in 3D (numerics-explicit.md, section 3).
    ///
    /// Candidate cells are found by walking from cell to cell along the
    /// segment, so the cost does not depend on the mesh or on its grading.
    /// Keeps work arrays: one object per thread. The mesh must outlive the
    /// object.
    template <int dim>
    class SegmentCutter
    {
    public:
      explicit SegmentCutter(const Mesh::NodalMesh<dim> &mesh);

      /// @param[out] pieces  in the order of the segment
      /// @return false when the pieces do not add up to the length (1e-8): the
      ///         segment leaves the body, and the bond has to be dropped
      bool
      cut(unsigned int                    first_node,
          unsigned int                    second_node,
          std::vector<SegmentPiece<dim>> &pieces);

    private:
      using Corners = std::array<dealii::Point<dim>, (1u << dim)>;

      struct Box
      {
        dealii::Point<dim> lower;
        dealii::Point<dim> upper;

        bool
        holds(const dealii::Point<dim> &point) const
        {
          for (int d = 0; d < dim; ++d)
            if (point[d] < lower[d] || point[d] > upper[d])
              return false;
          return true;
        }
      };

      /// A cell the segment may run through, relative to its first node.
      struct Candidate
      {
        unsigned int cell;
        Corners      corners;
        Box          box;
      };

      /// A cell around a point and the unit coordinates of the point there.
      struct Place
      {
        unsigned int candidate;
        double       excess; ///< distance to the unit cell, negative inside
      };

      void
      find_candidates(unsigned int                  first_node,
                      const dealii::Tensor<1, dim> &segment);

      /// Fills breaks with 0, the parameters of all crossings, and 1.
      void
      find_breaks(const dealii::Tensor<1, dim> &segment);

      /// Fills places with the cells that hold the point (relative to the first
      /// node of the segment).
      void
      find_places(const dealii::Point<dim> &point);

      const Mesh::NodalMesh<dim> &mesh;
      std::vector<Box>            boxes; ///< of the cells, slightly enlarged

      // Work arrays of one call.
      std::vector<unsigned int> visited; ///< number of the call, per cell
      unsigned int              call = 0;
      std::vector<Candidate>    candidates;
      std::vector<double>       breaks;
      std::vector<Place>        places;
    };
  } // namespace Bonds
} // namespace Perimorph
