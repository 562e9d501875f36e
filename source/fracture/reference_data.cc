#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/fracture/reference_data.h>
#include <perimorph/parameters/text_tools.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace Perimorph::Fracture
{
  namespace
  {
    std::vector<std::string>
    coordinate_names(const int dim)
    {
      return dim == 2 ? std::vector<std::string>{"x", "y"}
                      : std::vector<std::string>{"x", "y", "z"};
    }

    /// Columns a reference file may have besides the coordinates.
    template <int dim>
    std::vector<std::string>
    value_names()
    {
      std::vector<std::string> names(probe_columns<dim>().begin() + dim,
                                     probe_columns<dim>().end());
      names.resize(names.size() - 2); // without mises, principal_max
      return names;
    }

    /// Cells of a line, empty ones included.
    std::vector<std::string>
    split_cells(const std::string &line)
    {
      std::vector<std::string> cells(1);
      for (const char c : line)
        if (c == ',')
          cells.emplace_back();
        else
          cells.back() += c;
      for (std::string &cell : cells)
        cell = Parameters::trim(cell);
      return cells;
    }

    template <int dim>
    std::vector<std::string>
    check_header(const std::vector<std::string> &names,
                 const std::string              &place)
    {
      const auto coordinates = coordinate_names(dim);
      if (names.size() <= coordinates.size() ||
          !std::equal(coordinates.begin(), coordinates.end(), names.begin()))
        throw Base::InputError(Base::InputMessage{
          place,
          "the columns " + Base::join_names(names),
          Base::join_names(coordinates) + ", then at least one of " +
            Base::join_names(value_names<dim>()),
          ""});
      const std::vector<std::string> columns(names.begin() + dim, names.end());
      const auto                     allowed = value_names<dim>();
      for (auto name = columns.begin(); name != columns.end(); ++name)
        {
          if (std::find(allowed.begin(), allowed.end(), *name) == allowed.end())
            {
              const auto near = Base::nearest_name(*name, allowed);
              throw Base::InputError(Base::InputMessage{
                place,
                "the column '" + *name + "'",
                Base::join_names(allowed),
                near ? "Did you mean '" + *near + "'?" : std::string()});
            }
          if (std::find(columns.begin(), name, *name) != name)
            throw Base::InputError(
              Base::InputMessage{place,
                                 "the column '" + *name + "' twice",
                                 "each column once",
                                 ""});
        }
      return columns;
    }
  } // namespace

  template <int dim>
  ReferenceData<dim>
  read_reference_data(const std::string &filename)
  {
    std::ifstream file(filename);
    if (!file)
      throw Base::InputError(
        Base::InputMessage{"reference file " + filename,
                           "no readable file of this name",
                           "a CSV file; a relative name counts from the "
                           "folder of the parameter file",
                           ""});

    ReferenceData<dim> data;
    data.filename = filename;
    std::vector<std::string> names;
    std::string              line;
    for (unsigned int number = 1; std::getline(file, line); ++number)
      {
        line = Parameters::trim(line);
        if (line.empty() || line[0] == '#')
          continue;
        const std::string place =
          "reference file " + filename + ":" + std::to_string(number);
        const auto cells = split_cells(line);
        if (names.empty())
          {
            names        = cells;
            data.columns = check_header<dim>(names, place);
            data.values.resize(data.columns.size());
            continue;
          }
        if (cells.size() != names.size())
          throw Base::InputError(
            Base::InputMessage{place,
                               Parameters::count_of(cells.size(), "cell"),
                               Parameters::count_of(names.size(), "cell") +
                                 ", one for each of " + Base::join_names(names),
                               ""});
        dealii::Point<dim> point;
        for (unsigned int c = 0; c < cells.size(); ++c)
          {
            const auto value = Parameters::to_number(cells[c]);
            if (!value)
              throw Base::InputError(Base::InputMessage{
                place,
                "'" + cells[c] + "' in column '" + names[c] + "'",
                "a number",
                ""});
            if (c < dim)
              point[c] = *value;
            else
              data.values[c - dim].push_back(*value);
          }
        data.points.push_back(point);
      }
    if (data.points.empty())
      throw Base::InputError(
        Base::InputMessage{"reference file " + filename,
                           names.empty() ? "no line with names of columns"
                                         : "no line with numbers",
                           "both",
                           ""});
    for (unsigned int c = 0; c < data.columns.size(); ++c)
      if (std::all_of(data.values[c].begin(),
                      data.values[c].end(),
                      [](const double value) { return value == 0.; }))
        throw Base::InputError(Base::InputMessage{
          "reference file " + filename,
          "zero everywhere in column '" + data.columns[c] + "'",
          "columns with a value other than 0 (the error "
          "is relative)",
          "Leave the column out."});
    return data;
  }

  template <int dim>
  std::vector<std::pair<std::string, double>>
  relative_errors(const ProbeTable &table, const ReferenceData<dim> &reference)
  {
    std::vector<std::pair<std::string, double>> errors;
    for (unsigned int c = 0; c < reference.columns.size(); ++c)
      {
        const auto values = table.column(reference.columns[c]);
        AssertDimension(values.size(), reference.points.size());
        double difference = 0.;
        double size       = 0.;
        for (unsigned int n = 0; n < values.size(); ++n)
          {
            difference += std::pow(values[n] - reference.values[c][n], 2);
            size += std::pow(reference.values[c][n], 2);
          }
        errors.emplace_back(reference.columns[c], std::sqrt(difference / size));
      }
    return errors;
  }

  template struct ReferenceData<2>;
  template struct ReferenceData<3>;
  template ReferenceData<2>
  read_reference_data<2>(const std::string &);
  template ReferenceData<3>
  read_reference_data<3>(const std::string &);
  template std::vector<std::pair<std::string, double>>
  relative_errors<2>(const ProbeTable &, const ReferenceData<2> &);
  template std::vector<std::pair<std::string, double>>
  relative_errors<3>(const ProbeTable &, const ReferenceData<3> &);
} // namespace Perimorph::Fracture
