#include <perimorph/base/log.h>
#include <perimorph/base/timing.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdio>

namespace Perimorph::Base
{
  namespace
  {
    double
    seconds_between(const std::chrono::steady_clock::time_point first,
                    const std::chrono::steady_clock::time_point last)
    {
      return std::chrono::duration<double>(last - first).count();
    }
  } // namespace


  Timing::Scope::Scope(Timing &timing, const std::string &name)
    : timing(timing)
    , section(timing.find_or_add(name))
  {
    Section &own = timing.sections[section];
    ++own.n_calls;
    if (own.depth++ == 0)
      own.start = Clock::now();
  }


  Timing::Scope::~Scope()
  {
    Section &own = timing.sections[section];
    if (--own.depth == 0)
      own.seconds += seconds_between(own.start, Clock::now());
  }


  Timing::Timing(MPI_Comm communicator)
    : communicator(communicator)
    , start(Clock::now())
  {}


  Timing::Scope
  Timing::scope(const std::string &name)
  {
    return Scope(*this, name);
  }


  double
  Timing::seconds(const std::string &name) const
  {
    if (name == "total")
      return seconds_between(start, Clock::now());
    for (const Section &section : sections)
      if (section.name == name)
        return seconds_until_now(section);
    return 0.;
  }


  Timing::Table
  Timing::table() const
  {
    std::vector<std::string> own_names;
    for (const Section &section : sections)
      own_names.push_back(section.name);

    std::vector<std::string> names;
    for (const auto &rank_names :
         dealii::Utilities::MPI::all_gather(communicator, own_names))
      for (const std::string &name : rank_names)
        if (std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
    names.push_back("total");

    Table table;
    for (const std::string &name : names)
      table.emplace_back(
        name,
        dealii::Utilities::MPI::max(seconds(name), communicator));
    return table;
  }


  void
  Timing::print(Log &log, const Table &table) const
  {
    if (!log.is_active() || table.empty())
      return;
    const double total = std::max(table.back().second, 1e-9);
    log << "Timing (wall clock, slowest rank)   seconds   share   calls\n";
    for (const auto &[name, seconds] : table)
      {
        unsigned int n_calls = 1;
        for (const Section &section : sections)
          if (section.name == name)
            n_calls = section.n_calls;
        char line[128];
        std::snprintf(line,
                      sizeof(line),
                      "  %-32s %9.2f   %3.0f %%   %5u\n",
                      name.c_str(),
                      seconds,
                      100. * seconds / total,
                      n_calls);
        log << line;
      }
  }


  std::size_t
  Timing::find_or_add(const std::string &name)
  {
    for (std::size_t i = 0; i < sections.size(); ++i)
      if (sections[i].name == name)
        return i;
    sections.emplace_back();
    sections.back().name = name;
    return sections.size() - 1;
  }


  double
  Timing::seconds_until_now(const Section &section)
  {
    if (section.depth == 0)
      return section.seconds;
    return section.seconds + seconds_between(section.start, Clock::now());
  }


  PeakMemory
  peak_memory(MPI_Comm communicator)
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    const double own_mb = 1024e-6 * static_cast<double>(stats.VmHWM);
    return {dealii::Utilities::MPI::max(own_mb, communicator),
            dealii::Utilities::MPI::sum(own_mb, communicator)};
  }
} // namespace Perimorph::Base
