#pragma once

#include <perimorph/damage/thresholds.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Damage
{
  /// Tensile strengths in material axes [stress], axis 1 along the fibres.
  struct Strengths
  {
    double longitudinal = 0.; ///< X
    double transverse   = 0.; ///< Y, all directions across the fibres
    double shear        = 0.; ///< S, along the fibres
  };

  /// One bond under load, as criteria see it.
  struct BondState
  {
    double length;         ///< |xi|
    double extension;      ///< e . eta, e = xi / |xi| [length]
    double energy;         ///< of both halves of the bond
    double volume_product; ///< V_i V_j
    double horizon;        ///< mean of both ends [length]
    double horizon_ratio;  ///< mean of horizon over spacing of both ends [-]
    double youngs_modulus; ///< mean of both ends
    /// Of bonds that soften (SawTooth).
    unsigned int teeth_lost = 0;

    // Means of both ends, only where sees_particles(); the third direction of
    // a 2D model included.
    dealii::SymmetricTensor<2, 3> strain;
    dealii::SymmetricTensor<2, 3> stress;
    dealii::Tensor<1, 3>          direction; ///< e
    dealii::Tensor<1, 3> relative; ///< eta / |xi| without the mean rotation
    double               largest_dilatation; ///< tr(strain) of either end

    // Only where uses_strengths(), which see the stress of one material.
    dealii::Tensor<2, 3> axes; ///< material axes in rows
    Strengths            strengths;
  };

  /// When a bond breaks: one rule, one bond, no memory.
  class BreakingRule
  {
  public:
    virtual ~BreakingRule() = default;

    /// Factor of the loads at which the bond breaks in a linear problem; 1 or
    /// less: it breaks now. Infinity for bonds that do not extend.
    virtual double
    load_factor(const BondState &bond) const = 0;
  };

  enum class Criterion
  {
    critical_stretch,  ///< extension / length >= s_c
    critical_energy,   ///< energy / (V_i V_j) >= w_0 / kappa
    bond_strain,       ///< deviatoric_bond_strain() under tension
    equivalent_strain, ///< of the mean strain
    volumetric_strain, ///< of the mean strain
    principal_stress,  ///< of the mean stress, with Mohr-Coulomb
    tsai_hill,         ///< of the stress in material axes
    maximum_stress     ///< the same, each component by itself
  };

  /// Names as in the parameter file, in the order of the enumeration.
  const std::vector<std::string> &
  criterion_names();

  /// Whether bonds break by strain or stress of the particles at their ends.
  bool
  sees_particles(Criterion criterion);

  /// Whether bonds break by strengths in material axes.
  bool
  uses_strengths(Criterion criterion);

  /// What bonds bear. Zeros where a criterion does not ask.
  struct Limits
  {
    double fracture_energy = 0.; ///< G_c
    /// kappa by which G_c is divided for the energy of a bond at break; 0:
    /// lattice_trapping() for the energy, 1 for the stretch.
    double calibration = 0.;
    double stretch     = 0.; ///< s_c; 0: from G_c
    /// s_min at which bonds soften by the tanh law; 0: they do not.
    double softening_stretch   = 0.;
    double softening_steepness = 3.; ///< beta
    double bond_strain         = 0.;
    double equivalent_strain   = 0.;
    double volumetric_strain   = 0.;
    double tensile_strength    = 0.; ///< f_t [stress]
    double cohesion            = 0.; ///< C [stress]; 0: no failure by shear
    double friction_angle      = 0.; ///< phi [degrees], less than 90
  };

  template <int dim>
  std::unique_ptr<BreakingRule>
  make_breaking_rule(Criterion             criterion,
                     const Limits         &limits,
                     Materials::PlaneState state,
                     FamilyShape           shape);
} // namespace Perimorph::Damage
