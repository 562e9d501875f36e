#include <perimorph/materials/hencky.h>
#include <perimorph/materials/principal_stretches.h>

#include <algorithm>
#include <cmath>

namespace Perimorph
{
  namespace Materials
  {
    namespace
    {
      constexpr char law_name[] = "hencky";

      /// Stress in principal directions of B.
      template <int dim>
      struct PrincipalState
      {
        PrincipalState(const dealii::Tensor<2, dim> &H,
                       const LameConstants          &lame)
        {
          const VolumeRatio volume = volume_ratio(H, law_name);
          stretches = principal_stretches(left_cauchy_green_change(H), volume);
          const auto F_inverse = invert(deformation_gradient(H));
          for (int a = 0; a < dim; ++a)
            {
              kirchhoff[a] =
                lame.lambda * volume.log_J + lame.mu * stretches.logarithm[a];
              pulled_back[a] = F_inverse * stretches.direction[a];
            }
        }

        PrincipalStretches<dim> stretches;
        std::array<double, dim> kirchhoff;
        /// F^-1 n of the directions n
        std::array<dealii::Tensor<1, dim>, dim> pulled_back;
      };

      /// (ln w_a - ln w_b) / (2 (w_a - w_b)) for w_a >= w_b = smaller, of which
      /// the differences are given; 1 / (2 w) where they are equal.
      double
      half_logarithm_difference(const double smaller,
                                const double difference,
                                const double logarithm_difference)
      {
        const double x = difference / smaller;
        if (!(x > 0.))
          return 0.5 / smaller;
        return 0.5 * (x < 1. ? std::log1p(x) : logarithm_difference) /
               difference;
      }
    } // namespace

    template <int dim>
    Hencky<dim>::Hencky(const double     youngs_modulus,
                        const double     poissons_ratio,
                        const PlaneState state)
      : state(state)
      , lame(lame_constants(youngs_modulus, poissons_ratio, state))
    {}

    template <int dim>
    std::string
    Hencky<dim>::name() const
    {
      return law_name;
    }

    template <int dim>
    bool
    Hencky<dim>::is_linear() const
    {
      return false;
    }

    template <int dim>
    double
    Hencky<dim>::energy_density(const dealii::Tensor<2, dim> &H) const
    {
      const VolumeRatio volume = volume_ratio(H, law_name);
      const auto        stretches =
        principal_stretches(left_cauchy_green_change(H), volume);
      double squares = 0.;
      for (const double logarithm : stretches.logarithm)
        squares += logarithm * logarithm;
      return 0.5 * lame.lambda * volume.log_J * volume.log_J +
             0.25 * lame.mu * squares;
    }

    template <int dim>
    dealii::Tensor<2, dim>
    Hencky<dim>::first_piola_kirchhoff(const dealii::Tensor<2, dim> &H) const
    {
      const PrincipalState<dim> principal(H, lame);
      dealii::Tensor<2, dim>    P;
      for (int a = 0; a < dim; ++a)
        P += outer_product(principal.kirchhoff[a] *
                             principal.stretches.direction[a],
                           principal.pulled_back[a]);
      return P;
    }

    template <int dim>
    dealii::Tensor<4, dim>
    Hencky<dim>::tangent(const dealii::Tensor<2, dim> &H) const
    {
      // With dL = dF F^-1, dP = (dtau - tau dL^T) F^-T, and in principal
      // directions de_ab = l_ab (w_b dL_ab + w_a dL_ba), where l_ab is half the
      // divided difference of the logarithm.
      const PrincipalState<dim> principal(H, lame);
      const auto               &w         = principal.stretches.squared;
      const auto               &logarithm = principal.stretches.logarithm;
      const auto               &tau       = principal.kirchhoff;
      PrincipalTangent<dim>     coefficients;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          {
            coefficients.normal[a][b] =
              lame.lambda + (a == b ? 2. * lame.mu - tau[a] : 0.);
            const int    larger = std::max(a, b), smaller = std::min(a, b);
            const double difference =
              half_logarithm_difference(w[smaller],
                                        principal.stretches.change[larger] -
                                          principal.stretches.change[smaller],
                                        logarithm[larger] - logarithm[smaller]);
            coefficients.direct[a][b] = 2. * lame.mu * difference * w[b];
            // equal to 2 mu l w_b - tau_b; of the mean the symmetry is exact
            coefficients.crossed[a][b] =
              lame.mu * difference * (w[a] + w[b]) - 0.5 * (tau[a] + tau[b]);
          }
      return assemble_tangent<dim>(coefficients,
                                   principal.stretches.direction,
                                   principal.pulled_back);
    }

    template <int dim>
    double
    Hencky<dim>::out_of_plane_stress(const dealii::Tensor<2, dim> &H) const
    {
      const VolumeRatio volume = volume_ratio(H, law_name);
      return state == PlaneState::plane_strain ? lame.lambda * volume.log_J
                                               : 0.;
    }

    template <int dim>
    double
    Hencky<dim>::out_of_plane_stretch(const dealii::Tensor<2, dim> &H) const
    {
      return std::exp(-lame.contraction * volume_ratio(H, law_name).log_J);
    }

    template <int dim>
    double
    Hencky<dim>::shear_modulus() const
    {
      return lame.mu;
    }

    template class Hencky<2>;
    template class Hencky<3>;
  } // namespace Materials
} // namespace Perimorph
