#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/cells_at_cracks.h>
#include <perimorph/fracture/crack_slits.h>
#include <perimorph/fracture/stress_points.h>
#include <perimorph/mesh/cell_geometry.h>

#include <algorithm>

namespace Perimorph::Fracture
{
  namespace
  {
    // Parts along each axis that a touched cell is cut into: in 2D the crack
    // then passes between points that are h / 4 apart. In 3D parts cost eight
    // times the fits and gained nothing on the penny crack.
    template <int dim>
    constexpr unsigned int n_parts = dim == 2 ? 2 : 1;

    /// Sets stress and energy of a gradient.
    template <int dim>
    void
    apply_law(const Materials::Material<dim> &law, StressPoint<dim> &point)
    {
      const auto &H               = point.displacement_gradient;
      point.first_piola_kirchhoff = law.first_piola_kirchhoff(H);
      point.energy_density        = law.energy_density(H);
    }

    template <int dim>
    void
    finish_point(StressPointSet<dim> &set, const StressPoint<dim> &point)
    {
      set.points.push_back(point);
      set.offsets.push_back(set.node.size());
    }

    /// Gauss points of a cell.
    /// @param alpha  empty: 0
    template <int dim>
    void
    add_gauss_points(const DeformedBody<dim>   &body,
                     const unsigned int         cell,
                     const std::vector<double> &alpha,
                     StressPointSet<dim>       &set)
    {
      const auto &nodes = body.mesh.cells[cell];
      const auto &law   = *body.materials[body.mesh.cell_material[cell]];
      const Mesh::CellGeometry<dim> geometry(body.mesh.corners(cell));
      for (unsigned int q = 0; q < geometry.n_points; ++q)
        {
          double share = 1.;
          if (!alpha.empty())
            for (unsigned int v = 0; v < nodes.size(); ++v)
              share -= alpha[nodes[v]] * geometry.shape_value(q, v);
          // round-off where all nodes have alpha = 1
          if (share < 1e-12)
            continue;
          StressPoint<dim> point = {};
          point.x                = geometry.points[q];
          point.volume           = geometry.jxw[q] * share;
          for (unsigned int v = 0; v < nodes.size(); ++v)
            {
              const auto &gradient = geometry.gradients[q][v];
              point.displacement_gradient +=
                dealii::outer_product(body.displacement[nodes[v]], gradient);
              set.node.push_back(nodes[v]);
              set.value_weight.push_back(geometry.shape_value(q, v));
              set.gradient_weight.push_back(gradient);
            }
          apply_law(law, point);
          finish_point(set, point);
        }
    }

