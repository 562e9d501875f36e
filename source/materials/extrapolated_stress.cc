#include <perimorph/materials/extrapolated_stress.h>
#include <perimorph/materials/finite_strain.h>

namespace Perimorph
{
  namespace Materials
  {
    template <int dim>
    dealii::Tensor<2, dim>
    extrapolated_stress(const Material<dim>          &material,
                        const dealii::Tensor<2, dim> &H,
                        const dealii::Tensor<2, dim> &step)
    {
      const dealii::Tensor<2, dim> inverse = invert(deformation_gradient(H));
      const dealii::Tensor<2, dim> S =
        inverse * material.first_piola_kirchhoff(H);
      const dealii::Tensor<2, dim> dP =
        dealii::double_contract<2, 0, 3, 1>(material.tangent(H), step);
      return S + inverse * (dP - step * S);
    }

    template <int dim>
    dealii::Tensor<4, dim>
    tangent_with_stress(const Material<dim>          &material,
                        const dealii::Tensor<2, dim> &H,
                        const dealii::Tensor<2, dim> &S)
    {
      auto                         A = material.tangent(H);
      const dealii::Tensor<2, dim> difference =
        S - invert(deformation_gradient(H)) * material.first_piola_kirchhoff(H);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          for (int l = 0; l < dim; ++l)
            A[i][j][i][l] += 0.5 * (difference[j][l] + difference[l][j]);
      return A;
    }

#define INSTANTIATE(dim)                                    \
  template dealii::Tensor<2, dim> extrapolated_stress<dim>( \
    const Material<dim> &,                                  \
    const dealii::Tensor<2, dim> &,                         \
    const dealii::Tensor<2, dim> &);                        \
  template dealii::Tensor<4, dim> tangent_with_stress<dim>( \
    const Material<dim> &,                                  \
    const dealii::Tensor<2, dim> &,                         \
    const dealii::Tensor<2, dim> &);
    INSTANTIATE(2)
    INSTANTIATE(3)
#undef INSTANTIATE
  } // namespace Materials
} // namespace Perimorph
