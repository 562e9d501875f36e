#include <perimorph/base/exceptions.h>
#include <perimorph/bonds/support_search.h>
#include <perimorph/coupling/cut_families.h>
#include <perimorph/coupling/family_rows.h>
#include <perimorph/mesh/cell_geometry.h>

#include <array>
#include <cmath>
#include <memory>

namespace Perimorph::Coupling
{
  namespace
  {
    /// In spacings: where the weights over the cells at a particle have fallen
    /// off (numerics-explicit.md, section 2, ring form).
    constexpr double adjacent_radius = 1.5;

    /// Averages of the finite-element gradients over supports, with weights of
    /// all particles that sum to alpha at every quadrature point.
    template <int dim>
    class SupportAverages
    {
    public:
      /// @param supports  cells that a particle averages over
      /// @param radius    where the weights of a node have fallen off
      /// @param cuts    who sees what; or null
      /// @param wanted  particles that averages will be asked for
      SupportAverages(const Mesh::NodalMesh<dim>             &mesh,
                      const std::vector<double>              &alpha,
                      std::vector<double>                     radius,
                      const Peridynamics::InfluenceFunction   influence,
                      const std::vector<Bonds::ParticleSeed> &particles,
                      const Base::Csr<unsigned int>          &supports,
                      const CutFamilies<dim>                 *cuts,
                      const std::vector<bool>                &wanted)
        : mesh(mesh)
        , alpha(alpha)
        , radius(std::move(radius))
        , influence(influence)
        , particles(particles)
        , supports(supports)
        , cuts(cuts)
        , slot(mesh.n_cells(), not_needed)
      {
        for (std::size_t p = 0; p < particles.size(); ++p)
          if (wanted[p])
            for (const unsigned int c : supports.row(p))
              if (slot[c] == not_needed)
                {
                  slot[c] = geometries.size();
                  geometries.emplace_back(mesh.corners(c));
                  cells.push_back(c);
                }
        shares.resize(cells.size());
        for (std::size_t p = 0; p < particles.size(); ++p)
          for (const unsigned int c : supports.row(p))
            if (slot[c] != not_needed)
              for (unsigned int q = 0; q < n_points; ++q)
                shares[slot[c]][q] += weight(p, geometries[slot[c]], q);
        for (std::size_t k = 0; k < cells.size(); ++k)
          for (unsigned int q = 0; q < n_points; ++q)
            {
              double alpha_at_point = 0.;
              for (unsigned int v = 0; v < Geometry::n_nodes; ++v)
                alpha_at_point +=
                  alpha[mesh.cells[cells[k]][v]] * Geometry::shape_value(q, v);
              if (shares[k][q] > 0.) // not cut off from all particles
                shares[k][q] =
                  geometries[k].jxw[q] * alpha_at_point / shares[k][q];
            }
      }

      struct Result
      {
        double                 volume;   ///< a_i
        dealii::Tensor<1, dim> variance; ///< of the position
      };

      /// @param[out] scratch  sums of volume times gradient weight of the
      /// nodes,
      ///                      the own one included
      Result
      average(const std::size_t particle, FamilyScratch<dim> &scratch) const
      {
        const unsigned int     node = particles[particle].node;
        Result                 result{0., {}};
        dealii::Tensor<1, dim> first_moment, second_moment;
        for (const unsigned int c : supports.row(particle))
          {
            const Geometry &geometry = geometries[slot[c]];
            std::array<dealii::Tensor<1, dim>, Geometry::n_nodes> sums;
            bool is_seen = false;
            for (unsigned int q = 0; q < n_points; ++q)
              {
                const double own = weight(particle, geometry, q);
                if (own == 0.)
                  continue;
                is_seen            = true;
                const double share = own * shares[slot[c]][q];
                result.volume += share;
                const auto x = geometry.points[q] - mesh.nodes[node];
                for (int d = 0; d < dim; ++d)
                  {
                    first_moment[d] += share * x[d];
                    second_moment[d] += share * x[d] * x[d];
                  }
                for (unsigned int v = 0; v < Geometry::n_nodes; ++v)
                  sums[v] += share * geometry.gradients[q][v];
              }
            if (is_seen)
              for (unsigned int v = 0; v < Geometry::n_nodes; ++v)
                scratch.at(mesh.cells[c][v]) += sums[v];
          }
        for (int d = 0; d < dim; ++d)
          result.variance[d] = second_moment[d] / result.volume -
                               std::pow(first_moment[d] / result.volume, 2);
        return result;
      }

