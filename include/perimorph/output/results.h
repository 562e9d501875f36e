#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Perimorph::Base
{
  class Log;
}

namespace Perimorph::Output
{
  /// How a run ended.
  enum class Status
  {
    converged,
    stopped,
    failed
  };

  /// The word of results.json for a status.
  std::string
  to_string(const Status status);

  /// One number a run was made for.
  struct Quantity
  {
    double                value = 0.;
    std::string           unit; ///< empty if the run has no units
    std::optional<double> reference;

    /// |value - reference| / |reference|; none without a reference or if the
    /// reference is zero.
    std::optional<double>
    relative_error() const;
  };

  /// What results.json holds: the contract between a run and whoever reads
  /// its outcome (design.md, section 6). Every rank may fill its own copy;
  /// rank 0 writes.
  class Results
  {
  public:
    /// @param case_name   e.g. the name of the parameter file
    /// @param mode        coupled | finite elements | peridynamics
    /// @param version     of the program
    Results(const std::string &case_name,
            const std::string &mode,
            const std::string &version,
            const unsigned int n_ranks);

    ~Results();

    /// "failed" until something else is set.
    void
    set_status(const Status status);

    Status
    status() const;

    const std::string &
    case_name() const;

    const std::string &
    mode() const;

    /// Sets or replaces a quantity; its place is that of the first call.
    void
    set_quantity(const std::string &name,
                 const double       value,
                 const std::string &unit = "");

    /// The value a quantity should have; may come before the quantity.
    void
    set_reference(const std::string &name, const double reference);

    /// References whose quantity the run did not produce, sorted.
    std::vector<std::string>
    unmatched_references() const;

    bool
    has(const std::string &name) const;

    /// @throws std::out_of_range   unknown name; says which there are
    double
    value(const std::string &name) const;

    /// Value, unit and, if there is one, reference.
    Quantity
    quantity(const std::string &name) const;

    /// Names of all quantities in the order they were set.
    std::vector<std::string>
    names() const;

    /// A quantity of the companion run with finite elements alone: stored in
    /// "companion" with its relative difference to the one of this run.
    void
    set_companion_quantity(const std::string &name,
                           const double       value,
                           const std::string &unit = "");

    std::map<std::string, double>
    companion_quantities() const;

    /// (value - companion) / |companion|; none if the run lacks one of the
    /// two, or if the companion's value is only round-off (below 1e-9) of the
    /// largest quantity with the same unit.
    std::optional<double>
    companion_difference(const std::string &name) const;

    /// Peak memory [MB]: of the largest rank and of all ranks together.
    void
    set_peak_memory(const double max_mb, const double sum_mb);

    /// Of the largest rank [MB]; none if it was not set.
    std::optional<double>
    peak_memory_mb() const;

    /// Seconds of each section ("timings").
    void
    set_timings(const std::vector<std::pair<std::string, double>> &table);

    /// Adds to a number in "counts", e.g. newton_iterations.
    void
    add_count(const std::string &name, const std::int64_t amount);

    /// Sets an entry of a section: counts, checks, timings, companion,
    /// solver, skipped, or a new one that follows these in the file.
    void
    set(const std::string &section,
        const std::string &name,
        const double       value);

    void
    set(const std::string &section,
        const std::string &name,
        const std::string &value);

    void
    set(const std::string &section, const std::string &name, const char *value);

    template <typename Integer,
              std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
    void
    set(const std::string &section,
        const std::string &name,
        const Integer      value)
    {
      if constexpr (std::is_same_v<Integer, bool>)
        set_bool(section, name, value);
      else
        set_integer(section, name, static_cast<std::int64_t>(value));
    }

    /// A number of a section; none if it is missing, null or no number.
    std::optional<double>
    number(const std::string &section, const std::string &name) const;

    /// The entries of a section that are set, as text for people.
    std::vector<std::pair<std::string, std::string>>
    entries(const std::string &section) const;

    /// The whole content as JSON text. Numbers that are not finite become
    /// null; @p not_finite (if given) receives their names.
    std::string
    to_json(const std::vector<std::string> &warnings,
            std::vector<std::string>       *not_finite = nullptr) const;

    /// Writes the file on rank 0: aside first, then renamed, so that a reader
    /// never sees half of it. The warnings are those of @p log, which gets
    /// one more for each number that is not finite.
    /// @throws InputError   rank 0 only: the file cannot be written
    void
    write(const std::string &filename, Base::Log &log) const;

  private:
    struct Sections;

    void
    set_integer(const std::string &section,
                const std::string &name,
                const std::int64_t value);

    void
    set_bool(const std::string &section,
             const std::string &name,
             const bool         value);

    const std::string  case_text;
    const std::string  mode_text;
    const std::string  version;
    const unsigned int n_ranks;

    Status run_status = Status::failed;

    std::vector<std::pair<std::string, Quantity>> quantities;
    std::map<std::string, double>                 references;
    std::vector<std::pair<std::string, Quantity>> companion;
    std::unique_ptr<Sections>                     sections;
  };
} // namespace Perimorph::Output
