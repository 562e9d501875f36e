#include <perimorph/fracture/crack_quantities.h>

#include "near_tip_bodies.h"
#include <gtest/gtest.h>

#include <complex>

namespace
{
  using namespace Perimorph;
  using namespace Perimorph::Fracture;
  using Complex = std::complex<double>;

  constexpr double half_length = 1.;

  /// Infinite plate in plane strain, E = 1, crack of length 2 in a direction,
  /// tension 1 along y (complex potentials of Muskhelishvili).
  class SlantCrack
  {
  public:
    SlantCrack(const double angle, const dealii::Point<2> &center)
      : turn(std::polar(1., angle))
      , center(center[0], center[1])
      , normal(std::cos(angle) * std::cos(angle))
      , shear(std::sin(angle) * std::cos(angle))
      , along(std::sin(angle) * std::sin(angle))
      , constants(Testing::NearTipCase().isotropic_constants())
    {}

    dealii::Tensor<1, 2>
    displacement(const dealii::Point<2> &x) const
    {
      // Loads on the faces, normal and shear, and the uniform field.
      const Complex z = (Complex(x[0], x[1]) - center) / turn;
      const Complex u = (faces(z) + uniform(z)) * turn;
      return dealii::Tensor<1, 2>({u.real(), u.imag()});
    }

    double
    K_I() const
    {
      return normal * std::sqrt(std::acos(-1.) * half_length);
    }

    double
    K_II() const
    {
      return shear * std::sqrt(std::acos(-1.) * half_length);
    }

    std::unique_ptr<Materials::Material<2>>
    law() const
    {
      return Testing::NearTipCase().law();
    }

    Bonds::CrackSet<2>
    crack() const
    {
      Bonds::CrackFacet<2> facet;
      for (unsigned int k = 0; k < 2; ++k)
        {
          const Complex end =
            center + (k == 0 ? -half_length : half_length) * turn;
          facet.corners[k] = dealii::Point<2>(end.real(), end.imag());
        }
      return Bonds::CrackSet<2>({facet});
    }

  private:
    Complex turn, center;
    double  normal, shear, along; ///< stress in the axes of the crack
    IsotropicConstants constants;

    /// sqrt(z^2 - a^2) with the cut on the crack.
    static Complex
    root(const Complex z)
    {
      return std::sqrt(z - half_length) * std::sqrt(z + half_length);
    }

    /// phi = omega = (s - i t) / 2 (root - z): opposite tractions on the faces.
    Complex
    faces(const Complex z) const
    {
      const Complex load(0.5 * normal, -0.5 * shear);
      const Complex slope = load * (z / root(z) - 1.);
      const Complex other = load * (root(std::conj(z)) - std::conj(z));
      return (constants.kolosov * load * (root(z) - z) - other -
              (z - std::conj(z)) * std::conj(slope)) /
             (2. * constants.shear_modulus);
    }

    /// Strains of the uniform stress, by lambda and mu of plane strain.
    Complex
    uniform(const Complex z) const
    {
      const double mu    = constants.shear_modulus;
      const double share = 0.25 * (3. - constants.kolosov); // Poisson's ratio
      const double mean  = share * (normal + along);
      const double e_x   = (along - mean) / (2. * mu),
                   e_y   = (normal - mean) / (2. * mu);
      const double e_xy  = shear / (2. * mu);
      return Complex(e_x * z.real() + e_xy * z.imag(),
                     e_xy * z.real() + e_y * z.imag());
    }
  };

  /// Infinite anisotropic plate with a crack of length 2 under stresses 1
  /// across and 0.4 in shear in the axes of the crack (S. G. Lekhnitskii,
  /// Anisotropic Plates, 1968).
  class AnisotropicCrack
  {
  public:
    AnisotropicCrack(const double angle, const dealii::Point<2> &center)
    {
      body.angle     = angle;
      body.tip       = center;
      body.stiffness = Testing::graphite_epoxy(0.9);
      plane          = std::get<AnisotropicConstants>(body.constants());
    }

    dealii::Tensor<1, 2>
    displacement(const dealii::Point<2> &point) const
    {
      const auto   frame  = body.frame();
      const auto   away   = point - body.tip;
      const double x      = away * frame.axes[0];
      const double y      = away * frame.axes[1];
      const auto  &S      = plane.compliance;
      const auto   strain = S * dealii::Tensor<1, 3>({0., across, shear});
      dealii::Tensor<1, 2> u({strain[0] * x + 0.5 * strain[2] * y,
                              0.5 * strain[2] * x + strain[1] * y});
      const auto           roots = plane.roots();
      for (const unsigned int k : {0u, 1u})
        {
          const Complex m = roots[k], other = roots[1 - k];
          const Complex z      = x + m * y;
          const Complex factor = -(shear + other * across) / (m - other);
          const Complex potential =
            factor *
            (std::sqrt(z - half_length) * std::sqrt(z + half_length) - z);
          u[0] +=
            ((S[0][0] * m * m + S[0][1] - S[0][2] * m) * potential).real();
          u[1] += ((S[0][1] * m + S[1][1] / m - S[1][2]) * potential).real();
        }
      return u[0] * frame.axes[0] + u[1] * frame.axes[1];
    }

    double
    K_I() const
    {
      return across * std::sqrt(std::acos(-1.) * half_length);
    }

    double
    K_II() const
    {
      return shear * std::sqrt(std::acos(-1.) * half_length);
    }

