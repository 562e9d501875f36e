#include <perimorph/application/crack_setup.h>
#include <perimorph/application/meshed_cracks.h>
#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/crack_slits.h>
#include <perimorph/fracture/crack_tips.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    const std::string entry = "Cracks / pre-cracks";

    template <int dim>
    std::string
    at(const dealii::Point<dim> &point)
    {
      std::ostringstream text;
      text << "at (" << point << ")";
      return text.str();
    }

    template <int dim>
    double
    area(const Mesh::NodalMesh<dim> &mesh, const Mesh::BoundaryFace<dim> &face)
    {
      const auto corner = [&](const unsigned int v) {
        return mesh.nodes[face.nodes[v]];
      };
      if constexpr (dim == 2)
        return corner(0).distance(corner(1));
      else
        return Bonds::CrackFacet<3>{{{corner(0), corner(1), corner(2)}}}
                 .measure() +
               Bonds::CrackFacet<3>{{{corner(3), corner(1), corner(2)}}}
                 .measure();
    }

    /// Moves an end on the outer surface outwards.
    /// @throws Base::InputError  an end on a slit that goes on
    void
    open_surface(const Mesh::NodalMesh<2>   &mesh,
                 const Fracture::Surface<2> &surface,
                 const std::string          &name,
                 dealii::Point<2>           &end,
                 const dealii::Point<2>     &before)
    {
      std::vector<dealii::Point<2>> others;
      for (const auto &face : surface)
        {
          const auto  &a = mesh.nodes[face.nodes[0]];
          const auto  &b = mesh.nodes[face.nodes[1]];
          const double h = a.distance(b);
          if (Fracture::face_distance(mesh, face, end) > 1e-3 * h)
            continue;
          const auto middle = a + 0.5 * (b - a);
          for (const auto &other : others)
            if (other.distance(middle) < 1e-6 * h)
              throw Base::InputError(
                Base::InputMessage{"parameter '" + entry + "'",
                                   "'" + name + "', which ends " + at(end) +
                                     " on a slit of the mesh that goes on",
                                   "cracks as long as their slit",
                                   ""});
          others.push_back(middle);
        }
      if (!others.empty())
        end +=
          0.2 * others[0].distance(end) / end.distance(before) * (end - before);
    }

    template <int dim>
    std::vector<Bonds::CrackFacet<dim>>
    raw_facets(const std::vector<Parameters::Polyline> &lines)
    {
      std::vector<Bonds::CrackFacet<dim>> facets;
      for (unsigned int crack = 0; crack < lines.size(); ++crack)
        for (const auto &facet :
             facets_of_line<dim>(lines[crack],
                                 points_of_line<dim>(lines[crack]),
                                 crack))
          facets.push_back(facet);
      return facets;
    }

    std::vector<Fracture::CrackTip>
    find_ends(const Mesh::NodalMesh<2> &mesh, const Bonds::CrackSet<2> &cracks)
    {
      return Fracture::find_tips(mesh, cracks, true);
    }

    std::vector<Fracture::CrackFront>
    find_ends(const Mesh::NodalMesh<3> &mesh, const Bonds::CrackSet<3> &cracks)
    {
      return Fracture::find_fronts(mesh, cracks, true);
    }

    double
    distance(const Fracture::CrackTip &tip, const dealii::Point<2> &point)
    {
      return tip.frame.origin.distance(point);
    }

    double
    distance(const Fracture::CrackFront &front, const dealii::Point<3> &point)
    {
      return front.nearest(point).frame.origin.distance(point);
    }

    /// The sides of the slits are connected at tips and fronts only.
    template <int dim>
    void
    check_sides(const Mesh::NodalMesh<dim>              &mesh,
                const Bonds::CrackSet<dim>              &cracks,
                const std::vector<Parameters::Polyline> &lines)
    {
      const auto ends = find_ends(mesh, cracks);
      for (const unsigned int n : Fracture::nodes_of_both_sides(mesh, cracks))
        if (std::none_of(ends.begin(), ends.end(), [&](const auto &end) {
              return distance(end, mesh.nodes[n]) < 1e-3 * mesh.spacing[n];
            }))
          {
            unsigned int nearest  = 0;
            double       smallest = std::numeric_limits<double>::infinity();
            for (const auto &facet : cracks.facets())
              {
                const double found =
                  Bonds::CrackSet<dim>({facet}).distance(mesh.nodes[n]);
                if (found < smallest)
                  nearest = facet.crack;
                smallest = std::min(smallest, found);
              }
            throw Base::InputError(Base::InputMessage{
              "parameter '" + entry + "'",
              "'" + lines[nearest].name + "' " + at(mesh.nodes[n]) +
                ", where both sides of the slit share a node",
              "double nodes everywhere but at the tips",
              "Double this one as well: points between two lines of a slit, "
              "and its mouth at the surface (gmsh: "
              "Plugin(Crack).OpenBoundaryPhysicalGroup)."});
          }
    }

    /// The slit has two faces along all of the crack.
    template <int dim>
    void
    check_slit(const Mesh::NodalMesh<dim> &mesh,
               const Bonds::CrackSet<dim> &crack,
               const std::string          &name,
               Base::InputErrorCollector  &errors)
    {
      const auto points = Bonds::crack_points(mesh, crack);
      double     length = 0., open = 0.;
      for (const auto &point : points)
        length += point.measure;
      std::vector<Mesh::BoundaryFace<dim>> slit;
      const auto on = Fracture::faces_on_cracks(mesh, crack);
      for (unsigned int f = 0; f < on.size(); ++f)
        if (on[f])
          {
            slit.push_back(mesh.boundary_faces[f]);
            open += 0.5 * area(mesh, slit.back());
          }
      // Ends may miss their node by a small part of a face.
      if (points.empty())
        errors.add_parameter(entry,
                             "'" + name + "' outside of the body",
                             "cracks in the body");
      if (points.empty() || std::abs(open - length) < 1e-4 * length)
        return;
      const auto is_on = [&](const auto &faces, const auto &point) {
        return std::any_of(faces.begin(), faces.end(), [&](const auto &face) {
          return Fracture::face_distance(mesh, face, point.position) <
                 1e-3 * mesh.spacing[face.nodes[0]];
        });
      };
      const auto bare =
        std::find_if(points.begin(), points.end(), [&](const auto &point) {
          return !is_on(slit, point);
        });
      if (bare == points.end())
        errors.add_parameter(entry,
                             "'" + name + "' along a side of the body",
                             "cracks inside of the body");
      else if (is_on(mesh.boundary_faces, *bare))
        errors.add_parameter(entry,
                             "'" + name + "' " + at(bare->position) +
                               " on a face of a slit that it covers in part",
                             "in finite elements cracks that end and turn at "
                             "nodes of the slit");
      else
        errors.add_parameter(
          entry,
          "'" + name + "' " + at(bare->position) +
            ", where the mesh has no slit, with Mode = finite elements",
          "in finite elements cracks along double nodes; coupled, peridynamics",
          "Elements cannot be cut: double the nodes along it (gmsh: "
          "Plugin(Crack), or two lines between the same points), or let it cut "
          "bonds with Mode = coupled.");
    }
  } // namespace

  template <int dim>
  Bonds::CrackSet<dim>
  make_meshed_cracks(const Mesh::NodalMesh<dim>              &mesh,
                     const std::vector<Parameters::Polyline> &lines)
  {
    Base::InputErrorCollector errors;
    for (const auto &line : lines)
      check_slit(mesh,
                 Bonds::CrackSet<dim>(raw_facets<dim>({line})),
                 line.name,
                 errors);
    errors.throw_if_any();
    auto facets = raw_facets<dim>(lines);
    if constexpr (dim == 2)
      {
        const auto surface =
          Fracture::outer_surface(mesh, Bonds::CrackSet<2>(facets));
        facets.clear();
        for (unsigned int crack = 0; crack < lines.size(); ++crack)
          {
            const auto &line   = lines[crack];
            auto        points = points_of_line<2>(line);
            const auto  ends   = points;
            const auto  n      = points.size();
            if (ends.front() != ends.back())
              {
                open_surface(mesh, surface, line.name, points[0], ends[1]);
                open_surface(mesh,
                             surface,
                             line.name,
                             points[n - 1],
                             ends[n - 2]);
              }
            for (const auto &facet : facets_of_line<2>(line, points, crack))
              facets.push_back(facet);
          }
      }
    const Bonds::CrackSet<dim> cracks(facets);
    check_sides(mesh, cracks, lines);
    return cracks;
  }

  template Bonds::CrackSet<2>
  make_meshed_cracks<2>(const Mesh::NodalMesh<2> &,
                        const std::vector<Parameters::Polyline> &);
  template Bonds::CrackSet<3>
  make_meshed_cracks<3>(const Mesh::NodalMesh<3> &,
                        const std::vector<Parameters::Polyline> &);
} // namespace Perimorph::Application
