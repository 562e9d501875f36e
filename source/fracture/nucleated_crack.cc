#include <perimorph/fracture/crack_tips.h>
#include <perimorph/fracture/nucleated_crack.h>
#include <perimorph/fracture/segment_growth.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace Perimorph::Fracture
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// How near the tip of a crack an end belongs to it, and how near the
    /// surface bonds may have broken along it [in horizons]. No multiples of
    /// half the spacing: round-off must not decide on regular meshes.
    constexpr double reach_of_tip     = 1.51;
    constexpr double reach_of_surface = 1.01;

    /// Of places in one group, and of an end that takes others' place.
    constexpr double reach_of_place = 1.01;
    constexpr double shortest_piece = 0.51;

    bool
    are_next(const BrokenPlace &a, const BrokenPlace &b)
    {
      return a.position.distance(b.position) <=
             reach_of_place * std::max(a.horizon, b.horizon);
    }

    /// Distance along the band from one of its points (Dijkstra).
    std::vector<double>
    distances_along(const std::vector<BrokenPlace> &places,
                    const std::size_t               start)
    {
      std::vector<double> distance(places.size(), infinity);
      std::vector<bool>   done(places.size(), false);
      distance[start] = 0.;
      for (std::size_t step = 0; step < places.size(); ++step)
        {
          std::size_t nearest = places.size();
          for (std::size_t k = 0; k < places.size(); ++k)
            if (!done[k] &&
                (nearest == places.size() || distance[k] < distance[nearest]))
              nearest = k;
          done[nearest] = true;
          for (std::size_t k = 0; k < places.size(); ++k)
            if (!done[k] && are_next(places[nearest], places[k]))
              distance[k] =
                std::min(distance[k],
                         distance[nearest] + places[nearest].position.distance(
                                               places[k].position));
        }
      return distance;
    }

    /// The place at a distance along the band, by a fit of the positions that
    /// is linear in this distance.
    dealii::Point<2>
    fitted_place(const std::vector<BrokenPlace> &places,
                 const std::vector<double>      &along,
                 const double                    distance,
                 const double                    radius)
    {
      double           sum = 0., first = 0., second = 0.;
      dealii::Point<2> mean, moment;
      for (std::size_t k = 0; k < places.size(); ++k)
        {
          const double s = along[k] - distance;
          const double w = 1. - s * s / (radius * radius);
          if (w <= 0.)
            continue;
          sum += w;
          first += w * s;
          second += w * s * s;
          mean += w * places[k].position;
          moment += w * s * places[k].position;
        }
      const double determinant = sum * second - first * first;
      if (determinant < 1e-6 * sum * sum * radius * radius)
        return mean / sum;
      return dealii::Point<2>((second * mean - first * moment) / determinant);
    }

    /// Where the ray from a point through another one leaves the body.
    std::optional<dealii::Point<2>>
    way_out(const Mesh::NodalMesh<2> &mesh,
            const dealii::Point<2>   &from,
            const dealii::Point<2>   &through,
            const double              more)
    {
      const double               length  = through.distance(from);
      const dealii::Tensor<1, 2> along   = (through - from) / length;
      const double               nearest = surface_ahead(mesh, from, along);
      if (nearest > length + more)
        return std::nullopt;
      return from + nearest * along;
    }

    dealii::Point<2>
    nearest_on_surface(const Mesh::NodalMesh<2> &mesh,
                       const dealii::Point<2>   &point)
    {
      dealii::Point<2> nearest;
      double           smallest = infinity;
      for (const auto &face : mesh.boundary_faces)
        {
          const auto place =
            Mesh::closest_on_segment(point,
                                     mesh.nodes[face.nodes[0]],
                                     mesh.nodes[face.nodes[1]]);
          if (place.distance(point) < smallest)
            {
              smallest = place.distance(point);
              nearest  = place;
            }
        }
      return nearest;
    }

    /// Lets the last point be at a place, without a short piece before it.
    void
    end_at(std::vector<dealii::Point<2>> &line,
           const dealii::Point<2>        &place,
           const double                   horizon)
    {
      line.back() = place;
      while (line.size() > 2 &&
             line[line.size() - 2].distance(place) < shortest_piece * horizon)
        line.erase(line.end() - 2);
    }
  } // namespace

  BrokenPlace
  middle_of(const Mesh::NodalMesh<2>          &mesh,
            const std::vector<double>         &horizon,
            const std::array<unsigned int, 2> &nodes)
  {
    return {mesh.nodes[nodes[0]] +
              0.5 * (mesh.nodes[nodes[1]] - mesh.nodes[nodes[0]]),
            0.5 * (horizon[nodes[0]] + horizon[nodes[1]])};
  }

  std::vector<BrokenPlace>
  broken_places(const Mesh::NodalMesh<2>  &mesh,
                const std::vector<double> &horizon,
                const Bonds::BrokenBonds  &broken)
  {
    std::vector<BrokenPlace> places;
    for (const auto &bond : broken.list())
      if (bond.teeth == broken.n_teeth())
        places.push_back(middle_of(mesh, horizon, bond.nodes));
    return places;
  }

  std::vector<std::vector<BrokenPlace>>
  group_places(std::vector<BrokenPlace> places)
  {
    std::sort(places.begin(), places.end(), [](const auto &a, const auto &b) {
      return std::tie(a.position[0], a.position[1], a.horizon) <
             std::tie(b.position[0], b.position[1], b.horizon);
    });
    std::vector<std::vector<BrokenPlace>> groups;
    std::vector<bool>                     taken(places.size(), false);
    for (std::size_t start = 0; start < places.size(); ++start)
      {
        if (taken[start])
          continue;
        std::vector<std::size_t> members = {start};
        taken[start]                     = true;
        for (std::size_t next = 0; next < members.size(); ++next)
          for (std::size_t k = start + 1; k < places.size(); ++k)
            if (!taken[k] && are_next(places[members[next]], places[k]))
              {
                taken[k] = true;
                members.push_back(k);
              }
        std::sort(members.begin(), members.end());
        groups.emplace_back();
        for (const std::size_t k : members)
          groups.back().push_back(places[k]);
      }
    return groups;
  }

  std::vector<dealii::Point<2>>
  line_through(const std::vector<BrokenPlace> &places)
  {
    const auto furthest = [](const std::vector<double> &distance) {
      return std::max_element(distance.begin(), distance.end()) -
             distance.begin();
    };
    const auto   start  = furthest(distances_along(places, 0));
    const auto   along  = distances_along(places, start);
    const double length = along[furthest(along)];
    if (!(length > 0.))
      return {};
    double radius = 0.;
    for (const auto &place : places)
      radius += place.horizon / places.size();
    const auto n =
      static_cast<unsigned int>(std::max(1., std::round(length / radius)));
    std::vector<dealii::Point<2>> line;
    for (unsigned int k = 0; k <= n; ++k)
      line.push_back(fitted_place(places, along, k * length / n, radius));
    return line;
  }

  double
  length_of_line(const std::vector<dealii::Point<2>> &line)
  {
    double length = 0.;
    for (std::size_t k = 1; k < line.size(); ++k)
      length += line[k].distance(line[k - 1]);
    return length;
  }

  std::vector<dealii::Point<2>>
  with_end_moved(std::vector<dealii::Point<2>> line, double distance)
  {
    while (line.size() > 2 &&
           line.back().distance(line[line.size() - 2]) + distance <= 0.)
      {
        distance += line.back().distance(line[line.size() - 2]);
        line.pop_back();
      }
    const auto   piece  = line.back() - line[line.size() - 2];
    const double length = piece.norm();
    line.back() += std::max(distance, -0.9 * length) / length * piece;
    return line;
  }

  std::vector<NucleatedCrack>
  find_nucleated_cracks(const Mesh::NodalMesh<2> &mesh,
                        const Bonds::CrackSet<2> &cracks,
                        std::vector<BrokenPlace>  places)
  {
    const auto               tips = find_tips(mesh, cracks);
    std::vector<BrokenPlace> inside, at_surface;
    for (const auto &place : places)
      (place.position.distance(nearest_on_surface(mesh, place.position)) <
           reach_of_surface * place.horizon
         ? at_surface
         : inside)
        .push_back(place);
    std::vector<NucleatedCrack> found;
    for (const auto &group : group_places(std::move(inside)))
      {
        NucleatedCrack crack;
        auto          &line = crack.line;
        line                = line_through(group);
        if (line.empty())
          continue;
        crack.horizon = 0.;
        for (const auto &place : group)
          crack.horizon += place.horizon / group.size();
        // Tip at the first and the last point; of one tip the nearer end.
        const auto nearest_tip = [&](const dealii::Point<2> &end) {
          const CrackTip *nearest = nullptr;
          double          reach   = reach_of_tip * crack.horizon;
          for (const auto &tip : tips)
            if (tip.frame.origin.distance(end) < reach)
              {
                reach   = tip.frame.origin.distance(end);
                nearest = &tip;
              }
          return nearest;
        };
        std::array<const CrackTip *, 2> tip_at = {
          {nearest_tip(line.front()), nearest_tip(line.back())}};
        if (tip_at[0] && tip_at[0] == tip_at[1])
          tip_at[tip_at[0]->frame.origin.distance(line.front()) <
                     tip_at[0]->frame.origin.distance(line.back())
                   ? 1
                   : 0] = nullptr;
        for (const unsigned int end : {0u, 1u})
          {
            // The end in question is the last point.
            std::reverse(line.begin(), line.end());
            const auto   last  = line.back();
            const double reach = reach_of_tip * crack.horizon;
            // The direction at an end is that of a long piece.
            auto base = line.front();
            for (const auto &point : line)
              if (point.distance(last) >= reach)
                base = point;
            crack.is_free[end] =
              !tip_at[end] &&
              std::none_of(at_surface.begin(),
                           at_surface.end(),
                           [&](const auto &place) {
                             return place.position.distance(last) < reach;
                           });
            if (tip_at[end])
              end_at(line, tip_at[end]->frame.origin, crack.horizon);
            else if (!crack.is_free[end])
              end_at(
                line,
                way_out(mesh, base, last, 2. * reach)
                  .value_or(dealii::Point<2>(nearest_on_surface(mesh, last))),
                crack.horizon);
          }
        if (crack.is_free[0] && !crack.is_free[1])
          {
            std::reverse(line.begin(), line.end());
            std::swap(crack.is_free[0], crack.is_free[1]);
            std::swap(tip_at[0], tip_at[1]);
          }
        if (tip_at[0])
          crack.crack = tip_at[0]->crack;
        found.push_back(crack);
      }
    return found;
  }

  unsigned int
  try_moves(const std::function<double(double)> &change, const double precision)
  {
    constexpr double       step = 0.5, largest = 1.5;
    constexpr unsigned int most_calls = 8;
    double                 low = 0., high = 0.;
    double                 at_low = change(0.), at_high = at_low;
    const double           way     = at_low > 0. ? step : -step;
    unsigned int           n_calls = 1;
    while (at_low * at_high > 0. && std::abs(high) < largest &&
           std::abs(at_high) > precision)
      {
        low     = high;
        at_low  = at_high;
        high    = high + way;
        at_high = change(high);
        ++n_calls;
      }
    while (at_low * at_high < 0. && n_calls < most_calls &&
           std::abs(at_high) > precision)
      {
        const double middle = std::round((low * at_high - high * at_low) /
                                         (at_high - at_low) * 4096.) /
                              4096.;
        const double value = change(middle);
        ++n_calls;
        if (value * at_high < 0.)
          {
            low    = high;
            at_low = at_high;
          }
        else
          at_low *= 0.5;
        high    = middle;
        at_high = value;
      }
    return n_calls;
  }

  std::vector<dealii::Point<2>>
  with_tips_moved(const NucleatedCrack &crack, const double distance)
  {
    auto line = crack.line;
    for (const bool is_free : {crack.is_free[1], crack.is_free[0]})
      {
        if (is_free)
          line = with_end_moved(line, distance);
        std::reverse(line.begin(), line.end());
      }
    return line;
  }
} // namespace Perimorph::Fracture
