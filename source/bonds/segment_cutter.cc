#include <perimorph/bonds/segment_cutter.h>
#include <perimorph/mesh/cell_geometry.h>

#include <algorithm>
#include <cmath>

namespace Perimorph
{
  namespace Bonds
  {
    namespace
    {
      // Lengths relative to the segment, or unit coordinates of a cell.
      constexpr double merge_tolerance = 1e-12; ///< crossings that are the same
      constexpr double inside_tolerance =
        1e-12; ///< round-off of the inverse map
      /// A point in no cell may be this far off: faces of meshes read from
      /// files are straight only up to the digits written.
      constexpr double outside_tolerance = 1e-7;
      constexpr double face_tolerance    = 1e-6; ///< spare crossings do no harm
      constexpr double length_tolerance  = 1e-8;

      double
      cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
      {
        return a[0] * b[1] - a[1] * b[0];
      }

      double
      triple(const dealii::Tensor<1, 3> &a,
             const dealii::Tensor<1, 3> &b,
             const dealii::Tensor<1, 3> &c)
      {
        return a[0] * (b[1] * c[2] - b[2] * c[1]) +
               a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
      }

      bool
      on_face(const double unit_coordinate)
      {
        return unit_coordinate > -face_tolerance &&
               unit_coordinate < 1. + face_tolerance;
      }

      void
      keep_break(const double s, std::vector<double> &breaks)
      {
        if (s > merge_tolerance && s < 1. - merge_tolerance)
          breaks.push_back(s);
      }

      /// Crossing of the segment (from the origin along d) with the edge p0,
      /// p1. A parallel edge needs none: the next edge at its ends gives the
      /// crossing.
      void
      cross_edge(const dealii::Point<2>     &p0,
                 const dealii::Point<2>     &p1,
                 const dealii::Tensor<1, 2> &d,
                 std::vector<double>        &breaks)
      {
        const dealii::Tensor<1, 2> start       = p0 - dealii::Point<2>();
        const dealii::Tensor<1, 2> edge        = p1 - p0;
        const double               determinant = cross(d, edge);
        if (determinant * determinant <
            1e-28 * d.norm_square() * edge.norm_square())
          return;
        if (on_face(cross(start, d) / determinant))
          keep_break(cross(start, edge) / determinant, breaks);
      }

      /// Crossings of the segment with a bilinear face, at most two: the face
      /// is p00 + u e + v f + u v g, and det[p00 + u e, f + u g, d] = 0 gives
      /// u.
      void
      cross_face(const std::array<dealii::Point<3>, 4> &corners,
                 const dealii::Tensor<1, 3>            &d,
                 std::vector<double>                   &breaks)
      {
        const dealii::Tensor<1, 3> p00 = corners[0] - dealii::Point<3>();
        const dealii::Tensor<1, 3> e   = corners[1] - corners[0];
        const dealii::Tensor<1, 3> f   = corners[2] - corners[0];
        const dealii::Tensor<1, 3> g   = (corners[3] - corners[2]) - e;

        const double c0 = triple(p00, f, d);
        const double c1 = triple(e, f, d) + triple(p00, g, d);
        const double c2 = triple(e, g, d);
        const double scale =
          1e-14 *
          std::sqrt(d.norm_square() * f.norm_square() * e.norm_square());

        // Segment in the face or parallel to it: other faces give the
        // crossings.
        if (std::abs(c1) < scale && std::abs(c2) < scale)
          return;
        std::array<double, 2> roots;
        unsigned int          n_roots = 0;
        if (std::abs(c2) < scale)
          roots[n_roots++] = -c0 / c1;
        else
          {
            // A slightly negative discriminant is a segment that touches the
            // face.
            double discriminant = c1 * c1 - 4. * c0 * c2;
            if (discriminant < -1e-12 * (c1 * c1 + std::abs(4. * c0 * c2)))
              return;
            discriminant = std::max(discriminant, 0.);
            const double sum =
              -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
            roots[n_roots++] = sum / c2;
            if (sum != 0.)
              roots[n_roots++] = c0 / sum;
          }

        for (unsigned int r = 0; r < n_roots; ++r)
          if (on_face(roots[r]))
            {
              // (f + u g) v - d s = -(p00 + u e) in the least-squares sense.
              const dealii::Tensor<1, 3> line  = f + roots[r] * g;
              const dealii::Tensor<1, 3> start = p00 + roots[r] * e;

              const double ll          = line.norm_square();
              const double dd          = d.norm_square();
              const double ld          = line * d;
              const double determinant = ll * dd - ld * ld;
              if (determinant < 1e-24 * ll * dd)
                continue;
              const double ls = line * start;
              const double ds = d * start;
              if (on_face((ld * ds - dd * ls) / determinant))
                keep_break((ll * ds - ld * ls) / determinant, breaks);
            }
      }

