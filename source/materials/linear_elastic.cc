#include <perimorph/materials/linear_elastic.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Perimorph
{
  namespace Materials
  {
    template <int dim>
    LinearElastic<dim>::LinearElastic(const double     youngs_modulus,
                                      const double     poissons_ratio,
                                      const PlaneState state)
      : state(state)
      , lame(lame_constants(youngs_modulus, poissons_ratio, state))
    {}

    template <int dim>
    std::string
    LinearElastic<dim>::name() const
    {
      return "linear elastic";
    }

    template <int dim>
    bool
    LinearElastic<dim>::is_linear() const
    {
      return true;
    }

    template <int dim>
    double
    LinearElastic<dim>::energy_density(const dealii::Tensor<2, dim> &H) const
    {
      const auto   strain     = symmetrize(H);
      const double dilatation = trace(strain);
      return 0.5 * lame.lambda * dilatation * dilatation +
             lame.mu * (strain * strain);
    }

    template <int dim>
    dealii::Tensor<2, dim>
    LinearElastic<dim>::first_piola_kirchhoff(
      const dealii::Tensor<2, dim> &H) const
    {
      const auto strain = symmetrize(H);
      return lame.lambda * trace(strain) *
               dealii::unit_symmetric_tensor<dim>() +
             2. * lame.mu * strain;
    }

    template <int dim>
    dealii::Tensor<4, dim>
    LinearElastic<dim>::tangent(const dealii::Tensor<2, dim> &) const
    {
      dealii::Tensor<4, dim> A;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            A[i][i][j][j] += lame.lambda;
            A[i][j][i][j] += lame.mu;
            A[i][j][j][i] += lame.mu;
          }
      return A;
    }

    template <int dim>
    double
    LinearElastic<dim>::out_of_plane_stress(
      const dealii::Tensor<2, dim> &H) const
    {
      return state == PlaneState::plane_strain
               ? lame.lambda * trace(symmetrize(H))
               : 0.;
    }

    template <int dim>
    double
    LinearElastic<dim>::out_of_plane_stretch(
      const dealii::Tensor<2, dim> &H) const
    {
      return 1. - lame.contraction * trace(symmetrize(H));
    }

    template <int dim>
    double
    LinearElastic<dim>::shear_modulus() const
    {
      return lame.mu;
    }

    template class LinearElastic<2>;
    template class LinearElastic<3>;
  } // namespace Materials
} // namespace Perimorph