    /// Gauss points of the parts of a touched cell. The map of a part is that
    /// of the cell, so q and its gradient are those of the cell.
    template <int dim>
    void
    add_fitted_points(const DeformedBody<dim>    &body,
                      const unsigned int          cell,
                      const DisplacementFit<dim> &fit,
                      StressPointSet<dim>        &set)
    {
      const auto         corners  = body.mesh.corners(cell);
      const auto        &nodes    = body.mesh.cells[cell];
      const unsigned int material = body.mesh.cell_material[cell];
      double             spacing  = 0.;
      for (const unsigned int n : nodes)
        spacing += body.mesh.spacing[n] / nodes.size();

      unsigned int n_all = 1;
      for (int d = 0; d < dim; ++d)
        n_all *= n_parts<dim>;
      for (unsigned int part = 0; part < n_all; ++part)
        {
          std::array<std::array<double, (1u << dim)>, (1u << dim)> values;
          std::array<dealii::Point<dim>, (1u << dim)>              ends;
          for (unsigned int w = 0; w < ends.size(); ++w)
            {
              dealii::Point<dim> unit;
              for (unsigned int d = 0, rest = part; d < dim;
                   ++d, rest /= n_parts<dim>)
                unit[d] =
                  double(rest % n_parts<dim> + (w >> d & 1)) / n_parts<dim>;
              values[w] = Mesh::shape_values<dim>(unit);
              for (unsigned int v = 0; v < nodes.size(); ++v)
                ends[w] += values[w][v] * corners[v];
            }
          const Mesh::CellGeometry<dim> geometry(ends);
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            {
              StressPoint<dim> point = {};
              point.x                = geometry.points[q];
              point.volume           = geometry.jxw[q];
              const auto result =
                fit.fit(point.x, spacing, material, body.displacement);
              point.displacement_gradient = result.gradient;
              try
                {
                  if (result.n_nodes == 0)
                    throw Base::InadmissibleState("no gradient");
                  apply_law(*body.materials[material], point);
                }
              catch (const Base::InadmissibleState &)
                {
                  ++set.n_without_stress;
                  continue;
                }
              for (unsigned int v = 0; v < nodes.size(); ++v)
                {
                  dealii::Tensor<1, dim> gradient;
                  double                 value = 0.;
                  for (unsigned int w = 0; w < ends.size(); ++w)
                    {
                      gradient += values[w][v] * geometry.gradients[q][w];
                      value += values[w][v] * geometry.shape_value(q, w);
                    }
                  set.node.push_back(nodes[v]);
                  set.value_weight.push_back(value);
                  set.gradient_weight.push_back(gradient);
                }
              finish_point(set, point);
            }
        }
    }
  } // namespace

  template <int dim>
  void
  StressPointSet<dim>::set_weight(const std::vector<double> &q)
  {
    for (std::size_t p = 0; p < points.size(); ++p)
      {
        auto &point      = points[p];
        point.q          = 0.;
        point.q_gradient = 0.;
        // q is constant around most points: an exact zero says so
        const double first    = q[node[offsets[p]]];
        bool         constant = true;
        for (std::size_t k = offsets[p]; k < offsets[p + 1]; ++k)
          constant = constant && q[node[k]] == first;
        if (constant)
          point.q = first;
        else
          for (std::size_t k = offsets[p]; k < offsets[p + 1]; ++k)
            {
              point.q += q[node[k]] * value_weight[k];
              point.q_gradient += q[node[k]] * gradient_weight[k];
            }
      }
    for (auto &point : force_points)
      {
        point.q = 0.;
        for (unsigned int v = 0; v < point.nodes.size(); ++v)
          point.q += q[point.nodes[v]] * point.weights[v];
      }
  }

  template <int dim>
  std::vector<bool>
  nodes_within(const Mesh::NodalMesh<dim>            &mesh,
               const std::vector<dealii::Point<dim>> &centers,
               const double                           radius)
  {
    std::vector<bool> within(mesh.n_nodes(), false);
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      for (const auto &center : centers)
        if (mesh.nodes[n].distance_square(center) < radius * radius)
          {
            within[n] = true;
            break;
          }
    return within;
  }

  template <int dim>
  void
  add_element_points(const DeformedBody<dim>   &body,
                     const std::vector<double> &alpha,
                     const std::vector<bool>   &region,
                     StressPointSet<dim>       &set)
  {
    for (unsigned int c = 0; c < body.mesh.n_cells(); ++c)
      if (body.mesh.owns_cell(c) && in_region(body.mesh, c, region))
        add_gauss_points(body, c, alpha, set);
  }

