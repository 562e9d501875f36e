#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace Perimorph::Peridynamics
{
  /// Two particles and the force between them.
  template <int dim>
  struct PairForce
  {
    dealii::Point<dim> begin; ///< reference positions
    dealii::Point<dim> end;
    /// Derivative of the energy by the displacement of `end` relative to
    /// `begin` [force]: positive along the bond in tension.
    dealii::Tensor<1, dim> force;
  };

  /// How much of a bond counts for the stress of an averaging ball.
  enum class BondFunction
  {
    segment_in_ball, ///< fraction of its segment inside the ball
    /// One with both ends inside, else none: Li et al. (2022), eq. (29). Bonds
    /// that leave the ball are missing, which is 40 % of the stress in 2D.
    both_ends_in_ball
  };

  /// Area of the disc in 2D.
  template <int dim>
  double
  ball_volume(double radius);

  /// Part of the straight segment inside the ball, in [0, 1].
  template <int dim>
  double
  fraction_in_ball(const dealii::Point<dim> &begin,
                   const dealii::Point<dim> &end,
                   const dealii::Point<dim> &center,
                   double                    radius);

  /// Virial stress of a ball: sum of force (x) (end - begin) times the bond
  /// function, over the volume of the ball.
  /// @param pairs  every pair that meets the ball once, also those with both
  ///               ends outside
  /// @return       mean first Piola-Kirchhoff stress [force / length^(dim-1)],
  ///               in 2D per unit thickness
  /// Source: Li, Li, Lai, Liu (2022), eq. (28) with the step function.
  template <int dim>
  dealii::Tensor<2, dim>
  virial_stress(const dealii::Point<dim>          &center,
                double                             radius,
                const std::vector<PairForce<dim>> &pairs,
                BondFunction function = BondFunction::segment_in_ball);
} // namespace Perimorph::Peridynamics
