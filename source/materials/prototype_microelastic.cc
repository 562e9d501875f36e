#include <perimorph/materials/principal_stretches.h>
#include <perimorph/materials/prototype_microelastic.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace Perimorph
{
  namespace Materials
  {
    namespace
    {
      constexpr char law_name[] = "prototype microelastic";

      // directions per quadrant (octant); errors are in the header
      constexpr int n_angles_2d = 32;
      constexpr int n_angles_3d = 16;
      constexpr int n_heights   = 16;
      // (w_a - w_b) / (w_a + w_b) from which differences lose no digits
      constexpr double separate_stretches = 0.02;
    } // namespace

    template <int dim>
    PrototypeMicroelastic<dim>::PrototypeMicroelastic(
      const double     youngs_modulus,
      const PlaneState state)
      : state(state)
      , lame(lame_constants(youngs_modulus, poissons_ratio(state), state))
      , bond_stiffness((dim == 2 ? 8. : 15.) * lame.mu)
    {
      // heights z over the plane of the angles: zero in 2D; Gauss points of
      // [-1, 1] with z > 0 in 3D. The mean over z > 0 of an even function.
      std::vector<double> height = {0.}, height_weight = {1.};
      if (dim == 3)
        {
          const dealii::QGauss<1> rule(2 * n_heights);
          height.clear();
          height_weight.clear();
          for (unsigned int q = 0; q < rule.size(); ++q)
            if (rule.point(q)[0] > 0.5)
              {
                height.push_back(2. * rule.point(q)[0] - 1.);
                height_weight.push_back(2. * rule.weight(q));
              }
        }
      const int n_angles = dim == 2 ? n_angles_2d : n_angles_3d;
      for (std::size_t h = 0; h < height.size(); ++h)
        for (int k = 0; k < n_angles; ++k)
          {
            const double angle =
              0.5 * dealii::numbers::PI * (k + 0.5) / n_angles;
            const double cosine = std::cos(angle), sine = std::sin(angle);
            const double square = height[h] * height[h];
            squared_component[0].push_back((1. - square) * cosine * cosine);
            squared_component[1].push_back((1. - square) * sine * sine);
            if (dim == 3)
              squared_component[dim - 1].push_back(square);
            weight.push_back(height_weight[h] / n_angles);
          }
    }

    template <int dim>
    std::string
    PrototypeMicroelastic<dim>::name() const
    {
      return law_name;
    }

    template <int dim>
    bool
    PrototypeMicroelastic<dim>::is_linear() const
    {
      return false;
    }

    /// What the sums over directions need: F, principal values of C = F^T F.
    template <int dim>
    struct PrototypeMicroelastic<dim>::Moments
    {
      explicit Moments(const dealii::Tensor<2, dim> &H)
        : F(deformation_gradient(H))
        , stretches(principal_stretches(right_cauchy_green_change(H),
                                        volume_ratio(H, law_name)))
      {
        for (int a = 0; a < dim; ++a)
          image[a] = F * stretches.direction[a];
      }

      /// |F n|^2 - 1 of direction q.
      double
      squared_change(const PrototypeMicroelastic<dim> &law,
                     const std::size_t                 q) const
      {
        double change = 0.;
        for (int a = 0; a < dim; ++a)
          change += stretches.change[a] * law.squared_component[a][q];
        return change;
      }

      dealii::Tensor<2, dim>                  F;
      PrincipalStretches<dim>                 stretches;
      std::array<dealii::Tensor<1, dim>, dim> image; ///< F N_a
    };

    template <int dim>
    double
    PrototypeMicroelastic<dim>::poissons_ratio(const PlaneState state)
    {
      return state == PlaneState::plane_stress ? 1. / 3. : 1. / 4.;
    }

    template <int dim>
    double
    PrototypeMicroelastic<dim>::energy_density(
      const dealii::Tensor<2, dim> &H) const
    {
      const Moments moments(H);
      double        mean = 0.;
      for (std::size_t q = 0; q < weight.size(); ++q)
        {
          const double change = moments.squared_change(*this, q);
          // |F n| - 1 without cancellation
          const double extension = change / (1. + std::sqrt(1. + change));
          mean += weight[q] * extension * extension;
        }
      return 0.5 * bond_stiffness * mean;
    }

    template <int dim>
    dealii::Tensor<2, dim>
    PrototypeMicroelastic<dim>::first_piola_kirchhoff(
      const dealii::Tensor<2, dim> &H) const
    {
      // P = A F <(1 - 1/|F n|) n n>, diagonal in principal directions
      const Moments           moments(H);
      std::array<double, dim> mean{};
      for (std::size_t q = 0; q < weight.size(); ++q)
        {
          const double change  = moments.squared_change(*this, q);
          const double length  = std::sqrt(1. + change);
          const double tension = weight[q] * change / (length * (1. + length));
          for (int a = 0; a < dim; ++a)
            mean[a] += tension * squared_component[a][q];
        }
      dealii::Tensor<2, dim> P;
      for (int a = 0; a < dim; ++a)
        P += outer_product(bond_stiffness * mean[a] * moments.image[a],
                           moments.stretches.direction[a]);
      return P;
    }

    template <int dim>
    dealii::Tensor<4, dim>
    PrototypeMicroelastic<dim>::tangent(const dealii::Tensor<2, dim> &H) const
    {
      // dP = A (dF <(1 - 1/|F n|) n n> + <(F n) n (F n) n / |F n|^3> : dF)
      const Moments           moments(H);
      const auto             &direction = moments.stretches.direction;
      std::array<double, dim> mean{};
      PrincipalTangent<dim>   coefficients{};
      auto                   &fourth = coefficients.normal;
      for (std::size_t q = 0; q < weight.size(); ++q)
        {
          const double change   = moments.squared_change(*this, q);
          const double length   = std::sqrt(1. + change);
          const double inverse  = 1. / length;
          const double tension  = weight[q] * change * inverse / (1. + length);
          const double material = weight[q] * inverse * inverse * inverse;
          for (int a = 0; a < dim; ++a)
            {
              const double square = squared_component[a][q];
              mean[a] += tension * square;
              for (int b = 0; b <= a; ++b)
                fourth[a][b] += material * square * squared_component[b][q];
            }
        }
      dealii::Tensor<2, dim> second;
      for (int a = 0; a < dim; ++a)
        {
          second += outer_product(bond_stiffness * mean[a] * direction[a],
                                  direction[a]);
          for (int b = 0; b <= a; ++b)
            fourth[a][b] = fourth[b][a] = bond_stiffness * fourth[a][b];
        }
      // Shear across two principal directions turns the sum over directions
      // along: where the two stretches are apart, the derivative of P comes
      // from their difference, so that it is exact at any number of directions.
      coefficients.direct = fourth;
      const auto &w       = moments.stretches.squared;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < a; ++b)
          if (w[a] - w[b] > separate_stretches * (w[a] + w[b]))
            coefficients.direct[a][b] = coefficients.direct[b][a] =
              bond_stiffness * (mean[a] - mean[b]) / (w[a] - w[b]);
      coefficients.crossed = coefficients.direct;
      auto A = assemble_tangent<dim>(coefficients, moments.image, direction);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          for (int l = 0; l < dim; ++l)
            A[i][j][i][l] += second[j][l];
      return A;
    }

    template <int dim>
    double
    PrototypeMicroelastic<dim>::out_of_plane_stress(
      const dealii::Tensor<2, dim> &H) const
    {
      const VolumeRatio volume = volume_ratio(H, law_name);
      return state == PlaneState::plane_strain ? lame.lambda * volume.log_J
                                               : 0.;
    }

    template <int dim>
    double
    PrototypeMicroelastic<dim>::out_of_plane_stretch(
      const dealii::Tensor<2, dim> &H) const
    {
      return std::exp(-lame.contraction * volume_ratio(H, law_name).log_J);
    }

    template <int dim>
    double
    PrototypeMicroelastic<dim>::shear_modulus() const
    {
      return lame.mu;
    }

    template class PrototypeMicroelastic<2>;
    template class PrototypeMicroelastic<3>;
  } // namespace Materials
} // namespace Perimorph
