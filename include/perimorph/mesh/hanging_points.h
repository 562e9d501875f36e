#pragma once

#include <map>
#include <utility>
#include <vector>

namespace Perimorph::Mesh
{
  /// Points or nodes in the middle of an edge or face of a coarser cell, with
  /// the corners of that edge or face (none of which hangs) and their weights,
  /// whose sum is one: position and displacement are these means, so that the
  /// displacement is continuous across the edge or face.
  using HangingPoints =
    std::map<unsigned int, std::vector<std::pair<unsigned int, double>>>;

  /// Makes values at all nodes continuous.
  template <typename Value>
  void
  set_hanging_values(const HangingPoints &hanging, std::vector<Value> &values)
  {
    for (const auto &[node, parents] : hanging)
      {
        Value mean = Value();
        for (const auto &[parent, weight] : parents)
          mean += weight * values[parent];
        values[node] = mean;
      }
  }
} // namespace Perimorph::Mesh
