#include <perimorph/base/exceptions.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/gmsh_reader.h>

#include <deal.II/base/utilities.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <unordered_map>

namespace boost::serialization
{
  template <class Archive, int dim>
  void
  serialize(Archive                        &archive,
            Perimorph::Mesh::GmshMesh<dim> &mesh,
            const unsigned int)
  {
    archive &mesh.points &mesh.cells &mesh.volumes &mesh.surfaces &mesh.drawn;
  }
} // namespace boost::serialization

namespace Perimorph::Mesh
{
  namespace
  {
    /// Keeps gmsh initialised for one scope. Values for DefineConstant go in as
    /// options of its command line, which also reaches constants that the file
    /// does not offer to the user interface.
    struct GmshSession
    {
      explicit GmshSession(const std::map<std::string, double> &parameters)
      {
        std::vector<std::string> words = {"perimorph"};
        for (const auto &parameter : parameters)
          {
            std::ostringstream value;
            value.precision(17);
            value << parameter.second;
            words.insert(words.end(),
                         {"-setnumber", parameter.first, value.str()});
          }
        std::vector<char *> arguments;
        for (auto &word : words)
          arguments.push_back(&word[0]);
        gmsh::initialize(arguments.size(), arguments.data());
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::logger::start();
      }
      ~GmshSession()
      {
        try
          {
            gmsh::finalize();
          }
        catch (...)
          {}
      }

      /// The first error gmsh reported since the start of the session.
      static std::string
      first_error()
      {
        std::vector<std::string> log;
        gmsh::logger::get(log);
        for (const auto &line : log)
          if (line.rfind("Error", 0) == 0)
            return line;
        return "";
      }
    };

    std::string
    position(const std::vector<double> &x)
    {
      std::ostringstream text;
      text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
      return text.str();
    }

    /// Corner order of gmsh's cells and faces in lexicographic order.
    std::vector<unsigned int>
    lexicographic_order(const unsigned int dim)
    {
      if (dim == 1)
        return {0, 1};
      if (dim == 2)
        return {0, 1, 3, 2};
      return {0, 1, 3, 2, 4, 5, 7, 6};
    }

    /// gmsh element type of first-order lines, quadrilaterals and hexahedra.
    int
    first_order_type(const unsigned int dim)
    {
      return dim == 1 ? 1 : (dim == 2 ? 3 : 5);
    }

    /// Number of elements of a kind that Perimorph cannot use, in words.
    std::string
    unsupported_elements(const int dim)
    {
      static const std::map<int, std::string> kinds = {
        {2, "triangles"},
        {4, "tetrahedra"},
        {6, "prisms"},
        {7, "pyramids"},
        {9, "second-order triangles"},
        {10, "second-order quadrilaterals"},
        {11, "second-order tetrahedra"},
        {12, "second-order hexahedra"},
        {16, "second-order quadrilaterals"},
        {17, "second-order hexahedra"}};
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dim);
      std::string found;
      for (unsigned int k = 0; k < types.size(); ++k)
        if (types[k] != first_order_type(dim))
          {
            const auto kind = kinds.find(types[k]);
            found += (found.empty() ? "" : ", ") +
                     std::to_string(tags[k].size()) + " " +
                     (kind == kinds.end() ? "other elements" : kind->second);
          }
      return found;
    }

    void
    open_file(const std::string                   &file,
              const std::map<std::string, double> &geometry_parameters,
              const int                            dim)
    {
      const std::filesystem::path path(file);
      const std::string           where     = "mesh file '" + file + "'";
      const std::string           extension = path.extension().string();
      if (extension != ".msh" && extension != ".geo")
        throw Base::InputError(Base::InputMessage{where,
                                                  "ending '" + extension + "'",
                                                  "'.msh' or '.geo' (gmsh)",
                                                  ""});
      std::error_code status;
      if (!std::filesystem::is_regular_file(path, status))
        throw Base::InputError(Base::InputMessage{
          where,
          "no such file",
          "the path of a gmsh mesh (.msh) or geometry (.geo), "
          "relative to the parameter file",
          ""});
      std::ifstream     stream(file);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      if (!stream.good() && !stream.eof())
        throw Base::InputError(
          Base::InputMessage{where, "a file that cannot be read", "", ""});
      if (extension == ".msh" && text.find("$MeshFormat") == std::string::npos)
        throw Base::InputError(Base::InputMessage{
          where,
          text.empty() ? "an empty file" : "something that is not a gmsh mesh",
          "a gmsh mesh that starts with $MeshFormat (version 2.2 or 4.1)",
          ""});
      for (const auto &parameter : geometry_parameters)
        {
          if (extension == ".msh")
            throw Base::InputError(Base::InputMessage{
              "parameter 'Mesh / geometry parameters'",
              "'" + parameter.first + "' for the mesh '" + file + "'",
              "nothing: only a .geo has parameters",
              ""});
          if (!std::regex_search(
                text,
                std::regex("\\b" + parameter.first + "\\s*=\\s*\\{")))
            throw Base::InputError(Base::InputMessage{
              "parameter 'Mesh / geometry parameters'",
              "'" + parameter.first + "'",
              "a name that '" + file + "' defines with DefineConstant",
              ""});
        }

      std::string problem;
      try
        {
          gmsh::open(file);
          std::vector<std::size_t> tags;
          std::vector<double>      coordinates, parametric;
          gmsh::model::mesh::getNodes(tags, coordinates, parametric);
          if (extension == ".geo" && tags.empty())
            gmsh::model::mesh::generate(dim);
          problem = GmshSession::first_error();
        }
      catch (...)
        {
          problem = GmshSession::first_error();
          if (problem.empty())
            problem = "gmsh gave up without a reason";
        }
      if (!problem.empty())
        throw Base::InputError(
          Base::InputMessage{where,
                             "a problem reported by gmsh: " + problem,
                             "",
                             ""});
    }