    private:
      using Geometry                           = Mesh::CellGeometry<dim>;
      static constexpr unsigned int n_points   = Geometry::n_points;
      static constexpr unsigned int not_needed = static_cast<unsigned int>(-1);

      double
      weight(const std::size_t  particle,
             const Geometry    &geometry,
             const unsigned int q) const
      {
        if (cuts && (cuts->is_dead(particle) ||
                     !cuts->sees(particle, geometry.points[q])))
          return 0.;
        const unsigned int node = particles[particle].node;
        return alpha[node] * mesh.volume[node] *
               Peridynamics::averaging_weight(
                 influence,
                 geometry.points[q].distance(mesh.nodes[node]) / radius[node]);
      }

      const Mesh::NodalMesh<dim>             &mesh;
      const std::vector<double>              &alpha;
      const std::vector<double>               radius;
      const Peridynamics::InfluenceFunction   influence;
      const std::vector<Bonds::ParticleSeed> &particles;
      const Base::Csr<unsigned int>          &supports;
      const CutFamilies<dim>                 *cuts;

      std::vector<unsigned int> slot;  ///< of each cell
      std::vector<unsigned int> cells; ///< of each slot
      std::vector<Geometry>     geometries;
      /// Volume times alpha of the points, per unit of weight there.
      std::vector<std::array<double, n_points>> shares;
    };

    /// Node and gradient weight, divided by the volume.
    template <int dim>
    std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>>
    scaled(FamilyScratch<dim> &scratch, const double volume)
    {
      std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> list;
      for (const unsigned int n : scratch.sorted_nodes())
        list.emplace_back(n, scratch.at(n) / volume);
      return list;
    }
  } // namespace

  const std::vector<std::string> &
  gradient_support_names()
  {
    static const std::vector<std::string> names = {"adjacent cells", "horizon"};
    return names;
  }

  template <int dim>
  Peridynamics::FamilySet<dim>
  consistent_families(const Mesh::NodalMesh<dim> &mesh,
                      const std::vector<double>  &alpha,
                      const std::vector<double>  &horizon,
                      const FamilyParameters     &parameters,
                      const Bonds::CrackSet<dim> &cracks,
                      CrackReport                *report)
  {
    auto particles = Bonds::relevant_particles(mesh, alpha, horizon);
    if (!cracks.empty())
      add_particles_near_cracks(mesh, alpha, horizon, cracks, particles);
    const auto supports = Bonds::find_supports(mesh, particles, horizon);

    std::unique_ptr<CutFamilies<dim>> cuts;
    if (!cracks.empty())
      cuts = std::make_unique<CutFamilies<dim>>(mesh,
                                                horizon,
                                                parameters,
                                                cracks,
                                                particles,
                                                supports);
    const bool adjacent = parameters.support == GradientSupport::adjacent_cells;
    Base::Csr<unsigned int> adjacent_cells;
    std::vector<double>     radius = horizon;
    if (adjacent)
      {
        std::vector<unsigned int> cells;
        for (const auto &particle : particles)
          {
            Bonds::find_adjacent_cells(mesh, particle, cells);
            adjacent_cells.entries.insert(adjacent_cells.entries.end(),
                                          cells.begin(),
                                          cells.end());
            adjacent_cells.close_row();
          }
        for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
          radius[n] = adjacent_radius * mesh.spacing[n];
      }
    const bool correct = cuts && parameters.crack_rule == CrackRule::consistent;
    std::vector<bool> wanted(particles.size());
    for (std::size_t p = 0; p < particles.size(); ++p)
      wanted[p] =
        mesh.owns_node(particles[p].node) || (correct && cuts->in_system(p));
    const SupportAverages<dim> averages(mesh,
                                        alpha,
                                        std::move(radius),
                                        parameters.influence,
                                        particles,
                                        adjacent ? adjacent_cells : supports,
                                        cuts.get(),
                                        wanted);

    // Families of this rank, and those of others that the correction needs.
    Peridynamics::FamilySet<dim>      own, foreign;
    std::vector<FamilyReference<dim>> system;
    FamilyScratch<dim>                scratch(mesh.n_nodes());
    std::vector<unsigned int>         nodes;
    for (std::size_t p = 0; p < particles.size(); ++p)
      {
        const auto        &particle = particles[p];
        const unsigned int node     = particle.node;
        if (parameters.progress && p % 1000 == 0)
          parameters.progress(p, particles.size());
        if (!wanted[p] || (cuts && cuts->is_dead(p)))
          continue;
        auto      &set    = mesh.owns_node(node) ? own : foreign;
        const auto result = averages.average(p, scratch);
        const auto add    = [&](const unsigned int            neighbor,
                             const dealii::Tensor<1, dim> &gradient_weight) {
          append_bond(mesh,
                      node,
                      neighbor,
                      gradient_weight,
                      horizon[node],
                      parameters.influence,
                      set);
        };
        if (adjacent)
          {
            find_family_nodes(mesh,
                              node,
                              supports.row(p),
                              horizon[node],
                              nodes);
            for (const unsigned int n : nodes)
              scratch.at(n);
          }
        const auto average = scaled(scratch, result.volume);
        scratch.clear();
        const bool is_cut = cuts && cuts->is_cut(p);
        if (is_cut)
          for (const unsigned int n : cuts->neighbors(p))
            add(n, dealii::Tensor<1, dim>());
        else
          for (const auto &entry : average)
            if (entry.first != node)
              add(entry.first, entry.second);
        const auto inverse = inverse_shape_tensor(mesh, set, node);
        if (is_cut)
          use_shape_tensor(mesh, node, inverse, set);
        if (is_cut || parameters.scale == StabilizationScale::shear_modulus)
          close_row(particle, result.volume, parameters, inverse, set);
        else
          close_row_by_bending(mesh,
                               particle,
                               result.volume,
                               parameters,
                               result.variance,
                               set);
        if (!correct || !cuts->in_system(p))
          continue;
        system.push_back(
          {static_cast<unsigned int>(p), &set, set.n_particles() - 1});
        if (is_cut)
          cuts->add_mismatch(system.back(), average);
      }
    if (correct)
      cuts->correct(system);
    if (report && cuts)
      *report = {cuts->n_cut(),
                 cuts->n_dead(),
                 cuts->residual(),
                 cuts->target_nodes()};
    return own;
  }

