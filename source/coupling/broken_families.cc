#include <perimorph/coupling/broken_families.h>
#include <perimorph/coupling/family_rows.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <numeric>

namespace Perimorph::Coupling
{
  namespace
  {
    constexpr double largest_condition = 1e8;

    template <int dim>
    bool
    is_regular(const dealii::Tensor<2, dim> &K)
    {
      Eigen::Matrix<double, dim, dim> matrix;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          matrix(a, b) = K[a][b];
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, dim, dim>>
                 eigen(matrix, Eigen::EigenvaluesOnly);
      const auto values = eigen.eigenvalues();
      return values[dim - 1] > 0. &&
             values[0] * largest_condition > values[dim - 1];
    }

    unsigned int
    root(std::vector<unsigned int> &parent, unsigned int k)
    {
      while (parent[k] != k)
        k = parent[k] = parent[parent[k]];
      return k;
    }

    /// Adds particles that keep all their bonds.
    template <int dim>
    void
    copy_rows(const Peridynamics::FamilySet<dim> &families,
              const std::size_t                   begin,
              const std::size_t                   end,
              Peridynamics::FamilySet<dim>       &set)
    {
      const auto copy = [](const auto       &from,
                           const std::size_t first,
                           const std::size_t last,
                           auto             &to) {
        to.insert(to.end(), from.begin() + first, from.begin() + last);
      };
      copy(families.node, begin, end, set.node);
      copy(families.material, begin, end, set.material);
      copy(families.weight, begin, end, set.weight);
      copy(families.stabilization, begin, end, set.stabilization);
      const std::size_t first = families.offsets[begin];
      const std::size_t last  = families.offsets[end];
      for (std::size_t p = begin; p < end; ++p)
        set.offsets.push_back(set.neighbor.size() + families.offsets[p + 1] -
                              first);
      copy(families.neighbor, first, last, set.neighbor);
      copy(families.gradient_weight, first, last, set.gradient_weight);
      copy(families.bond_weight, first, last, set.bond_weight);
    }

    /// The smaller root stays one.
    void
    join(std::vector<unsigned int> &parent, unsigned int a, unsigned int b)
    {
      a                      = root(parent, a);
      b                      = root(parent, b);
      parent[std::max(a, b)] = std::min(a, b);
    }
  } // namespace

  template <int dim>
  bool
  break_family(const Mesh::NodalMesh<dim>         &mesh,
               const std::vector<double>          &horizon,
               const FamilyParameters             &parameters,
               const Bonds::BrokenBonds           &broken,
               const Peridynamics::FamilySet<dim> &families,
               const std::size_t                   p,
               Peridynamics::FamilySet<dim>       &set)
  {
    const unsigned int node   = families.node[p];
    const auto         begin  = set.neighbor.size();
    bool               softer = false;
    for (std::size_t b = families.offsets[p]; b < families.offsets[p + 1]; ++b)
      if (!broken.contains(node, families.neighbor[b]))
        {
          const double share = broken.share_left(node, families.neighbor[b]);
          softer             = softer || share < 1.;
          set.neighbor.push_back(families.neighbor[b]);
          set.gradient_weight.push_back(share * families.gradient_weight[b]);
          set.bond_weight.push_back(families.bond_weight[b]);
        }
    const bool is_whole =
      !softer && set.neighbor.size() - begin ==
                   families.offsets[p + 1] - families.offsets[p];
    const Bonds::ParticleSeed particle{node, families.material[p]};
    if (is_whole)
      {
        set.node.push_back(node);
        set.material.push_back(particle.material);
        set.weight.push_back(families.weight[p]);
        set.stabilization.push_back(families.stabilization[p]);
        set.offsets.push_back(set.neighbor.size());
        return true;
      }
    // The weights of the bending scale are those of another family.
    dealii::Tensor<2, dim> K, rest;
    for (int d = 0; d < dim; ++d)
      rest[d][d] = 1.;
    for (std::size_t b = begin; b < set.neighbor.size(); ++b)
      {
        set.bond_weight[b] = broken.share_left(node, set.neighbor[b]) *
                             bond_weight(mesh,
                                         node,
                                         set.neighbor[b],
                                         horizon[node],
                                         parameters.influence);
        const dealii::Tensor<1, dim> xi =
          mesh.nodes[set.neighbor[b]] - mesh.nodes[node];
        K += set.bond_weight[b] * outer_product(xi, xi);
        rest -= outer_product(set.gradient_weight[b], xi);
      }
    if (!is_regular(K))
      {
        set.neighbor.resize(begin);
        set.gradient_weight.resize(begin);
        set.bond_weight.resize(begin);
        return false;
      }
    const auto inverse = invert(K);
    for (std::size_t b = begin; b < set.neighbor.size(); ++b)
      set.gradient_weight[b] +=
        set.bond_weight[b] *
        (rest * (inverse * (mesh.nodes[set.neighbor[b]] - mesh.nodes[node])));
    close_row(particle, families.weight[p], parameters, inverse, set);
    return true;
  }

