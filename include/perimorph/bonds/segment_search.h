#pragma once

#include <perimorph/bonds/segment_crossings.h>
#include <perimorph/bonds/segment_piece.h>
#include <perimorph/mesh/multilinear_map.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <vector>

namespace Perimorph::Bonds
{
  /// Cuts any segment between two nodes at the faces of the cells, also along
  /// faces and edges: finds all cells it may meet, all crossings with their
  /// faces, and which cells hold what is between two crossings.
  ///
  /// The cells are those that common nodes connect along the segment: not
  /// across a gap. They come from the cells around the first node, gathered
  /// once for all its segments: call cut() in the order of first nodes. Keeps
  /// work arrays: one object per thread. The mesh must outlive the object.
  template <int dim>
  class SegmentSearch
  {
  public:
    explicit SegmentSearch(const Mesh::NodalMesh<dim> &mesh);

    /// @param[out] pieces  in the order of the segment
    /// @return false when the pieces do not add up to the length (1e-8)
    bool
    cut(unsigned int                    first_node,
        unsigned int                    second_node,
        std::vector<SegmentPiece<dim>> &pieces);

  private:
    using Corners  = typename SegmentCrossings<dim>::Corners;
    using Crossing = typename SegmentCrossings<dim>::Crossing;

    /// A cell near the first node, relative to it.
    struct NearCell
    {
      unsigned int              cell;
      Corners                   corners;
      Mesh::MultilinearMap<dim> map; ///< of the corners, once asked for
      bool                      has_map = false;
    };

    static constexpr unsigned int n_lanes = 8;
    using Lanes                           = std::array<double, n_lanes>;

    /// Boxes around cells, slightly enlarged.
    struct Boxes
    {
      std::array<Lanes, dim> lower;
      std::array<Lanes, dim> upper;
    };

    /// A near cell whose box the segment meets, and where.
    struct Candidate
    {
      unsigned int near_cell;
      double       enter;
      double       leave;
      unsigned int crossings_begin; ///< with its faces
      unsigned int crossings_end;
    };

    /// A cell that holds a piece of the segment.
    struct Place
    {
      unsigned int       near_cell;
      double             excess; ///< of its middle over the unit cell, or < 0
      dealii::Point<dim> unit_begin, unit_end; ///< approximate
    };

    /// Fills near_cells and their boxes with all cells that paths of cells from
    /// the node can reach within a distance.
    void
    gather(unsigned int node, double distance);

    /// Adds the box of the last near cell.
    void
    add_box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

    void
    find_candidates(const dealii::Tensor<1, dim> &segment);

    /// Leaves candidates that common nodes connect with the first node.
    void
    keep_connected();

    /// Fills breaks with 0, the parameters of all crossings, and 1, and drops
    /// candidates that the segment misses.
    void
    find_breaks(const dealii::Tensor<1, dim> &segment);

    /// Fills places with the cells that hold the part of the segment between
    /// two breaks.
    void
    find_places(const dealii::Tensor<1, dim> &segment,
                double                        begin,
                double                        end);

    /// Unit coordinates of a break if it is a crossing with a face of the
    /// candidate, else those of the middle of the cell.
    dealii::Point<dim>
    guess_unit(const Candidate &candidate, double s) const;

    const Mesh::MultilinearMap<dim> &
    map_of(unsigned int near_cell);

    const Mesh::NodalMesh<dim> &mesh;

    // Around the first node of the last call.
    unsigned int              first_node;
    double                    gathered = 0.; ///< up to this distance
    double                    longest  = 0.; ///< segment from there
    std::vector<NearCell>     near_cells;
    std::vector<Boxes>        boxes;
    std::vector<unsigned int> gathered_nodes;
    std::vector<unsigned int> cell_mark, node_mark; ///< number of the search
    unsigned int              mark = 0;

    // Work arrays of one call.
    std::vector<Candidate> candidates;
    std::vector<Crossing>  crossings;
    std::vector<double>    breaks;
    std::vector<Place>     places;
  };
} // namespace Perimorph::Bonds
