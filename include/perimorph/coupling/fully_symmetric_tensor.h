#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace Perimorph::Coupling
{
  /// Numbers of the components of fully symmetric tensors: one per set of
  /// indices {a <= b <= c <= d}, in the order of the sets read as numbers.
  template <int dim>
  struct SymmetricIndices
  {
    static constexpr unsigned int n3 = dim == 2 ? 4 : 10; ///< of rank 3
    static constexpr unsigned int n4 = dim == 2 ? 5 : 15; ///< of rank 4

    /// Component of rank 4 that holds index (triple, axis).
    struct Extension
    {
      unsigned int triple;
      unsigned int axis;
      unsigned int component;
    };

    std::array<std::array<unsigned int, 3>, n3> triples{};
    std::array<std::array<unsigned int, 4>, n4> quadruples{};
    /// How many of the dim^3 and dim^4 indices a component stands for.
    std::array<unsigned int, n3> multiplicity3{};
    std::array<unsigned int, n4> multiplicity4{};
    /// Component of (a, b, c, d) at a + dim (b + dim (c + dim d)).
    std::array<unsigned char, dim * dim * dim * dim> component4{};
    /// All pairs of a component of rank 3 and an axis.
    std::array<Extension, dim * n3> extensions{};

    constexpr SymmetricIndices()
    {
      unsigned int n_triples = 0, n_quadruples = 0;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = a; b < dim; ++b)
          for (unsigned int c = b; c < dim; ++c)
            {
              triples[n_triples++] = {{a, b, c}};
              for (unsigned int d = c; d < dim; ++d)
                quadruples[n_quadruples++] = {{a, b, c, d}};
            }
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          for (unsigned int c = 0; c < dim; ++c)
            {
              // Without the leading 0 a set of three is one of four.
              ++multiplicity3[number(a, b, c, 0)];
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const unsigned int component = number(a, b, c, d);
                  ++multiplicity4[component];
                  component4[a + dim * (b + dim * (c + dim * d))] = component;
                }
            }
      for (unsigned int t = 0; t < n3; ++t)
        for (unsigned int d = 0; d < dim; ++d)
          extensions[dim * t + d] = {
            t,
            d,
            number(triples[t][0], triples[t][1], triples[t][2], d)};
    }

    /// Sets with fewer indices above 0 come first, then those with fewer 2.
    static constexpr unsigned int
    number(const unsigned int a,
           const unsigned int b,
           const unsigned int c,
           const unsigned int d)
    {
      const unsigned int n = (a > 0) + (b > 0) + (c > 0) + (d > 0);
      if (dim == 2)
        return n;
      return n * (n + 1) / 2 + (a == 2) + (b == 2) + (c == 2) + (d == 2);
    }
  };

  template <int dim>
  inline constexpr SymmetricIndices<dim> symmetric_indices{};

  /// Tensor of rank 4 that does not change under any exchange of indices: the
  /// stiffness of a set of bonds.
  ///
  /// One component per set of indices {a <= b <= c <= d}: 5 in 2D (0000,
  /// 0001, 0011, 0111, 1111), 15 in 3D.
  template <int dim>
  struct FullySymmetricTensor
  {
    static constexpr unsigned int n_components = SymmetricIndices<dim>::n4;

    std::array<double, n_components> components{};

    /// direction (x) direction (x) direction (x) direction
    static FullySymmetricTensor
    dyad(const dealii::Tensor<1, dim> &direction);

    /// Component that stands for index (a, b, c, d).
    static unsigned int
    component(const unsigned int a,
              const unsigned int b,
              const unsigned int c,
              const unsigned int d)
    {
      return symmetric_indices<dim>.component4[a +
                                               dim * (b + dim * (c + dim * d))];
    }

    /// How many of the dim^4 indices a component stands for.
    static unsigned int
    multiplicity(const unsigned int component)
    {
      return symmetric_indices<dim>.multiplicity4[component];
    }

    double
    operator()(const unsigned int a,
               const unsigned int b,
               const unsigned int c,
               const unsigned int d) const
    {
      return components[component(a, b, c, d)];
    }

    /// Adds factor * other.
    void
    add(double factor, const FullySymmetricTensor &other);

    /// sigma_ab = C_abcd strain_cd.
    dealii::SymmetricTensor<2, dim>
    contract(const dealii::SymmetricTensor<2, dim> &strain) const;

    /// All dim^4 components.
    dealii::Tensor<4, dim>
    full() const;

    /// Frobenius norm of the full tensor.
    double
    norm() const;
  };
} // namespace Perimorph::Coupling
