#include <perimorph/application/crack_groups.h>
#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Perimorph::Application
{
  namespace
  {
    template <int dim>
    using Facet = std::array<dealii::Point<dim>, dim>;

    template <int dim>
    std::vector<double>
    numbers_of(const dealii::Point<dim> &point)
    {
      return std::vector<double>(point.begin_raw(), point.end_raw());
    }

    template <int dim>
    std::vector<Facet<dim>>
    facets_of_group(const Mesh::GmshMesh<dim> &mesh, const std::string &name)
    {
      // Corners of a quadrilateral are lexicographic.
      using Corners = std::vector<std::array<unsigned int, 3>>;
      const Corners corners =
        dim == 2 ? Corners{{{0, 1, 0}}} : Corners{{{0, 1, 3}}, {{0, 3, 2}}};
      std::vector<Facet<dim>> facets;
      if (const auto drawn = mesh.drawn.find(name); drawn != mesh.drawn.end())
        facets = drawn->second;
      if (const auto faces = mesh.surfaces.find(name);
          faces != mesh.surfaces.end())
        for (const auto &face : faces->second)
          for (const auto &some : corners)
            {
              Facet<dim> facet;
              for (int v = 0; v < dim; ++v)
                facet[v] = mesh.points[face[some[v]]];
              facets.push_back(facet);
            }
      // Both faces of a slit may be in the group.
      std::set<std::set<std::vector<double>>> known;
      facets.erase(std::remove_if(facets.begin(),
                                  facets.end(),
                                  [&](const Facet<dim> &facet) {
                                    std::set<std::vector<double>> corners;
                                    for (const auto &corner : facet)
                                      corners.insert(numbers_of(corner));
                                    return !known.insert(corners).second;
                                  }),
                   facets.end());
      return facets;
    }

    /// Whether b lies on the straight way from a to c.
    bool
    is_straight(const std::vector<double> &a,
                const std::vector<double> &b,
                const std::vector<double> &c)
    {
      const double u[2] = {b[0] - a[0], b[1] - a[1]};
      const double v[2] = {c[0] - b[0], c[1] - b[1]};
      const double dot  = u[0] * v[0] + u[1] * v[1];
      return std::abs(u[0] * v[1] - u[1] * v[0]) < 1e-10 * dot;
    }

    /// Lines whose pieces share points, from end to end, from branch to branch
    /// or around.
    std::vector<std::vector<std::vector<double>>>
    join_lines(const std::vector<Facet<2>> &pieces)
    {
      using Place = std::vector<double>;
      std::map<Place, std::vector<std::size_t>> at;
      for (std::size_t k = 0; k < pieces.size(); ++k)
        for (const auto &end : pieces[k])
          at[numbers_of(end)].push_back(k);
      std::vector<bool>               used(pieces.size(), false);
      std::vector<std::vector<Place>> lines;
      const auto follow = [&](Place place, std::size_t piece) {
        std::vector<Place> line = {place};
        while (true)
          {
            used[piece]      = true;
            const auto first = numbers_of(pieces[piece][0]);
            place = first == place ? numbers_of(pieces[piece][1]) : first;
            if (line.size() > 1 &&
                is_straight(line[line.size() - 2], line.back(), place))
              line.back() = place;
            else
              line.push_back(place);
            const auto &here = at[place];
            const auto  next =
              std::find_if(here.begin(), here.end(), [&](const std::size_t k) {
                return !used[k];
              });
            if (here.size() != 2 || next == here.end())
              break;
            piece = *next;
          }
        lines.push_back(line);
      };
      for (const auto &[place, here] : at)
        if (here.size() != 2)
          for (const std::size_t piece : here)
            if (!used[piece])
              follow(place, piece);
      for (std::size_t k = 0; k < pieces.size(); ++k)
        if (!used[k])
          follow(numbers_of(pieces[k][0]), k);
      return lines;
    }

    template <int dim>
    std::vector<std::string>
    group_names(const Mesh::GmshMesh<dim> &mesh)
    {
      std::set<std::string> names;
      for (const auto &group : mesh.surfaces)
        names.insert(group.first);
      for (const auto &group : mesh.drawn)
        names.insert(group.first);
      return {names.begin(), names.end()};
    }
  } // namespace

  template <int dim>
  std::vector<Parameters::Polyline>
  read_crack_groups(const Mesh::GmshMesh<dim>               &mesh,
                    const std::vector<Parameters::Polyline> &cracks)
  {
    std::vector<Parameters::Polyline> list;
    Base::InputErrorCollector         errors;
    for (const auto &crack : cracks)
      {
        if (crack.group.empty())
          {
            list.push_back(crack);
            continue;
          }
        const auto facets = facets_of_group(mesh, crack.group);
        if (facets.empty())
          {
            errors.add_parameter(
              "Cracks / pre-cracks",
              "'" + crack.group + "' is not a surface of the mesh" +
                Base::did_you_mean(crack.group, group_names(mesh)),
              "");
            continue;
          }
        if constexpr (dim == 2)
          {
            const auto lines = join_lines(facets);
            for (std::size_t k = 0; k < lines.size(); ++k)
              {
                list.push_back(crack);
                list.back().points = lines[k];
                if (lines.size() > 1)
                  list.back().name += "_" + std::to_string(k + 1);
              }
          }
        else
          {
            list.push_back(crack);
            for (const auto &facet : facets)
              {
                std::vector<double> corners;
                for (const auto &corner : facet)
                  corners.insert(corners.end(),
                                 corner.begin_raw(),
                                 corner.end_raw());
                list.back().triangles.push_back(corners);
              }
          }
      }
    errors.throw_if_any();
    return list;
  }

  template std::vector<Parameters::Polyline>
  read_crack_groups<2>(const Mesh::GmshMesh<2> &,
                       const std::vector<Parameters::Polyline> &);
  template std::vector<Parameters::Polyline>
  read_crack_groups<3>(const Mesh::GmshMesh<3> &,
                       const std::vector<Parameters::Polyline> &);
} // namespace Perimorph::Application
