#pragma once

#include <deal.II/base/config.h>

#include <cstring>

namespace Perimorph::Base
{
  /// Doubles side by side, on which arithmetic works as on one: vector
  /// extensions of GCC and Clang, which fill the registers there are.
  using EightLanes = double __attribute__((vector_size(64)));
  using FourLanes  = double __attribute__((vector_size(32)));

  /// @tparam Lanes  EightLanes, FourLanes or double
  template <typename Lanes>
  inline Lanes
  load_lanes(const double *from)
  {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof(Lanes));
    return lanes;
  }

  template <typename Lanes>
  inline void
  store_lanes(const Lanes &lanes, double *to)
  {
    std::memcpy(to, &lanes, sizeof(Lanes));
  }

  inline double
  sum_of_lanes(const double lane)
  {
    return lane;
  }
  inline double
  sum_of_lanes(const FourLanes &lanes)
  {
    return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
  }

  /// Lanes k and k + 4 together.
  inline FourLanes
  fold_lanes(const EightLanes &lanes)
  {
    FourLanes halves[2];
    std::memcpy(halves, &lanes, sizeof(lanes));
    return halves[0] + halves[1];
  }

  /// Walks over a range: action(first, lanes) for eight entries at a time, then
  /// four, then one; lanes is zero and gives the type. Actions must be inlined
  /// (DEAL_II_ALWAYS_INLINE), or what they sum up is not in registers.
  template <typename Action>
  inline DEAL_II_ALWAYS_INLINE void
  for_lanes(const unsigned int n, const Action &action)
  {
    unsigned int k = 0;
    for (; k + 8 <= n; k += 8)
      action(k, EightLanes{});
    for (; k + 4 <= n; k += 4)
      action(k, FourLanes{});
    for (; k < n; ++k)
      action(k, double{});
  }
} // namespace Perimorph::Base
