#pragma once

#include <mpi.h>

#include <numeric>
#include <type_traits>
#include <vector>

namespace Perimorph::Base
{
  /// The values of all ranks one after another, on every rank. Unlike the
  /// general functions of deal.II it neither packs nor compresses.
  template <typename Value>
  std::vector<Value>
  gather_on_all(MPI_Comm communicator, const std::vector<Value> &values)
  {
    static_assert(std::is_trivially_copyable_v<Value>);
    int n_ranks = 1;
    MPI_Comm_size(communicator, &n_ranks);
    const int        size = values.size() * sizeof(Value);
    std::vector<int> sizes(n_ranks), starts(n_ranks, 0);
    MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator);
    std::partial_sum(sizes.begin(), sizes.end() - 1, starts.begin() + 1);
    std::vector<Value> all((starts.back() + sizes.back()) / sizeof(Value));
    MPI_Allgatherv(values.data(),
                   size,
                   MPI_BYTE,
                   all.data(),
                   sizes.data(),
                   starts.data(),
                   MPI_BYTE,
                   communicator);
    return all;
  }
} // namespace Perimorph::Base
