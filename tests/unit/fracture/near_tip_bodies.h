#pragma once

#include <perimorph/coupling/consistent_families.h>
#include <perimorph/fracture/domain_integral.h>
#include <perimorph/materials/linear_elastic.h>

#include "exact_fields.h"
#include <harness/test_meshes.h>

#include <cmath>

// Plates whose nodes move by the exact near-tip fields.
namespace Perimorph::Testing
{
  constexpr double near_tip_poissons_ratio = 0.3;

  /// Factors of the fields, and the tip.
  struct NearTipCase
  {
    double                K_I   = 1.;
    double                K_II  = 0.6;
    double                T     = 0.4;
    double                angle = 0.; ///< of the crack
    dealii::Point<2>      tip;
    Materials::PlaneState state = Materials::PlaneState::plane_strain;

    Fracture::TipFrame<2>
    frame() const
    {
      return Fracture::tip_frame(
        tip,
        dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
    }

    Materials::LinearElastic<2>
    law() const
    {
      return {1., near_tip_poissons_ratio, state};
    }

    Fracture::NearTipConstants
    constants() const
    {
      return Fracture::near_tip_constants(law());
    }

    Fracture::NearTipState<2>
    at(const dealii::Point<2> &x) const
    {
      using Fracture::NearTipField;
      const auto opening =
        near_tip_state(NearTipField::opening, constants(), frame(), x);
      const auto sliding =
        near_tip_state(NearTipField::sliding, constants(), frame(), x);
      Fracture::NearTipState<2> sum;
      sum.displacement =
        K_I * opening.displacement + K_II * sliding.displacement;
      sum.gradient = K_I * opening.gradient + K_II * sliding.gradient;
      // stress T along the crack: strains T / E' and -nu' T / E'
      const double kappa  = constants().kolosov;
      const double along  = T / constants().plane_modulus();
      const double across = along * (kappa - 3.) / (kappa + 1.);
      const auto  &axes   = frame().axes;
      const auto   strain = along * dealii::outer_product(axes[0], axes[0]) +
                          across * dealii::outer_product(axes[1], axes[1]);
      sum.gradient += strain;
      sum.displacement += strain * (x - tip);
      sum.stress = law().first_piola_kirchhoff(sum.gradient);
      return sum;
    }

    Bonds::CrackSet<2>
    crack() const
    {
      Bonds::CrackFacet<2> facet;
      facet.corners = {{tip - 4. * frame().axes[0], tip}};
      return Bonds::CrackSet<2>({facet});
    }
  };

  /// Families of all particles with alpha > 0, cut by the cracks.
  template <int dim>
  Peridynamics::FamilySet<dim>
  cut_families(const Mesh::NodalMesh<dim>     &mesh,
               const std::vector<double>      &alpha,
               const double                    horizon_ratio,
               const Bonds::CrackSet<dim>     &cracks,
               const Materials::Material<dim> &law)
  {
    std::vector<double> horizon(mesh.n_nodes());
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      horizon[n] = horizon_ratio * mesh.spacing[n];
    Coupling::FamilyParameters parameters;
    parameters.constants = {Coupling::elastic_constants(law)};
    return Coupling::consistent_families(mesh,
                                         alpha,
                                         horizon,
                                         parameters,
                                         cracks);
  }
} // namespace Perimorph::Testing
