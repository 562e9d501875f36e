#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/williams_field.h>
#include <perimorph/materials/anisotropic_stiffness.h>

#include <cmath>
#include <complex>

namespace Perimorph::Fracture
{
  namespace
  {
    using Complex = std::complex<double>;

    const double pi = std::acos(-1.);

    /// Components in the plane normal to the front.
    struct PlaneState
    {
      dealii::Tensor<1, 2> displacement;
      dealii::Tensor<2, 2> gradient;
      dealii::Tensor<2, 2> stress;
    };

    /// @param factor  K_I - i K_II
    PlaneState
    open_and_slide(const Complex           factor,
                   const NearTipConstants &constants,
                   const Complex           z)
    {
      const double  kappa = constants.kolosov;
      const Complex i(0., 1.);
      const Complex phi       = factor * std::sqrt(z) / std::sqrt(2. * pi);
      const Complex slope     = 0.5 * phi / z;
      const Complex curvature = -0.5 * slope / z;
      // omega = phi, at the mirrored point
      const Complex mirrored =
        factor * std::sqrt(std::conj(z)) / std::sqrt(2. * pi);
      const Complex mirrored_slope = 0.5 * mirrored / std::conj(z);
      const Complex twice_y(0., 2. * z.imag());

      const double  scale = 0.5 / constants.shear_modulus;
      const Complex u =
        scale * (kappa * phi - mirrored - twice_y * std::conj(slope));
      const Complex u_x = scale * (kappa * slope - mirrored_slope -
                                   twice_y * std::conj(curvature));
      const Complex u_y =
        scale * i *
        (kappa * slope + mirrored_slope - 2. * std::conj(slope) +
         twice_y * std::conj(curvature));
      const double  trace = 4. * slope.real();
      const Complex s_y   = slope + mirrored_slope + // s_yy - i s_xy
                          twice_y * std::conj(curvature);

      PlaneState state;
      state.displacement   = dealii::Tensor<1, 2>({u.real(), u.imag()});
      state.gradient[0][0] = u_x.real();
      state.gradient[1][0] = u_x.imag();
      state.gradient[0][1] = u_y.real();
      state.gradient[1][1] = u_y.imag();
      state.stress[0][0]   = trace - s_y.real();
      state.stress[1][1]   = s_y.real();
      state.stress[0][1] = state.stress[1][0] = -s_y.imag();
      return state;
    }

    PlaneState
    pull(const NearTipConstants &constants, const Complex z)
    {
      const double r     = std::abs(z);
      const double theta = std::arg(z);
      const double c     = z.real() / r;
      const double s     = z.imag() / r;
      const double mu    = constants.shear_modulus;
      const double plus  = (constants.kolosov + 1.) / (8. * pi * mu);
      const double minus = (constants.kolosov - 1.) / (8. * pi * mu);
      const double other = 1. / (4. * pi * mu);

      PlaneState state;
      state.displacement[0] = -plus * std::log(r) - other * s * s;
      state.displacement[1] = -minus * theta + other * s * c;
      const dealii::Tensor<1, 2> radial({c, s});
      const dealii::Tensor<1, 2> around({-s / r, c / r}); // grad theta
      state.gradient[0] = -plus / r * radial - other * 2. * s * c * around;
      state.gradient[1] = (other * (c * c - s * s) - minus) * around;
      state.stress      = -c / (pi * r) * dealii::outer_product(radial, radial);
      return state;
    }
  } // namespace

  TipFrame<2>
  tip_frame(const dealii::Point<2>     &origin,
            const dealii::Tensor<1, 2> &direction)
  {
    const dealii::Tensor<1, 2> along = direction / direction.norm();
    return {origin, {{along, dealii::Tensor<1, 2>({-along[1], along[0]})}}, 0.};
  }

  template <int dim>
  NearTipConstants
  near_tip_constants(const Materials::Material<dim> &material)
  {
    if (Materials::is_anisotropic(material.name()))
      throw Base::InputError(Base::InputMessage{
        "parameter 'Material / law'",
        "'" + material.name() + "' at a crack tip",
        "isotropic laws where stress intensity factors are computed",
        ""});
    const dealii::Tensor<2, dim> rest;
    const auto                   A      = material.tangent(rest);
    const double                 mu     = A[0][1][0][1];
    const double                 lambda = A[0][0][1][1];
    return {mu, (lambda + 3. * mu) / (lambda + mu)};
  }

  template <int dim>
  NearTipState<dim>
  near_tip_state(const NearTipField        field,
                 const NearTipConstants   &constants,
                 const TipFrame<dim>      &frame,
                 const dealii::Point<dim> &point)
  {
    const dealii::Tensor<1, dim> away = point - frame.origin;
    const Complex                z(away * frame.axes[0], away * frame.axes[1]);

    NearTipState<dim> local;
    if (field == NearTipField::tearing)
      {
        if constexpr (dim == 3)
          {
            const Complex f = std::sqrt(2. * z / pi) / constants.shear_modulus;
            const Complex slope   = 0.5 * f / z;
            local.displacement[2] = f.imag();
            local.gradient[2][0]  = slope.imag();
            local.gradient[2][1]  = slope.real();
            for (int a = 0; a < 2; ++a)
              local.stress[2][a] = local.stress[a][2] =
                constants.shear_modulus * local.gradient[2][a];
          }
      }
    else
      {
        const PlaneState plane =
          field == NearTipField::point_force
            ? pull(constants, z)
            : open_and_slide(field == NearTipField::opening ? Complex(1., 0.)
                                                            : Complex(0., -1.),
                             constants,
                             z);
        for (int i = 0; i < 2; ++i)
          {
            local.displacement[i] = plane.displacement[i];
            for (int j = 0; j < 2; ++j)
              {
                local.gradient[i][j] = plane.gradient[i][j];
                local.stress[i][j]   = plane.stress[i][j];
              }
          }
        if constexpr (dim == 3)
          local.stress[2][2] =
            0.25 * (3. - constants.kolosov) * trace(plane.stress);
      }

    dealii::Tensor<2, dim> rotation; // local to global
    for (int i = 0; i < dim; ++i)
      for (int a = 0; a < dim; ++a)
        rotation[i][a] = frame.axes[a][i];
    return {rotation * local.displacement,
            rotation * local.gradient * transpose(rotation),
            rotation * local.stress * transpose(rotation)};
  }

#define INSTANTIATE(dim)                                                   \
  template NearTipConstants near_tip_constants<dim>(                       \
    const Materials::Material<dim> &);                                     \
  template NearTipState<dim> near_tip_state<dim>(NearTipField,             \
                                                 const NearTipConstants &, \
                                                 const TipFrame<dim> &,    \
                                                 const dealii::Point<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
