#include <perimorph/base/exceptions.h>
#include <perimorph/bonds/bond_search.h>
#include <perimorph/peridynamics/bond_based.h>

#include <deal.II/base/numbers.h>

#include <string>

namespace Perimorph
{
  namespace Peridynamics
  {
    using Materials::PlaneState;

    double
    micromodulus(const double     youngs_modulus,
                 const double     horizon,
                 const PlaneState state)
    {
      const double cube = horizon * horizon * horizon;
      switch (state)
        {
          case PlaneState::plane_stress:
            return 9. * youngs_modulus / (dealii::numbers::PI * cube);
          case PlaneState::plane_strain:
            return 48. * youngs_modulus / (5. * dealii::numbers::PI * cube);
          default:
            return 12. * youngs_modulus /
                   (dealii::numbers::PI * cube * horizon);
        }
    }

    double
    allowed_poissons_ratio(const PlaneState state)
    {
      return state == PlaneState::plane_stress ? 1. / 3. : 1. / 4.;
    }

    template <int dim>
    double
    lattice_sum(const double horizon_ratio, const double power)
    {
      const int reach   = static_cast<int>(horizon_ratio + 0.5);
      const int z_reach = dim == 3 ? reach : 0;
      double    sum     = 0.;
      for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
          for (int z = -z_reach; z <= z_reach; ++z)
            {
              const double length = std::sqrt(x * x + y * y + z * z);
              sum += Bonds::volume_factor(horizon_ratio, 1., length) *
                     std::pow(length, power);
            }
      return sum;
    }

    template <int dim>
    double
    calibration_factor(const double horizon_ratio)
    {
      // Lattice of spacing 1, E = 1. The ratio of c to the shear modulus
      // is the same in both plane states.
      const PlaneState state =
        dim == 2 ? PlaneState::plane_strain : PlaneState::three_dimensional;
      const double c             = micromodulus(1., horizon_ratio, state);
      const double shear_modulus = 0.5 / (1. + allowed_poissons_ratio(state));

      // C_abab = 1/2 sum c beta |xi| over the family of a node.
      const double sum = lattice_sum<dim>(horizon_ratio, 1.);
      if (!(sum > 0.))
        throw Base::InputError(Base::InputMessage{
          "horizon ratio of the bond-based model",
          std::to_string(horizon_ratio) + " at a particle",
          "more than 1 (below, a particle may have no neighbours)",
          "Usual value: 2."});
      // Both Lame constants of a bond-based material are equal.
      const double target = (dim == 2 ? 8. : 15.) * shear_modulus;
      return target / (0.5 * c * sum);
    }

    double
    pair_stiffness(const BondEnd &first,
                   const BondEnd &second,
                   const double   length)
    {
      return 0.25 * (first.alpha + second.alpha) *
             (first.micromodulus * first.beta +
              second.micromodulus * second.beta) *
             first.volume * second.volume / length;
    }

    template double
    lattice_sum<2>(double, double);
    template double
    lattice_sum<3>(double, double);
    template double
    calibration_factor<2>(double);
    template double
    calibration_factor<3>(double);
  } // namespace Peridynamics
} // namespace Perimorph
