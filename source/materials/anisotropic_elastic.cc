#include <perimorph/materials/anisotropic_elastic.h>

namespace Perimorph::Materials
{
  template <int dim>
  AnisotropicElastic<dim>::AnisotropicElastic(
    const std::string          &name,
    const LinearStiffness<dim> &stiffness)
    : law(name)
    , linear(stiffness)
    , full(stiffness.stiffness)
  {}

  template <int dim>
  std::string
  AnisotropicElastic<dim>::name() const
  {
    return law;
  }

  template <int dim>
  bool
  AnisotropicElastic<dim>::is_linear() const
  {
    return true;
  }

  template <int dim>
  double
  AnisotropicElastic<dim>::energy_density(const dealii::Tensor<2, dim> &H) const
  {
    const auto strain = symmetrize(H);
    return 0.5 * (strain * (linear.stiffness * strain));
  }

  template <int dim>
  dealii::Tensor<2, dim>
  AnisotropicElastic<dim>::first_piola_kirchhoff(
    const dealii::Tensor<2, dim> &H) const
  {
    return linear.stiffness * symmetrize(H);
  }

  template <int dim>
  dealii::Tensor<4, dim>
  AnisotropicElastic<dim>::tangent(const dealii::Tensor<2, dim> &) const
  {
    return full;
  }

  template <int dim>
  double
  AnisotropicElastic<dim>::out_of_plane_stress(
    const dealii::Tensor<2, dim> &H) const
  {
    return linear.out_of_plane_stress * symmetrize(H);
  }

  template <int dim>
  double
  AnisotropicElastic<dim>::out_of_plane_stretch(
    const dealii::Tensor<2, dim> &H) const
  {
    return 1. + linear.out_of_plane_strain * symmetrize(H);
  }

  template <int dim>
  double
  AnisotropicElastic<dim>::shear_modulus() const
  {
    return mean_shear_modulus(linear.stiffness);
  }

  template <int dim>
  double
  mean_shear_modulus(const dealii::SymmetricTensor<4, dim> &stiffness)
  {
    // The trace of the deviatoric part of S over the number of deviators.
    const auto   S    = invert(stiffness);
    const auto   unit = dealii::unit_symmetric_tensor<dim>();
    double       full = 0.;
    const double mean = unit * (S * unit) / dim;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        full += S[i][j][i][j];
    constexpr int n_deviators = dim * (dim + 1) / 2 - 1;
    return 0.5 * n_deviators / (full - mean);
  }

  template class AnisotropicElastic<2>;
  template class AnisotropicElastic<3>;
  template double
  mean_shear_modulus<2>(const dealii::SymmetricTensor<4, 2> &);
  template double
  mean_shear_modulus<3>(const dealii::SymmetricTensor<4, 3> &);
} // namespace Perimorph::Materials
