#include <perimorph/base/exceptions.h>
#include <perimorph/materials/finite_strain.h>
#include <perimorph/materials/saint_venant_kirchhoff.h>

#include <cmath>
#include <sstream>

namespace Perimorph
{
  namespace Materials
  {
    namespace
    {
      constexpr char law_name[] = "saint venant-kirchhoff";

      template <int dim>
      dealii::SymmetricTensor<2, dim>
      second_piola_kirchhoff(const dealii::SymmetricTensor<2, dim> &strain,
                             const LameConstants                   &lame)
      {
        return lame.lambda * trace(strain) *
                 dealii::unit_symmetric_tensor<dim>() +
               2. * lame.mu * strain;
      }
    } // namespace

    template <int dim>
    SaintVenantKirchhoff<dim>::SaintVenantKirchhoff(const double youngs_modulus,
                                                    const double poissons_ratio,
                                                    const PlaneState state)
      : state(state)
      , lame(lame_constants(youngs_modulus, poissons_ratio, state))
    {}

    template <int dim>
    std::string
    SaintVenantKirchhoff<dim>::name() const
    {
      return law_name;
    }

    template <int dim>
    bool
    SaintVenantKirchhoff<dim>::is_linear() const
    {
      return false;
    }

    template <int dim>
    dealii::SymmetricTensor<2, dim>
    SaintVenantKirchhoff<dim>::admissible_strain(
      const dealii::Tensor<2, dim> &H) const
    {
      volume_ratio(H, law_name);
      const auto   strain           = 0.5 * right_cauchy_green_change(H);
      const double thickness_strain = -lame.contraction * trace(strain);
      if (!(thickness_strain > -0.5))
        {
          std::ostringstream message;
          message << "the law '" << law_name
                  << "' has no thickness free of stress at the in-plane "
                     "Green-Lagrange strain of trace "
                  << trace(strain) << "; allowed: less than "
                  << 0.5 / lame.contraction;
          throw Base::InadmissibleState(message.str());
        }
      return strain;
    }

    template <int dim>
    double
    SaintVenantKirchhoff<dim>::energy_density(
      const dealii::Tensor<2, dim> &H) const
    {
      const auto   strain     = admissible_strain(H);
      const double dilatation = trace(strain);
      return 0.5 * lame.lambda * dilatation * dilatation +
             lame.mu * (strain * strain);
    }

    template <int dim>
    dealii::Tensor<2, dim>
    SaintVenantKirchhoff<dim>::first_piola_kirchhoff(
      const dealii::Tensor<2, dim> &H) const
    {
      return deformation_gradient(H) *
             dealii::Tensor<2, dim>(
               second_piola_kirchhoff(admissible_strain(H), lame));
    }

    template <int dim>
    dealii::Tensor<4, dim>
    SaintVenantKirchhoff<dim>::tangent(const dealii::Tensor<2, dim> &H) const
    {
      const auto F = deformation_gradient(H);
      const auto S = second_piola_kirchhoff(admissible_strain(H), lame);
      const auto B = F * transpose(F);
      dealii::Tensor<4, dim> A;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          for (int k = 0; k < dim; ++k)
            for (int l = 0; l < dim; ++l)
              A[i][j][k][l] =
                (i == k ? S[j][l] : 0.) + (j == l ? lame.mu * B[i][k] : 0.) +
                lame.lambda * F[i][j] * F[k][l] + lame.mu * F[i][l] * F[k][j];
      return A;
    }

    template <int dim>
    double
    SaintVenantKirchhoff<dim>::out_of_plane_stress(
      const dealii::Tensor<2, dim> &H) const
    {
      const auto strain = admissible_strain(H);
      return state == PlaneState::plane_strain ? lame.lambda * trace(strain)
                                               : 0.;
    }

    template <int dim>
    double
    SaintVenantKirchhoff<dim>::out_of_plane_stretch(
      const dealii::Tensor<2, dim> &H) const
    {
      return std::sqrt(1. -
                       2. * lame.contraction * trace(admissible_strain(H)));
    }

    template <int dim>
    double
    SaintVenantKirchhoff<dim>::shear_modulus() const
    {
      return lame.mu;
    }

    template class SaintVenantKirchhoff<2>;
    template class SaintVenantKirchhoff<3>;
  } // namespace Materials
} // namespace Perimorph
