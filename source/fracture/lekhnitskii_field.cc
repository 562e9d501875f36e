#include <perimorph/fracture/lekhnitskii_field.h>

#include <cmath>

namespace Perimorph::Fracture
{
  namespace
  {
    using Complex = std::complex<double>;

    const double pi = std::acos(-1.);

    /// A function f of a root m: f(m_1), f(m_2) and (f(m_1) - f(m_2)) /
    /// (m_1 - m_2).
    struct Pair
    {
      Complex first, second, difference;
    };

    Pair
    operator*(const Pair &f, const Pair &g)
    {
      return {f.first * g.first,
              f.second * g.second,
              f.first * g.difference + f.difference * g.second};
    }

    Pair
    operator*(const double factor, const Pair &f)
    {
      return {factor * f.first, factor * f.second, factor * f.difference};
    }

    Pair
    operator+(const Pair &f, const Pair &g)
    {
      return {f.first + g.first,
              f.second + g.second,
              f.difference + g.difference};
    }

    Pair
    inverse(const Pair &f)
    {
      return {1. / f.first,
              1. / f.second,
              -f.difference / (f.first * f.second)};
    }

    /// Of a function on one side of the negative axis.
    Pair
    root(const Pair &f)
    {
      const Complex first = std::sqrt(f.first), second = std::sqrt(f.second);
      return {first, second, f.difference / (first + second)};
    }

    /// As above.
    Pair
    logarithm(const Pair &f)
    {
      const Complex sum   = f.first + f.second;
      const Complex ratio = (f.first - f.second) / sum;
      const Complex factor =
        ratio == 0. ? Complex(1.) : std::atanh(ratio) / ratio;
      return {std::log(f.first),
              std::log(f.second),
              2. * f.difference / sum * factor};
    }

    /// What the real parts of the potentials add up to.
    double
    sum(const NearTipField field, const Pair &m, const Pair &f)
    {
      switch (field)
        {
          case NearTipField::opening:
            return (f.first - m.first * f.difference).real() /
                   std::sqrt(2. * pi);
          case NearTipField::sliding:
            return -f.difference.real() / std::sqrt(2. * pi);
          default:
            return -f.difference.imag() / (2. * pi);
        }
    }
  } // namespace

  NearTipState<2>
  lekhnitskii_state(const NearTipField          field,
                    const AnisotropicConstants &constants,
                    const double                x,
                    const double                y)
  {
    const auto &S     = constants.compliance;
    const auto  roots = constants.roots();
    const Pair  one   = {1., 1., 0.};
    const Pair  m     = {roots[0], roots[1], 1.};
    // x + m y keeps the sign of a zero y: the side of the crack
    const Pair z = {Complex(x + roots[0].real() * y, roots[0].imag() * y),
                    Complex(x + roots[1].real() * y, roots[1].imag() * y),
                    y};
    // displacement = (p, q) times a potential
    const Pair p = S[0][0] * (m * m) + S[0][1] * one + -S[0][2] * m;
    const Pair q = S[0][1] * m + S[1][1] * inverse(m) + -S[1][2] * one;

    const bool is_force = field == NearTipField::point_force;
    const Pair slope    = is_force ? inverse(z) : inverse(root(z));
    const Pair value    = is_force ? logarithm(z) : 2. * root(z);

    NearTipState<2> state;
    state.displacement[0] = sum(field, m, p * value);
    state.displacement[1] = sum(field, m, q * value);
    state.gradient[0][0]  = sum(field, m, p * slope);
    state.gradient[0][1]  = sum(field, m, p * m * slope);
    state.gradient[1][0]  = sum(field, m, q * slope);
    state.gradient[1][1]  = sum(field, m, q * m * slope);
    state.stress[0][0]    = sum(field, m, m * m * slope);
    state.stress[1][1]    = sum(field, m, slope);
    state.stress[0][1] = state.stress[1][0] = -sum(field, m, m * slope);
    return state;
  }
} // namespace Perimorph::Fracture
