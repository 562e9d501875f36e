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
    for (unsigned int j = 0; j < family.n_gradient_bonds; ++j)
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
    for (unsigned int j = 0; j < family.n_bonds; ++j)
      {
        const auto   xi     = family.xi[j];
        const double spring = kappa * family.bond_weight[j];
        for (int a = 0; a < dim; ++a)
          {
            double z = eta[j][a];
            for (int b = 0; b < dim; ++b)
              z -= H[a][b] * xi[b];
            const double force = spring * z;
            forces[j][a]       = force;
            for (int b = 0; b < dim; ++b)
              stress[a][b] -= force * xi[b];
          }
      }
    for (unsigned int j = 0; j < family.n_gradient_bonds; ++j)
      forces[j] += stress * family.gradient_weight[j];
  }

  template <int dim>
  void
  family_tangent(const Family<dim>            &family,
                 const dealii::Tensor<4, dim> &A,
                 dealii::FullMatrix<double>   &matrix)
  {
    const unsigned int n = family.n_bonds + 1;
    matrix.reinit(dim * n, dim * n, true);

    // The energy of the z_j = eta_j - H xi_j is a quadratic form with scalar
    // coefficients kappa (D_rc + g_r . (K g_c - p_c) - p_r . g_c) between
    // nodes r and c, the particle first: g and p = w xi are minus their sums
    // there, D is the form of springs w from the particle, K the shape tensor.
    std::vector<dealii::Tensor<1, dim>> g(n), p(n);
    dealii::Tensor<2, dim>              K;
    for (unsigned int j = 1; j < n; ++j)
      {
        g[j] = family.gradient_weight[j - 1];
        p[j] = family.bond_weight[j - 1] * family.xi[j - 1];
        g[0] -= g[j];
        p[0] -= p[j];
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            K[a][b] += p[j][a] * family.xi[j - 1][b];
      }
    const double                        kappa = family.stabilization;
    std::vector<dealii::Tensor<3, dim>> A_g(n);
    std::vector<dealii::Tensor<1, dim>> q(n), kappa_g(n);
    for (unsigned int c = 0; c < n; ++c)
      {
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k)
            for (int m = 0; m < dim; ++m)
              A_g[c][i][k][m] = A[i][m][k] * g[c];
        q[c]       = kappa * (K * g[c] - p[c]);
        kappa_g[c] = kappa * g[c];
      }
    for (unsigned int r = 0; r < n; ++r)
      for (int i = 0; i < dim; ++i)
        {
          double *row = &matrix(dim * r + i, 0);
          for (unsigned int c = 0; c < n; ++c, row += dim)
            {
              for (int k = 0; k < dim; ++k)
                {
                  row[k] = 0.;
                  for (int m = 0; m < dim; ++m)
                    row[k] += g[r][m] * A_g[c][i][k][m];
                }
              for (int m = 0; m < dim; ++m)
                row[i] += g[r][m] * q[c][m] - p[r][m] * kappa_g[c][m];
            }
        }
    for (unsigned int j = 1; j < n; ++j)
      for (int i = 0; i < dim; ++i)
        {
          const double spring = kappa * family.bond_weight[j - 1];
          matrix(i, i) += spring;
          matrix(dim * j + i, dim * j + i) += spring;
          matrix(i, dim * j + i) -= spring;
          matrix(dim * j + i, i) -= spring;
        }
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
