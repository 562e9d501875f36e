#include <perimorph/bonds/segment_search.h>
#include <perimorph/mesh/cell_geometry.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Bonds
{
  namespace
  {
    // Lengths relative to the segment, or unit coordinates of a cell.
    constexpr double inside_tolerance = 1e-12; ///< round-off of the inverse map
    /// A point in no cell may be this far off: faces of meshes read from
    /// files are straight only up to the digits written.
    constexpr double outside_tolerance = 1e-7;
    constexpr double length_tolerance  = 1e-8;

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
  SegmentSearch<dim>::SegmentSearch(const Mesh::NodalMesh<dim> &mesh)
    : mesh(mesh)
    , first_node(dealii::numbers::invalid_unsigned_int)
    , cell_mark(mesh.n_cells(), 0)
    , node_mark(mesh.n_nodes(), 0)
  {}

  template <int dim>
  void
  SegmentSearch<dim>::add_box(const dealii::Point<dim> &lower,
                              const dealii::Point<dim> &upper)
  {
    const unsigned int lane = (near_cells.size() - 1) % n_lanes;
    if (lane == 0)
      {
        boxes.emplace_back();
        // Boxes that no segment meets.
        for (int d = 0; d < dim; ++d)
          {
            boxes.back().lower[d].fill(1e30);
            boxes.back().upper[d].fill(1e30);
          }
      }
    for (int d = 0; d < dim; ++d)
      {
        boxes.back().lower[d][lane] = lower[d];
        boxes.back().upper[d][lane] = upper[d];
      }
  }

  template <int dim>
  void
  SegmentSearch<dim>::gather(const unsigned int node, const double distance)
  {
    first_node = node;
    gathered   = distance;
    near_cells.clear();
    boxes.clear();
    gathered_nodes.assign(1, node);
    ++mark;
    node_mark[node]                     = mark;
    const dealii::Tensor<1, dim> origin = mesh.nodes[node];
    for (std::size_t k = 0; k < gathered_nodes.size(); ++k)
      for (const unsigned int cell : mesh.node_cells.row(gathered_nodes[k]))
        {
          if (cell_mark[cell] == mark)
            continue;
          cell_mark[cell] = mark;
          auto corners    = mesh.corners(cell);
          for (auto &corner : corners)
            corner -= origin;
          dealii::Point<dim> lower = corners[0], upper = corners[0];
          for (const auto &corner : corners)
            for (int d = 0; d < dim; ++d)
              {
                lower[d] = std::min(lower[d], corner[d]);
                upper[d] = std::max(upper[d], corner[d]);
              }
          const double margin = face_tolerance * lower.distance(upper);
          double       square = 0.; // of the distance of the box
          for (int d = 0; d < dim; ++d)
            {
              lower[d] -= margin;
              upper[d] += margin;
              const double excess = std::max({lower[d], -upper[d], 0.});
              square += excess * excess;
            }
          if (square > distance * distance)
            continue;
          near_cells.push_back({cell, corners, {}, false});
          add_box(lower, upper);
          for (const unsigned int n : mesh.cells[cell])
            if (node_mark[n] != mark)
              {
                node_mark[n] = mark;
                gathered_nodes.push_back(n);
              }
        }
  }

  template <int dim>
  void
  SegmentSearch<dim>::find_candidates(const dealii::Tensor<1, dim> &segment)
  {
    // A segment across an axis meets all or nothing there.
    std::array<double, dim> inverse;
    for (int d = 0; d < dim; ++d)
      inverse[d] = std::abs(segment[d]) > 1e-200 ? 1. / segment[d] : 1e200;
    candidates.clear();
    unsigned int near_cell = 0;
    for (const Boxes &box : boxes)
      {
        Lanes enter, leave;
        for (unsigned int k = 0; k < n_lanes; ++k)
          {
            enter[k] = 0.;
            leave[k] = 1.;
          }
        for (int d = 0; d < dim; ++d)
          for (unsigned int k = 0; k < n_lanes; ++k)
            {
              const double a = box.lower[d][k] * inverse[d];
              const double b = box.upper[d][k] * inverse[d];
              enter[k]       = std::max(enter[k], std::min(a, b));
              leave[k]       = std::min(leave[k], std::max(a, b));
            }
        for (unsigned int k = 0; k < n_lanes; ++k, ++near_cell)
          if (enter[k] <= leave[k])
            candidates.push_back({near_cell, enter[k], leave[k], 0, 0});
      }
    keep_connected();
  }

  template <int dim>
  void
  SegmentSearch<dim>::keep_connected()
  {
    ++mark;
    node_mark[first_node] = mark;
    std::size_t n_kept    = 0;
    for (bool grows = true; grows && n_kept < candidates.size();)
      {
        grows = false;
        for (std::size_t k = n_kept; k < candidates.size(); ++k)
          {
            const auto &nodes =
              mesh.cells[near_cells[candidates[k].near_cell].cell];
            if (std::none_of(
                  nodes.begin(),
                  nodes.end(),
                  [&](const unsigned int n) { return node_mark[n] == mark; }))
              continue;
            for (const unsigned int n : nodes)
              node_mark[n] = mark;
            std::swap(candidates[k], candidates[n_kept++]);
            grows = true;
          }
      }
    candidates.erase(candidates.begin() + n_kept, candidates.end());
  }

  template <int dim>
  void
  SegmentSearch<dim>::find_breaks(const dealii::Tensor<1, dim> &segment)
  {
    crossings.clear();
    const SegmentCrossings<dim> to_cross(segment);
    std::size_t                 n_met = 0;
    for (Candidate &candidate : candidates)
      {
        candidate.crossings_begin = crossings.size();
        if (!to_cross.add(near_cells[candidate.near_cell].corners, crossings))
          continue;
        candidate.crossings_end = crossings.size();
        candidates[n_met++]     = candidate;
      }
    candidates.erase(candidates.begin() + n_met, candidates.end());
    breaks = {0., 1.};
    for (const Crossing &crossing : crossings)
      breaks.push_back(crossing.s);
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(),
                             breaks.end(),
                             [](const double a, const double b) {
                               return b - a < merge_tolerance;
                             }),
                 breaks.end());
  }

  template <int dim>
  const Mesh::MultilinearMap<dim> &
  SegmentSearch<dim>::map_of(const unsigned int near_cell)
  {
    NearCell &cell = near_cells[near_cell];
    if (!cell.has_map)
      {
        cell.map     = Mesh::MultilinearMap<dim>(cell.corners);
        cell.has_map = true;
      }
    return cell.map;
  }

  template <int dim>
  dealii::Point<dim>
  SegmentSearch<dim>::guess_unit(const Candidate &candidate,
                                 const double     s) const
  {
    dealii::Point<dim> unit_point;
    for (int d = 0; d < dim; ++d)
      unit_point[d] = 0.5;
    for (unsigned int k = candidate.crossings_begin;
         k < candidate.crossings_end;
         ++k)
      if (std::abs(crossings[k].s - s) < 2. * merge_tolerance)
        {
          const Crossing    &crossing = crossings[k];
          const unsigned int axis     = crossing.face / 2;
          unit_point[axis]            = crossing.face % 2;
          for (unsigned int d = 0; d + 1 < dim; ++d)
            unit_point[(axis + 1 + d) % dim] = crossing.on_face[d];
          break;
        }
    return unit_point;
  }

  template <int dim>
  void
  SegmentSearch<dim>::find_places(const dealii::Tensor<1, dim> &segment,
                                  const double                  begin,
                                  const double                  end)
  {
    places.clear();
    const double             s = 0.5 * (begin + end);
    const dealii::Point<dim> point(s * segment);
    double                   smallest_excess = outside_tolerance;
    for (const Candidate &candidate : candidates)
      {
        if (s < candidate.enter || s > candidate.leave)
          continue;
        const auto unit_begin = guess_unit(candidate, begin);
        const auto unit_end   = guess_unit(candidate, end);
        auto       unit_point = unit_begin + 0.5 * (unit_end - unit_begin);
        if (!map_of(candidate.near_cell).refine(point, unit_point))
          continue;
        const double excess = distance_to_unit_cell(unit_point);
        if (excess <= outside_tolerance)
          places.push_back({candidate.near_cell, excess, unit_begin, unit_end});
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
  SegmentSearch<dim>::cut(const unsigned int              first_node,
                          const unsigned int              second_node,
                          std::vector<SegmentPiece<dim>> &pieces)
  {
    pieces.clear();
    const dealii::Tensor<1, dim> segment =
      mesh.nodes[second_node] - mesh.nodes[first_node];
    const double length = segment.norm();

    // Segments of neighbouring nodes have similar lengths.
    if (first_node != this->first_node)
      {
        gather(first_node, std::max(length * (1. + 1e-8), longest));
        longest = 0.;
      }
    else if (length >= gathered)
      gather(first_node, 1.2 * length);
    longest = std::max(longest, length * (1. + 1e-8));

    find_candidates(segment);
    find_breaks(segment);
    const auto at = [&](const double s) {
      return dealii::Point<dim>(s * segment);
    };

    double sum = 0.;
    for (unsigned int k = 0; k + 1 < breaks.size(); ++k)
      {
        const double begin = breaks[k];
        const double end   = breaks[k + 1];
        find_places(segment, begin, end);
        for (const Place &place : places)
          {
            const auto        &map        = map_of(place.near_cell);
            dealii::Point<dim> unit_begin = place.unit_begin;
            dealii::Point<dim> unit_end   = place.unit_end;
            // An end outside the cell means a crossing was missed.
            if (!map.refine(at(begin), unit_begin) ||
                !map.refine(at(end), unit_end) ||
                distance_to_unit_cell(unit_begin) > face_tolerance ||
                distance_to_unit_cell(unit_end) > face_tolerance)
              return false;
            SegmentPiece<dim> piece;
            piece.cell        = near_cells[place.near_cell].cell;
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

  template class SegmentSearch<2>;
  template class SegmentSearch<3>;
} // namespace Perimorph::Bonds
