#pragma once

#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <cstddef>
#include <vector>

namespace Perimorph::Peridynamics
{
  /// One family of the non-ordinary state-based correspondence model with
  /// zero-energy stabilisation, seen from its particle.
  ///
  /// Energy per unit weight: W(I + H) + kappa / 2 sum_j w_j |z_j|^2 with
  /// H = sum_j eta_j (x) g_j and z_j = eta_j - H xi_j (numerics.md, section 2).
  ///
  /// Vectors have one array per component, so that bonds are worked on side by
  /// side: component a of bond j is at a * stride + j, and at a * n_bonds + j
  /// of the arguments `eta` and `forces` of the functions below.
  template <int dim>
  struct Family
  {
    unsigned int  n_bonds;
    unsigned int  n_gradient_bonds; ///< g_j = 0 behind them
    std::size_t   stride;
    const double *xi;              ///< X_j - X_i
    const double *gradient_weight; ///< g_j
    const double *bond_weight;     ///< w_j
    double        stabilization;   ///< kappa
  };

  /// Vectors with one array per component: component a of vector j at a * n +
  /// j.
  template <int dim>
  std::vector<double>
  by_components(const dealii::Tensor<1, dim> *vectors, std::size_t n);

  /// H = sum_j eta_j (x) g_j, eta_j = u_j - u_i.
  template <int dim>
  dealii::Tensor<2, dim>
  displacement_gradient(const Family<dim> &family, const double *eta);

  /// kappa / 2 sum_j w_j |eta_j - H xi_j|^2, per unit weight of the particle.
  template <int dim>
  double
  stabilization_energy(const Family<dim>            &family,
                       const double                 *eta,
                       const dealii::Tensor<2, dim> &H);

  /// Forces dE/d eta_j per unit weight:
  /// q_j = (P - kappa S) g_j + kappa w_j z_j, S = sum_l w_l z_l (x) xi_l.
  /// S vanishes only for the uncorrected gradient; it keeps the force the
  /// gradient of the energy for any g.
  template <int dim>
  void
  family_forces(const Family<dim>            &family,
                const double                 *eta,
                const dealii::Tensor<2, dim> &H,
                const dealii::Tensor<2, dim> &first_piola_kirchhoff,
                double                       *forces);

  /// Second derivative of the energy per unit weight with respect to the
  /// displacements of the particle (first) and its neighbours.
  /// @param A  derivative of P with respect to F
  template <int dim>
  void
  family_tangent(const Family<dim>            &family,
                 const dealii::Tensor<4, dim> &A,
                 dealii::FullMatrix<double>   &matrix);
} // namespace Perimorph::Peridynamics
