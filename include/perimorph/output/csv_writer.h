#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <type_traits>
#include <vector>

namespace Perimorph::Base
{
  class Log;
}

namespace Perimorph::Output
{
  /// Shortest text that reads back as exactly this number (at most 17
  /// digits): "0.1", "1e-12", "nan".
  std::string
  shortest_text(const double value);

  /// One cell of a row: a number or a word.
  class CsvCell
  {
  public:
    template <typename Number,
              std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
    CsvCell(const Number number)
      : text(number_text(number))
    {}

    /// Quoted if it holds a comma, a quote or a line break.
    CsvCell(const std::string &word);
    CsvCell(const char *word);

    std::string text;

  private:
    template <typename Number>
    static std::string
    number_text(const Number number)
    {
      if constexpr (std::is_floating_point_v<Number>)
        return shortest_text(number);
      else
        return std::to_string(number);
    }
  };

  /// A table that grows row by row, readable at any time: load_steps.csv,
  /// newton.csv, probe_<name>.csv. Rank 0 writes, other ranks do nothing.
  ///
  ///   CsvWriter table(folder + "/load_steps.csv", {"step", "time"}, log);
  ///   table.write_row({step, time});
  class CsvWriter
  {
  public:
    /// Starts a new file with @p columns as its first line.
    /// @throws InputError   rank 0 only: the file cannot be written
    CsvWriter(const std::string              &filename,
              const std::vector<std::string> &columns,
              const Base::Log                &log);

    /// Goes on behind the rows that an earlier run left in a file, see
    /// check_table() and cut_table().
    /// @param size   [bytes] of the file
    /// @throws InputError   rank 0 only: the file cannot be written
    CsvWriter(const std::string              &filename,
              const std::vector<std::string> &columns,
              const std::uintmax_t            size,
              const Base::Log                &log);

    /// [bytes] written so far, all of them in the file; zero on other ranks.
    std::uintmax_t
    size() const
    {
      return n_bytes;
    }

    /// @param row   as many cells as there are columns
    void
    write_row(const std::vector<CsvCell> &row);

    /// The same for numbers only.
    void
    write_numbers(const std::vector<double> &row);

  private:
    const std::size_t n_columns;
    const bool        active;
    std::ofstream     file;
    std::uintmax_t    n_bytes = 0;
  };

  /// Sees to it that a table can be cut back to this size.
  /// @throws InputError   no such file, or a shorter one
  void
  check_table(const std::string &filename, const std::uintmax_t size);

  /// Drops what comes behind the first @p size bytes of a table.
  /// @throws InputError   the file cannot be written
  void
  cut_table(const std::string &filename, const std::uintmax_t size);
} // namespace Perimorph::Output
