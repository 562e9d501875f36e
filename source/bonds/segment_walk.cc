#include <perimorph/bonds/segment_walk.h>

#include <algorithm>

namespace Perimorph::Bonds
{
  namespace
  {
    constexpr unsigned int none    = static_cast<unsigned int>(-1);
    constexpr unsigned int unknown = static_cast<unsigned int>(-2);

    /// What is nearer to a corner or an edge of a cell, in unit coordinates, is
    /// left to the general way. Wider than the tolerances there.
    constexpr double clearance = 1e-5;
    /// Crossings nearer to the beginning of a piece are that one [-].
    constexpr double same_crossing = 1e-8;
    /// Of the two expressions for a crossing, on the segment and on the face,
    /// over the size of the face: nearly parallel ones differ.
    constexpr double largest_mismatch = 1e-13;

    bool
    is_clear(const double unit_coordinate)
    {
      return unit_coordinate > clearance && unit_coordinate < 1. - clearance;
    }

    /// Multilinear shape functions of a face.
    template <int dim>
    std::array<double, (1u << (dim - 1))>
    face_shapes(const std::array<double, dim - 1> &on_face)
    {
      std::array<double, (1u << (dim - 1))> shapes;
      for (unsigned int k = 0; k < shapes.size(); ++k)
        {
          shapes[k] = 1.;
          for (unsigned int d = 0; d + 1 < dim; ++d)
            shapes[k] *= (k >> d) & 1u ? on_face[d] : 1. - on_face[d];
        }
      return shapes;
    }

    template <int dim>
    unsigned int
    corner_of(const typename Mesh::NodalMesh<dim>::Cell &cell,
              const unsigned int                         node)
    {
      return std::find(cell.begin(), cell.end(), node) - cell.begin();
    }
  } // namespace

  template <int dim>
  SegmentWalk<dim>::SegmentWalk(const Mesh::NodalMesh<dim> &mesh)
    : mesh(mesh)
    , neighbours(mesh.n_cells())
  {
    for (auto &of_cell : neighbours)
      of_cell.fill(unknown);
  }

  template <int dim>
  unsigned int
  SegmentWalk<dim>::neighbour(const unsigned int cell, const unsigned int face)
  {
    unsigned int &result = neighbours[cell][face];
    if (result == unknown)
      {
        const auto corners = SegmentCrossings<dim>::face_corners(face);
        result             = none;
        for (const unsigned int other :
             mesh.node_cells.row(mesh.cells[cell][corners[0]]))
          if (other != cell &&
              std::all_of(corners.begin(),
                          corners.end(),
                          [&](const unsigned int corner) {
                            return corner_of<dim>(mesh.cells[other],
                                                  mesh.cells[cell][corner]) <
                                   n_corners;
                          }))
            result = other;
      }
    return result;
  }

  template <int dim>
  unsigned int
  SegmentWalk<dim>::first_cell(const unsigned int            node,
                               const dealii::Tensor<1, dim> &segment) const
  {
    for (const unsigned int cell : mesh.node_cells.row(node))
      {
        const auto            &nodes  = mesh.cells[cell];
        const unsigned int     corner = corner_of<dim>(nodes, node);
        dealii::Tensor<2, dim> edges; // in columns
        for (int d = 0; d < dim; ++d)
          {
            const dealii::Tensor<1, dim> edge =
              mesh.nodes[nodes[corner ^ (1u << d)]] - mesh.nodes[node];
            for (int a = 0; a < dim; ++a)
              edges[a][d] = edge[a];
          }
        // The parts of the segment along the edges, times the determinant.
        const double           sign = determinant(edges) > 0. ? 1. : -1.;
        dealii::Tensor<1, dim> parts;
        double                 sum = 0.;
        for (int d = 0; d < dim; ++d)
          {
            dealii::Tensor<2, dim> replaced = edges;
            for (int a = 0; a < dim; ++a)
              replaced[a][d] = segment[a];
            parts[d] = sign * determinant(replaced);
            sum += std::abs(parts[d]);
          }
        bool is_inside = true;
        for (int d = 0; d < dim; ++d)
          is_inside = is_inside && parts[d] > clearance * sum;
        if (is_inside)
          return cell;
      }
    return none;
  }

