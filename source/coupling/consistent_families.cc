#include <perimorph/base/exceptions.h>
#include <perimorph/bonds/support_search.h>
#include <perimorph/coupling/consistent_families.h>
#include <perimorph/mesh/cell_geometry.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Nodes of one family while it is built, with their sums; clears in
    /// O(size).
    template <int dim>
    class FamilyScratch
    {
    public:
      explicit FamilyScratch(const unsigned int n_nodes)
        : sums(n_nodes)
        , seen(n_nodes, false)
      {}

      dealii::Tensor<1, dim> &
      at(const unsigned int node)
      {
        if (!seen[node])
          {
            seen[node] = true;
            nodes.push_back(node);
            sums[node] = dealii::Tensor<1, dim>();
          }
        return sums[node];
      }

      const std::vector<unsigned int> &
      sorted_nodes()
      {
        std::sort(nodes.begin(), nodes.end());
        return nodes;
      }

      void
      clear()
      {
        for (const unsigned int n : nodes)
          seen[n] = false;
        nodes.clear();
      }

    private:
      std::vector<dealii::Tensor<1, dim>> sums;
      std::vector<bool>                   seen;
      std::vector<unsigned int>           nodes;
    };

    /// Shape tensor of the row that is being written to the set, and with it
    /// the stabilisation kappa = gamma mu tr(K^-1) / dim.
    template <int dim>
    dealii::Tensor<2, dim>
    shape_tensor_of_last_row(const Mesh::NodalMesh<dim>         &mesh,
                             const Peridynamics::FamilySet<dim> &set,
                             const unsigned int                  node)
    {
      dealii::Tensor<2, dim> K;
      for (std::size_t b = set.offsets.back(); b < set.neighbor.size(); ++b)
        {
          const dealii::Tensor<1, dim> xi =
            mesh.nodes[set.neighbor[b]] - mesh.nodes[node];
          K += set.bond_weight[b] * outer_product(xi, xi);
        }
      return K;
    }

    /// Adds a bond from `node` to the row that is being written.
    template <int dim>
    void
    append_bond(const Mesh::NodalMesh<dim>           &mesh,
                const unsigned int                    node,
                const unsigned int                    neighbor,
                const dealii::Tensor<1, dim>         &gradient_weight,
                const double                          horizon,
                const Peridynamics::InfluenceFunction influence,
                Peridynamics::FamilySet<dim>         &set)
    {
      const double r =
        mesh.nodes[neighbor].distance(mesh.nodes[node]) / horizon;
      const double in_horizon = r <= 1. + Bonds::horizon_slack
                                  ? Peridynamics::influence(influence, r)
                                  : 0.;
      set.neighbor.push_back(neighbor);
      set.gradient_weight.push_back(gradient_weight);
      set.bond_weight.push_back(
        mesh.volume[neighbor] *
        std::max(in_horizon, Peridynamics::smallest_influence));
    }

    /// Pure bending of a beam along axis a in the plane (a, b), curvature 1:
    /// strain -x_b along a, uniaxial stress.
    template <int dim>
    dealii::Tensor<1, dim>
    bending_field(const int                     a,
                  const int                     b,
                  const double                  poissons_ratio,
                  const dealii::Tensor<1, dim> &x)
    {
      dealii::Tensor<1, dim> u;
      u[a] = -x[a] * x[b];
      u[b] = 0.5 * (x[a] * x[a] + poissons_ratio * x[b] * x[b]);
      for (int c = 0; c < dim; ++c)
        if (c != a && c != b)
          {
            u[b] -= 0.5 * poissons_ratio * x[c] * x[c];
            u[c] += poissons_ratio * x[b] * x[c];
          }
      return u;
    }

    /// Weighs the bonds of the row that is being written so that its z-energy
    /// is the variance of the energy of every bending field along the axes,
    /// for kappa = gamma: w_ij sum_d kappa_d (xi_d / |xi|)^2.
    /// @param variance  of the position over the averaging weights
    template <int dim>
    void
    weigh_by_bending(const Mesh::NodalMesh<dim>   &mesh,
                     const unsigned int            node,
                     const dealii::Tensor<1, dim> &variance,
                     const ElasticConstants       &constants,
                     Peridynamics::FamilySet<dim> &set)
    {
      const std::size_t begin   = set.offsets.back();
      const auto        squares = [&](const std::size_t bond) {
        dealii::Tensor<1, dim> c =
          mesh.nodes[set.neighbor[bond]] - mesh.nodes[node];
        const double length_square = c.norm_square();
        for (int d = 0; d < dim; ++d)
          c[d] *= c[d] / length_square;
        return c;
      };
      // One row per bending field: z-energy of each kappa_d = 1, and the energy
      // that is missing; rows are scaled to the latter.
      Eigen::Matrix<double, dim *(dim - 1), dim> shares;
      shares.setZero();
      double smallest = std::numeric_limits<double>::max();
      int    row      = 0;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          if (a != b)
            {
              dealii::Tensor<2, dim> H;
              const auto             eta = [&](const std::size_t bond) {
                return bending_field<dim>(a,
                                          b,
                                          constants.poissons_ratio,
                                          mesh.nodes[set.neighbor[bond]] -
                                            mesh.nodes[node]);
              };
              for (std::size_t j = begin; j < set.neighbor.size(); ++j)
                H += outer_product(eta(j), set.gradient_weight[j]);
              for (std::size_t j = begin; j < set.neighbor.size(); ++j)
                {
                  const dealii::Tensor<1, dim> xi =
                    mesh.nodes[set.neighbor[j]] - mesh.nodes[node];
                  const double energy =
                    set.bond_weight[j] * (eta(j) - H * xi).norm_square() /
                    (constants.youngs_modulus * variance[b]);
                  for (int d = 0; d < dim; ++d)
                    shares(row, d) += energy * squares(j)[d];
                }
              smallest = std::min(smallest, 1. / shares.row(row).sum());
              ++row;
            }
      // Weights below a part of the scalar solution would not control
      // zero-energy modes: they stay there, the others follow.
      const double floor = 0.5 * smallest;
      using Column       = Eigen::Matrix<double, dim *(dim - 1), 1>;
      std::array<bool, dim>         held{};
      Eigen::Matrix<double, dim, 1> kappa;
      for (int pass = 0; pass < dim; ++pass)
        {
          Eigen::Matrix<double, dim *(dim - 1), dim> system = shares;
          Column                                     rest   = Column::Ones();
          for (int d = 0; d < dim; ++d)
            if (held[d])
              {
                rest -= floor * shares.col(d);
                system.col(d).setZero();
              }
          kappa = system.completeOrthogonalDecomposition().solve(rest);
          for (int d = 0; d < dim; ++d)
            if (held[d] || !(kappa[d] >= floor))
              {
                held[d]  = true;
                kappa[d] = floor;
              }
        }
      for (std::size_t j = begin; j < set.neighbor.size(); ++j)
        {
          double factor = 0.;
          for (int d = 0; d < dim; ++d)
            factor += kappa[d] * squares(j)[d];
          set.bond_weight[j] *= factor;
        }
    }

    template <int dim>
    void
    close_family(const Mesh::NodalMesh<dim>   &mesh,
                 const Bonds::ParticleSeed    &particle,
                 const double                  weight,
                 const FamilyParameters       &parameters,
                 Peridynamics::FamilySet<dim> &set,
                 const dealii::Tensor<1, dim> *variance)
    {
      const auto K = shape_tensor_of_last_row(mesh, set, particle.node);
      // The determinant of a regular shape tensor is of the order of its norm
      // to the power dim.
      if (!(determinant(K) > 1e-10 * std::pow(K.norm(), dim)))
        {
          std::ostringstream where;
          where << "particle at (" << mesh.nodes[particle.node] << ")";
          throw Base::InputError(Base::InputMessage{
            where.str(),
            std::to_string(set.neighbor.size() - set.offsets.back()) +
              " neighbours, all in one line or plane",
            "at least " + std::to_string(dim) + " independent bonds",
            "Use a larger horizon ratio or a mesh with more cells across."});
        }
      const auto inverse = invert(K);
      if (!variance)
        for (std::size_t b = set.offsets.back(); b < set.neighbor.size(); ++b)
          set.gradient_weight[b] =
            set.bond_weight[b] * (inverse * (mesh.nodes[set.neighbor[b]] -
                                             mesh.nodes[particle.node]));
      set.node.push_back(particle.node);
      set.material.push_back(particle.material);
      set.weight.push_back(weight);
      const auto &constants = parameters.constants[particle.material];
      const bool  bending =
        variance && parameters.scale == StabilizationScale::bending;
      if (bending)
        weigh_by_bending(mesh, particle.node, *variance, constants, set);
      set.stabilization.push_back(
        parameters.gamma *
        (bending ? 1. : constants.shear_modulus * trace(inverse) / dim));
      set.offsets.push_back(set.neighbor.size());
    }
  } // namespace

  template <int dim>
  Peridynamics::FamilySet<dim>
  consistent_families(const Mesh::NodalMesh<dim> &mesh,
                      const std::vector<double>  &alpha,
                      const std::vector<double>  &horizon,
                      const FamilyParameters     &parameters)
  {
    using Geometry                    = Mesh::CellGeometry<dim>;
    constexpr unsigned int n_points   = Geometry::n_points;
    constexpr unsigned int not_needed = dealii::numbers::invalid_unsigned_int;

    const auto particles = Bonds::relevant_particles(mesh, alpha, horizon);
    const auto supports  = Bonds::find_supports(mesh, particles, horizon);

    // Quadrature data of the cells that owned particles average over.
    std::vector<unsigned int>                 slot(mesh.n_cells(), not_needed);
    std::vector<Geometry>                     geometries;
    std::vector<std::array<double, n_points>> weight_sums;
    for (std::size_t p = 0; p < particles.size(); ++p)
      if (mesh.owns_node(particles[p].node))
        for (const unsigned int c : supports.row(p))
          if (slot[c] == not_needed)
            {
              slot[c] = geometries.size();
              geometries.emplace_back(mesh.corners(c));
              weight_sums.push_back({});
            }

    const auto averaging = [&](const unsigned int node,
                               const Geometry    &geometry,
                               const unsigned int q) {
      return alpha[node] * mesh.volume[node] *
             Peridynamics::averaging_weight(
               parameters.influence,
               geometry.points[q].distance(mesh.nodes[node]) / horizon[node]);
    };
    for (std::size_t p = 0; p < particles.size(); ++p)
      for (const unsigned int c : supports.row(p))
        if (slot[c] != not_needed)
          for (unsigned int q = 0; q < n_points; ++q)
            weight_sums[slot[c]][q] +=
              averaging(particles[p].node, geometries[slot[c]], q);

    Peridynamics::FamilySet<dim> set;
    FamilyScratch<dim>           scratch(mesh.n_nodes());
    for (std::size_t p = 0; p < particles.size(); ++p)
      {
        const unsigned int node = particles[p].node;
        if (parameters.progress && p % 1000 == 0)
          parameters.progress(p, particles.size());
        if (!mesh.owns_node(node))
          continue;
        double                 weight = 0.;
        dealii::Tensor<1, dim> first_moment, second_moment;
        for (const unsigned int c : supports.row(p))
          {
            const Geometry &geometry = geometries[slot[c]];
            for (unsigned int q = 0; q < n_points; ++q)
              {
                double alpha_at_point = 0.;
                for (unsigned int v = 0; v < Geometry::n_nodes; ++v)
                  alpha_at_point +=
                    alpha[mesh.cells[c][v]] * Geometry::shape_value(q, v);
                const double share = geometry.jxw[q] * alpha_at_point *
                                     averaging(node, geometry, q) /
                                     weight_sums[slot[c]][q];
                weight += share;
                const auto x = geometry.points[q] - mesh.nodes[node];
                for (int d = 0; d < dim; ++d)
                  {
                    first_moment[d] += share * x[d];
                    second_moment[d] += share * x[d] * x[d];
                  }
                for (unsigned int v = 0; v < Geometry::n_nodes; ++v)
                  scratch.at(mesh.cells[c][v]) +=
                    share * geometry.gradients[q][v];
              }
          }
        for (const unsigned int n : scratch.sorted_nodes())
          if (n != node)
            append_bond(mesh,
                        node,
                        n,
                        scratch.at(n) / weight,
                        horizon[node],
                        parameters.influence,
                        set);
        scratch.clear();
        dealii::Tensor<1, dim> variance;
        for (int d = 0; d < dim; ++d)
          variance[d] =
            second_moment[d] / weight - std::pow(first_moment[d] / weight, 2);
        close_family(mesh, particles[p], weight, parameters, set, &variance);
      }
    return set;
  }

  template <int dim>
  Peridynamics::FamilySet<dim>
  classical_families(const Mesh::NodalMesh<dim> &mesh,
                     const std::vector<double>  &alpha,
                     const std::vector<double>  &horizon,
                     const FamilyParameters     &parameters)
  {
    const auto particles = Bonds::relevant_particles(mesh, alpha, horizon);
    const auto supports  = Bonds::find_supports(mesh, particles, horizon);

    Peridynamics::FamilySet<dim> set;
    FamilyScratch<dim>           scratch(mesh.n_nodes());
    for (std::size_t p = 0; p < particles.size(); ++p)
      {
        const auto        &particle = particles[p];
        const unsigned int node     = particle.node;
        if (!mesh.owns_node(node))
          continue;
        double volume = 0.;
        for (const unsigned int c : mesh.node_cells.row(node))
          if (mesh.cell_material[c] == particle.material)
            {
              const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
              for (unsigned int v = 0; v < geometry.n_nodes; ++v)
                {
                  scratch.at(mesh.cells[c][v]);
                  if (mesh.cells[c][v] == node)
                    for (unsigned int q = 0; q < geometry.n_points; ++q)
                      volume += geometry.jxw[q] * geometry.shape_value(q, v);
                }
            }
        // Nodes within the horizon, reached over cells within it: not across a
        // gap.
        const double reach = horizon[node] * (1. + Bonds::horizon_slack);
        for (const unsigned int c : supports.row(p))
          for (const unsigned int n : mesh.cells[c])
            if (mesh.nodes[n].distance(mesh.nodes[node]) <= reach)
              scratch.at(n);
        for (const unsigned int n : scratch.sorted_nodes())
          if (n != node)
            append_bond(mesh,
                        node,
                        n,
                        dealii::Tensor<1, dim>(),
                        horizon[node],
                        parameters.influence,
                        set);
        scratch.clear();
        close_family(mesh,
                     particle,
                     alpha[node] * volume,
                     parameters,
                     set,
                     static_cast<const dealii::Tensor<1, dim> *>(nullptr));
      }
    return set;
  }

  template Peridynamics::FamilySet<2>
  consistent_families<2>(const Mesh::NodalMesh<2> &,
                         const std::vector<double> &,
                         const std::vector<double> &,
                         const FamilyParameters &);
  template Peridynamics::FamilySet<3>
  consistent_families<3>(const Mesh::NodalMesh<3> &,
                         const std::vector<double> &,
                         const std::vector<double> &,
                         const FamilyParameters &);
  template Peridynamics::FamilySet<2>
  classical_families<2>(const Mesh::NodalMesh<2> &,
                        const std::vector<double> &,
                        const std::vector<double> &,
                        const FamilyParameters &);
  template Peridynamics::FamilySet<3>
  classical_families<3>(const Mesh::NodalMesh<3> &,
                        const std::vector<double> &,
                        const std::vector<double> &,
                        const FamilyParameters &);
} // namespace Perimorph::Coupling
