#include <perimorph/fracture/crack_advance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

namespace Perimorph::Fracture
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Boxes per horizon: ways through their means are hardly longer than
    /// those along the bonds themselves, which are many more.
    constexpr double boxes_per_horizon = 4.;

    bool
    is_behind(const CrackTip &tip, const BrokenPlace &place)
    {
      const auto   from  = place.position - tip.frame.origin;
      const double ahead = from * tip.frame.axes[0];
      return ahead < 0. && ahead > -tip.crack_length &&
             std::abs(from * tip.frame.axes[1]) <= place.horizon;
    }

    /// Means of the places in each box of a grid.
    class Boxes
    {
    public:
      Boxes(const std::vector<CrackTip>    &tips,
            const std::vector<BrokenPlace> &places)
      {
        for (const auto &place : places)
          reach = std::max(reach, place.horizon);
        std::map<Index, std::pair<BrokenPlace, unsigned int>> sums;
        for (const auto &place : places)
          if (std::none_of(tips.begin(), tips.end(), [&](const auto &tip) {
                return is_behind(tip, place);
              }))
            {
              auto &[sum, n] =
                sums.try_emplace(index_of(place.position), BrokenPlace(), 0)
                  .first->second;
              sum.position += place.position;
              sum.horizon += place.horizon;
              ++n;
            }
        for (const auto &[index, sum] : sums)
          {
            number_of[index] = means.size();
            means.push_back({dealii::Point<2>(sum.first.position / sum.second),
                             sum.first.horizon / sum.second});
          }
      }

      const std::vector<BrokenPlace> &
      places() const
      {
        return means;
      }

      /// Calls the action for all places within one horizon of a point with the
      /// distance.
      void
      for_each_near(
        const dealii::Point<2>                                &point,
        const std::function<void(std::size_t number, double)> &action) const
      {
        const int  n     = static_cast<int>(boxes_per_horizon) + 1;
        const auto index = index_of(point);
        for (int i = -n; i <= n; ++i)
          for (int j = -n; j <= n; ++j)
            if (const auto found =
                  number_of.find({{index[0] + i, index[1] + j}});
                found != number_of.end())
              {
                const auto  &place    = means[found->second];
                const double distance = place.position.distance(point);
                if (distance <= place.horizon)
                  action(found->second, distance);
              }
      }

    private:
      using Index = std::array<int, 2>;

      Index
      index_of(const dealii::Point<2> &point) const
      {
        const double size = reach / boxes_per_horizon;
        return {{static_cast<int>(std::floor(point[0] / size)),
                 static_cast<int>(std::floor(point[1] / size))}};
      }

      double                       reach = 0.;
      std::vector<BrokenPlace>     means;
      std::map<Index, std::size_t> number_of;
    };
  } // namespace

  std::vector<double>
  crack_advances(const std::vector<CrackTip>    &tips,
                 const std::vector<BrokenPlace> &places)
  {
    std::vector<double> advances(tips.size(), 0.);
    if (places.empty())
      return advances;
    const Boxes boxes(tips, places);

    std::vector<double>       way(boxes.places().size(), infinity);
    std::vector<bool>         done(way.size(), false);
    std::vector<unsigned int> tip_of(way.size(), 0);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto reach = [&](const dealii::Point<2> &from,
                           const double            way_there,
                           const unsigned int      tip) {
      boxes.for_each_near(from,
                          [&](const std::size_t number, const double distance) {
                            if (way_there + distance >= way[number])
                              return;
                            way[number]    = way_there + distance;
                            tip_of[number] = tip;
                            open.push({way[number], number});
                          });
    };
    for (unsigned int t = 0; t < tips.size(); ++t)
      reach(tips[t].frame.origin, 0., t);
    while (!open.empty())
      {
        const std::size_t number = open.top().second;
        open.pop();
        if (done[number])
          continue;
        done[number]     = true;
        auto &advance    = advances[tip_of[number]];
        advance          = std::max(advance, way[number]);
        const auto &from = boxes.places()[number].position;
        reach(from, way[number], tip_of[number]);
      }
    return advances;
  }

  void
  AdvanceHistory::add(const double time, const std::vector<double> &advances)
  {
    if (!rows.empty() && rows.back().front() == time)
      rows.pop_back();
    std::vector<double> row = {time};
    row.insert(row.end(), advances.begin(), advances.end());
    rows.push_back(std::move(row));
    if (rows.size() > n_times)
      rows.erase(rows.begin());
  }

  double
  AdvanceHistory::speed(const unsigned int tip) const
  {
    double mean_time = 0., mean_advance = 0.;
    for (const auto &row : rows)
      {
        mean_time += row.front() / rows.size();
        mean_advance += row[tip + 1] / rows.size();
      }
    double product = 0., square = 0.;
    for (const auto &row : rows)
      {
        const double time = row.front() - mean_time;
        product += time * (row[tip + 1] - mean_advance);
        square += time * time;
      }
    return product / square;
  }
} // namespace Perimorph::Fracture
