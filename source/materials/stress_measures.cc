#include <perimorph/materials/principal_stretches.h>
#include <perimorph/materials/stress_measures.h>

namespace Perimorph
{
  namespace Materials
  {
    namespace
    {
      /// 1/2 ln(F F^T) of F = I + H.
      dealii::SymmetricTensor<2, 3>
      logarithmic_strain(const dealii::Tensor<2, 3> &H,
                         const std::string          &law_name)
      {
        const auto stretches =
          principal_stretches(left_cauchy_green_change(H),
                              volume_ratio(H, law_name.c_str()));
        dealii::SymmetricTensor<2, 3> strain;
        for (int a = 0; a < 3; ++a)
          strain += 0.5 * stretches.logarithm[a] *
                    symmetrize(outer_product(stretches.direction[a],
                                             stretches.direction[a]));
        return strain;
      }
    } // namespace

    template <int dim>
    StressMeasures
    stress_measures(const Material<dim> &law, const dealii::Tensor<2, dim> &H)
    {
      const auto           P = law.first_piola_kirchhoff(H);
      StressMeasures       measures;
      dealii::Tensor<2, 3> gradient;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          {
            gradient[a][b]                       = H[a][b];
            measures.first_piola_kirchhoff[a][b] = P[a][b];
          }
      if (dim == 2)
        {
          gradient[2][2] = law.out_of_plane_stretch(H) - 1.;
          measures.first_piola_kirchhoff[2][2] = law.out_of_plane_stress(H);
        }
      measures.deformation_gradient = deformation_gradient(gradient);
      if (law.is_linear())
        {
          measures.kirchhoff = symmetrize(measures.first_piola_kirchhoff);
          measures.cauchy    = measures.kirchhoff;
          measures.strain    = symmetrize(gradient);
          return measures;
        }
      measures.kirchhoff = symmetrize(measures.first_piola_kirchhoff *
                                      transpose(measures.deformation_gradient));
      measures.cauchy =
        measures.kirchhoff / determinant(measures.deformation_gradient);
      measures.strain = logarithmic_strain(gradient, law.name());
      return measures;
    }

    template StressMeasures
    stress_measures(const Material<2> &, const dealii::Tensor<2, 2> &);
    template StressMeasures
    stress_measures(const Material<3> &, const dealii::Tensor<2, 3> &);
  } // namespace Materials
} // namespace Perimorph
