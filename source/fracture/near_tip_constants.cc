#include <perimorph/fracture/near_tip_constants.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Fracture
{
  namespace
  {
    using Complex = std::complex<double>;
  } // namespace

  TipFrame<2>
  tip_frame(const dealii::Point<2>     &origin,
            const dealii::Tensor<1, 2> &direction)
  {
    const dealii::Tensor<1, 2> along = direction / direction.norm();
    return {origin, {{along, dealii::Tensor<1, 2>({-along[1], along[0]})}}, 0.};
  }

  std::array<Complex, 2>
  AnisotropicConstants::roots() const
  {
    const Complex half = 0.5 * root_sum;
    const Complex away = std::sqrt(half * half - root_product);
    return {{half + away, half - away}};
  }

  AnisotropicConstants
  anisotropic_constants(const dealii::SymmetricTensor<2, 3> &S)
  {
    // eigenvalues of the companion matrix
    const std::array<double, 4> powers = {
      {S[1][1], -2. * S[1][2], 2. * S[0][1] + S[2][2], -2. * S[0][2]}};
    dealii::LAPACKFullMatrix<double> companion(4);
    for (int k = 0; k < 4; ++k)
      {
        if (k > 0)
          companion(k, k - 1) = 1.;
        companion(k, 3) = -powers[k] / S[0][0];
      }
    companion.compute_eigenvalues();
    std::array<Complex, 4> roots;
    for (int k = 0; k < 4; ++k)
      roots[k] = companion.eigenvalue(k);
    std::sort(
      roots.begin(),
      roots.end(),
      [](const Complex &a, const Complex &b) { return a.imag() > b.imag(); });
    return {S, roots[0] + roots[1], roots[0] * roots[1]};
  }

  template <int dim>
  IsotropicConstants
  isotropic_constants(const Materials::Material<dim> &material)
  {
    const auto   A      = material.tangent(dealii::Tensor<2, dim>());
    const double mu     = A[0][1][0][1];
    const double lambda = A[0][0][1][1];
    return {mu, (lambda + 3. * mu) / (lambda + mu)};
  }

  template <int dim>
  bool
  is_isotropic(const Materials::Material<dim> &material)
  {
    const auto   A       = material.tangent(dealii::Tensor<2, dim>());
    const double mu      = A[0][1][0][1];
    const double lambda  = A[0][0][1][1];
    double       largest = 0., difference = 0.;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < dim; ++l)
            {
              const double isotropic =
                lambda * (i == j && k == l) +
                mu * ((i == k && j == l) + (i == l && j == k));
              largest = std::max(largest, std::abs(A[i][j][k][l]));
              difference =
                std::max(difference, std::abs(A[i][j][k][l] - isotropic));
            }
    return difference <= 1e-9 * largest;
  }

  dealii::SymmetricTensor<2, 3>
  plane_compliance(const Materials::Material<2> &material,
                   const TipFrame<2>            &frame)
  {
    const auto A = material.tangent(dealii::Tensor<2, 2>());
    constexpr std::array<std::array<int, 2>, 3> pairs = {
      {{{0, 0}}, {{1, 1}}, {{0, 1}}}};
    dealii::SymmetricTensor<2, 3> stiffness;
    for (int p = 0; p < 3; ++p)
      for (int q = p; q < 3; ++q)
        {
          const auto left  = dealii::outer_product(frame.axes[pairs[p][0]],
                                                  frame.axes[pairs[p][1]]);
          const auto right = dealii::outer_product(frame.axes[pairs[q][0]],
                                                   frame.axes[pairs[q][1]]);
          stiffness[p][q]  = dealii::scalar_product(
            left,
            dealii::double_contract<2, 0, 3, 1>(A, right));
        }
    return invert(stiffness);
  }

  template <int dim>
  std::optional<NearTipConstants>
  near_tip_constants(const Materials::Material<dim> &material,
                     const TipFrame<dim>            &frame)
  {
    if (is_isotropic(material))
      return isotropic_constants(material);
    if constexpr (dim == 2)
      return anisotropic_constants(plane_compliance(material, frame));
    else
      return std::nullopt;
  }

  dealii::SymmetricTensor<2, 2>
  inverse_barnett_lothe_tensor(const NearTipConstants &constants)
  {
    dealii::SymmetricTensor<2, 2> tensor;
    if (const auto *plane = std::get_if<AnisotropicConstants>(&constants))
      {
        const auto &S = plane->compliance;
        tensor[0][0]  = S[0][0] * plane->root_sum.imag();
        tensor[0][1]  = S[0][0] * plane->root_product.imag();
        tensor[1][1] =
          -S[1][1] * (plane->root_sum / plane->root_product).imag();
      }
    else
      tensor[0][0] = tensor[1][1] =
        2. / std::get<IsotropicConstants>(constants).plane_modulus();
    return tensor;
  }

  double
  axial_compliance(const NearTipConstants &constants)
  {
    if (const auto *plane = std::get_if<AnisotropicConstants>(&constants))
      return plane->compliance[0][0];
    return 1. / std::get<IsotropicConstants>(constants).plane_modulus();
  }

#define INSTANTIATE(dim)                                             \
  template IsotropicConstants isotropic_constants<dim>(              \
    const Materials::Material<dim> &);                               \
  template bool is_isotropic<dim>(const Materials::Material<dim> &); \
  template std::optional<NearTipConstants> near_tip_constants<dim>(  \
    const Materials::Material<dim> &,                                \
    const TipFrame<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
