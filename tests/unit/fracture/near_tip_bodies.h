#pragma once

#include <perimorph/coupling/consistent_families.h>
#include <perimorph/fracture/domain_integral.h>
#include <perimorph/materials/linear_elastic.h>

#include "exact_fields.h"
#include "plane_stiffness_law.h"
#include <harness/test_meshes.h>

#include <cmath>
#include <memory>
#include <optional>

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
    /// Of an anisotropic law (11, 22, 12) in global axes, instead of the
    /// isotropic one with E = 1.
    std::optional<dealii::SymmetricTensor<2, 3>> stiffness = std::nullopt;

    Fracture::TipFrame<2>
    frame() const
    {
      return Fracture::tip_frame(
        tip,
        dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
    }

    std::unique_ptr<Materials::Material<2>>
    law() const
    {
      if (stiffness)
        return std::make_unique<PlaneStiffnessLaw>(*stiffness);
      return std::make_unique<Materials::LinearElastic<2>>(
        1.,
        near_tip_poissons_ratio,
        state);
    }

    Fracture::IsotropicConstants
    isotropic_constants() const
    {
      return Fracture::isotropic_constants(*law());
    }

    Fracture::NearTipConstants
    constants() const
    {
      return *Fracture::near_tip_constants(*law(), frame());
    }

    /// J = 1/2 K . L^-1 K
    double
    exact_J() const
    {
      const dealii::Tensor<1, 2> K({K_II, K_I});
      return 0.5 * (K * (inverse_barnett_lothe_tensor(constants()) * K));
    }

    Fracture::NearTipState<2>
    at(const dealii::Point<2> &x) const
    {
      using Fracture::NearTipField;
      const auto known = constants();
      const auto opening =
        near_tip_state(NearTipField::opening, known, frame(), x);
      const auto sliding =
        near_tip_state(NearTipField::sliding, known, frame(), x);
      Fracture::NearTipState<2> sum;
      sum.displacement =
        K_I * opening.displacement + K_II * sliding.displacement;
      sum.gradient = K_I * opening.gradient + K_II * sliding.gradient;
      // strains of the stress T along the crack
      const auto  S    = plane_compliance(*law(), frame());
      const auto &axes = frame().axes;
      const auto  strain =
        T * (S[0][0] * dealii::outer_product(axes[0], axes[0]) +
             S[0][1] * dealii::outer_product(axes[1], axes[1]) +
             0.5 * S[0][2] *
               (dealii::outer_product(axes[0], axes[1]) +
                dealii::outer_product(axes[1], axes[0])));
      sum.gradient += strain;
      sum.displacement += strain * (x - tip);
      sum.stress = law()->first_piola_kirchhoff(sum.gradient);
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
