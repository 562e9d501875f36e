#include <perimorph/base/exceptions.h>
#include <perimorph/coupling/family_rows.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Pure bending in uniaxial stress, linear in x_b: strain -x_b e, with e
    /// that of the stress (UniaxialStress::strain). A beam along axis a bends
    /// with curvature 1 and, where e has shear of the axes, turns or twists.
    template <int dim>
    dealii::Tensor<1, dim>
    bending_field(const int                            b,
                  const dealii::SymmetricTensor<2, 3> &e,
                  const dealii::Tensor<1, dim>        &x)
    {
      dealii::Tensor<1, dim> e_x;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          e_x[i] += e[i][j] * x[j];
      auto u = -x[b] * e_x;
      u[b] += 0.5 * (x * e_x);
      return u;
    }

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
                return bending_field<dim>(b,
                                          constants.along[a].strain,
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
                    (constants.along[a].youngs_modulus * variance[b]);
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
    close(const Bonds::ParticleSeed    &particle,
          const double                  weight,
          const double                  stabilization,
          Peridynamics::FamilySet<dim> &set)
    {
      set.node.push_back(particle.node);
      set.material.push_back(particle.material);
      set.weight.push_back(weight);
      set.stabilization.push_back(stabilization);
      set.offsets.push_back(set.neighbor.size());
    }
  } // namespace

  template <int dim>
  double
  bond_weight(const Mesh::NodalMesh<dim>           &mesh,
              const unsigned int                    node,
              const unsigned int                    neighbor,
              const double                          horizon,
              const Peridynamics::InfluenceFunction influence)
  {
    const double r = mesh.nodes[neighbor].distance(mesh.nodes[node]) / horizon;
    const double in_horizon = r <= 1. + Bonds::horizon_slack
                                ? Peridynamics::influence(influence, r)
                                : 0.;
    return mesh.volume[neighbor] *
           std::max(in_horizon, Peridynamics::smallest_influence);
  }

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
    set.neighbor.push_back(neighbor);
    set.gradient_weight.push_back(gradient_weight);
    set.bond_weight.push_back(
      bond_weight(mesh, node, neighbor, horizon, influence));
  }

  template <int dim>
  dealii::Tensor<2, dim>
  inverse_shape_tensor(const Mesh::NodalMesh<dim>         &mesh,
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
    // The determinant of a regular shape tensor is of the order of its norm to
    // the power dim.
    if (!(determinant(K) > 1e-10 * std::pow(K.norm(), dim)))
      {
        std::ostringstream where;
        where << "particle at (" << mesh.nodes[node] << ")";
        throw Base::InputError(Base::InputMessage{
          where.str(),
          std::to_string(set.neighbor.size() - set.offsets.back()) +
            " neighbours, all in one line or plane",
          "at least " + std::to_string(dim) + " independent bonds",
          "Use a larger horizon ratio or a mesh with more cells across."});
      }
    return invert(K);
  }

  template <int dim>
  void
  use_shape_tensor(const Mesh::NodalMesh<dim>   &mesh,
                   const unsigned int            node,
                   const dealii::Tensor<2, dim> &inverse,
                   Peridynamics::FamilySet<dim> &set)
  {
    for (std::size_t b = set.offsets.back(); b < set.neighbor.size(); ++b)
      set.gradient_weight[b] =
        set.bond_weight[b] *
        (inverse * (mesh.nodes[set.neighbor[b]] - mesh.nodes[node]));
  }

  template <int dim>
  void
  close_row(const Bonds::ParticleSeed    &particle,
            const double                  weight,
            const FamilyParameters       &parameters,
            const dealii::Tensor<2, dim> &inverse_shape_tensor,
            Peridynamics::FamilySet<dim> &set)
  {
    close(particle,
          weight,
          parameters.gamma *
            parameters.constants[particle.material].shear_modulus *
            trace(inverse_shape_tensor) / dim,
          set);
  }

  template <int dim>
  void
  close_row_by_bending(const Mesh::NodalMesh<dim>   &mesh,
                       const Bonds::ParticleSeed    &particle,
                       const double                  weight,
                       const FamilyParameters       &parameters,
                       const dealii::Tensor<1, dim> &variance,
                       Peridynamics::FamilySet<dim> &set)
  {
    weigh_by_bending(mesh,
                     particle.node,
                     variance,
                     parameters.constants[particle.material],
                     set);
    close(particle, weight, parameters.gamma, set);
  }

#define PERIMORPH_INSTANTIATE(dim)                                                   \
  template double                 bond_weight<dim>(const Mesh::NodalMesh<dim> &,     \
                                   unsigned int,                     \
                                   unsigned int,                     \
                                   double,                           \
                                   Peridynamics::InfluenceFunction); \
  template void                   append_bond<dim>(const Mesh::NodalMesh<dim> &,     \
                                 unsigned int,                     \
                                 unsigned int,                     \
                                 const dealii::Tensor<1, dim> &,   \
                                 double,                           \
                                 Peridynamics::InfluenceFunction,  \
                                 Peridynamics::FamilySet<dim> &);  \
  template dealii::Tensor<2, dim> inverse_shape_tensor<dim>(                         \
    const Mesh::NodalMesh<dim> &,                                                    \
    const Peridynamics::FamilySet<dim> &,                                            \
    unsigned int);                                                                   \
  template void use_shape_tensor<dim>(const Mesh::NodalMesh<dim> &,                  \
                                      unsigned int,                                  \
                                      const dealii::Tensor<2, dim> &,                \
                                      Peridynamics::FamilySet<dim> &);               \
  template void close_row<dim>(const Bonds::ParticleSeed &,                          \
                               double,                                               \
                               const FamilyParameters &,                             \
                               const dealii::Tensor<2, dim> &,                       \
                               Peridynamics::FamilySet<dim> &);                      \
  template void close_row_by_bending<dim>(const Mesh::NodalMesh<dim> &,              \
                                          const Bonds::ParticleSeed &,               \
                                          double,                                    \
                                          const FamilyParameters &,                  \
                                          const dealii::Tensor<1, dim> &,            \
                                          Peridynamics::FamilySet<dim> &);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
