#include <perimorph/application/crack_setup.h>
#include <perimorph/base/exceptions.h>
#include <perimorph/base/label_sizes.h>
#include <perimorph/bonds/crack_points.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    template <int dim>
    dealii::Point<dim>
    to_point(const std::vector<double> &numbers)
    {
      dealii::Point<dim> point;
      for (int d = 0; d < dim; ++d)
        point[d] = numbers[d];
      return point;
    }

    /// How a facet that starts on the surface goes on.
    enum class Way
    {
      outside,
      along_surface,
      into_body
    };

    Way
    find_way(const Mesh::NodalMesh<2>   &mesh,
             const Bonds::CrackFacet<2> &facet,
             const double                tolerance)
    {
      const auto points =
        Bonds::crack_points(mesh, Bonds::CrackSet<2>({facet}));
      for (const auto &point : points)
        if (std::none_of(mesh.boundary_faces.begin(),
                         mesh.boundary_faces.end(),
                         [&](const auto &face) {
                           return point.position.distance(
                                    Mesh::closest_on_segment(
                                      point.position,
                                      mesh.nodes[face.nodes[0]],
                                      mesh.nodes[face.nodes[1]])) < tolerance;
                         }))
          return Way::into_body;
      return points.empty() ? Way::outside : Way::along_surface;
    }

    /// Moves an end on the surface outward along the crack: a little, or, where
    /// bonds pass outside of the body around a corner, as far as they reach.
    void
    open_surface(const Mesh::NodalMesh<2> &mesh,
                 const double              reach,
                 const std::string        &name,
                 dealii::Point<2>         &end,
                 const dealii::Point<2>   &before)
    {
      for (const auto &face : mesh.boundary_faces)
        {
          const auto  &a = mesh.nodes[face.nodes[0]];
          const auto  &b = mesh.nodes[face.nodes[1]];
          const double h = a.distance(b);
          if (end.distance(Mesh::closest_on_segment(end, a, b)) < 1e-3 * h)
            {
              const auto direction = (end - before) / (end - before).norm();
              const auto near      = end + 0.1 * h * direction;
              const auto far       = end + reach * h * direction;
              const bool is_corner = std::any_of(
                mesh.nodes.begin(),
                mesh.nodes.end(),
                [&](const auto &node) {
                  const auto to = node - end;
                  return to.norm() < reach * h && to * direction > 1e-3 * h;
                });
              const Way way =
                is_corner ? find_way(mesh, {{{near, far}}, 0, 0}, 1e-3 * h)
                          : Way::into_body;
              if (way == Way::along_surface)
                {
                  std::ostringstream found;
                  found << "'" << name << "' that goes on at (" << end
                        << ") along a side of the body";
                  throw Base::InputError(Base::InputMessage{
                    "parameter 'Cracks / pre-cracks'",
                    found.str(),
                    "cracks that open the surface",
                    "Let it begin outside of the body, beside that side: it "
                    "is not clear to which face of the crack the side "
                    "belongs."});
                }
              end = way == Way::outside ? far : near;
              return;
            }
        }
    }
  } // namespace

  template <int dim>
  std::vector<dealii::Point<dim>>
  points_of_line(const Parameters::Polyline &line)
  {
    std::vector<dealii::Point<dim>> points;
    for (const auto &numbers : line.points)
      points.push_back(to_point<dim>(numbers));
    return points;
  }

  template <int dim>
  std::vector<Bonds::CrackFacet<dim>>
  facets_of_line(const Parameters::Polyline            &line,
                 const std::vector<dealii::Point<dim>> &points,
                 const unsigned int                     crack)
  {
    std::vector<Bonds::CrackFacet<dim>> facets;
    if constexpr (dim == 2)
      for (unsigned int k = 0; k + 1 < points.size(); ++k)
        facets.push_back({{{points[k], points[k + 1]}}, crack, 0});
    else
      {
        for (unsigned int k = 1; k + 1 < points.size(); ++k)
          facets.push_back({{{points[0], points[k], points[k + 1]}}, crack, 0});
        for (const auto &numbers : line.triangles)
          {
            Bonds::CrackFacet<dim> facet;
            for (int v = 0; v < dim; ++v)
              for (int d = 0; d < dim; ++d)
                facet.corners[v][d] = numbers[dim * v + d];
            facet.crack = crack;
            facets.push_back(facet);
          }
      }
    return facets;
  }

  template <int dim>
  Bonds::CrackSet<dim>
  make_cracks(const Mesh::NodalMesh<dim>              &mesh,
              const std::vector<Parameters::Polyline> &lines,
              const double                             horizon_ratio)
  {
    std::vector<Bonds::CrackFacet<dim>> facets;
    for (unsigned int crack = 0; crack < lines.size(); ++crack)
      {
        auto points = points_of_line<dim>(lines[crack]);
        if constexpr (dim == 2)
          {
            // A closed line has no ends.
            const auto n = points.size();
            if (points.front() != points.back())
              {
                const auto first = points[0];
                // Horizons vary from node to node.
                const double reach = 1.5 * horizon_ratio;
                open_surface(mesh,
                             reach,
                             lines[crack].name,
                             points[0],
                             points[1]);
                open_surface(mesh,
                             reach,
                             lines[crack].name,
                             points[n - 1],
                             n == 2 ? first : points[n - 2]);
              }
          }
        for (const auto &facet :
             facets_of_line<dim>(lines[crack], points, crack))
          facets.push_back(facet);
      }
    Bonds::CrackSet<dim>   cracks(facets);
    std::set<unsigned int> inside;
    for (const auto &point : Bonds::crack_points(mesh, cracks))
      inside.insert(facets[point.facet].crack);
    Base::InputErrorCollector errors;
    for (unsigned int crack = 0; crack < lines.size(); ++crack)
      if (inside.count(crack) == 0)
        errors.add_parameter("Cracks / pre-cracks",
                             "'" + lines[crack].name + "' outside of the body",
                             "cracks in the body");
    errors.throw_if_any();
    return cracks;
  }

  template <int dim>
  std::vector<Parameters::Feature>
  crack_features(const Bonds::CrackSet<dim> &cracks)
  {
    std::vector<Parameters::Feature> features;
    for (const auto &facet : cracks.facets())
      {
        Parameters::Feature feature;
        feature.kind = dim == 2 ? Parameters::FeatureKind::segment
                                : Parameters::FeatureKind::triangle;
        for (const auto &corner : facet.corners)
          for (int d = 0; d < dim; ++d)
            feature.numbers.push_back(corner[d]);
        features.push_back(feature);
      }
    return features;
  }

  template <int dim>
  std::vector<unsigned int>
  parts_of_body(const Mesh::NodalMesh<dim> &mesh,
                const Bonds::CrackSet<dim> &cracks)
  {
    constexpr unsigned int    none = static_cast<unsigned int>(-1);
    std::vector<unsigned int> parts(mesh.n_nodes(), none), front;
    unsigned int              n_parts = 0;
    for (unsigned int start = 0; start < mesh.n_nodes(); ++start)
      {
        if (parts[start] != none)
          continue;
        parts[start] = n_parts;
        front.assign(1, start);
        for (std::size_t next = 0; next < front.size(); ++next)
          for (const unsigned int cell : mesh.node_cells.row(front[next]))
            for (const unsigned int n : mesh.cells[cell])
              if (parts[n] == none &&
                  !cracks.crosses(mesh.nodes[front[next]], mesh.nodes[n]))
                {
                  parts[n] = n_parts;
                  front.push_back(n);
                }
        ++n_parts;
      }
    return parts;
  }

  unsigned int
  count_large_parts(const std::vector<unsigned int> &parts,
                    const std::vector<bool>         &marked)
  {
    constexpr double  smallest = 0.05;
    const auto        sizes    = Base::label_sizes(parts);
    std::vector<bool> counts(sizes.size());
    for (std::size_t k = 0; k < sizes.size(); ++k)
      counts[k] = sizes[k] > smallest * parts.size();
    for (std::size_t n = 0; n < marked.size(); ++n)
      if (marked[n])
        counts[parts[n]] = true;
    return std::count(counts.begin(), counts.end(), true);
  }

  template <int dim>
  std::vector<CrackMouth>
  find_mouths(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::CrackSet<dim> &cracks)
  {
    // Edges of a face by its nodes in lexicographic order.
    const std::vector<std::array<unsigned int, 2>> edges =
      dim == 2 ? std::vector<std::array<unsigned int, 2>>{{{0, 1}}}
               : std::vector<std::array<unsigned int, 2>>{{{0, 1}},
                                                          {{1, 3}},
                                                          {{3, 2}},
                                                          {{2, 0}}};
    std::vector<CrackMouth> mouths;
    for (unsigned int f = 0; f < mesh.boundary_faces.size(); ++f)
      {
        const auto &nodes = mesh.boundary_faces[f].nodes;
        for (unsigned int k = 0; k < cracks.facets().size(); ++k)
          for (const auto &edge : edges)
            if (Bonds::crosses(cracks.facets()[k],
                               mesh.nodes[nodes[edge[0]]],
                               mesh.nodes[nodes[edge[1]]]))
              {
                mouths.push_back({f, k});
                break;
              }
      }
    return mouths;
  }

  template <int dim>
  void
  check_cracks_in_core(const Mesh::NodalMesh<dim>     &mesh,
                       const Mesh::RegionMap          &region,
                       const Bonds::CrackSet<dim>     &cracks,
                       const std::vector<std::string> &names)
  {
    std::set<unsigned int> reported;
    for (const auto &point : Bonds::crack_points(mesh, cracks))
      for (const unsigned int n : mesh.cells[point.cell])
        {
          const unsigned int crack = cracks.facets()[point.facet].crack;
          if (region.alpha[n] == 1. || !reported.insert(crack).second)
            continue;
          std::ostringstream found;
          found << "'" << names[crack] << "' at (" << point.position
                << ") where elements carry a part (alpha = " << region.alpha[n]
                << ")";
          throw Base::InputError(
            Base::InputMessage{"parameter 'Cracks / pre-cracks'",
                               found.str(),
                               "cracks in the peridynamic core",
                               "Use a larger 'Peridynamics / core size'."});
        }
  }

  template <int dim>
  std::vector<bool>
  protected_nodes(const Mesh::DistributedMesh<dim>       &mesh,
                  const Mesh::RegionMap                  &region,
                  const std::vector<Parameters::Feature> &features)
  {
    using Parameters::FeatureKind;
    const auto               &nodal = mesh.nodal();
    std::vector<bool>         found(nodal.n_nodes(), false);
    Base::InputErrorCollector errors;
    for (const auto &feature : features)
      errors.collect([&]() {
        const bool boundary = feature.kind == FeatureKind::boundary;
        const bool volume   = feature.kind == FeatureKind::volume;
        const bool is_solid = volume || feature.kind == FeatureKind::box ||
                              feature.kind == FeatureKind::ball;
        const Mesh::FeatureDistance<dim> distance(
          feature,
          mesh,
          std::string("parameter 'Cracks / protected ") +
            (boundary ? "boundaries'"
             : volume ? "materials'"
                      : "regions'"));
        for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
          {
            const double reach =
              (is_solid ? 0. : region.horizon[n]) + 1e-9 * nodal.spacing[n];
            if (distance
                  .closest_to_node(
                    nodal,
                    n,
                    [&](const auto &) {
                      return typename Mesh::FeatureDistance<dim>::Range{reach,
                                                                        reach};
                    })
                  .distance <= reach)
              found[n] = true;
          }
      });
    errors.throw_if_any();
    return found;
  }

