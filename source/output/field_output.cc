#include <perimorph/mesh/nodal_mesh.h>
#include <perimorph/output/field_output.h>

#include <array>
#include <cstdio>
#include <stdexcept>

namespace Perimorph::Output
{
  namespace
  {
    /// x y z of a point, zero z in 2D.
    template <int dim>
    void
    append_point(std::vector<double>      &coordinates,
                 const dealii::Point<dim> &point)
    {
      for (unsigned int d = 0; d < 3; ++d)
        coordinates.push_back(d < dim ? point[d] : 0.);
    }
  } // namespace


  template <int dim>
  void
  Fields<dim>::add(const std::string &name, const std::vector<double> &values)
  {
    list.push_back({name, 1, values});
  }


  template <int dim>
  void
  Fields<dim>::add(const std::string                         &name,
                   const std::vector<dealii::Tensor<1, dim>> &values)
  {
    VtuArray array{name, 3, std::vector<double>(3 * values.size(), 0.)};
    for (std::size_t n = 0; n < values.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        array.values[3 * n + d] = values[n][d];
    list.push_back(std::move(array));
  }


  template <int dim>
  void
  Fields<dim>::add(const std::string                                  &name,
                   const std::vector<dealii::SymmetricTensor<2, dim>> &values)
  {
    constexpr std::array<std::array<unsigned int, 2>, 6> components = {
      {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{0, 1}}, {{0, 2}}, {{1, 2}}}};
    for (const auto &[i, j] : components)
      if (j < dim)
        {
          VtuArray array{name + '_' + "xyz"[i] + "xyz" [j], 1, {}};
          array.values.reserve(values.size());
          for (const auto &value : values)
            array.values.push_back(value[i][j]);
          list.push_back(std::move(array));
        }
  }


  template <int dim>
  void
  Fields<dim>::add_vector(const std::string         &name,
                          const std::vector<double> &values)
  {
    if (values.size() % dim != 0)
      throw std::logic_error("vector field '" + name + "' is incomplete");
    VtuArray array{name, 3, std::vector<double>(values.size() / dim * 3, 0.)};
    for (std::size_t k = 0; k < values.size(); ++k)
      array.values[k / dim * 3 + k % dim] = values[k];
    list.push_back(std::move(array));
  }


  template <int dim>
  const std::vector<VtuArray> &
  Fields<dim>::arrays() const
  {
    return list;
  }


  template <int dim>
  FieldOutput<dim>::FieldOutput(const std::string          &folder,
                                const Mesh::NodalMesh<dim> &mesh)
    : folder(folder)
    , mesh(mesh)
  {}


  template <int dim>
  bool
  FieldOutput<dim>::is_active() const
  {
    return mesh.rank == 0;
  }


  template <int dim>
  void
  FieldOutput<dim>::write(const unsigned int step,
                          const double       time,
                          const Fields<dim> &nodal_fields,
                          const Fields<dim> &cell_fields)
  {
    if (!is_active())
      return;
    VtuGrid grid;
    grid.cell_type = (dim == 2) ? VtuCell::quadrilateral : VtuCell::hexahedron;
    grid.points.reserve(3 * mesh.nodes.size());
    for (const auto &node : mesh.nodes)
      append_point(grid.points, node);

    // VTK goes around a face where deal.II counts x first
    constexpr std::array<unsigned int, 8> vtk_order = {
      {0, 1, 3, 2, 4, 5, 7, 6}};
    grid.connectivity.reserve(mesh.cells.size() * mesh.nodes_per_cell);
    for (const auto &cell : mesh.cells)
      for (unsigned int v = 0; v < cell.size(); ++v)
        grid.connectivity.push_back(
          static_cast<std::int32_t>(cell[vtk_order[v]]));

    grid.point_data = nodal_fields.arrays();
    grid.cell_data  = cell_fields.arrays();
    grid.cell_data.push_back({"material",
                              1,
                              std::vector<double>(mesh.cell_material.begin(),
                                                  mesh.cell_material.end())});
    grid.cell_data.push_back(
      {"rank",
       1,
       std::vector<double>(mesh.cell_owner.begin(), mesh.cell_owner.end())});
    write_step(solution, step, time, grid);
  }


  template <int dim>
  void
  FieldOutput<dim>::write_particles(const unsigned int               step,
                                    const double                     time,
                                    const std::vector<unsigned int> &nodes,
                                    const Fields<dim>               &fields)
  {
    if (!is_active())
      return;
    VtuGrid grid;
    for (const unsigned int node : nodes)
      {
        grid.connectivity.push_back(
          static_cast<std::int32_t>(grid.points.size() / 3));
        append_point(grid.points, mesh.nodes[node]);
      }
    grid.point_data = fields.arrays();
    write_step(particles, step, time, grid);
  }


  template <int dim>
  void
  FieldOutput<dim>::write_cracks(
    const unsigned int                                      step,
    const double                                            time,
    const std::vector<std::array<dealii::Point<dim>, dim>> &corners,
    const Fields<dim>                                      &fields)
  {
    if (!is_active())
      return;
    VtuGrid grid;
    grid.cell_type = dim == 2 ? VtuCell::line : VtuCell::triangle;
    for (const auto &piece : corners)
      for (const auto &point : piece)
        {
          grid.connectivity.push_back(
            static_cast<std::int32_t>(grid.points.size() / 3));
          append_point(grid.points, point);
        }
    grid.cell_data = fields.arrays();
    write_step(cracks, step, time, grid);
  }


  template <int dim>
  std::map<std::string, typename FieldOutput<dim>::Steps>
  FieldOutput<dim>::series() const
  {
    std::map<std::string, Steps> all;
    for (const Series *series : {&solution, &particles, &cracks})
      if (!series->steps.empty())
        all[series->name] = series->steps;
    return all;
  }


  template <int dim>
  void
  FieldOutput<dim>::restore(const std::map<std::string, Steps> &earlier)
  {
    if (!is_active())
      return;
    for (Series *series : {&solution, &particles, &cracks})
      {
        const auto found = earlier.find(series->name);
        if (found == earlier.end())
          continue;
        series->steps = found->second;
        write_pvd(folder + "/" + series->name + ".pvd", series->steps);
      }
  }


  template <int dim>
  std::vector<std::string>
  FieldOutput<dim>::files() const
  {
    std::vector<std::string> names;
    for (const Series *series : {&solution, &particles, &cracks})
      if (!series->steps.empty())
        names.push_back(series->name + ".pvd");
    return names;
  }


  template <int dim>
  void
  FieldOutput<dim>::write_step(Series            &series,
                               const unsigned int step,
                               const double       time,
                               const VtuGrid     &grid)
  {
    char number[16];
    std::snprintf(number, sizeof(number), "%04u", step);
    const std::string file = series.name + "_" + number + ".vtu";
    write_vtu(folder + "/" + file, grid, time);
    // a step that is written again replaces the earlier one
    if (series.steps.empty() || series.steps.back().second != file)
      series.steps.emplace_back(time, file);
    else
      series.steps.back().first = time;
    write_pvd(folder + "/" + series.name + ".pvd", series.steps);
  }


  template class Fields<2>;
  template class Fields<3>;
  template class FieldOutput<2>;
  template class FieldOutput<3>;
} // namespace Perimorph::Output
