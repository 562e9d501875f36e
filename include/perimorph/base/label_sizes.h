#pragma once

#include <vector>

namespace Perimorph::Base
{
  /// How often each of the labels 0, 1, 2... occurs.
  std::vector<unsigned int>
  label_sizes(const std::vector<unsigned int> &labels);
} // namespace Perimorph::Base
