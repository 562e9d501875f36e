#pragma once

#include <perimorph/fracture/stress_points.h>
#include <perimorph/fracture/williams_field.h>

#include <mpi.h>

#include <functional>
#include <optional>
#include <vector>

namespace Perimorph::Fracture
{
  /// Where the weight q of a domain integral falls from 1 to 0.
  struct Annulus
  {
    double inner; ///< q = 1 up to here
    double outer; ///< q = 0 from here on

    /// q at a distance from the tip: linear in between. A smoother q gains
    /// nothing, because only its nodal values enter, and concentrates the sum
    /// on fewer points. Measured on 32 rotated and distorted plates whose nodes
    /// follow the exact field, h = 1/10, 1/20, 1/40 of the crack, inner 0.3,
    /// outer 0.8: root mean square error of J from cells 1.3e-3, 2.6e-4, 5e-5
    /// (cubic 1.6e-3, 2.9e-4, 6e-5; quintic 1.9e-3, 3.1e-4, 6e-5), from
    /// families 6.6e-3, 1.6e-3, 6e-4 (cubic 6.3e-3, 1.9e-3, 8e-4).
    double
    weight(double distance) const;
  };

  /// Annuli for a tip, at least two spacings wide, inside the free distance and
  /// outside the horizon; fewer than two, or none, if there is no room.
  ///
  /// With L the smaller of the crack length and 0.9 times the free distance:
  /// (0.3, 0.8) L as in numerics.md, Q4, and (0.5, 1) L.
  /// @param crack_length   half length of a crack with two tips
  /// @param free_distance  from the tip to the next boundary or other crack
  /// @param horizon        of the families at the tip; 0 without families
  /// @param spacing        of the mesh at the tip
  ///
  /// A tip needs a free distance of least_free_distance() for one of them.
  std::vector<Annulus>
  default_annuli(double crack_length,
                 double free_distance,
                 double horizon,
                 double spacing);

  double
  least_free_distance(double horizon, double spacing);

  /// q of every node for a tip of a plane crack.
  std::vector<double>
  annulus_weights(const Mesh::NodalMesh<2> &mesh,
                  const dealii::Point<2>   &tip,
                  const Annulus            &annulus);

  /// What drives a crack at a tip.
  struct FractureQuantities
  {
    double J = 0.; ///< energy release rate [stress * length]
    /// False where no near-tip fields are known: no factors, no T-stress.
    bool   has_factors = true;
    double K_I         = 0.; ///< [stress * length^(1/2)]
    double K_II        = 0.;
    double K_III       = 0.; ///< 0 in 2D
    /// Stress along the crack that the singular terms leave over [stress]; 0
    /// in 3D.
    double T_stress = 0.;
  };

  /// The same for a tip in a plane and for a point of a front: axes at a place.
  template <int dim>
  using FrameField = std::function<TipFrame<dim>(const dealii::Point<dim> &)>;

  /// J = sum volume (P_ij H_i1 - W delta_1j) dq/dx_j along the direction of
  /// advance, and the interaction integrals I with the near-tip fields. The
  /// points hold the gradient of q (StressPointSet::set_weight).
  ///
  /// (K_II, K_I) = L (I_II, I_I) with the tensor of Barnett and Lothe
  /// (near_tip_constants.h), K_III = mu I_III, T = I / S11.
  ///
  /// Where the stress has a divergence f, inertia rho a or a body force -b, J
  /// also has the sum of volume q f . H e_1 and each I that of volume q f . H
  /// e_1 of its auxiliary field, which is in equilibrium by itself (a crack
  /// that stands still: T. Nishioka, S. N. Atluri, Eng. Fract. Mech. 18 (1983)
  /// 1). The kinetic energy adds nothing: its terms are the integral of -d(q
  /// rho v^2 / 2)/dx_1, zero around a crack along x_1.
  ///
  /// The crack must be free of traction and alone within the
  /// annulus, straight or with points on its faces (crack_faces.h), the body
  /// homogeneous. K and T belong to small strain, J to any. Sums over all
  /// ranks.
  /// @param direction  of advance, where q = 1
  /// @param axes       local axes of the auxiliary fields at a place
  /// @param area       by which the crack grows when it advances by q:
  ///                   1 in 2D, integral of q along the front in 3D
  /// @param constants  none: J only
  template <int dim>
  FractureQuantities
  fracture_quantities(const StressPointSet<dim>             &set,
                      const dealii::Tensor<1, dim>          &direction,
                      const FrameField<dim>                 &axes,
                      double                                 area,
                      const std::optional<NearTipConstants> &constants,
                      MPI_Comm                               communicator);

  /// Of one tip of a plane crack.
  FractureQuantities
  fracture_quantities(StressPointSet<2>                     &set,
                      const Mesh::NodalMesh<2>              &mesh,
                      const TipFrame<2>                     &tip,
                      const Annulus                         &annulus,
                      const std::optional<NearTipConstants> &constants,
                      MPI_Comm                               communicator);
} // namespace Perimorph::Fracture
