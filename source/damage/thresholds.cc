#include <perimorph/bonds/bond_search.h>
#include <perimorph/damage/thresholds.h>
#include <perimorph/peridynamics/bond_based.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Damage
{
  double
  critical_stretch(const double                fracture_energy,
                   const double                youngs_modulus,
                   const double                horizon,
                   const Materials::PlaneState state)
  {
    const double c = Peridynamics::micromodulus(youngs_modulus, horizon, state);
    const double fourth = std::pow(horizon, 4);
    return std::sqrt(state == Materials::PlaneState::three_dimensional
                       ? 10. * fracture_energy /
                           (dealii::numbers::PI * c * fourth * horizon)
                       : 4. * fracture_energy / (c * fourth));
  }

  template <int dim>
  double
  critical_stretch_of_node(const double fracture_energy, const double moment)
  {
    const double share = dim == 2 ? 0.5 / dealii::numbers::PI : 0.125;
    return std::sqrt(fracture_energy / (share * moment));
  }

  template <int dim>
  double
  critical_stretch_of_lattice(const double                fracture_energy,
                              const double                youngs_modulus,
                              const double                horizon,
                              const double                horizon_ratio,
                              const Materials::PlaneState state)
  {
    const double sum     = Peridynamics::lattice_sum<dim>(horizon_ratio, 2.);
    const double spacing = horizon / horizon_ratio;
    return critical_stretch_of_node<dim>(
      fracture_energy,
      Peridynamics::calibration_factor<dim>(horizon_ratio) *
        Peridynamics::micromodulus(youngs_modulus, horizon, state) * sum *
        std::pow(spacing, dim + 2));
  }

  template <int dim>
  double
  critical_energy_density(const double fracture_energy, const double horizon)
  {
    return dim == 2 ? 1.5 * fracture_energy / std::pow(horizon, 3)
                    : 4. * fracture_energy /
                        (dealii::numbers::PI * std::pow(horizon, 4));
  }

  double
  lattice_trapping(const double horizon_ratio, const FamilyShape shape)
  {
    const double at_2 = shape == FamilyShape::ball ? 1.75 : 3.04;
    const double at_3 = shape == FamilyShape::ball ? 1.26 : 2.;
    return at_2 + (at_3 - at_2) * std::clamp(horizon_ratio - 2., 0., 1.);
  }

  template double
  critical_stretch_of_node<2>(double, double);
  template double
  critical_stretch_of_node<3>(double, double);
  template double
  critical_stretch_of_lattice<2>(double,
                                 double,
                                 double,
                                 double,
                                 Materials::PlaneState);
  template double
  critical_stretch_of_lattice<3>(double,
                                 double,
                                 double,
                                 double,
                                 Materials::PlaneState);
  template double
  critical_energy_density<2>(double, double);
  template double
  critical_energy_density<3>(double, double);
} // namespace Perimorph::Damage