#define PERIMORPH_INSTANTIATE(dim)                                           \
  template std::vector<dealii::Point<dim>> points_of_line<dim>(              \
    const Parameters::Polyline &);                                           \
  template std::vector<Bonds::CrackFacet<dim>> facets_of_line<dim>(          \
    const Parameters::Polyline &,                                            \
    const std::vector<dealii::Point<dim>> &,                                 \
    unsigned int);                                                           \
  template Bonds::CrackSet<dim> make_cracks<dim>(                            \
    const Mesh::NodalMesh<dim> &,                                            \
    const std::vector<Parameters::Polyline> &,                               \
    double);                                                                 \
  template std::vector<Parameters::Feature> crack_features<dim>(             \
    const Bonds::CrackSet<dim> &);                                           \
  template std::vector<unsigned int> parts_of_body<dim>(                     \
    const Mesh::NodalMesh<dim> &,                                            \
    const Bonds::CrackSet<dim> &);                                           \
  template std::vector<CrackMouth> find_mouths<dim>(                         \
    const Mesh::NodalMesh<dim> &,                                            \
    const Bonds::CrackSet<dim> &);                                           \
  template void check_cracks_in_core<dim>(const Mesh::NodalMesh<dim> &,      \
                                          const Mesh::RegionMap &,           \
                                          const Bonds::CrackSet<dim> &,      \
                                          const std::vector<std::string> &); \
  template std::vector<bool> protected_nodes<dim>(                           \
    const Mesh::DistributedMesh<dim> &,                                      \
    const Mesh::RegionMap &,                                                 \
    const std::vector<Parameters::Feature> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
