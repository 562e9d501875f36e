#include <perimorph/base/exceptions.h>
#include <perimorph/base/name_help.h>
#include <perimorph/base/point_cloud.h>
#include <perimorph/mesh/feature_distance.h>
#include <perimorph/mesh/refinement_rule.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Mesh
{
  namespace
  {
    /// Edges are compared with what was asked for up to digits of files.
    constexpr double slack = 1. + 1e-6;

    template <int dim>
    double
    mean_edge(const NodalMesh<dim> &mesh, const unsigned int cell)
    {
      double       sum   = 0.;
      unsigned int count = 0;
      const auto  &nodes = mesh.cells[cell];
      for (unsigned int v = 0; v < nodes.size(); ++v)
        for (int d = 0; d < dim; ++d)
          if (!((v >> d) & 1u))
            {
              sum +=
                mesh.nodes[nodes[v]].distance(mesh.nodes[nodes[v | (1u << d)]]);
              ++count;
            }
      return sum / count;
    }

    /// How far the fine mesh reaches, seen from a place on a feature.
    template <int dim>
    class Reach
    {
    public:
      Reach(const NodalMesh<dim>       &mesh,
            const RegionParameters     &region,
            const RefinementParameters &refinement)
        : mesh(mesh)
        , region(region)
        , refinement(refinement)
        , cloud(mesh.nodes)
      {}

      double
      operator()(const dealii::Point<dim> &place, const bool with_region) const
      {
        // The spacing there once its cells are fine enough.
        double h = mesh.spacing[cloud.nearest(place).first];
        while (h > refinement.spacing * slack)
          h /= 2.;
        const double horizon = region.horizon_length > 0.
                                 ? region.horizon_length
                                 : region.horizon_ratio * h;
        const auto   length  = [&](const Parameters::Length &size) {
          return length_of(size, h, horizon);
        };
        double reach = length(refinement.distance);
        if (with_region)
          reach += length(region.core_size);
        if (with_region && region.blending_function != BlendingFunction::splice)
          reach += length(region.blending_width);
        return reach;
      }

    private:
      const NodalMesh<dim>       &mesh;
      const RegionParameters     &region;
      const RefinementParameters &refinement;
      Base::PointCloud<dim>       cloud;
    };
  } // namespace

  template <int dim>
  std::vector<unsigned int>
  too_large_cells(const DistributedMesh<dim> &mesh,
                  const RegionParameters     &region,
                  const RefinementParameters &refinement)
  {
    const auto               &nodal = mesh.nodal();
    std::vector<unsigned int> large;
    std::vector<double>       length(nodal.n_cells());
    for (unsigned int c = 0; c < nodal.n_cells(); ++c)
      {
        length[c] = mean_edge(nodal, c) / slack;
        if (length[c] > refinement.spacing)
          large.push_back(c);
      }
    if (region.mode == Mode::peridynamics)
      return large;
    if (region.features.empty() && refinement.features.empty())
      throw Base::InputError(Base::InputMessage{
        "parameter 'Mesh / Refinement / target spacing'",
        "nothing that the mesh shall be fine around",
        "places in 'Mesh / Refinement / around' or 'Peridynamics / around': a "
        "boundary (" +
          Base::join_names(mesh.boundary_names()) +
          "), volume, point, segment, plane, box or ball",
        ""});
    const Reach<dim>  reach(nodal, region, refinement);
    std::vector<bool> chosen(nodal.n_cells(), false);
    const auto        choose = [&](const auto        &features,
                            const bool         with_region,
                            const std::string &used_by) {
      for (const auto &feature : features)
        {
          const FeatureDistance<dim> distance(feature, mesh, used_by);
          for (const unsigned int c : large)
            {
              if (chosen[c])
                continue;
              double radius = 0.;
              for (const unsigned int n : nodal.cells[c])
                radius =
                  std::max(radius,
                           nodal.cell_centroid[c].distance(nodal.nodes[n]));
              // A cell that touches the fine part, and one too large for its
              // distance from there.
              const double slope =
                (length[c] - refinement.spacing) / refinement.grading;
              const auto limit = [&](const auto &place) {
                return reach(place, with_region) + std::max(radius, slope);
              };
              const auto closest =
                distance.closest_to_cell(nodal, c, [&](const auto &place) {
                  const double far = limit(place);
                  return typename FeatureDistance<dim>::Range{.8 * far, far};
                });
              chosen[c] = closest.distance <= limit(closest.point);
            }
        }
    };
    choose(region.features, true, "parameter 'Peridynamics / around'");
    choose(refinement.features,
           false,
           "parameter 'Mesh / Refinement / around'");
    large.erase(
      std::remove_if(large.begin(),
                     large.end(),
                     [&](const unsigned int c) { return !chosen[c]; }),
      large.end());
    return large;
  }

  template <int dim>
  std::vector<unsigned int>
  cells_that_disturb_families(const NodalMesh<dim> &mesh,
                              const RegionMap      &region)
  {
    // A family has nodes of the cells that its horizon touches.
    std::vector<dealii::Point<dim>> particles;
    std::vector<double>             reach;
    double                          longest = 0.;
    for (unsigned int n = 0; n < mesh.n_nodes() && !mesh.hanging.empty(); ++n)
      if (region.alpha[n] > 0.)
        {
          particles.push_back(mesh.nodes[n]);
          reach.push_back(region.horizon[n] +
                          std::sqrt(double(dim)) * mesh.spacing[n]);
          longest = std::max(longest, reach.back());
        }
    if (particles.empty())
      return {};
    const Base::PointCloud<dim> cloud(particles);
    std::vector<unsigned int>   near, cells;
    for (const auto &[node, parents] : mesh.hanging)
      {
        cloud.within(mesh.nodes[node], longest, near);
        const auto &place = mesh.nodes[node];
        if (std::none_of(near.begin(), near.end(), [&](const unsigned int p) {
              return particles[p].distance(place) <= slack * reach[p];
            }))
          continue;
        // The cells of which it halves an edge or a face.
        for (const unsigned int c : mesh.node_cells.row(parents[0].first))
          {
            const auto        &corners = mesh.cells[c];
            const unsigned int n_shared =
              std::count_if(parents.begin(),
                            parents.end(),
                            [&corners](const auto &parent) {
                              return std::find(corners.begin(),
                                               corners.end(),
                                               parent.first) != corners.end();
                            });
            if (n_shared > 1)
              cells.push_back(c);
          }
      }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }

#define PERIMORPH_INSTANTIATE(dim)                                     \
  template std::vector<unsigned int> too_large_cells<dim>(             \
    const DistributedMesh<dim> &,                                      \
    const RegionParameters &,                                          \
    const RefinementParameters &);                                     \
  template std::vector<unsigned int> cells_that_disturb_families<dim>( \
    const NodalMesh<dim> &,                                            \
    const RegionMap &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Mesh
