#include <perimorph/peridynamics/correspondence.h>

#include <vector>

namespace Perimorph::Peridynamics
{
  template <int dim>
  dealii::Tensor<2, dim>
  displacement_gradient(const Family<dim>            &family,
                        const dealii::Tensor<1, dim> *eta)
  {
    dealii::Tensor<2, dim> H;
    for (unsigned int j = 0; j < family.n_bonds; ++j)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          H[a][b] += eta[j][a] * family.gradient_weight[j][b];
    return H;
  }

  template <int dim>
  double
  stabilization_energy(const Family<dim>            &family,
                       const dealii::Tensor<1, dim> *eta,
                       const dealii::Tensor<2, dim> &H)
  {
    double sum = 0.;
    for (unsigned int j = 0; j < family.n_bonds; ++j)
      sum += family.bond_weight[j] * (eta[j] - H * family.xi[j]).norm_square();
    return 0.5 * family.stabilization * sum;
  }

  template <int dim>
  void
  family_forces(const Family<dim>            &family,
                const dealii::Tensor<1, dim> *eta,
                const dealii::Tensor<2, dim> &H,
                const dealii::Tensor<2, dim> &first_piola_kirchhoff,
                dealii::Tensor<1, dim>       *forces)
  {
    const double           kappa  = family.stabilization;
    dealii::Tensor<2, dim> stress = first_piola_kirchhoff;
    if (kappa == 0.)
      {
        for (unsigned int j = 0; j < family.n_bonds; ++j)
          forces[j] = stress * family.gradient_weight[j];
        return;
      }
    for (unsigned int j = 0; j < family.n_bonds; ++j)
      {
        forces[j] = kappa * family.bond_weight[j] * (eta[j] - H * family.xi[j]);
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            stress[a][b] -= forces[j][a] * family.xi[j][b];
      }
    for (unsigned int j = 0; j < family.n_bonds; ++j)
      forces[j] += stress * family.gradient_weight[j];
  }

  template <int dim>
  void
  family_tangent(const Family<dim>            &family,
                 const dealii::Tensor<4, dim> &A,
                 dealii::FullMatrix<double>   &matrix)
  {
    const unsigned int n = family.n_bonds + 1;
    matrix.reinit(dim * n, dim * n);

    // Gradient weights of all nodes of the block, the particle first.
    std::vector<dealii::Tensor<1, dim>> g(n);
    for (unsigned int j = 1; j < n; ++j)
      {
        g[j] = family.gradient_weight[j - 1];
        g[0] -= g[j];
      }
    for (unsigned int c = 0; c < n; ++c)
      {
        dealii::Tensor<3, dim> A_g;
        for (int i = 0; i < dim; ++i)
          for (int m = 0; m < dim; ++m)
            for (int k = 0; k < dim; ++k)
              A_g[i][m][k] = A[i][m][k] * g[c];
        for (unsigned int r = 0; r < n; ++r)
          for (int i = 0; i < dim; ++i)
            for (int k = 0; k < dim; ++k)
              {
                double sum = 0.;
                for (int m = 0; m < dim; ++m)
                  sum += g[r][m] * A_g[i][m][k];
                matrix(dim * r + i, dim * c + k) += sum;
              }
      }

    if (family.stabilization == 0.)
      return;
    // z_j = sum_k row_j[k] u_k with scalar coefficients.
    dealii::FullMatrix<double> scalar(n, n);
    std::vector<double>        row(n);
    for (unsigned int j = 1; j < n; ++j)
      {
        for (unsigned int k = 0; k < n; ++k)
          row[k] = -(g[k] * family.xi[j - 1]);
        row[j] += 1.;
        row[0] -= 1.;
        const double factor = family.stabilization * family.bond_weight[j - 1];
        for (unsigned int r = 0; r < n; ++r)
          {
            const double weighted = factor * row[r];
            for (unsigned int c = 0; c < n; ++c)
              scalar(r, c) += weighted * row[c];
          }
      }
    for (unsigned int r = 0; r < n; ++r)
      for (unsigned int c = 0; c < n; ++c)
        for (int i = 0; i < dim; ++i)
          matrix(dim * r + i, dim * c + i) += scalar(r, c);
  }

#define PERIMORPH_INSTANTIATE(dim)                                           \
  template dealii::Tensor<2, dim> displacement_gradient<dim>(                \
    const Family<dim> &,                                                     \
    const dealii::Tensor<1, dim> *);                                         \
  template double stabilization_energy<dim>(const Family<dim> &,             \
                                            const dealii::Tensor<1, dim> *,  \
                                            const dealii::Tensor<2, dim> &); \
  template void   family_forces<dim>(const Family<dim> &,                    \
                                   const dealii::Tensor<1, dim> *,         \
                                   const dealii::Tensor<2, dim> &,         \
                                   const dealii::Tensor<2, dim> &,         \
                                   dealii::Tensor<1, dim> *);              \
  template void   family_tangent<dim>(const Family<dim> &,                   \
                                    const dealii::Tensor<4, dim> &,        \
                                    dealii::FullMatrix<double> &);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Peridynamics
