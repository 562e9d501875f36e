#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/output/csv_writer.h>

#include <charconv>
#include <filesystem>
#include <stdexcept>

namespace Perimorph::Output
{
  std::string
  shortest_text(const double value)
  {
    char       text[32];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    return std::string(text, end);
  }


  CsvCell::CsvCell(const std::string &word)
    : text(word)
  {
    if (word.find_first_of(",\"\n\r") == std::string::npos)
      return;
    text = "\"";
    for (const char character : word)
      text +=
        (character == '"') ? std::string("\"\"") : std::string(1, character);
    text += '"';
  }


  CsvCell::CsvCell(const char *word)
    : CsvCell(std::string(word))
  {}


  CsvWriter::CsvWriter(const std::string              &filename,
                       const std::vector<std::string> &columns,
                       const Base::Log                &log)
    : n_columns(columns.size())
    , active(log.is_active())
  {
    if (!active)
      return;
    file.open(filename);
    write_row(std::vector<CsvCell>(columns.begin(), columns.end()));
    if (!file)
      throw Base::InputError("the table " + filename + " cannot be written");
  }


  CsvWriter::CsvWriter(const std::string              &filename,
                       const std::vector<std::string> &columns,
                       const std::uintmax_t            size,
                       const Base::Log                &log)
    : n_columns(columns.size())
    , active(log.is_active())
  {
    if (!active)
      return;
    file.open(filename, std::ios::app);
    n_bytes = size;
    if (!file)
      throw Base::InputError("the table " + filename + " cannot be written");
  }


  void
  CsvWriter::write_row(const std::vector<CsvCell> &row)
  {
    if (row.size() != n_columns)
      throw std::logic_error("CSV row of " + std::to_string(row.size()) +
                             " cells in a table of " +
                             std::to_string(n_columns) + " columns");
    if (!active)
      return;
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column)
      line += (column == 0 ? "" : ",") + row[column].text;
    line += '\n';
    file << line << std::flush;
    n_bytes += line.size();
  }


  void
  CsvWriter::write_numbers(const std::vector<double> &row)
  {
    write_row(std::vector<CsvCell>(row.begin(), row.end()));
  }


  void
  check_table(const std::string &filename, const std::uintmax_t size)
  {
    std::error_code status;
    const auto      there = std::filesystem::file_size(filename, status);
    if (status || there < size)
      throw Base::InputError(Base::InputMessage{
        "table '" + filename + "'",
        status ? "no such file" : std::to_string(there) + " bytes",
        "the " + std::to_string(size) +
          " bytes or more that it had at the checkpoint",
        ""});
  }


  void
  cut_table(const std::string &filename, const std::uintmax_t size)
  {
    std::error_code status;
    std::filesystem::resize_file(filename, size, status);
    if (status)
      throw Base::InputError("the table " + filename + " cannot be written");
  }
} // namespace Perimorph::Output