    template <int dim>
    GmshMesh<dim>
    collect()
    {
      GmshMesh<dim>            mesh;
      std::vector<std::size_t> node_tags;
      std::vector<double>      coordinates, parametric;
      gmsh::model::mesh::getNodes(node_tags, coordinates, parametric);
      std::unordered_map<std::size_t, std::size_t> position_of;
      for (std::size_t k = 0; k < node_tags.size(); ++k)
        position_of[node_tags[k]] = k;

      const std::string unsupported = unsupported_elements(dim);
      if (!unsupported.empty())
        throw Base::InputError(Base::InputMessage{
          "mesh",
          unsupported,
          dim == 2 ? "first-order quadrilaterals only"
                   : "first-order hexahedra only",
          "In a .geo use Recombine with Mesh.RecombinationAlgorithm = 2 or "
          "Mesh.SubdivisionAlgorithm = 1 (2 in 3D)."});

      std::vector<std::size_t> cell_tags, cell_nodes;
      gmsh::model::mesh::getElementsByType(first_order_type(dim),
                                           cell_tags,
                                           cell_nodes);
      if (cell_tags.empty())
        throw Base::InputError(
          Base::InputMessage{"mesh",
                             "no cells of dimension " + std::to_string(dim),
                             dim == 2 ? "quadrilaterals" : "hexahedra",
                             "Check the parameter 'Dimension' and the physical "
                             "groups of the mesh."});

      std::unordered_map<std::size_t, unsigned int> point_of;
      const auto point = [&](std::size_t tag) {
        const auto inserted = point_of.emplace(tag, mesh.points.size());
        if (inserted.second)
          {
            const double *x = &coordinates[3 * position_of.at(tag)];
            if (!std::isfinite(x[0]) || !std::isfinite(x[1]) ||
                !std::isfinite(x[2]))
              throw Base::InputError(Base::InputMessage{
                "mesh",
                "node " + std::to_string(tag) +
                  " with a coordinate that is not a number or infinite",
                "finite coordinates",
                ""});
            if (dim == 2 && std::abs(x[2]) > 1e-12 * (1. + std::abs(x[0])))
              throw Base::InputError(
                Base::InputMessage{"mesh",
                                   "a node at " + position({x[0], x[1], x[2]}),
                                   "z = 0 in a two-dimensional mesh",
                                   "Check the parameter 'Dimension'."});
            dealii::Point<dim> p;
            for (int d = 0; d < dim; ++d)
              p[d] = x[d];
            mesh.points.push_back(p);
          }
        return inserted.first->second;
      };

      const auto         order          = lexicographic_order(dim);
      const unsigned int nodes_per_cell = 1u << dim;
      std::unordered_map<std::size_t, unsigned int> cell_of;
      for (std::size_t c = 0; c < cell_tags.size(); ++c)
        {
          typename GmshMesh<dim>::Cell cell;
          for (unsigned int v = 0; v < nodes_per_cell; ++v)
            cell[v] = point(cell_nodes[c * nodes_per_cell + order[v]]);
          cell_of[cell_tags[c]] = c;
          mesh.cells.push_back(cell);
        }

      const int  triangle  = 2;
      const auto add_drawn = [&](const std::string               &name,
                                 const std::size_t               *tags,
                                 const std::vector<unsigned int> &corners) {
        std::array<dealii::Point<dim>, dim> facet;
        for (int v = 0; v < dim; ++v)
          for (int d = 0; d < dim; ++d)
            facet[v][d] = coordinates[3 * position_of.at(tags[corners[v]]) + d];
        mesh.drawn[name].push_back(facet);
      };

      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups);
      for (const auto &group : groups)
        {
          if (group.first != dim && group.first != dim - 1)
            continue;
          std::string name;
          gmsh::model::getPhysicalName(group.first, group.second, name);
          if (name.empty())
            name = std::to_string(group.second);
          std::vector<int> entities;
          gmsh::model::getEntitiesForPhysicalGroup(group.first,
                                                   group.second,
                                                   entities);
          for (const int entity : entities)
            {
              std::vector<int>                      types;
              std::vector<std::vector<std::size_t>> tags, nodes;
              gmsh::model::mesh::getElements(types,
                                             tags,
                                             nodes,
                                             group.first,
                                             entity);
              for (std::size_t k = 0; k < types.size(); ++k)
                if (group.first == dim)
                  for (const auto tag : tags[k])
                    mesh.volumes[name].push_back(cell_of.at(tag));
                else if (dim == 3 && types[k] == triangle)
                  for (std::size_t f = 0; f < tags[k].size(); ++f)
                    add_drawn(name, &nodes[k][3 * f], {0, 1, 2});
                else if (types[k] == first_order_type(dim - 1))
                  {
                    const auto face_order = lexicographic_order(dim - 1);
                    const unsigned int n  = 1u << (dim - 1);
                    for (std::size_t f = 0; f < tags[k].size(); ++f)
                      {
                        typename GmshMesh<dim>::Face face;
                        bool                         in_mesh = true;
                        for (unsigned int v = 0; v < n; ++v)
                          {
                            const auto found =
                              point_of.find(nodes[k][f * n + face_order[v]]);
                            in_mesh = in_mesh && found != point_of.end();
                            if (in_mesh)
                              face[v] = found->second;
                          }
                        const std::size_t *first = &nodes[k][f * n];
                        if (in_mesh)
                          mesh.surfaces[name].push_back(face);
                        else if (dim == 2)
                          add_drawn(name, first, {0, 1});
                        else
                          {
                            add_drawn(name, first, {0, 1, 2});
                            add_drawn(name, first, {0, 2, 3});
                          }
                      }
                  }
            }
        }
      return mesh;
    }

    /// Turns cells of negative volume and refuses cells that are not convex.
    template <int dim>
    void
    check_cells(GmshMesh<dim> &mesh)
    {
      unsigned int       n_bad = 0;
      dealii::Point<dim> first_bad;
      for (auto &cell : mesh.cells)
        {
          const auto corners = [&]() {
            std::array<dealii::Point<dim>, (1u << dim)> points;
            for (unsigned int v = 0; v < points.size(); ++v)
              points[v] = mesh.points[cell[v]];
            return points;
          };
          if (smallest_relative_jacobian<dim>(corners()) > 1e-6)
            continue;
          // A cell that is only oriented the other way is swapped in its first
          // direction.
          auto original = cell;
          for (unsigned int v = 0; v < cell.size(); v += 2)
            std::swap(cell[v], cell[v + 1]);
          if (smallest_relative_jacobian<dim>(corners()) > 1e-6)
            continue;
          cell = original;
          if (n_bad++ == 0)
            for (unsigned int v = 0; v < cell.size(); ++v)
              first_bad += mesh.points[cell[v]] / double(cell.size());
        }
      if (n_bad > 0)
        {
          std::ostringstream found;
          found << n_bad << " inverted or non-convex cell"
                << (n_bad > 1 ? "s" : "") << ", the first with its centre at ("
                << first_bad << ")";
          throw Base::InputError(Base::InputMessage{
            "mesh",
            found.str(),
            "cells with a positive Jacobian at every corner",
            "Improve the mesh in gmsh (smoothing, finer spacing)."});
        }
    }
  } // namespace

  template <int dim>
  GmshMesh<dim>
  read_gmsh(const std::string                   &file,
            const std::map<std::string, double> &geometry_parameters,
            const MPI_Comm                       communicator)
  {
    GmshMesh<dim>            mesh;
    std::vector<std::string> errors;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        try
          {
            const GmshSession session(geometry_parameters);
            open_file(file, geometry_parameters, dim);
            mesh = collect<dim>();
            check_cells(mesh);
          }
        catch (const Base::InputError &error)
          {
            errors = error.messages();
          }
        catch (const std::exception &error)
          {
            errors = {"mesh file '" + file +
                      "' cannot be read: " + error.what()};
          }
        catch (const std::string &error) // thrown by gmsh
          {
            errors = {"mesh file '" + file + "' cannot be read: " + error};
          }
        for (auto &error : errors)
          if (error.rfind("mesh\n", 0) == 0)
            error.replace(0, 4, "mesh '" + file + "'");
      }
    errors = dealii::Utilities::MPI::broadcast(communicator, errors, 0);
    if (!errors.empty())
      throw Base::InputError(errors);
    return dealii::Utilities::MPI::broadcast(communicator, mesh, 0);
  }

  template GmshMesh<2>
  read_gmsh<2>(const std::string &,
               const std::map<std::string, double> &,
               MPI_Comm);
  template GmshMesh<3>
  read_gmsh<3>(const std::string &,
               const std::map<std::string, double> &,
               MPI_Comm);
} // namespace Perimorph::Mesh
