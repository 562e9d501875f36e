#include <perimorph/bonds/crack_points.h>
#include <perimorph/coupling/cut_families.h>
#include <perimorph/coupling/family_rows.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Families within this many horizons of a crack share the correction.
    constexpr double system_reach = 2.;

    /// How far a family looks: its horizon or the cells at its node.
    template <int dim>
    double
    reach(const Mesh::NodalMesh<dim> &mesh,
          const std::vector<double>  &horizon,
          const unsigned int          node)
    {
      return horizon[node] + 2. * mesh.spacing[node];
    }

    unsigned int
    root(std::vector<unsigned int> &parent, unsigned int k)
    {
      while (parent[k] != k)
        k = parent[k] = parent[parent[k]];
      return k;
    }

    /// Numbers the nodes of families from 0.
    template <int dim>
    class Numbering
    {
    public:
      explicit Numbering(const std::vector<FamilyReference<dim>> &families)
      {
        for (const auto &family : families)
          {
            const auto &set = *family.set;
            add(set.node[family.row]);
            for (std::size_t b = set.offsets[family.row];
                 b < set.offsets[family.row + 1];
                 ++b)
              add(set.neighbor[b]);
          }
      }

      unsigned int
      of(const unsigned int node) const
      {
        return numbers.at(node);
      }

      bool
      has(const unsigned int node) const
      {
        return numbers.count(node) > 0;
      }

      const std::vector<unsigned int> &
      nodes() const
      {
        return list;
      }

    private:
      void
      add(const unsigned int node)
      {
        if (numbers.emplace(node, list.size()).second)
          list.push_back(node);
      }

      std::unordered_map<unsigned int, unsigned int> numbers;
      std::vector<unsigned int>                      list;
    };
  } // namespace

  template <int dim>
  void
  add_particles_near_cracks(const Mesh::NodalMesh<dim>       &mesh,
                            const std::vector<double>        &alpha,
                            const std::vector<double>        &horizon,
                            const Bonds::CrackSet<dim>       &cracks,
                            std::vector<Bonds::ParticleSeed> &particles)
  {
    double largest_horizon = 0., largest_reach = 0.;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (alpha[n] > 0.)
        {
          largest_horizon = std::max(largest_horizon, horizon[n]);
          largest_reach   = std::max(largest_reach, reach(mesh, horizon, n));
        }
    const double radius = system_reach * largest_horizon + 2. * largest_reach;
    std::vector<double> weight(mesh.n_nodes(), 0.);
    for (const auto &particle : particles)
      weight[particle.node] = alpha[particle.node];
    std::vector<unsigned int> materials;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (alpha[n] > 0. && weight[n] == 0. &&
          cracks.is_within(mesh.nodes[n], radius))
        {
          materials.clear();
          for (const unsigned int c : mesh.node_cells.row(n))
            materials.push_back(mesh.cell_material[c]);
          std::sort(materials.begin(), materials.end());
          materials.erase(std::unique(materials.begin(), materials.end()),
                          materials.end());
          for (const unsigned int m : materials)
            particles.push_back({n, m});
        }
    std::sort(particles.begin(),
              particles.end(),
              [](const auto &a, const auto &b) {
                return std::make_pair(a.node, a.material) <
                       std::make_pair(b.node, b.material);
              });
  }

  template <int dim>
  CutFamilies<dim>::CutFamilies(
    const Mesh::NodalMesh<dim>             &mesh,
    const std::vector<double>              &horizon,
    const FamilyParameters                 &parameters,
    const Bonds::CrackSet<dim>             &cracks,
    const std::vector<Bonds::ParticleSeed> &particles,
    const Base::Csr<unsigned int>          &supports)
    : mesh(mesh)
    , horizon(horizon)
    , parameters(parameters)
    , cracks(cracks)
    , particles(particles)
    , supports(supports)
    , slot(particles.size(), none)
    , near(particles.size(), false)
  {
    std::vector<bool> touched(mesh.n_cells(), false);
    for (const auto &point : Bonds::crack_points(mesh, cracks))
      touched[point.cell] = true;

    std::vector<unsigned int> facets;
    for (unsigned int p = 0; p < particles.size(); ++p)
      {
        const unsigned int              node = particles[p].node;
        std::vector<dealii::Point<dim>> corners;
        for (const unsigned int c : supports.row(p))
          for (const unsigned int n : mesh.cells[c])
            corners.push_back(mesh.nodes[n]);
        cracks.near(dealii::BoundingBox<dim>(corners), facets);
        bool is_cut = false;
        if (!facets.empty())
          {
            for (const unsigned int c : supports.row(p))
              is_cut = is_cut || touched[c];
            for (std::size_t k = 0; k < corners.size() && !is_cut; ++k)
              is_cut = cracks.crosses(mesh.nodes[node], corners[k]);
          }
        if (is_cut)
          {
            slot[p] = cut.size();
            cut.emplace_back();
            find_bonds(p, cut.back());
          }
        near[p] = is_cut || cracks.is_within(mesh.nodes[node],
                                             system_reach * horizon[node]);
      }
    const Bonds::CrackTraces<dim> traces(mesh, cracks);
    target = crack_target(mesh, cracks, traces);
    defect = target;
  }

  template <int dim>
  std::pair<double, double>
  CutFamilies<dim>::shape_eigenvalues(
    const unsigned int               node,
    const std::vector<unsigned int> &neighbors) const
  {
    Eigen::Matrix<double, dim, dim> K = Eigen::Matrix<double, dim, dim>::Zero();
    for (const unsigned int n : neighbors)
      {
        const auto   xi = mesh.nodes[n] - mesh.nodes[node];
        const double w =
          bond_weight(mesh, node, n, horizon[node], parameters.influence);
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            K(a, b) += w * xi[a] * xi[b];
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, dim, dim>> eigen(
      K,
      Eigen::EigenvaluesOnly);
    return {eigen.eigenvalues()[0], eigen.eigenvalues()[dim - 1]};
  }

  template <int dim>
  void
  CutFamilies<dim>::find_bonds(const unsigned int particle,
                               CutFamily         &family) const
  {
    const unsigned int        node = particles[particle].node;
    std::vector<unsigned int> all;
    const double reach = parameters.support == GradientSupport::adjacent_cells
                           ? horizon[node]
                           : std::numeric_limits<double>::infinity();
    find_family_nodes(mesh, node, supports.row(particle), reach, all);
    all.erase(std::find(all.begin(), all.end(), node));
    const auto take_visible = [&](const std::vector<unsigned int> &candidates) {
      family.neighbors.clear();
      for (const unsigned int n : candidates)
        if (!cracks.crosses(mesh.nodes[node], mesh.nodes[n]))
          family.neighbors.push_back(n);
    };
    take_visible(all);
    family.broken_bonds = family.neighbors.size() < all.size();

    // C1: a thin family looks further on its own side.
    const auto is_thin = [&]() {
      const auto [low, high] = shape_eigenvalues(node, family.neighbors);
      return family.neighbors.size() < dim + 1 || low < high / 50.;
    };
    for (const double factor : {1.5, 2., 2.5})
      {
        if (!is_thin())
          return;
        std::vector<unsigned int> front = all;
        const double radius             = factor * horizon[node] * (1. + 1e-10);
        for (std::size_t k = 0; k < front.size(); ++k)
          for (const unsigned int c : mesh.node_cells.row(front[k]))
            if (mesh.cell_material[c] == particles[particle].material)
              for (const unsigned int n : mesh.cells[c])
                if (n != node &&
                    mesh.nodes[n].distance(mesh.nodes[node]) <= radius &&
                    std::find(front.begin(), front.end(), n) == front.end())
                  front.push_back(n);
        std::sort(front.begin(), front.end());
        take_visible(front);
      }
    const auto [low, high] = shape_eigenvalues(node, family.neighbors);
    family.dead = family.neighbors.size() < dim || !(low > 1e-3 * high);
  }

  template <int dim>
  std::size_t
  CutFamilies<dim>::n_dead() const
  {
    return std::count_if(cut.begin(), cut.end(), [](const auto &family) {
      return family.dead;
    });
  }

  template <int dim>
  void
  CutFamilies<dim>::add_mismatch(
    const FamilyReference<dim>                                         &family,
    const std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> &average)
  {
    const auto  &set  = *family.set;
    const double a    = set.weight[family.row];
    const auto   node = set.node[family.row];
    for (const auto &entry : average)
      defect[entry.first] += a * entry.second;
    for (std::size_t b = set.offsets[family.row];
         b < set.offsets[family.row + 1];
         ++b)
      {
        defect[set.neighbor[b]] -= a * set.gradient_weight[b];
        defect[node] += a * set.gradient_weight[b];
      }
  }

  template <int dim>
  void
  CutFamilies<dim>::fit_volumes(
    const std::vector<FamilyReference<dim>> &families)
  {
    const Numbering<dim>      numbering(families);
    std::vector<unsigned int> parent(numbering.nodes().size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (const auto &family : families)
      {
        const auto        &set  = *family.set;
        const unsigned int node = numbering.of(set.node[family.row]);
        for (std::size_t b = set.offsets[family.row];
             b < set.offsets[family.row + 1];
             ++b)
          parent[root(parent, numbering.of(set.neighbor[b]))] =
            root(parent, node);
      }
    // Missing volume of each piece, and the volume that may be scaled.
    // Positions from a node of the piece: far origins cost digits.
    std::map<unsigned int, double> missing, scalable;
    for (const auto &entry : defect)
      if (numbering.has(entry.first))
        {
          const unsigned int piece = root(parent, numbering.of(entry.first));
          missing[piece] +=
            entry.second *
            (mesh.nodes[entry.first] - mesh.nodes[numbering.nodes()[piece]]) /
            dim;
        }
    const auto may_scale = [&](const FamilyReference<dim> &family) {
      return is_cut(family.particle) && cut[slot[family.particle]].broken_bonds;
    };
    for (const auto &family : families)
      if (may_scale(family))
        scalable[root(parent, numbering.of(family.set->node[family.row]))] +=
          family.set->weight[family.row];
    for (const auto &family : families)
      {
        auto              &set = *family.set;
        const unsigned int piece =
          root(parent, numbering.of(set.node[family.row]));
        if (!may_scale(family) || scalable[piece] <= 0.)
          continue;
        const double change = missing[piece] / scalable[piece];
        if (std::abs(change) < 1e-13)
          continue;
        const double a = set.weight[family.row];
        for (std::size_t b = set.offsets[family.row];
             b < set.offsets[family.row + 1];
             ++b)
          {
            const auto more = change * a * set.gradient_weight[b];
            defect[set.neighbor[b]] -= more;
            defect[set.node[family.row]] += more;
          }
        set.weight[family.row] *= 1. + change;
      }
  }

  template <int dim>
  void
  CutFamilies<dim>::correct(const std::vector<FamilyReference<dim>> &families)
  {
    fit_volumes(families);
    const Numbering<dim> numbering(families);
    const unsigned int   n_unknowns = numbering.nodes().size();

    // Rows of z_ij = lambda_j - lambda_i - L_i xi_ij; the last column is
    // lambda_i.
    const auto shape = [&](const FamilyReference<dim> &family,
                           Eigen::VectorXd            &weight) {
      const auto            &set   = *family.set;
      const unsigned int     node  = set.node[family.row];
      const std::size_t      begin = set.offsets[family.row];
      const unsigned int     n     = set.offsets[family.row + 1] - begin;
      dealii::Tensor<2, dim> K;
      weight.resize(n);
      for (unsigned int k = 0; k < n; ++k)
        {
          const unsigned int j = set.neighbor[begin + k];
          weight[k] =
            bond_weight(mesh, node, j, horizon[node], parameters.influence);
          const dealii::Tensor<1, dim> xi = mesh.nodes[j] - mesh.nodes[node];
          K += weight[k] * outer_product(xi, xi);
        }
      const auto      inverse = invert(K);
      Eigen::MatrixXd Z       = Eigen::MatrixXd::Zero(n, n + 1);
      for (unsigned int k = 0; k < n; ++k)
        {
          const dealii::Tensor<1, dim> xi =
            mesh.nodes[set.neighbor[begin + k]] - mesh.nodes[node];
          Z(k, k) += 1.;
          Z(k, n) -= 1.;
          for (unsigned int l = 0; l < n; ++l)
            {
              const double part =
                weight[l] * ((inverse * (mesh.nodes[set.neighbor[begin + l]] -
                                         mesh.nodes[node])) *
                             xi);
              Z(k, l) -= part;
              Z(k, n) += part;
            }
        }
      return Z;
    };
    const auto unknowns = [&](const FamilyReference<dim> &family) {
      const auto               &set = *family.set;
      std::vector<unsigned int> list;
      for (std::size_t b = set.offsets[family.row];
           b < set.offsets[family.row + 1];
           ++b)
        list.push_back(numbering.of(set.neighbor[b]));
      list.push_back(numbering.of(set.node[family.row]));
      return list;
    };

    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd                     weight;
    for (const auto &family : families)
      {
        const Eigen::MatrixXd Z = shape(family, weight);
        const Eigen::MatrixXd M = family.set->weight[family.row] *
                                  Z.transpose() * weight.asDiagonal() * Z;
        const auto list = unknowns(family);
        for (unsigned int r = 0; r < list.size(); ++r)
          for (unsigned int c = 0; c < list.size(); ++c)
            entries.emplace_back(list[r], list[c], M(r, c));
      }
    Eigen::SparseMatrix<double> matrix(n_unknowns, n_unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n_unknowns, dim);
    for (const auto &entry : defect)
      if (numbering.has(entry.first))
        for (int d = 0; d < dim; ++d)
          right(numbering.of(entry.first), d) = entry.second[d];

    // Affine fields of each piece are in the kernel and orthogonal to the right
    // hand side; a tiny diagonal keeps the factorisation regular, iteration
    // takes its effect away.
    Eigen::SparseMatrix<double> regular = matrix;
    const double                scale   = matrix.diagonal().maxCoeff();
    for (unsigned int k = 0; k < n_unknowns; ++k)
      regular.coeffRef(k, k) += 1e-11 * scale;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(regular);
    Eigen::MatrixXd lambda = Eigen::MatrixXd::Zero(n_unknowns, dim);
    for (unsigned int iteration = 0; iteration < 4; ++iteration)
      lambda += factor.solve(right - matrix * lambda);
    const Eigen::MatrixXd rest = right - matrix * lambda;
    largest_residual           = 0.;
    for (unsigned int k = 0; k < n_unknowns; ++k)
      largest_residual =
        std::max(largest_residual,
                 rest.row(k).norm() /
                   std::pow(mesh.spacing[numbering.nodes()[k]], dim - 1));

    for (const auto &family : families)
      {
        const Eigen::MatrixXd Z    = shape(family, weight);
        const auto            list = unknowns(family);
        Eigen::MatrixXd       mine(list.size(), dim);
        for (unsigned int k = 0; k < list.size(); ++k)
          mine.row(k) = lambda.row(list[k]);
        const Eigen::MatrixXd z     = Z * mine;
        const std::size_t     begin = family.set->offsets[family.row];
        for (unsigned int k = 0; k + 1 < list.size(); ++k)
          for (int d = 0; d < dim; ++d)
            family.set->gradient_weight[begin + k][d] += weight[k] * z(k, d);
      }
  }

#define PERIMORPH_INSTANTIATE(dim)              \
  template void add_particles_near_cracks<dim>( \
    const Mesh::NodalMesh<dim> &,               \
    const std::vector<double> &,                \
    const std::vector<double> &,                \
    const Bonds::CrackSet<dim> &,               \
    std::vector<Bonds::ParticleSeed> &);        \
  template class CutFamilies<dim>;

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
