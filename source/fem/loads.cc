#include <perimorph/base/exceptions.h>
#include <perimorph/fem/body_force.h>
#include <perimorph/fem/face_geometry.h>
#include <perimorph/fem/loads.h>
#include <perimorph/fem/supports.h>
#include <perimorph/mesh/cell_geometry.h>

#include <numeric>

namespace Perimorph::Fem
{
  namespace
  {
    /// Expressions of a list of conditions, for checks that treat all alike.
    template <int dim>
    std::vector<const Parameters::Expression *>
    expressions_of(const ComponentExpressions<dim> &components)
    {
      std::vector<const Parameters::Expression *> list;
      for (const auto &component : components)
        if (component)
          list.push_back(&*component);
      return list;
    }

    template <int dim>
    void
    check_finite(const std::vector<const Parameters::Expression *> &expressions,
                 const std::vector<dealii::Point<dim>>             &points,
                 const std::vector<double>                         &times,
                 Base::InputErrorCollector                         &errors)
    {
      for (const auto *expression : expressions)
        [&]() {
          for (const double time : times)
            for (const auto &point : points)
              if (!expression->check_finite(point, time, errors))
                return; // one message per expression says enough
        }();
    }
  } // namespace

  template <int dim>
  Loads<dim>::Loads(const Mesh::DistributedMesh<dim> &mesh,
                    const BoundaryConditions<dim>    &conditions_,
                    const std::vector<double>        &times)
    : mesh(mesh)
    , conditions(conditions_)
  {
    const auto               &nodal = mesh.nodal();
    Base::InputErrorCollector errors;
    const auto cell_points = [&](const std::vector<unsigned int> &cells) {
      std::vector<dealii::Point<dim>> points;
      for (const unsigned int c : cells)
        for (const auto &p : Mesh::CellGeometry<dim>(nodal.corners(c)).points)
          points.push_back(p);
      return points;
    };

    for (const auto &load : conditions.surface_loads)
      errors.collect([&]() {
        const std::string entry = load.follows    ? "follower pressure"
                                  : load.pressure ? "pressure"
                                                  : "traction";
        std::vector<dealii::Point<dim>> points;
        for (const unsigned int f :
             mesh.boundary(load.boundary,
                           "parameter 'Boundary conditions / " + entry + "'"))
          for (const auto &p :
               FaceGeometry<dim>(nodal, nodal.boundary_faces[f]).points)
            points.push_back(p);
        auto expressions = expressions_of<dim>(load.traction);
        if (load.pressure)
          expressions.push_back(&*load.pressure);
        check_finite(expressions, points, times, errors);
      });
    for (const auto &force : conditions.body_forces)
      errors.collect([&]() {
        std::vector<unsigned int> cells(nodal.n_cells());
        std::iota(cells.begin(), cells.end(), 0u);
        if (!force.volume.empty())
          cells = mesh.volume(force.volume,
                              "parameter 'Boundary conditions / body force'");
        check_finite(expressions_of<dim>(force.components),
                     cell_points(cells),
                     times,
                     errors);
      });
    for (const auto &force : conditions.point_forces)
      errors.collect([&]() {
        const unsigned int node =
          node_at(nodal,
                  force.point,
                  "parameter 'Boundary conditions / point force'");
        point_force_nodes.push_back(node);
        check_finite(expressions_of<dim>(force.components),
                     std::vector<dealii::Point<dim>>{nodal.nodes[node]},
                     times,
                     errors);
      });
    errors.throw_if_any();
  }

  template <int dim>
  template <typename Add>
  void
  Loads<dim>::for_each_force(const double time, const Add &add) const
  {
    const auto &nodal = mesh.nodal();
    for (const auto &load : conditions.surface_loads)
      for (const unsigned int f : mesh.boundary(load.boundary, "load"))
        {
          if (load.follows) // FollowerPressure adds it
            break;
          const auto &face = nodal.boundary_faces[f];
          if (!nodal.owns_cell(face.cell))
            continue;
          const FaceGeometry<dim> geometry(nodal, face);
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            {
              const auto &x     = geometry.points[q];
              auto        force = geometry.normal_jxw[q].norm() *
                           value_of<dim>(load.traction, x, time);
              if (load.pressure)
                force -= load.pressure->value(x, time) * geometry.normal_jxw[q];
              for (unsigned int v = 0; v < geometry.n_nodes; ++v)
                add(face.nodes[v], geometry.shape[q][v] * force);
            }
        }
    for_each_body_force<dim>(
      mesh,
      conditions.body_forces,
      time,
      false,
      [&](const unsigned int             c,
          const Mesh::CellGeometry<dim> &geometry,
          const unsigned int             q,
          const dealii::Tensor<1, dim>  &density) {
        const auto force = geometry.jxw[q] * density;
        for (unsigned int v = 0; v < geometry.n_nodes; ++v)
          add(nodal.cells[c][v], geometry.shape_value(q, v) * force);
      });
    for (unsigned int k = 0; k < conditions.point_forces.size(); ++k)
      if (nodal.owns_node(point_force_nodes[k]))
        add(point_force_nodes[k],
            value_of<dim>(conditions.point_forces[k].components,
                          nodal.nodes[point_force_nodes[k]],
                          time));
  }

  template <int dim>
  void
  Loads<dim>::add_forces(const double              time,
                         const NodePartition<dim> &partition,
                         Vector                   &forces) const
  {
    double *entries = forces.begin();
    for_each_force(
      time,
      [&](const unsigned int node, const dealii::Tensor<1, dim> &force) {
        const unsigned int local = partition.local(node);
        for (int d = 0; d < dim; ++d)
          entries[dim * local + d] += force[d];
      });
  }

  template <int dim>
  bool
  Loads<dim>::depend_on_time() const
  {
    std::vector<const Parameters::Expression *> all;
    const auto                                  add =
      [&all](const std::vector<const Parameters::Expression *> &l) {
        all.insert(all.end(), l.begin(), l.end());
      };
    for (const auto &load : conditions.surface_loads)
      {
        add(expressions_of<dim>(load.traction));
        if (load.pressure)
          all.push_back(&*load.pressure);
      }
    for (const auto &force : conditions.body_forces)
      add(expressions_of<dim>(force.components));
    for (const auto &force : conditions.point_forces)
      add(expressions_of<dim>(force.components));
    for (const auto *expression : all)
      if (expression->depends_on_time())
        return true;
    return false;
  }

  template <int dim>
  bool
  Loads<dim>::empty() const
  {
    return conditions.surface_loads.empty() && conditions.body_forces.empty() &&
           conditions.point_forces.empty();
  }

  template class Loads<2>;
  template class Loads<3>;
} // namespace Perimorph::Fem
