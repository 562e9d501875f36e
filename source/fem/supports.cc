#include <perimorph/base/exceptions.h>
#include <perimorph/base/point_cloud.h>
#include <perimorph/fem/face_geometry.h>
#include <perimorph/fem/supports.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Fem
{
  namespace
  {
    constexpr char component_letter[] = "xyz";
  }

  template <int dim>
  std::string
  DisplacementCondition<dim>::label() const
  {
    if (!boundary.empty())
      return "displacement of '" + boundary + "'";
    std::ostringstream text;
    text << "point displacement at (";
    for (unsigned int d = 0; d < point.size(); ++d)
      text << (d > 0 ? ", " : "") << point[d];
    text << ")";
    return text.str();
  }

  template <int dim>
  unsigned int
  node_at(const Mesh::NodalMesh<dim> &mesh,
          const std::vector<double>  &coordinates,
          const std::string          &used_by)
  {
    dealii::Point<dim> point;
    for (int d = 0; d < dim; ++d)
      point[d] = coordinates[d];
    unsigned int nearest = 0;
    while (mesh.hangs(nearest))
      ++nearest;
    for (unsigned int n = nearest + 1; n < mesh.n_nodes(); ++n)
      if (mesh.nodes[n].distance_square(point) <
            mesh.nodes[nearest].distance_square(point) &&
          !mesh.hangs(n))
        nearest = n;
    const double distance = mesh.nodes[nearest].distance(point);
    if (distance > mesh.spacing[nearest])
      {
        std::ostringstream found, hint;
        found << "the point (" << point << "), " << distance
              << " away from the body";
        hint << "The nearest node is at (" << mesh.nodes[nearest] << ").";
        throw Base::InputError(Base::InputMessage{used_by,
                                                  found.str(),
                                                  "a point of the body",
                                                  hint.str()});
      }
    return nearest;
  }

  template <int dim>
  Supports<dim>::Supports(const Mesh::DistributedMesh<dim> &mesh,
                          const BoundaryConditions<dim>    &conditions_,
                          const std::vector<double>        &times)
    : mesh(mesh)
    , conditions(conditions_)
  {
    const auto               &nodal = mesh.nodal();
    Base::InputErrorCollector errors;

    for (const auto &name : conditions.symmetry)
      errors.collect([&]() {
        const std::string used_by =
          "parameter 'Boundary conditions / symmetry'";
        const auto plane = symmetry_plane(mesh, name, used_by);
        planes.push_back(plane);
        unsigned int axis = 0;
        for (int d = 0; d < dim; ++d)
          if (std::abs(plane.normal[d]) > std::abs(plane.normal[axis]))
            axis = d;
        for (const unsigned int node : mesh.boundary_nodes(name, used_by))
          add(dim * node + axis,
              {nullptr, "symmetry of '" + name + "'", name},
              times);
      });
    for (const auto &condition : conditions.displacement)
      errors.collect([&]() {
        std::vector<unsigned int> nodes;
        if (condition.boundary.empty())
          nodes = {node_at(nodal,
                           condition.point,
                           "parameter 'Boundary conditions / point "
                           "displacement'")};
        else
          nodes = mesh.boundary_nodes(
            condition.boundary,
            "parameter 'Boundary conditions / displacement'");
        for (int d = 0; d < dim; ++d)
          if (condition.components[d])
            for (const unsigned int node : nodes)
              add(dim * node + d,
                  {&*condition.components[d],
                   condition.label(),
                   condition.boundary},
                  times);
      });
    for (const auto &motion : conditions.mean_displacement)
      errors.collect([&]() { add_mean(motion); });
    for (const auto &motion : conditions.rigid_plates)
      errors.collect([&]() { add_plate(motion); });
    for (const auto *list :
         {&conditions.mean_displacement, &conditions.rigid_plates})
      for (const auto &motion : *list)
        for (const double time : times)
          {
            for (const auto &component : motion.translation)
              if (component)
                component->check_finite(nodal.nodes[0], time, errors);
            if (motion.rotation)
              motion.rotation->check_finite(nodal.nodes[0], time, errors);
          }
    errors.throw_if_any();
  }

  template <int dim>
  void
  Supports<dim>::add(const unsigned int         dof,
                     const Entry               &entry,
                     const std::vector<double> &times)
  {
    // Its parents are on the same surface and take it along.
    if (mesh.nodal().hangs(dof / dim))
      return;
    const auto &position   = mesh.nodal().nodes[dof / dim];
    const auto *expression = entry.expression;
    if (expression)
      for (const double time : times)
        {
          Base::InputErrorCollector errors;
          if (!expression->check_finite(position, time, errors))
            {
              // One message per condition says enough.
              for (const auto &message : errors.messages())
                throw Base::InputError(message);
            }
        }
    const auto inserted = prescribed.emplace(dof, entry);
    if (inserted.second || inserted.first->second.expression == expression)
      return;
    const Entry &first = inserted.first->second;
    for (const double time : times)
      {
        const double before = value(dof, time);
        const double now = expression ? expression->value(position, time) : 0.;
        // Below round-off of the coordinates two values are one.
        if (std::abs(before - now) >
            1e-12 * std::max({std::abs(before),
                              std::abs(now),
                              mesh.nodal().spacing[dof / dim]}))
          {
            std::ostringstream found;
            found << component_letter[dof % dim] << " = " << before
                  << " from the " << first.label << " but " << now
                  << " from the " << entry.label << " at the node (" << position
                  << "), t = " << time;
            const std::string where = "contradicting supports";
            throw Base::InputError(Base::InputMessage{
              where,
              found.str(),
              "one value per node and component",
              "Leave the component out of one of the two conditions."});
          }
      }
  }

  template <int dim>
  double
  Supports<dim>::value(const unsigned int dof, const double time) const
  {
    const auto &entry = prescribed.at(dof);
    return entry.expression
             ? entry.expression->value(mesh.nodal().nodes[dof / dim], time)
             : 0.;
  }

  template <int dim>
  void
  Supports<dim>::pin(const unsigned int dof)
  {
    prescribed.emplace(dof, Entry{nullptr, "removal of rigid motion", ""});
  }

  template struct DisplacementCondition<2>;
  template struct DisplacementCondition<3>;
  template class Supports<2>;
  template class Supports<3>;
  template unsigned int
  node_at<2>(const Mesh::NodalMesh<2> &,
             const std::vector<double> &,
             const std::string &);
  template unsigned int
  node_at<3>(const Mesh::NodalMesh<3> &,
             const std::vector<double> &,
             const std::string &);
} // namespace Perimorph::Fem
