#pragma once

#include <perimorph/materials/material.h>
#include <perimorph/materials/plane_state.h>

#include <array>
#include <vector>

namespace Perimorph
{
  namespace Materials
  {
    /// The bond-based solid (prototype microelastic brittle, linear bonds,
    /// without fracture) as a law at a point, the limit of a vanishing horizon:
    /// W = A/2 mean over all directions n of (|F n| - 1)^2.
    /// With <n n n n> = (II + two permutations) / 8 in 2D and / 15 in 3D, small
    /// strain has lambda = mu = A/8 (2D: bonds in the plane only) and A/15
    /// (3D), so that Poisson's ratio is 1/4 in plane strain and 3D and 1/3 in
    /// plane stress, and A = 3.2 E, 6 E and 3 E.
    ///
    /// A law of bonds in the plane says nothing of the thickness: stress and
    /// stretch out of the plane are those of Hencky's law with the same
    /// constants, exact at small strain.
    ///
    /// Means are taken in principal directions of F^T F, which keeps the law
    /// exactly isotropic. 2D: 128 directions on the circle, error of the order
    /// ((s1 - s2) / (s1 + s2))^64 of the stretches s1 > s2; measured, relative
    /// to E, below 1e-12 within [0.5, 2], 1e-8 at (0.5, 3), 2e-3 at (0.25, 4).
    /// 3D: product rule with 16 x 16 directions per octant, below 1e-10 within
    /// [0.7, 1.6], 1e-6 within [0.5, 2]. Beyond, the sum is still an energy
    /// with exact derivatives (the tangent up to the error above for pairs of
    /// nearly equal stretches), but of finitely many directions.
    ///
    /// Source: Silling (2000), Silling and Askari (2005); means in doc/theory.
    template <int dim>
    class PrototypeMicroelastic : public Material<dim>
    {
    public:
      /// @param youngs_modulus  E > 0 [stress]
      PrototypeMicroelastic(double youngs_modulus, PlaneState state);

      /// The only Poisson's ratio of such a solid: 1/3 in plane stress,
      /// otherwise 1/4.
      static double
      poissons_ratio(PlaneState state);

      std::string
      name() const override;
      bool
      is_linear() const override;
      double
      energy_density(const dealii::Tensor<2, dim> &H) const override;
      dealii::Tensor<2, dim>
      first_piola_kirchhoff(const dealii::Tensor<2, dim> &H) const override;
      dealii::Tensor<4, dim>
      tangent(const dealii::Tensor<2, dim> &H) const override;
      double
      out_of_plane_stress(const dealii::Tensor<2, dim> &H) const override;
      double
      out_of_plane_stretch(const dealii::Tensor<2, dim> &H) const override;
      double
      shear_modulus() const override;

    private:
      struct Moments;

      PlaneState    state;
      LameConstants lame;
      double        bond_stiffness; ///< A [stress]

      /// One octant (quadrant) of directions: squared components in principal
      /// directions and weights of sum 1.
      std::array<std::vector<double>, dim> squared_component;
      std::vector<double>                  weight;
    };
  } // namespace Materials
} // namespace Perimorph