    double
    T_stress() const
    {
      return (shear * plane.root_sum + across * plane.root_product).real();
    }

    double
    J() const
    {
      auto tip = body;
      tip.K_I  = K_I();
      tip.K_II = K_II();
      return tip.exact_J();
    }

    Bonds::CrackSet<2>
    crack() const
    {
      const auto           along = half_length * body.frame().axes[0];
      Bonds::CrackFacet<2> facet;
      facet.corners = {{body.tip - along, body.tip + along}};
      return Bonds::CrackSet<2>({facet});
    }

    std::unique_ptr<Materials::Material<2>>
    law() const
    {
      return body.law();
    }

  private:
    static constexpr double across = 1., shear = 0.4;
    Testing::NearTipCase    body;
    AnisotropicConstants    plane;
  };

  constexpr unsigned int n_cells = 48; // h = a / 12

  /// Both tips of a crack, from the exact displacement of the nodes: everything
  /// between the parameter file and the numbers but the solve.
  template <typename Exact>
  std::vector<TipQuantities>
  tips_of(const Exact &exact, const bool with_families)
  {
    const auto      mesh = Testing::structured_mesh<2>({{n_cells, n_cells}},
                                                  dealii::Point<2>(-2., -2.),
                                                  dealii::Point<2>(2., 2.),
                                                  0.2);
    MaterialList<2> materials;
    materials.push_back(exact.law());
    std::vector<dealii::Tensor<1, 2>> displacement;
    for (const auto &x : mesh.nodes)
      displacement.push_back(exact.displacement(x));
    const auto                cracks = exact.crack();
    const std::vector<double> alpha(mesh.n_nodes(), 1.);
    std::vector<double>       horizon;
    for (const double h : mesh.spacing)
      horizon.push_back(1.5 * h);
    const auto families =
      Testing::cut_families(mesh, alpha, 1.5, cracks, *materials[0]);

    CrackedBody<2> body = {{mesh, materials, displacement},
                           cracks,
                           alpha,
                           horizon};
    if (with_families)
      body.families = &families;
    return tip_quantities(body, find_tips(mesh, cracks), {}, MPI_COMM_SELF);
  }

  // K_I = s sqrt(pi a) cos^2 b, K_II = s sqrt(pi a) sin b cos b. Tolerances
  // here and below: about 1.3 times the errors measured.
  TEST(CrackQuantities, both_tips_of_a_slant_crack)
  {
    const SlantCrack exact(0.4, dealii::Point<2>(0.02, -0.03));
    for (const bool with_families : {false, true})
      {
        const auto result = tips_of(exact, with_families);
        ASSERT_EQ(result.size(), 2u);
        EXPECT_LT(result[0].tip.frame.axes[0][0], 0.);
        for (const auto &tip : result)
          {
            const double modulus =
              Testing::NearTipCase().isotropic_constants().plane_modulus();
            ASSERT_EQ(tip.values.size(), 2u);
            EXPECT_EQ(tip.n_without_stress, 0u);
            EXPECT_LT(tip.domain_dependence(), with_families ? 2e-3 : 1e-3);
            for (const auto &value : tip.values)
              {
                EXPECT_NEAR(value.K_I / exact.K_I(),
                            1.,
                            with_families ? 1.5e-3 : 1.3e-3);
                EXPECT_NEAR(value.K_II / exact.K_II(),
                            1.,
                            with_families ? 1.3e-2 : 2.5e-3);
                EXPECT_NEAR(
                  value.J * modulus /
                    (exact.K_I() * exact.K_I() + exact.K_II() * exact.K_II()),
                  1.,
                  with_families ? 4.7e-3 : 1.4e-3);
              }
            EXPECT_NEAR(tip.opening.K_I / exact.K_I(), 1., 8e-3);
            EXPECT_NEAR(tip.opening.K_II / exact.K_II(), 1., 0.11);
          }
      }
  }

  // K_I = s sqrt(pi a), K_II = t sqrt(pi a), T = Re(t (m_1 + m_2) + s m_1 m_2).
  TEST(CrackQuantities, both_tips_of_a_crack_in_an_anisotropic_body)
  {
    const AnisotropicCrack exact(0.4, dealii::Point<2>(0.02, -0.03));
    for (const bool with_families : {false, true})
      for (const auto &tip : tips_of(exact, with_families))
        {
          EXPECT_FALSE(tip.is_isotropic);
          ASSERT_EQ(tip.values.size(), 2u);
          EXPECT_EQ(tip.n_without_stress, 0u);
          for (const auto &value : tip.values)
            {
              EXPECT_NEAR(value.K_I / exact.K_I(),
                          1.,
                          with_families ? 2.9e-3 : 2e-3);
              EXPECT_NEAR(value.K_II / exact.K_II(),
                          1.,
                          with_families ? 2.3e-2 : 7.6e-3);
              EXPECT_NEAR(value.J / exact.J(),
                          1.,
                          with_families ? 6.5e-3 : 1.5e-3);
              EXPECT_NEAR(value.T_stress / exact.T_stress(),
                          1.,
                          with_families ? 1.6e-2 : 2.6e-3);
            }
          EXPECT_NEAR(tip.opening.K_I / exact.K_I(), 1., 1.5e-2);
          EXPECT_NEAR(tip.opening.K_II / exact.K_II(), 1., 0.105);
        }
  }
} // namespace
