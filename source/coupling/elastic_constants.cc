#include <perimorph/coupling/elastic_constants.h>
#include <perimorph/materials/anisotropic_elastic.h>

namespace Perimorph::Coupling
{
  template <int dim>
  ElasticConstants
  elastic_constants(const Materials::Material<dim> &law)
  {
    const auto                      A = law.tangent(dealii::Tensor<2, dim>());
    dealii::SymmetricTensor<4, dim> stiffness;
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        for (int k = 0; k < dim; ++k)
          for (int l = k; l < dim; ++l)
            stiffness[i][j][k][l] = A[i][j][k][l];
    const auto       compliance = invert(stiffness);
    ElasticConstants constants;
    constants.shear_modulus = Materials::mean_shear_modulus(stiffness);
    for (int a = 0; a < dim; ++a)
      {
        auto &stress          = constants.along[a];
        stress.youngs_modulus = 1. / compliance[a][a][a][a];
        for (int i = 0; i < dim; ++i)
          for (int j = i; j < dim; ++j)
            stress.strain[i][j] =
              stress.youngs_modulus * compliance[i][j][a][a];
      }
    return constants;
  }

  template ElasticConstants
  elastic_constants<2>(const Materials::Material<2> &);
  template ElasticConstants
  elastic_constants<3>(const Materials::Material<3> &);
} // namespace Perimorph::Coupling
