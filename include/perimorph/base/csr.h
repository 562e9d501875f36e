#pragma once

#include <cstddef>
#include <vector>

namespace Perimorph
{
  namespace Base
  {
    /// Rows of different length in one array (compressed sparse rows).
    ///
    /// Row r holds entries[offsets[r]] to entries[offsets[r + 1] - 1].
    template <typename T>
    struct Csr
    {
      std::vector<std::size_t> offsets = {0};
      std::vector<T>           entries;

      /// A row as a range: `for (const T &x : csr.row(r))`.
      struct Row
      {
        const T *first;
        const T *last;

        const T *
        begin() const
        {
          return first;
        }
        const T *
        end() const
        {
          return last;
        }
        std::size_t
        size() const
        {
          return last - first;
        }
        const T &
        operator[](const std::size_t k) const
        {
          return first[k];
        }
      };

      std::size_t
      n_rows() const
      {
        return offsets.size() - 1;
      }

      Row
      row(const std::size_t r) const
      {
        return {entries.data() + offsets[r], entries.data() + offsets[r + 1]};
      }

      /// Closes the row that consists of all entries pushed since the last
      /// call.
      void
      close_row()
      {
        offsets.push_back(entries.size());
      }
    };
  } // namespace Base
} // namespace Perimorph