  template <int dim>
  void
  add_family_points(const DeformedBody<dim>            &body,
                    const Bonds::CrackSet<dim>         &cracks,
                    const Peridynamics::FamilySet<dim> &families,
                    const std::vector<bool>            &region,
                    StressPointSet<dim>                &set)
  {
    for (std::size_t p = 0; p < families.n_particles(); ++p)
      {
        const unsigned int own   = families.node[p];
        const auto         first = families.neighbor.begin();
        // A family outside feels q when it reaches inside.
        const bool near =
          region[own] ||
          std::any_of(first + families.offsets[p],
                      first + families.offsets[p + 1],
                      [&](const unsigned int n) { return region[n]; });
        if (!near || families.weight[p] == 0.)
          continue;
        StressPoint<dim> point = {};
        point.x                = place_beside(body.mesh, cracks, own);
        point.volume           = families.weight[p];
        dealii::Tensor<1, dim> sum;
        for (std::size_t b = families.offsets[p]; b < families.offsets[p + 1];
             ++b)
          {
            const unsigned int other  = families.neighbor[b];
            const auto        &weight = families.gradient_weight[b];
            point.displacement_gradient += dealii::outer_product(
              body.displacement[other] - body.displacement[own],
              weight);
            set.node.push_back(other);
            set.value_weight.push_back(0.);
            set.gradient_weight.push_back(weight);
            sum += weight;
          }
        set.node.push_back(own);
        set.value_weight.push_back(1.);
        set.gradient_weight.push_back(-sum);
        apply_law(*body.materials[families.material[p]], point);
        finish_point(set, point);
      }
  }

  template <int dim>
  void
  add_cell_points(const DeformedBody<dim>    &body,
                  const Bonds::CrackSet<dim> &cracks,
                  const DisplacementFit<dim> &fit,
                  const std::vector<bool>    &region,
                  StressPointSet<dim>        &set)
  {
    std::vector<unsigned int> facets;
    for (unsigned int c = 0; c < body.mesh.n_cells(); ++c)
      if (body.mesh.owns_cell(c) && in_region(body.mesh, c, region))
        {
          if (is_touched(body.mesh, c, cracks, facets))
            add_fitted_points(body, c, fit, set);
          else
            add_gauss_points(body, c, {}, set);
        }
  }

  template <int dim>
  std::unique_ptr<DisplacementFit<dim>>
  visible_fit(const Mesh::NodalMesh<dim>   &mesh,
              const Bonds::CrackSet<dim>   &cracks,
              std::vector<MirrorPlane<dim>> planes,
              const bool                    meshed)
  {
    auto fit = std::make_unique<DisplacementFit<dim>>(mesh, std::move(planes));
    if (meshed && !cracks.empty())
      {
        const auto places = view_points(mesh, cracks);
        fit->set_visibility(
          [&cracks, places](const dealii::Point<dim> &point,
                            const unsigned int        node) {
            return !cracks.crosses(point, places[node]);
          },
          places);
      }
    else if (!cracks.empty())
      fit->set_visibility(
        [&](const dealii::Point<dim> &point, const unsigned int node) {
          return !cracks.crosses(point, mesh.nodes[node]);
        });
    return fit;
  }

#define INSTANTIATE(dim)                                                     \
  template struct StressPointSet<dim>;                                       \
  template std::vector<bool> nodes_within<dim>(                              \
    const Mesh::NodalMesh<dim> &,                                            \
    const std::vector<dealii::Point<dim>> &,                                 \
    double);                                                                 \
  template void add_element_points<dim>(const DeformedBody<dim> &,           \
                                        const std::vector<double> &,         \
                                        const std::vector<bool> &,           \
                                        StressPointSet<dim> &);              \
  template void add_family_points<dim>(const DeformedBody<dim> &,            \
                                       const Bonds::CrackSet<dim> &,         \
                                       const Peridynamics::FamilySet<dim> &, \
                                       const std::vector<bool> &,            \
                                       StressPointSet<dim> &);               \
  template void add_cell_points<dim>(const DeformedBody<dim> &,              \
                                     const Bonds::CrackSet<dim> &,           \
                                     const DisplacementFit<dim> &,           \
                                     const std::vector<bool> &,              \
                                     StressPointSet<dim> &);                 \
  template std::unique_ptr<DisplacementFit<dim>> visible_fit<dim>(           \
    const Mesh::NodalMesh<dim> &,                                            \
    const Bonds::CrackSet<dim> &,                                            \
    std::vector<MirrorPlane<dim>>,                                           \
    bool);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