  template <int dim>
  Peridynamics::FamilySet<dim>
  break_bonds(const Mesh::NodalMesh<dim>         &mesh,
              const std::vector<double>          &horizon,
              const FamilyParameters             &parameters,
              const Bonds::BrokenBonds           &broken,
              const Peridynamics::FamilySet<dim> &families,
              std::size_t                        &n_isolated)
  {
    n_isolated = 0;
    Peridynamics::FamilySet<dim> set;
    set.node.reserve(families.n_particles());
    set.offsets.reserve(families.n_particles() + 1);
    set.neighbor.reserve(families.n_bonds());
    set.gradient_weight.reserve(families.n_bonds());
    set.bond_weight.reserve(families.n_bonds());
    std::size_t first_whole = 0; // of the particles that are not copied yet
    for (std::size_t p = 0; p < families.n_particles(); ++p)
      {
        const unsigned int node = families.node[p];
        if (broken.count(node) == 0)
          continue;
        copy_rows(families, first_whole, p, set);
        first_whole = p + 1;
        if (!break_family(mesh, horizon, parameters, broken, families, p, set))
          ++n_isolated;
      }
    copy_rows(families, first_whole, families.n_particles(), set);
    return set;
  }

  template <int dim>
  std::vector<unsigned int>
  find_parts(const Mesh::NodalMesh<dim>         &mesh,
             const std::vector<double>          &alpha,
             const Peridynamics::FamilySet<dim> &families,
             const MPI_Comm                      communicator)
  {
    std::vector<std::array<unsigned int, 2>> bonds;
    bonds.reserve(families.n_bonds());
    for (std::size_t p = 0; p < families.n_particles(); ++p)
      for (std::size_t b = families.offsets[p]; b < families.offsets[p + 1];
           ++b)
        bonds.push_back({{families.node[p], families.neighbor[b]}});
    return find_parts(mesh, alpha, bonds, communicator);
  }

  template <int dim>
  std::vector<unsigned int>
  find_parts(const Mesh::NodalMesh<dim>                     &mesh,
             const std::vector<double>                      &alpha,
             const std::vector<std::array<unsigned int, 2>> &bonds,
             const MPI_Comm                                  communicator)
  {
    std::vector<unsigned int> parent(mesh.n_nodes());
    std::iota(parent.begin(), parent.end(), 0u);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        bool has_element = false;
        for (const unsigned int n : mesh.cells[c])
          has_element = has_element || alpha[n] < 1.;
        if (has_element)
          for (const unsigned int n : mesh.cells[c])
            join(parent, mesh.cells[c][0], n);
      }
    for (const auto &[first, second] : bonds)
      join(parent, first, second);
    // Every rank knows its own families: the smallest label wins until nothing
    // changes.
    for (bool changes = true; changes;)
      {
        std::vector<unsigned int> label(parent.size());
        for (unsigned int n = 0; n < label.size(); ++n)
          label[n] = root(parent, n);
        auto common = label;
        dealii::Utilities::MPI::min(label, communicator, common);
        for (unsigned int n = 0; n < label.size(); ++n)
          join(parent, common[n], n);
        changes = dealii::Utilities::MPI::max(common != label ? 1u : 0u,
                                              communicator) > 0;
      }
    std::vector<unsigned int> number(parent.size()), part(parent.size());
    unsigned int              n_parts = 0;
    for (unsigned int n = 0; n < part.size(); ++n)
      {
        if (parent[n] == n)
          number[n] = n_parts++;
        part[n] = number[root(parent, n)];
      }
    return part;
  }

#define PERIMORPH_INSTANTIATE(dim)                                      \
  template Peridynamics::FamilySet<dim> break_bonds<dim>(               \
    const Mesh::NodalMesh<dim> &,                                       \
    const std::vector<double> &,                                        \
    const FamilyParameters &,                                           \
    const Bonds::BrokenBonds &,                                         \
    const Peridynamics::FamilySet<dim> &,                               \
    std::size_t &);                                                     \
  template bool break_family<dim>(const Mesh::NodalMesh<dim> &,         \
                                  const std::vector<double> &,          \
                                  const FamilyParameters &,             \
                                  const Bonds::BrokenBonds &,           \
                                  const Peridynamics::FamilySet<dim> &, \
                                  std::size_t,                          \
                                  Peridynamics::FamilySet<dim> &);      \
  template std::vector<unsigned int> find_parts<dim>(                   \
    const Mesh::NodalMesh<dim> &,                                       \
    const std::vector<double> &,                                        \
    const Peridynamics::FamilySet<dim> &,                               \
    MPI_Comm);                                                          \
  template std::vector<unsigned int> find_parts<dim>(                   \
    const Mesh::NodalMesh<dim> &,                                       \
    const std::vector<double> &,                                        \
    const std::vector<std::array<unsigned int, 2>> &,                   \
    MPI_Comm);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