      template <int dim>
      double
      distance_to_unit_cell(const dealii::Point<dim> &unit_point)
      {
        double excess = -1.;
        for (int d = 0; d < dim; ++d)
          excess = std::max({excess, -unit_point[d], unit_point[d] - 1.});
        return excess;
      }
    } // namespace

    template <int dim>
    SegmentCutter<dim>::SegmentCutter(const Mesh::NodalMesh<dim> &mesh)
      : mesh(mesh)
      , boxes(mesh.n_cells())
      , visited(mesh.n_cells(), 0)
    {
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const auto corners = mesh.corners(cell);
          Box       &box     = boxes[cell];
          box.lower = box.upper = corners[0];
          for (const auto &corner : corners)
            for (int d = 0; d < dim; ++d)
              {
                box.lower[d] = std::min(box.lower[d], corner[d]);
                box.upper[d] = std::max(box.upper[d], corner[d]);
              }
          const double margin = face_tolerance * box.lower.distance(box.upper);
          for (int d = 0; d < dim; ++d)
            {
              box.lower[d] -= margin;
              box.upper[d] += margin;
            }
        }
    }

    template <int dim>
    void
    SegmentCutter<dim>::find_candidates(const unsigned int first_node,
                                        const dealii::Tensor<1, dim> &segment)
    {
      const dealii::Point<dim> &origin = mesh.nodes[first_node];

      const auto meets = [&](const Box &box) {
        double enter = 0.;
        double leave = 1.;
        for (int d = 0; d < dim; ++d)
          {
            const double to_lower = box.lower[d] - origin[d];
            const double to_upper = box.upper[d] - origin[d];
            if (segment[d] == 0.)
              {
                if (to_lower > 0. || to_upper < 0.)
                  return false;
                continue;
              }
            const double a = to_lower / segment[d];
            const double b = to_upper / segment[d];
            enter          = std::max(enter, std::min(a, b));
            leave          = std::min(leave, std::max(a, b));
          }
        return enter <= leave;
      };

      ++call;
      candidates.clear();
      const auto visit = [&](const unsigned int cell) {
        if (visited[cell] == call)
          return;
        visited[cell] = call;
        if (!meets(boxes[cell]))
          return;
        candidates.push_back({cell, mesh.corners(cell), boxes[cell]});
        const dealii::Tensor<1, dim> shift = origin - dealii::Point<dim>();
        for (auto &corner : candidates.back().corners)
          corner -= shift;
        candidates.back().box.lower -= shift;
        candidates.back().box.upper -= shift;
      };

      for (const unsigned int cell : mesh.node_cells.row(first_node))
        visit(cell);
      for (unsigned int k = 0; k < candidates.size(); ++k)
        for (const unsigned int node : mesh.cells[candidates[k].cell])
          for (const unsigned int cell : mesh.node_cells.row(node))
            visit(cell);
    }

