#pragma once

#include <mpi.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace Perimorph::Base
{
  class Log;

  /// Wall-clock time of named sections of a run; "total" runs by itself from
  /// construction. Sections may be nested: each counts its whole time, a
  /// section inside itself counts once.
  ///
  ///   const auto timer = timing.scope("assembly");
  class Timing
  {
  public:
    /// Section name and seconds, in the order of first use, "total" last.
    using Table = std::vector<std::pair<std::string, double>>;

    /// Keeps a section running as long as it lives.
    class [[nodiscard]] Scope
    {
    public:
      Scope(Timing &timing, const std::string &name);
      ~Scope();
      Scope(const Scope &) = delete;
      Scope &
      operator=(const Scope &) = delete;

    private:
      Timing           &timing;
      const std::size_t section;
    };

    explicit Timing(MPI_Comm communicator = MPI_COMM_WORLD);

    Scope
    scope(const std::string &name);

    /// Seconds of one section on this rank so far, 0 if it never ran.
    double
    seconds(const std::string &name) const;

    /// All sections: for each the maximum over ranks, also of sections that
    /// only some ranks have entered. Collective.
    Table
    table() const;

    /// Prints a table with seconds, share of the total and number of calls
    /// of this rank. Not collective: @p table is the result of table().
    void
    print(Log &log, const Table &table) const;

  private:
    using Clock = std::chrono::steady_clock;

    struct Section
    {
      std::string       name;
      double            seconds = 0.; ///< of completed calls
      unsigned int      n_calls = 0;
      unsigned int      depth   = 0; ///< > 0: running
      Clock::time_point start;
    };

    std::size_t
    find_or_add(const std::string &name);

    static double
    seconds_until_now(const Section &section);

    MPI_Comm             communicator;
    std::vector<Section> sections;
    Clock::time_point    start;
  };

  /// Largest resident memory so far [MB of 10^6 bytes].
  struct PeakMemory
  {
    double max_mb; ///< of the rank that needs most
    double sum_mb; ///< of all ranks; shared libraries are counted per rank
  };

  /// Collective. Zero where the system does not tell (it does on Linux).
  PeakMemory
  peak_memory(MPI_Comm communicator);
} // namespace Perimorph::Base
