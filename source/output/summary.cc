#include <perimorph/base/log.h>
#include <perimorph/output/results.h>
#include <perimorph/output/summary.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <optional>

namespace Perimorph::Output
{
  namespace
  {
    /// printf into a string.
    std::string
    format(const char *pattern, ...) __attribute__((format(printf, 1, 2)));

    std::string
    format(const char *pattern, ...)
    {
      char    text[512];
      va_list arguments;
      va_start(arguments, pattern);
      std::vsnprintf(text, sizeof(text), pattern, arguments);
      va_end(arguments);
      return text;
    }


    /// Sign included; few digits for large errors, enough for small ones.
    std::string
    percent(const double fraction)
    {
      return format(std::abs(fraction) < 1e-4 && fraction != 0. ? "%+.1e %%"
                                                                : "%+.2f %%",
                    100. * fraction);
    }


    /// 'broken_bonds' -> 'broken bonds'
    std::string
    in_words(std::string name)
    {
      std::replace(name.begin(), name.end(), '_', ' ');
      return name;
    }


    void
    print_quantities(Base::Log &log, const Results &results)
    {
      const auto names = results.names();
      if (names.empty())
        return;
      std::size_t width      = 8;
      std::size_t unit_width = 0;
      bool        references = false;
      for (const std::string &name : names)
        {
          const Quantity quantity = results.quantity(name);
          width                   = std::max(width, name.size());
          unit_width              = std::max(unit_width, quantity.unit.size());
          references              = references || quantity.reference;
        }
      const auto companion = results.companion_quantities();

      std::string title =
        format("%-*s %13s", static_cast<int>(width) + 2, "Quantities", "value");
      title += std::string(unit_width == 0 ? 0 : unit_width + 1, ' ');
      if (references)
        title += format(" %13s %10s", "reference", "error");
      if (!companion.empty())
        title += format(" %13s %10s", "pure FE", "change");
      log << title << '\n';

      for (const std::string &name : names)
        {
          const Quantity quantity = results.quantity(name);
          std::string    line     = format("  %-*s %13.6g",
                                    static_cast<int>(width),
                                    name.c_str(),
                                    quantity.value);
          if (unit_width > 0)
            line += format(" %-*s",
                           static_cast<int>(unit_width),
                           quantity.unit.c_str());
          // a difference in percent makes no sense against zero
          const auto compare = [&line](const double                other,
                                       const std::optional<double> difference) {
            line += format(" %13.6g %10s",
                           other,
                           difference ? percent(*difference).c_str() : "-");
          };
          if (quantity.reference)
            {
              const double other = *quantity.reference;
              compare(other,
                      other == 0.
                        ? std::nullopt
                        : std::optional<double>((quantity.value - other) /
                                                std::abs(other)));
            }
          else if (references)
            line += std::string(25, ' ');
          const auto entry = companion.find(name);
          if (entry != companion.end())
            compare(entry->second, results.companion_difference(name));
          line.erase(line.find_last_not_of(' ') + 1);
          log << line << '\n';
        }
      log << '\n';
    }


    void
    print_section(Base::Log         &log,
                  const Results     &results,
                  const char        *section,
                  const std::string &title)
    {
      const auto entries = results.entries(section);
      if (entries.empty())
        return;
      log << title << '\n';
      for (const auto &[name, value] : entries)
        log << format("  %-20s ", in_words(name).c_str()) << value << '\n';
      log << '\n';
    }
  } // namespace


  void
  print_summary(Base::Log                      &log,
                const Results                  &results,
                const std::string              &folder,
                const std::vector<std::string> &files,
                const Base::Timing             &timing,
                const Base::Timing::Table      &table)
  {
    if (!log.is_active())
      return;

    log << '\n' << std::string(72, '-') << '\n';
    log << "Case " << results.case_name() << ", mode " << results.mode() << ": "
        << to_string(results.status()) << '\n';
    std::string size;
    for (const auto &[name, number] : results.entries("counts"))
      if (number != "0")
        size += (size.empty() ? "" : ", ") + number + " " + in_words(name);
    if (!size.empty())
      log << "  " << size << '\n';
    log << '\n';

    print_quantities(log, results);
    print_section(log, results, "growth", "Growth of cracks");
    print_section(log, results, "checks", "Checks");
    print_section(log, results, "solver", "Solver");
    print_section(log, results, "skipped", "Not done");

    timing.print(log, table);
    if (const auto memory = results.peak_memory_mb())
      log << format("  Peak memory of the largest rank: %.0f MB\n", *memory);
    log << '\n';

    if (!log.warnings().empty())
      {
        log << "Warnings\n";
        for (const std::string &text : log.warnings())
          log << "  - " << text << '\n';
        log << '\n';
      }
    if (!files.empty())
      {
        log << "Written to " << folder << ":\n ";
        for (std::size_t i = 0; i < files.size(); ++i)
          log << ' ' << files[i] << (i + 1 < files.size() ? "," : "\n");
      }
    log << std::flush;
  }
} // namespace Perimorph::Output
