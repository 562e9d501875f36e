#include <perimorph/base/label_sizes.h>

#include <algorithm>

namespace Perimorph::Base
{
  std::vector<unsigned int>
  label_sizes(const std::vector<unsigned int> &labels)
  {
    std::vector<unsigned int> sizes;
    for (const unsigned int label : labels)
      {
        sizes.resize(std::max<std::size_t>(sizes.size(), label + 1), 0);
        ++sizes[label];
      }
    return sizes;
  }
} // namespace Perimorph::Base
