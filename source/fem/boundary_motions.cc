#include <perimorph/base/exceptions.h>
#include <perimorph/fem/face_geometry.h>
#include <perimorph/fem/rigid_motion.h>
#include <perimorph/fem/supports.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace Perimorph::Fem
{
  namespace
  {
    /// Integrals of the shape functions over a boundary, by node.
    template <int dim>
    std::map<unsigned int, double>
    nodal_areas(const Mesh::DistributedMesh<dim> &mesh,
                const std::string                &boundary,
                const std::string                &used_by)
    {
      std::map<unsigned int, double> areas;
      const auto                    &nodal = mesh.nodal();
      for (const unsigned int f : mesh.boundary(boundary, used_by))
        {
          const auto             &face = nodal.boundary_faces[f];
          const FaceGeometry<dim> geometry(nodal, face);
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            for (unsigned int v = 0; v < geometry.n_nodes; ++v)
              areas[face.nodes[v]] +=
                geometry.shape[q][v] * geometry.normal_jxw[q].norm();
        }
      return areas;
    }

    template <int dim>
    dealii::Point<dim>
    centroid(const Mesh::NodalMesh<dim>           &mesh,
             const std::map<unsigned int, double> &areas)
    {
      dealii::Point<dim> sum;
      double             total = 0.;
      for (const auto &[node, area] : areas)
        {
          sum += area * mesh.nodes[node];
          total += area;
        }
      return dealii::Point<dim>(sum / total);
    }

    template <int dim>
    dealii::Point<3>
    in_space(const dealii::Point<dim> &point)
    {
      dealii::Point<3> result;
      for (int d = 0; d < dim; ++d)
        result[d] = point[d];
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int>
  Supports<dim>::claim(const BoundaryMotion<dim> &motion,
                       const std::string         &entry,
                       const bool                 alone)
  {
    const std::string used_by =
      "parameter 'Boundary conditions / " + entry + "'";
    auto nodes = mesh.boundary_nodes(motion.boundary, used_by);
    nodes.erase(std::remove_if(nodes.begin(),
                               nodes.end(),
                               [this](const unsigned int n) {
                                 return mesh.nodal().hangs(n);
                               }),
                nodes.end());
    for (const unsigned int node : nodes)
      {
        std::string other;
        const auto  held = held_as_a_whole.find(node);
        if (held != held_as_a_whole.end())
          other = "the motion of '" + held->second + "' as a whole";
        for (int d = 0; d < dim; ++d)
          {
            const auto single = prescribed.find(dim * node + d);
            if (alone && single != prescribed.end())
              other = "the " + single->second.label;
          }
        if (other.empty())
          continue;
        std::ostringstream found;
        found << "boundary '" << motion.boundary << "' with the node ("
              << mesh.nodal().nodes[node] << ") that is held by " << other
              << " too";
        throw Base::InputError(
          Base::InputMessage{used_by,
                             found.str(),
                             "a boundary without other supports",
                             "Leave one of the two conditions out."});
      }
    for (const unsigned int node : nodes)
      held_as_a_whole[node] = motion.boundary;
    return nodes;
  }

  template <int dim>
  void
  Supports<dim>::add_mean(const BoundaryMotion<dim> &motion)
  {
    const std::string used_by =
      "parameter 'Boundary conditions / mean displacement'";
    claim(motion, "mean displacement", false);
    const auto areas  = nodal_areas(mesh, motion.boundary, used_by);
    const auto center = centroid(mesh.nodal(), areas);
    double     total  = 0.;
    for (const auto &entry : areas)
      total += entry.second;
    const auto add_row = [&](LinearConstraint mean) {
      for (const auto &[node, parents] : mesh.nodal().hanging)
        for (int d = 0; d < dim; ++d)
          {
            const auto found = mean.factors.find(dim * node + d);
            if (found == mean.factors.end())
              continue;
            for (const auto &[parent, weight] : parents)
              mean.factors[dim * parent + d] += weight * found->second;
            mean.factors.erase(found);
          }
      bool free = false;
      for (const auto &entry : mean.factors)
        free = free || prescribed.count(entry.first) == 0;
      if (!free)
        throw Base::InputError(Base::InputMessage{
          used_by,
          "boundary '" + motion.boundary + "', all held by other supports",
          "a component of the mean that nothing else holds",
          "Leave the component out."});
      means.push_back(mean);
    };
    for (int d = 0; d < dim; ++d)
      if (motion.translation[d])
        {
          LinearConstraint mean;
          mean.value  = &*motion.translation[d];
          mean.center = in_space(center);
          for (const auto &[node, area] : areas)
            mean.factors[dim * node + d] = area / total;
          add_row(mean);
        }
    if (!motion.rotation)
      return;
    for (const auto &generator : rotation_generators<dim>())
      {
        LinearConstraint mean;
        mean.value    = &*motion.rotation;
        mean.center   = in_space(center);
        double square = 0.;
        for (const auto &[node, area] : areas)
          square +=
            area *
            (generator * (mesh.nodal().nodes[node] - center)).norm_square();
        for (const auto &[node, area] : areas)
          {
            const auto velocity =
              generator * (mesh.nodal().nodes[node] - center);
            for (int d = 0; d < dim; ++d)
              if (std::abs(velocity[d]) > 0.)
                mean.factors[dim * node + d] = area * velocity[d] / square;
          }
        add_row(mean);
      }
  }

  template <int dim>
  void
  Supports<dim>::add_plate(const BoundaryMotion<dim> &motion)
  {
    const std::string used_by = "parameter 'Boundary conditions / rigid plate'";
    RigidPlate<dim>   plate;
    plate.boundary = motion.boundary;
    plate.nodes    = claim(motion, "rigid plate", true);
    plate.center =
      centroid(mesh.nodal(), nodal_areas(mesh, motion.boundary, used_by));
    for (int d = 0; d < dim; ++d)
      plate.translation[d] =
        motion.translation[d] ? &*motion.translation[d] : nullptr;
    plate.rotation = motion.rotation ? &*motion.rotation : nullptr;
    plates.push_back(plate);
  }

  template <int dim>
  bool
  Supports<dim>::move(const double time) const
  {
    for (const auto &entry : prescribed)
      if (value(entry.first, time) != 0.)
        return true;
    for (const auto &mean : means)
      if (mean.value->value(mean.center, time) != 0.)
        return true;
    for (const auto &plate : plates)
      {
        for (const auto *component : plate.translation)
          if (component && component->value(plate.center, time) != 0.)
            return true;
        if (plate.rotation && plate.rotation->value(plate.center, time) != 0.)
          return true;
      }
    return false;
  }

  template <int dim>
  bool
  Supports<dim>::hold(const unsigned int dof) const
  {
    return prescribed.count(dof) > 0 || held_as_a_whole.count(dof / dim) > 0;
  }

  template <int dim>
  const std::string &
  Supports<dim>::boundary_motion_at(const unsigned int node) const
  {
    static const std::string none;
    const auto               held = held_as_a_whole.find(node);
    return held == held_as_a_whole.end() ? none : held->second;
  }

  template <int dim>
  std::vector<unsigned int>
  Supports<dim>::coupled_nodes() const
  {
    std::vector<unsigned int> nodes;
    for (const auto &entry : held_as_a_whole)
      nodes.push_back(entry.first);
    return nodes;
  }

  template <int dim>
  std::map<unsigned int, std::string>
  Supports<dim>::point_supports() const
  {
    std::map<unsigned int, std::string> nodes;
    for (const auto &[dof, entry] : prescribed)
      if (entry.expression && entry.boundary.empty())
        nodes[dof / dim] = entry.label;
    return nodes;
  }

  template void
  Supports<2>::add_mean(const BoundaryMotion<2> &);
  template void
  Supports<3>::add_mean(const BoundaryMotion<3> &);
  template void
  Supports<2>::add_plate(const BoundaryMotion<2> &);
  template void
  Supports<3>::add_plate(const BoundaryMotion<3> &);
  template std::vector<unsigned int>
  Supports<2>::claim(const BoundaryMotion<2> &, const std::string &, bool);
  template std::vector<unsigned int>
  Supports<3>::claim(const BoundaryMotion<3> &, const std::string &, bool);
  template bool
  Supports<2>::move(double) const;
  template bool
  Supports<3>::move(double) const;
  template bool
  Supports<2>::hold(unsigned int) const;
  template bool
  Supports<3>::hold(unsigned int) const;
  template const std::string &
  Supports<2>::boundary_motion_at(unsigned int) const;
  template const std::string &
  Supports<3>::boundary_motion_at(unsigned int) const;
  template std::vector<unsigned int>
  Supports<2>::coupled_nodes() const;
  template std::vector<unsigned int>
  Supports<3>::coupled_nodes() const;
  template std::map<unsigned int, std::string>
  Supports<2>::point_supports() const;
  template std::map<unsigned int, std::string>
  Supports<3>::point_supports() const;
} // namespace Perimorph::Fem
