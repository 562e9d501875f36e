#pragma once

#include <perimorph/materials/linear_elastic.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>

namespace Perimorph
{
  namespace Peridynamics
  {
    /// Micromodulus c of the bond-based (PMB) model for a constant influence
    /// function: force per volume squared = c * stretch. In 2D per unit
    /// thickness.
    /// @param horizon  delta [length]
    /// @return         c [stress / length^(dim + 1)]
    /// Source: numerics.md, section 3.
    double
    micromodulus(double                youngs_modulus,
                 double                horizon,
                 Materials::PlaneState state);

    /// The only Poisson's ratio the model can have: 1/3 in plane stress, else
    /// 1/4.
    double
    allowed_poissons_ratio(Materials::PlaneState state);

    /// sum of beta |xi|^power over the family of a node in a lattice of spacing
    /// 1, beta the volume factor.
    template <int dim>
    double
    lattice_sum(double horizon_ratio, double power);

    /// Factor for the micromodulus that makes the sum C_abab over a and b, the
    /// mean stiffness over all directions, exact at a node with a full family
    /// on a uniform lattice. It depends on the horizon ratio m = horizon /
    /// spacing only, not on the plane state.
    /// @throws Base::InputError   m <= 1/2: the family is empty
    template <int dim>
    double
    calibration_factor(double horizon_ratio);

    /// One end of a bond.
    struct BondEnd
    {
      double alpha;        ///< blending weight [-]
      double micromodulus; ///< calibrated, of the family of this node
      double beta;         ///< volume factor in the family of this node [-]
      double volume;       ///< V
    };

    /// k_ij = 1/2 (alpha_i + alpha_j)/2 (c_i beta_i + c_j beta_j) V_i V_j /
    /// |xi| [force / length], so that the energy is k_ij (|xi + eta| - |xi|)^2
    /// / 2.
    /// @param length  |xi|, reference length of the bond
    double
    pair_stiffness(const BondEnd &first, const BondEnd &second, double length);

    // Kernels of one bond of stiffness k. xi is the reference bond vector from
    // its first to its second node, eta the displacement of the second relative
    // to the first. Forces are derivatives of the energy by eta: the internal
    // force is +force at the second node and -force at the first one. "small"
    // stands for the same bond linearised at rest.

    /// k (|xi + eta| - |xi|)^2 / 2.
    template <int dim>
    inline double
    bond_energy(const double                  k,
                const dealii::Tensor<1, dim> &xi,
                const dealii::Tensor<1, dim> &eta)
    {
      // Not the difference of the lengths, which loses digits at small strain.
      const double extension =
        (2. * (xi * eta) + eta * eta) / ((xi + eta).norm() + xi.norm());
      return 0.5 * k * extension * extension;
    }

    template <int dim>
    inline dealii::Tensor<1, dim>
    bond_force(const double                  k,
               const dealii::Tensor<1, dim> &xi,
               const dealii::Tensor<1, dim> &eta)
    {
      const dealii::Tensor<1, dim> bond   = xi + eta;
      const double                 length = bond.norm();
      const double                 extension =
        (2. * (xi * eta) + eta * eta) / (length + xi.norm());
      return (k * extension / length) * bond;
    }

    template <int dim>
    inline dealii::Tensor<2, dim>
    bond_tangent(const double                  k,
                 const dealii::Tensor<1, dim> &xi,
                 const dealii::Tensor<1, dim> &eta)
    {
      const dealii::Tensor<1, dim> bond          = xi + eta;
      const double                 length_square = bond * bond;
      const double                 length        = std::sqrt(length_square);
      const double                 extension =
        (2. * (xi * eta) + eta * eta) / (length + xi.norm());
      // k [n (x) n + (extension / length) (I - n (x) n)]
      const double along  = k * (1. - extension / length) / length_square;
      const double across = k * extension / length;

      dealii::Tensor<2, dim> tangent;
      for (int a = 0; a < dim; ++a)
        {
          for (int b = 0; b < dim; ++b)
            tangent[a][b] = along * bond[a] * bond[b];
          tangent[a][a] += across;
        }
      return tangent;
    }

    /// k (e . eta)^2 / 2 with e = xi / |xi|.
    template <int dim>
    inline double
    small_bond_energy(const double                  k,
                      const dealii::Tensor<1, dim> &xi,
                      const dealii::Tensor<1, dim> &eta)
    {
      const double projection = xi * eta;
      return 0.5 * k * projection * projection / (xi * xi);
    }

    template <int dim>
    inline dealii::Tensor<1, dim>
    small_bond_force(const double                  k,
                     const dealii::Tensor<1, dim> &xi,
                     const dealii::Tensor<1, dim> &eta)
    {
      return (k * (xi * eta) / (xi * xi)) * xi;
    }

    template <int dim>
    inline dealii::Tensor<2, dim>
    small_bond_tangent(const double k, const dealii::Tensor<1, dim> &xi)
    {
      return (k / (xi * xi)) * dealii::outer_product(xi, xi);
    }
  } // namespace Peridynamics
} // namespace Perimorph