    template <int dim>
    void
    SegmentCutter<dim>::find_breaks(const dealii::Tensor<1, dim> &segment)
    {
      breaks.clear();
      for (const Candidate &candidate : candidates)
        for (int axis = 0; axis < dim; ++axis)
          for (unsigned int side = 0; side < 2; ++side)
            {
              const auto        &corners = candidate.corners;
              const unsigned int base    = side << axis;
              if constexpr (dim == 2)
                cross_edge(corners[base],
                           corners[base + (1u << (1 - axis))],
                           segment,
                           breaks);
              else
                {
                  const unsigned int step_u = 1u << ((axis + 1) % 3);
                  const unsigned int step_v = 1u << ((axis + 2) % 3);
                  cross_face({{corners[base],
                               corners[base + step_u],
                               corners[base + step_v],
                               corners[base + step_u + step_v]}},
                             segment,
                             breaks);
                }
            }
      breaks.push_back(0.);
      breaks.push_back(1.);
      std::sort(breaks.begin(), breaks.end());
      breaks.erase(std::unique(breaks.begin(),
                               breaks.end(),
                               [](const double a, const double b) {
                                 return b - a < merge_tolerance;
                               }),
                   breaks.end());
    }

    template <int dim>
    void
    SegmentCutter<dim>::find_places(const dealii::Point<dim> &point)
    {
      places.clear();
      double smallest_excess = outside_tolerance;
      for (unsigned int k = 0; k < candidates.size(); ++k)
        {
          const Candidate   &candidate = candidates[k];
          dealii::Point<dim> unit_point;
          if (!candidate.box.holds(point) ||
              !Mesh::map_to_unit_cell<dim>(candidate.corners,
                                           point,
                                           unit_point))
            continue;
          const double excess = distance_to_unit_cell(unit_point);
          if (excess <= outside_tolerance)
            places.push_back({k, excess});
          smallest_excess = std::min(smallest_excess, excess);
        }
      // Cells that really hold the point go before cells that nearly do.
      if (smallest_excess <= inside_tolerance)
        places.erase(std::remove_if(places.begin(),
                                    places.end(),
                                    [](const Place &place) {
                                      return place.excess > inside_tolerance;
                                    }),
                     places.end());
    }

    template <int dim>
    bool
    SegmentCutter<dim>::cut(const unsigned int              first_node,
                            const unsigned int              second_node,
                            std::vector<SegmentPiece<dim>> &pieces)
    {
      pieces.clear();
      const dealii::Tensor<1, dim> segment =
        mesh.nodes[second_node] - mesh.nodes[first_node];
      const double length = segment.norm();

      find_candidates(first_node, segment);
      find_breaks(segment);
      const auto at = [&](const double s) {
        return dealii::Point<dim>(s * segment);
      };

      double sum = 0.;
      for (unsigned int k = 0; k + 1 < breaks.size(); ++k)
        {
          const double begin = breaks[k];
          const double end   = breaks[k + 1];
          find_places(at(0.5 * (begin + end)));
          for (const Place &place : places)
            {
              const Candidate   &candidate = candidates[place.candidate];
              dealii::Point<dim> unit_begin, unit_end;
              // An end outside the cell means a crossing was missed.
              if (!Mesh::map_to_unit_cell<dim>(candidate.corners,
                                               at(begin),
                                               unit_begin) ||
                  !Mesh::map_to_unit_cell<dim>(candidate.corners,
                                               at(end),
                                               unit_end) ||
                  distance_to_unit_cell(unit_begin) > face_tolerance ||
                  distance_to_unit_cell(unit_end) > face_tolerance)
                return false;
              SegmentPiece<dim> piece;
              piece.cell        = candidate.cell;
              piece.share       = 1. / places.size();
              piece.length      = (end - begin) * length;
              piece.shape_begin = Mesh::shape_values<dim>(unit_begin);
              piece.shape_end   = Mesh::shape_values<dim>(unit_end);
              sum += piece.share * piece.length;
              pieces.push_back(piece);
            }
        }
      return std::abs(sum - length) <= length_tolerance * length;
    }

    template class SegmentCutter<2>;
    template class SegmentCutter<3>;
  } // namespace Bonds
} // namespace Perimorph