  template <int dim>
  Peridynamics::FamilySet<dim>
  classical_families(const Mesh::NodalMesh<dim> &mesh,
                     const std::vector<double>  &alpha,
                     const std::vector<double>  &horizon,
                     const FamilyParameters     &parameters,
                     const Bonds::CrackSet<dim> &cracks)
  {
    const auto particles = Bonds::relevant_particles(mesh, alpha, horizon);
    const auto supports  = Bonds::find_supports(mesh, particles, horizon);

    Peridynamics::FamilySet<dim> set;
    std::vector<unsigned int>    cells, nodes;
    for (std::size_t p = 0; p < particles.size(); ++p)
      {
        const auto        &particle = particles[p];
        const unsigned int node     = particle.node;
        if (!mesh.owns_node(node))
          continue;
        double volume = 0.;
        Bonds::find_adjacent_cells(mesh, particle, cells);
        for (const unsigned int c : cells)
          {
            const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
            for (unsigned int v = 0; v < geometry.n_nodes; ++v)
              if (mesh.cells[c][v] == node)
                for (unsigned int q = 0; q < geometry.n_points; ++q)
                  volume += geometry.jxw[q] * geometry.shape_value(q, v);
          }
        // Reached over cells within the horizon: not across a gap.
        find_family_nodes(mesh, node, supports.row(p), horizon[node], nodes);
        for (const unsigned int n : nodes)
          if (n != node && !cracks.crosses(mesh.nodes[node], mesh.nodes[n]))
            append_bond(mesh,
                        node,
                        n,
                        dealii::Tensor<1, dim>(),
                        horizon[node],
                        parameters.influence,
                        set);
        const auto inverse = inverse_shape_tensor(mesh, set, node);
        use_shape_tensor(mesh, node, inverse, set);
        close_row(particle, alpha[node] * volume, parameters, inverse, set);
      }
    return set;
  }

#define PERIMORPH_INSTANTIATE(dim)                                \
  template Peridynamics::FamilySet<dim> consistent_families<dim>( \
    const Mesh::NodalMesh<dim> &,                                 \
    const std::vector<double> &,                                  \
    const std::vector<double> &,                                  \
    const FamilyParameters &,                                     \
    const Bonds::CrackSet<dim> &,                                 \
    CrackReport *);                                               \
  template Peridynamics::FamilySet<dim> classical_families<dim>(  \
    const Mesh::NodalMesh<dim> &,                                 \
    const std::vector<double> &,                                  \
    const std::vector<double> &,                                  \
    const FamilyParameters &,                                     \
    const Bonds::CrackSet<dim> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