  template <int dim>
  bool
  SegmentWalk<dim>::cut_edge(const unsigned int              first_node,
                             const unsigned int              second_node,
                             const double                    length,
                             std::vector<SegmentPiece<dim>> &pieces) const
  {
    for (const unsigned int cell : mesh.node_cells.row(first_node))
      {
        const auto        &nodes = mesh.cells[cell];
        const unsigned int end   = corner_of<dim>(nodes, second_node);
        if (end == n_corners)
          continue;
        const unsigned int begin  = corner_of<dim>(nodes, first_node);
        const unsigned int across = begin ^ end;
        if ((across & (across - 1)) != 0)
          return false; // a diagonal
        SegmentPiece<dim> piece;
        piece.cell   = cell;
        piece.length = length;
        piece.shape_begin.fill(0.);
        piece.shape_end.fill(0.);
        piece.shape_begin[begin] = 1.;
        piece.shape_end[end]     = 1.;
        pieces.push_back(piece);
      }
    for (auto &piece : pieces)
      piece.share = 1. / pieces.size();
    return !pieces.empty();
  }

  template <int dim>
  bool
  SegmentWalk<dim>::cut(const unsigned int              first_node,
                        const unsigned int              second_node,
                        std::vector<SegmentPiece<dim>> &pieces)
  {
    pieces.clear();
    const dealii::Tensor<1, dim> origin  = mesh.nodes[first_node];
    const dealii::Tensor<1, dim> segment = mesh.nodes[second_node] - origin;
    const double                 length  = segment.norm();
    if (cut_edge(first_node, second_node, length, pieces))
      return true;

    const SegmentCrossings<dim> to_cross(segment);
    SegmentPiece<dim>           piece;
    piece.cell  = first_cell(first_node, segment);
    piece.share = 1.;
    if (piece.cell == none)
      return false;
    piece.shape_begin.fill(0.);
    piece.shape_begin[corner_of<dim>(mesh.cells[piece.cell], first_node)] = 1.;
    for (double begin = 0.;;)
      {
        const auto &nodes   = mesh.cells[piece.cell];
        auto        corners = mesh.corners(piece.cell);
        for (auto &corner : corners)
          corner -= origin;
        crossings.clear();
        if (!to_cross.add(corners, crossings))
          return false;
        const Crossing *exit = nullptr;
        for (const Crossing &crossing : crossings)
          if (crossing.s > begin + same_crossing &&
              crossing.s < 1. - same_crossing &&
              (!exit || crossing.s < exit->s))
            exit = &crossing;
        if (!exit)
          {
            const unsigned int corner = corner_of<dim>(nodes, second_node);
            if (corner == n_corners)
              return false;
            piece.length = (1. - begin) * length;
            piece.shape_end.fill(0.);
            piece.shape_end[corner] = 1.;
            pieces.push_back(piece);
            return true;
          }

        if (!std::all_of(exit->on_face.begin(), exit->on_face.end(), is_clear))
          return false;
        const auto of_face = SegmentCrossings<dim>::face_corners(exit->face);
        const auto shapes  = face_shapes<dim>(exit->on_face);
        dealii::Tensor<1, dim> mismatch = -exit->s * segment;
        for (unsigned int k = 0; k < of_face.size(); ++k)
          mismatch += shapes[k] * corners[of_face[k]];
        const unsigned int next = neighbour(piece.cell, exit->face);
        if (next == none ||
            mismatch.norm_square() > largest_mismatch * largest_mismatch *
                                       corners[of_face.front()].distance_square(
                                         corners[of_face.back()]))
          return false;

        piece.length = (exit->s - begin) * length;
        piece.shape_end.fill(0.);
        for (unsigned int k = 0; k < of_face.size(); ++k)
          piece.shape_end[of_face[k]] = shapes[k];
        pieces.push_back(piece);
        begin      = exit->s;
        piece.cell = next;
        piece.shape_begin.fill(0.);
        for (unsigned int k = 0; k < of_face.size(); ++k)
          piece
            .shape_begin[corner_of<dim>(mesh.cells[next], nodes[of_face[k]])] =
            shapes[k];
      }
  }

  template class SegmentWalk<2>;
  template class SegmentWalk<3>;
} // namespace Perimorph::Bonds
