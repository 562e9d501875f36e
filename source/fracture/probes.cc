#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/probes.h>
#include <perimorph/mesh/cell_geometry.h>

#include <deal.II/boost_adaptors/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Perimorph::Fracture
{
  namespace
  {
    // Outside by more than this part of the spacing is an error: a quarter
    // circle meshed with four cells bulges 0.05 spacings beyond its edges.
    constexpr double reach_outside = 0.2;

    // Points within this part of the spacing outside a cell count as inside.
    constexpr double round_off = 1e-6;

    template <int dim>
    std::string
    text_of(const dealii::Point<dim> &point)
    {
      std::ostringstream text;
      for (int d = 0; d < dim; ++d)
        text << (d > 0 ? " " : "") << point[d];
      return text.str();
    }
  } // namespace

  std::vector<double>
  ProbeTable::column(const std::string &name) const
  {
    const auto found = std::find(columns.begin(), columns.end(), name);
    Assert(found != columns.end(),
           dealii::ExcMessage("no column '" + name + "' in the probe"));
    const std::size_t   position = found - columns.begin();
    std::vector<double> values;
    for (const auto &row : rows)
      values.push_back(row[position]);
    return values;
  }

  template <int dim>
  const std::vector<std::string> &
  probe_columns()
  {
    static const std::vector<std::string> names =
      dim == 2 ? std::vector<std::string>{"x",
                                          "y",
                                          "ux",
                                          "uy",
                                          "sxx",
                                          "syy",
                                          "szz",
                                          "sxy",
                                          "stt",
                                          "mises",
                                          "principal_max"}
               : std::vector<std::string>{"x",
                                          "y",
                                          "z",
                                          "ux",
                                          "uy",
                                          "uz",
                                          "sxx",
                                          "syy",
                                          "szz",
                                          "sxy",
                                          "sxz",
                                          "syz",
                                          "stt",
                                          "mises",
                                          "principal_max"};
    return names;
  }

  template <int dim>
  std::vector<dealii::Point<dim>>
  line_points(const dealii::Point<dim> &from,
              const dealii::Point<dim> &to,
              const unsigned int        n_points)
  {
    std::vector<dealii::Point<dim>> points;
    for (unsigned int n = 0; n < n_points; ++n)
      points.push_back(from +
                       (n_points > 1 ? n / (n_points - 1.) : 0.) * (to - from));
    return points;
  }

  template <int dim>
  std::vector<dealii::Point<dim>>
  circle_points(const dealii::Point<dim> &center,
                const double              radius,
                const double              from_degrees,
                const double              to_degrees,
                const unsigned int        n_points)
  {
    const double                    degree = std::acos(-1.) / 180.;
    std::vector<dealii::Point<dim>> points;
    for (unsigned int n = 0; n < n_points; ++n)
      {
        const double part = n_points > 1 ? n / (n_points - 1.) : 0.;
        const double angle =
          degree * (from_degrees + part * (to_degrees - from_degrees));
        dealii::Point<dim> point = center;
        point[0] += radius * std::cos(angle);
        point[1] += radius * std::sin(angle);
        points.push_back(point);
      }
    return points;
  }

  template <int dim>
  struct PointProbe<dim>::CellSearch
  {
    std::vector<dealii::BoundingBox<dim>>       boxes;
    decltype(dealii::pack_rtree_of_indices(
      std::vector<dealii::BoundingBox<dim>>{})) tree;

    explicit CellSearch(const Mesh::NodalMesh<dim> &mesh)
      : boxes(boxes_of(mesh))
      , tree(dealii::pack_rtree_of_indices(boxes))
    {}

    static std::vector<dealii::BoundingBox<dim>>
    boxes_of(const Mesh::NodalMesh<dim> &mesh)
    {
      std::vector<dealii::BoundingBox<dim>> boxes;
      boxes.reserve(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        boxes.emplace_back(mesh.corners(c));
      return boxes;
    }
  };

  template <int dim>
  PointProbe<dim>::PointProbe(const NodalStress<dim> &recovery)
    : recovery(recovery)
    , search(std::make_unique<CellSearch>(recovery.fit().mesh()))
  {}

  template <int dim>
  PointProbe<dim>::~PointProbe() = default;

  template <int dim>
  typename PointProbe<dim>::Location
  PointProbe<dim>::locate(const dealii::Point<dim> &point) const
  {
    namespace bgi             = boost::geometry::index;
    const auto        &mesh   = recovery.fit().mesh();
    const unsigned int node   = recovery.fit().nearest_node(point);
    const double       length = mesh.spacing[node];

    dealii::Point<dim> lower = point;
    dealii::Point<dim> upper = point;
    for (int d = 0; d < dim; ++d)
      {
        lower[d] -= reach_outside * length;
        upper[d] += reach_outside * length;
      }
    std::vector<unsigned int> candidates;
    for (const auto index :
         search->tree | bgi::adaptors::queried(bgi::intersects(
                          dealii::BoundingBox<dim>({lower, upper}))))
      candidates.push_back(index);
    std::sort(candidates.begin(), candidates.end());

    Location best;
    double   smallest = std::numeric_limits<double>::max();
    for (const unsigned int cell : candidates)
      {
        const auto         corners = mesh.corners(cell);
        dealii::Point<dim> unit_point;
        if (!Mesh::map_to_unit_cell<dim>(corners, point, unit_point))
          continue;
        // Distance to the image of the nearest unit point of the cell.
        dealii::Point<dim> inside = unit_point;
        for (int d = 0; d < dim; ++d)
          inside[d] = std::min(1., std::max(0., inside[d]));
        const auto         values = Mesh::shape_values<dim>(inside);
        dealii::Point<dim> image;
        for (unsigned int v = 0; v < corners.size(); ++v)
          image += values[v] * corners[v];
        double distance = image.distance(point);
        if (distance < round_off * length)
          distance = 0.; // so that the first of several cells is taken
        if (distance < smallest)
          {
            smallest = distance;
            best     = {cell, unit_point};
          }
      }
    if (smallest <= reach_outside * length)
      return best;

    std::ostringstream allowed;
    allowed << "points of the body; the nearest node (" +
                 text_of(mesh.nodes[node]) + ") is "
            << mesh.nodes[node].distance(point) << " away";
    throw Base::InputError(Base::InputMessage{"point (" + text_of(point) + ")",
                                              "outside the mesh",
                                              allowed.str(),
                                              ""});
  }

  template <int dim>
  dealii::Tensor<1, dim>
  PointProbe<dim>::displacement_at(
    const dealii::Point<dim>                  &point,
    const std::vector<dealii::Tensor<1, dim>> &displacement) const
  {
    const Location         place  = locate(point);
    const auto             values = Mesh::shape_values<dim>(place.unit_point);
    const auto            &cell   = recovery.fit().mesh().cells[place.cell];
    dealii::Tensor<1, dim> result;
    for (unsigned int v = 0; v < cell.size(); ++v)
      result += values[v] * displacement[cell[v]];
    return result;
  }

  template <int dim>
  unsigned int
  PointProbe<dim>::nearest_node_of(const unsigned int        cell,
                                   const dealii::Point<dim> &point) const
  {
    const auto        &nodes   = recovery.fit().mesh().nodes;
    const auto        &corners = recovery.fit().mesh().cells[cell];
    const unsigned int nearest = recovery.fit().nearest_node(point);
    if (std::find(corners.begin(), corners.end(), nearest) != corners.end())
      return nearest;
    return *std::min_element(corners.begin(),
                             corners.end(),
                             [&](const unsigned int a, const unsigned int b) {
                               return nodes[a].distance_square(point) <
                                      nodes[b].distance_square(point);
                             });
  }

  template <int dim>
  Stress<dim>
  PointProbe<dim>::stress_at(
    const dealii::Point<dim>                  &point,
    const std::vector<dealii::Tensor<1, dim>> &displacement) const
  {
    const unsigned int cell = locate(point).cell;
    return recovery.at_point(point,
                             recovery.fit().mesh().cell_material[cell],
                             displacement,
                             nearest_node_of(cell, point));
  }

  template <int dim>
  ProbeTable
  PointProbe<dim>::evaluate(
    const std::vector<dealii::Point<dim>>     &points,
    const std::vector<dealii::Tensor<1, dim>> &displacement,
    const dealii::Point<dim>                  &center) const
  {
    ProbeTable table;
    table.columns = probe_columns<dim>();
    for (const auto &point : points)
      {
        const auto  u      = displacement_at(point, displacement);
        const auto  stress = stress_at(point, displacement);
        const auto &s      = stress.in_plane;

        std::vector<double> row;
        for (int d = 0; d < dim; ++d)
          row.push_back(point[d]);
        for (int d = 0; d < dim; ++d)
          row.push_back(u[d]);
        for (int d = 0; d < dim; ++d)
          row.push_back(s[d][d]);
        if (dim == 2)
          row.push_back(stress.out_of_plane);
        for (int i = 0; i < dim; ++i)
          for (int j = i + 1; j < dim; ++j)
            row.push_back(s[i][j]);
        row.push_back(hoop_stress(stress, point, center));
        row.push_back(von_mises_stress(stress));
        row.push_back(principal_stresses(stress)[0]);
        table.rows.push_back(row);
      }
    return table;
  }

  void
  write_probe(const ProbeTable  &table,
              const std::string &folder,
              const std::string &name,
              const MPI_Comm     communicator)
  {
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    const std::string filename = folder + "/probe_" + name + ".csv";
    std::ofstream     file(filename);
    file << std::setprecision(12);
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      file << (c > 0 ? "," : "") << table.columns[c];
    file << '\n';
    for (const auto &row : table.rows)
      {
        for (std::size_t c = 0; c < row.size(); ++c)
          file << (c > 0 ? "," : "") << row[c];
        file << '\n';
      }
    file.close();
    if (!file)
      throw Base::InputError(
        Base::InputMessage{"file " + filename,
                           "that it cannot be written",
                           "a folder that exists and may be written to",
                           ""});
  }

  template class PointProbe<2>;
  template class PointProbe<3>;
#define INSTANTIATE(dim)                                         \
  template const std::vector<std::string> &probe_columns<dim>(); \
  template std::vector<dealii::Point<dim>> line_points<dim>(     \
    const dealii::Point<dim> &,                                  \
    const dealii::Point<dim> &,                                  \
    unsigned int);                                               \
  template std::vector<dealii::Point<dim>> circle_points<dim>(   \
    const dealii::Point<dim> &,                                  \
    double,                                                      \
    double,                                                      \
    double,                                                      \
    unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
