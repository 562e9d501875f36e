#include <perimorph/base/lanes.h>
#include <perimorph/peridynamics/correspondence.h>

#include <type_traits>

namespace Perimorph::Peridynamics
{
  namespace
  {
    /// Sums in lanes of eight, of four, and one by one.
    template <int dim>
    struct TensorSums
    {
      Base::EightLanes       of_eight[dim][dim] = {};
      Base::FourLanes        of_four[dim][dim]  = {};
      dealii::Tensor<2, dim> of_one;

      Base::EightLanes &
      entry(const int a, const int b, Base::EightLanes)
      {
        return of_eight[a][b];
      }
      Base::FourLanes &
      entry(const int a, const int b, Base::FourLanes)
      {
        return of_four[a][b];
      }
      double &
      entry(const int a, const int b, double)
      {
        return of_one[a][b];
      }

      dealii::Tensor<2, dim>
      total() const
      {
        auto sum = of_one;
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            sum[a][b] += Base::sum_of_lanes(of_four[a][b] +
                                            Base::fold_lanes(of_eight[a][b]));
        return sum;
      }
    };

    /// Of one bond, from one array per component.
    template <int dim>
    dealii::Tensor<1, dim>
    vector_at(const double      *components,
              const std::size_t  stride,
              const unsigned int bond)
    {
      dealii::Tensor<1, dim> vector;
      for (int a = 0; a < dim; ++a)
        vector[a] = components[a * stride + bond];
      return vector;
    }
  } // namespace

  template <int dim>
  std::vector<double>
  by_components(const dealii::Tensor<1, dim> *vectors, const std::size_t n)
  {
    std::vector<double> result(dim * n);
    for (std::size_t j = 0; j < n; ++j)
      for (int a = 0; a < dim; ++a)
        result[a * n + j] = vectors[j][a];
    return result;
  }

  template <int dim>
  dealii::Tensor<2, dim>
  displacement_gradient(const Family<dim> &family, const double *eta)
  {
    TensorSums<dim> H;
    Base::for_lanes(
      family.n_gradient_bonds,
      [&](const unsigned int j, const auto zero) DEAL_II_ALWAYS_INLINE {
        using Lanes = std::decay_t<decltype(zero)>;
        Lanes g[dim];
        for (int b = 0; b < dim; ++b)
          g[b] = Base::load_lanes<Lanes>(family.gradient_weight +
                                         b * family.stride + j);
        for (int a = 0; a < dim; ++a)
          {
            const auto value =
              Base::load_lanes<Lanes>(eta + a * family.n_bonds + j);
            for (int b = 0; b < dim; ++b)
              H.entry(a, b, zero) += value * g[b];
          }
      });
    return H.total();
  }

  template <int dim>
  double
  stabilization_energy(const Family<dim>            &family,
                       const double                 *eta,
                       const dealii::Tensor<2, dim> &H)
  {
    double sum = 0.;
    for (unsigned int j = 0; j < family.n_bonds; ++j)
      {
        const auto z = vector_at<dim>(eta, family.n_bonds, j) -
                       H * vector_at<dim>(family.xi, family.stride, j);
        sum += family.bond_weight[j] * z.norm_square();
      }
    return 0.5 * family.stabilization * sum;
  }

  template <int dim>
  void
  family_forces(const Family<dim>            &family,
                const double                 *eta,
                const dealii::Tensor<2, dim> &H,
                const dealii::Tensor<2, dim> &first_piola_kirchhoff,
                double                       *forces)
  {
    const unsigned int n = family.n_bonds;
    TensorSums<dim>    stress;
    stress.of_one = first_piola_kirchhoff;
    Base::for_lanes(
      n,
      [&](const unsigned int j, const auto zero) DEAL_II_ALWAYS_INLINE {
        using Lanes        = std::decay_t<decltype(zero)>;
        const Lanes spring = family.stabilization *
                             Base::load_lanes<Lanes>(family.bond_weight + j);
        Lanes xi[dim];
        for (int b = 0; b < dim; ++b)
          xi[b] = Base::load_lanes<Lanes>(family.xi + b * family.stride + j);
        for (int a = 0; a < dim; ++a)
          {
            auto z = Base::load_lanes<Lanes>(eta + a * n + j);
            for (int b = 0; b < dim; ++b)
              z -= H[a][b] * xi[b];
            const Lanes force = spring * z;
            for (int b = 0; b < dim; ++b)
              stress.entry(a, b, zero) -= force * xi[b];
            Base::store_lanes(force, forces + a * n + j);
          }
      });
    const auto total = stress.total();
    Base::for_lanes(
      family.n_gradient_bonds,
      [&](const unsigned int j, const auto zero) DEAL_II_ALWAYS_INLINE {
        using Lanes = std::decay_t<decltype(zero)>;
        for (int a = 0; a < dim; ++a)
          {
            auto force = Base::load_lanes<Lanes>(forces + a * n + j);
            for (int b = 0; b < dim; ++b)
              force +=
                total[a][b] * Base::load_lanes<Lanes>(family.gradient_weight +
                                                      b * family.stride + j);
            Base::store_lanes(force, forces + a * n + j);
          }
      });
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
        const auto xi = vector_at<dim>(family.xi, family.stride, j - 1);
        g[j] = vector_at<dim>(family.gradient_weight, family.stride, j - 1);
        p[j] = family.bond_weight[j - 1] * xi;
        g[0] -= g[j];
        p[0] -= p[j];
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            K[a][b] += p[j][a] * xi[b];
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
  template std::vector<double> by_components<dim>(                           \
    const dealii::Tensor<1, dim> *,                                          \
    std::size_t);                                                            \
  template dealii::Tensor<2, dim> displacement_gradient<dim>(                \
    const Family<dim> &,                                                     \
    const double *);                                                         \
  template double stabilization_energy<dim>(const Family<dim> &,             \
                                            const double *,                  \
                                            const dealii::Tensor<2, dim> &); \
  template void   family_forces<dim>(const Family<dim> &,                    \
                                   const double *,                         \
                                   const dealii::Tensor<2, dim> &,         \
                                   const dealii::Tensor<2, dim> &,         \
                                   double *);                              \
  template void   family_tangent<dim>(const Family<dim> &,                   \
                                    const dealii::Tensor<4, dim> &,        \
                                    dealii::FullMatrix<double> &);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Peridynamics
