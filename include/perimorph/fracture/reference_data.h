#pragma once

#include <perimorph/fracture/probes.h>

#include <string>
#include <utility>
#include <vector>

namespace Perimorph::Fracture
{
  /// A table of reference values at points, read from a CSV file: lines that
  /// start with '#' are comments, then the names of the columns (x, y[, z]
  /// first, then some of ux, uy, uz, sxx, syy, szz, sxy, sxz, syz, stt; in 2D
  /// those that exist there), then one line of numbers per point.
  template <int dim>
  struct ReferenceData
  {
    std::string                      filename;
    std::vector<dealii::Point<dim>>  points;
    std::vector<std::string>         columns; ///< without the coordinates
    std::vector<std::vector<double>> values;  ///< [column][point]
  };

  /// @throws Base::InputError  the file cannot be read, a column is unknown or
  ///                           named twice, a cell is not a number, a line is
  ///                           too short or too long, a column is zero
  ///                           everywhere (no relative error)
  template <int dim>
  ReferenceData<dim>
  read_reference_data(const std::string &filename);

  /// Relative L2 error of each column, sqrt(sum (v - ref)^2 / sum ref^2).
  /// @param table  PointProbe::evaluate() at the points of the reference
  template <int dim>
  std::vector<std::pair<std::string, double>>
  relative_errors(const ProbeTable &table, const ReferenceData<dim> &reference);
} // namespace Perimorph::Fracture
