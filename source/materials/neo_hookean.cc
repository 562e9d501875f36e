#include <perimorph/base/exceptions.h>
#include <perimorph/materials/finite_strain.h>
#include <perimorph/materials/neo_hookean.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph
{
  namespace Materials
  {
    namespace
    {
      constexpr char law_name[] = "neo-hookean";

      /// x = ln s with mu (exp(2 x) - 1) + lambda (log_J + x) = 0, on the
      /// branch through rest, where the left side rises.
      double
      stress_free_thickness(const double log_J,
                            const double lambda,
                            const double mu)
      {
        constexpr int max_iterations = 200;
        // the left side is convex: from any point of the rising branch the
        // second step and all later ones come down to the solution
        double x = -lambda * log_J / (lambda + 2. * mu);
        if (lambda < 0.)
          x = std::max(x, 0.);
        for (int iteration = 0; iteration < max_iterations; ++iteration)
          {
            const double slope = 2. * mu * std::exp(2. * x) + lambda;
            const double step =
              (mu * std::expm1(2. * x) + lambda * (log_J + x)) / slope;
            if (!(slope > 0. && std::isfinite(step)))
              break;
            x -= std::min(step, 1.);
            // quadratic convergence: the next step is below round-off
            if (std::abs(step) <= 1e-8 * std::abs(x))
              return x;
          }
        std::ostringstream message;
        message << "the law '" << law_name
                << "': the plane-stress iteration for the thickness failed at "
                   "det F = "
                << std::exp(log_J) << " with lambda / mu = " << lambda / mu
                << ", last thickness stretch " << std::exp(x);
        throw Base::InadmissibleState(message.str());
      }
    } // namespace

    template <int dim>
    NeoHookean<dim>::NeoHookean(const double     youngs_modulus,
                                const double     poissons_ratio,
                                const PlaneState state)
      : state(state)
    {
      const LameConstants lame = lame_constants(youngs_modulus,
                                                poissons_ratio,
                                                PlaneState::three_dimensional);
      lame_lambda              = lame.lambda;
      lame_mu                  = lame.mu;
    }

    template <int dim>
    std::string
    NeoHookean<dim>::name() const
    {
      return law_name;
    }

    template <int dim>
    bool
    NeoHookean<dim>::is_linear() const
    {
      return false;
    }

    template <int dim>
    typename NeoHookean<dim>::Volume
    NeoHookean<dim>::volume(const dealii::Tensor<2, dim> &H) const
    {
      const VolumeRatio in_plane = volume_ratio(H, law_name);
      const double      log_thickness =
        state == PlaneState::plane_stress
               ? stress_free_thickness(in_plane.log_J, lame_lambda, lame_mu)
               : 0.;
      return {in_plane, log_thickness, in_plane.log_J + log_thickness};
    }

    template <int dim>
    double
    NeoHookean<dim>::energy_density(const dealii::Tensor<2, dim> &H) const
    {
      const Volume v = volume(H);
      // I1 - 3 - 2 ln J without its terms of first order, which cancel
      const double excess =
        H.norm_square() - 2. * v.in_plane.second_order +
        2. * excess_over_logarithm(v.in_plane.change, v.in_plane.log_J) +
        exponential_excess(2. * v.log_thickness);
      return 0.5 * lame_mu * excess + 0.5 * lame_lambda * v.log_J * v.log_J;
    }

    template <int dim>
    dealii::Tensor<2, dim>
    NeoHookean<dim>::first_piola_kirchhoff(
      const dealii::Tensor<2, dim> &H) const
    {
      const Volume v = volume(H);
      // F - F^-T = (F F^T - I) F^-T
      auto kirchhoff = lame_mu * left_cauchy_green_change(H);
      for (int a = 0; a < dim; ++a)
        kirchhoff[a][a] += lame_lambda * v.log_J;
      return dealii::Tensor<2, dim>(kirchhoff) *
             transpose(invert(deformation_gradient(H)));
    }

    template <int dim>
    dealii::Tensor<4, dim>
    NeoHookean<dim>::tangent(const dealii::Tensor<2, dim> &H) const
    {
      const Volume v         = volume(H);
      const auto   F_inverse = invert(deformation_gradient(H));
      // in plane stress d(ln J) = (1 + d(ln s) / d(ln det F)) F^-T : dF
      double volumetric = lame_lambda;
      if (state == PlaneState::plane_stress)
        {
          const double stiffness =
            2. * lame_mu * std::exp(2. * v.log_thickness);
          volumetric *= stiffness / (stiffness + lame_lambda);
        }
      const double           geometric = lame_mu - lame_lambda * v.log_J;
      dealii::Tensor<4, dim> A;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          for (int k = 0; k < dim; ++k)
            for (int l = 0; l < dim; ++l)
              A[i][j][k][l] = (i == k && j == l ? lame_mu : 0.) +
                              geometric * F_inverse[j][k] * F_inverse[l][i] +
                              volumetric * F_inverse[j][i] * F_inverse[l][k];
      return A;
    }

    template <int dim>
    double
    NeoHookean<dim>::out_of_plane_stress(const dealii::Tensor<2, dim> &H) const
    {
      const Volume v = volume(H);
      return state == PlaneState::plane_strain ? lame_lambda * v.log_J : 0.;
    }

    template <int dim>
    double
    NeoHookean<dim>::out_of_plane_stretch(const dealii::Tensor<2, dim> &H) const
    {
      return std::exp(volume(H).log_thickness);
    }

    template <int dim>
    double
    NeoHookean<dim>::shear_modulus() const
    {
      return lame_mu;
    }

    template class NeoHookean<2>;
    template class NeoHookean<3>;
  } // namespace Materials
} // namespace Perimorph
