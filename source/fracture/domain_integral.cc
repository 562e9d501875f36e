#include <perimorph/fracture/domain_integral.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Perimorph::Fracture
{
  double
  Annulus::weight(const double distance) const
  {
    return std::clamp((outer - distance) / (outer - inner), 0., 1.);
  }

  namespace
  {
    // Of the free distance, what an annulus may use; its least width in
    // spacings.
    constexpr double share = 0.9, least_width = 2.;

    /// Families closer to the tip reach around it.
    double
    least_radius(const double horizon, const double spacing)
    {
      return horizon + spacing;
    }
  } // namespace

  double
  least_free_distance(const double horizon, const double spacing)
  {
    return (least_radius(horizon, spacing) + least_width * spacing) / share;
  }

  std::vector<Annulus>
  default_annuli(const double crack_length,
                 const double free_distance,
                 const double horizon,
                 const double spacing)
  {
    const double         room     = share * free_distance;
    const double         length   = std::min(crack_length, room);
    const double         smallest = least_radius(horizon, spacing);
    const Annulus        wanted[] = {{0.3 * length, 0.8 * length},
                                     {0.5 * length, length}};
    std::vector<Annulus> annuli;
    for (const auto &[inner, outer] : wanted)
      {
        Annulus annulus;
        annulus.inner = std::max(inner, smallest);
        annulus.outer =
          std::min(room, std::max(outer, annulus.inner + 3. * spacing));
        if (annulus.outer - annulus.inner >= least_width * spacing &&
            (annuli.empty() || annuli[0].outer < annulus.outer))
          annuli.push_back(annulus);
      }
    return annuli;
  }

  std::vector<double>
  annulus_weights(const Mesh::NodalMesh<2> &mesh,
                  const dealii::Point<2>   &tip,
                  const Annulus            &annulus)
  {
    std::vector<double> q;
    q.reserve(mesh.n_nodes());
    for (const auto &node : mesh.nodes)
      q.push_back(annulus.weight(node.distance(tip)));
    Mesh::set_hanging_values(mesh.hanging, q);
    return q;
  }

  namespace
  {
    /// True where a field is continued beyond the line behind the tip.
    bool
    changes_sign(const NearTipField field, const double branch)
    {
      return branch < 0. && field != NearTipField::point_force;
    }

    /// Divergence of the interaction flux: what keeps auxiliary fields that
    /// turn with a curved front from equilibrium and compatibility,
    /// (P t) . (dG e) - (t . e) P : dG + (dS t) . (H e) with the derivatives
    /// dG = W G - G W, dS = W S - S W along the tangent t, W = rate (t (x) d -
    /// d (x) t), d the direction of growth at x and e that of the advance.
    template <int dim>
    double
    flux_divergence(const StressPoint<dim>       &point,
                    const dealii::Tensor<1, dim> &advance,
                    const TipFrame<dim>          &frame,
                    const NearTipState<dim>      &other)
    {
      const auto  &forward = frame.axes.front();
      const auto  &tangent = frame.axes.back();
      const double rate =
        frame.curvature /
        (1. + frame.curvature * (forward * (point.x - frame.origin)));
      const auto  turn = rate * (dealii::outer_product(tangent, forward) -
                                dealii::outer_product(forward, tangent));
      const auto &P    = point.first_piola_kirchhoff;
      const auto  dG   = turn * other.gradient - other.gradient * turn;
      const auto  dS   = turn * other.stress - other.stress * turn;
      return (P * tangent) * (dG * advance) -
             (tangent * advance) * dealii::scalar_product(P, dG) +
             (dS * tangent) * (point.displacement_gradient * advance);
    }

    /// Mean of the derivative of an auxiliary displacement along the direction
    /// of advance over the square (cube) around a place: squares closer to the
    /// tip than twice their side are divided, the smallest at the tip left out
    /// (2^-8 of the mean of 1 / r, the strongest singularity). The field of the
    /// owner's side is continued past the crack.
    /// @param height  of the owner over the line of the crack
    template <int dim>
    dealii::Tensor<1, dim>
    mean_slope(const NearTipField            field,
               const NearTipConstants       &constants,
               const TipFrame<dim>          &frame,
               const dealii::Point<dim>     &place,
               const double                  side,
               const dealii::Tensor<1, dim> &direction,
               const double                  height,
               const unsigned int            n_divisions = 8)
    {
      const auto away = place - frame.origin;
      if (std::hypot(away * frame.axes[0], away * frame.axes[1]) >= 2. * side)
        {
          const auto slope =
            near_tip_state(field, constants, frame, place).gradient * direction;
          const bool is_beyond = changes_sign(field, -1.) &&
                                 away * frame.axes[0] < 0. &&
                                 (away * frame.axes[1]) * height < 0.;
          return is_beyond ? -slope : slope;
        }
      dealii::Tensor<1, dim> mean;
      if (n_divisions > 0)
        for (const double x : {-0.25, 0.25})
          for (const double y : {-0.25, 0.25})
            mean +=
              0.25 *
              mean_slope(field,
                         constants,
                         frame,
                         place + side * (x * frame.axes[0] + y * frame.axes[1]),
                         0.5 * side,
                         direction,
                         height,
                         n_divisions - 1);
      return mean;
    }

    // Of each kind of point: whether no integral feels it, its share of J and
    // of the interaction integral with a field on its own side of the crack.

    template <int dim>
    bool
    is_without_share(const StressPoint<dim> &point)
    {
      return point.q_gradient.norm_square() == 0. &&
             (dim == 2 || point.q == 0.);
    }

    template <int dim>
    double
    energy_release(const StressPoint<dim>       &point,
                   const dealii::Tensor<1, dim> &direction)
    {
      const auto u_along = point.displacement_gradient * direction;
      return point.volume *
             (u_along * (point.first_piola_kirchhoff * point.q_gradient) -
              point.energy_density * (point.q_gradient * direction));
    }

    template <int dim>
    double
    interaction(const StressPoint<dim>       &point,
                const NearTipField            field,
                const NearTipConstants       &constants,
                const TipFrame<dim>          &frame,
                const dealii::Tensor<1, dim> &direction)
    {
      const auto &P     = point.first_piola_kirchhoff;
      const auto &slope = point.q_gradient;
      double      sum   = 0.;
      if (slope.norm_square() != 0. || frame.curvature != 0.)
        {
          const auto other = near_tip_state(field, constants, frame, point.x);
          sum +=
            other.gradient * direction * (P * slope) +
            (point.displacement_gradient * direction) * (other.stress * slope) -
            dealii::scalar_product(P, other.gradient) * (slope * direction);
          if (frame.curvature != 0.)
            sum += point.q * flux_divergence(point, direction, frame, other);
        }
      return point.volume * sum;
    }

    template <int dim>
    bool
    is_without_share(const ForcePoint<dim> &point)
    {
      return point.q == 0.;
    }

    template <int dim>
    double
    energy_release(const ForcePoint<dim>        &point,
                   const dealii::Tensor<1, dim> &direction)
    {
      return point.volume * point.q *
             (point.stress_divergence *
              (point.displacement_gradient * direction));
    }

    template <int dim>
    double
    interaction(const ForcePoint<dim>        &point,
                const NearTipField            field,
                const NearTipConstants       &constants,
                const TipFrame<dim>          &frame,
                const dealii::Tensor<1, dim> &direction)
    {
      return point.volume * point.q *
             (point.stress_divergence *
              mean_slope(field,
                         constants,
                         frame,
                         point.x,
                         point.width,
                         direction,
                         (point.owner - frame.origin) * frame.axes[1]));
    }

    template <int dim>
    bool
    is_without_share(const FacePoint<dim> &point)
    {
      return point.q == 0.;
    }

    template <int dim>
    double
    energy_release(const FacePoint<dim>         &point,
                   const dealii::Tensor<1, dim> &direction)
    {
      return point.length * point.q * point.energy_density *
             (point.normal * direction);
    }

    template <int dim>
    double
    interaction(const FacePoint<dim>         &point,
                const NearTipField            field,
                const NearTipConstants       &constants,
                const TipFrame<dim>          &frame,
                const dealii::Tensor<1, dim> &direction)
    {
      const auto other = near_tip_state(field, constants, frame, point.x);
      return point.length * point.q *
             (dealii::scalar_product(point.first_piola_kirchhoff,
                                     other.gradient) *
                (point.normal * direction) -
              (other.stress * point.normal) *
                (point.displacement_gradient * direction));
    }
  } // namespace

  template <int dim>
  FractureQuantities
  fracture_quantities(const StressPointSet<dim>             &set,
                      const dealii::Tensor<1, dim>          &direction,
                      const FrameField<dim>                 &axes,
                      const double                           area,
                      const std::optional<NearTipConstants> &constants,
                      const MPI_Comm                         communicator)
  {
    constexpr std::array<NearTipField, 3> fields = {
      {NearTipField::opening,
       NearTipField::sliding,
       dim == 3 ? NearTipField::tearing : NearTipField::point_force}};
    std::array<double, 4> sums = {}; // three interactions, J
    const auto            add  = [&](const auto &points) {
      for (const auto &point : points)
        {
          if (is_without_share(point))
            continue;
          sums[3] += energy_release(point, direction);
          if (!constants)
            continue;
          const auto frame = axes(point.x);
          for (unsigned int k = 0; k < 3; ++k)
            {
              const double share =
                interaction(point, fields[k], *constants, frame, direction);
              sums[k] += changes_sign(fields[k], point.branch) ? -share : share;
            }
        }
    };
    add(set.points);
    add(set.force_points);
    add(set.face_points);
    std::array<double, 4> all;
    dealii::Utilities::MPI::sum(
      dealii::ArrayView<const double>(sums.data(), sums.size()),
      communicator,
      dealii::ArrayView<double>(all.data(), all.size()));
    for (auto &sum : all)
      sum /= area;

    FractureQuantities result;
    result.J           = all[3];
    result.has_factors = constants.has_value();
    if (!constants)
      return result;
    const dealii::Tensor<1, 2> K =
      invert(inverse_barnett_lothe_tensor(*constants)) *
      dealii::Tensor<1, 2>({all[1], all[0]});
    result.K_I  = K[1];
    result.K_II = K[0];
    if (dim == 3)
      result.K_III =
        std::get<IsotropicConstants>(*constants).shear_modulus * all[2];
    else
      result.T_stress = all[2] / axial_compliance(*constants);
    return result;
  }

  FractureQuantities
  fracture_quantities(StressPointSet<2>                     &set,
                      const Mesh::NodalMesh<2>              &mesh,
                      const TipFrame<2>                     &tip,
                      const Annulus                         &annulus,
                      const std::optional<NearTipConstants> &constants,
                      const MPI_Comm                         communicator)
  {
    set.set_weight(annulus_weights(mesh, tip.origin, annulus));
    for (auto &face : set.face_points)
      face.q = annulus.weight(face.x.distance(tip.origin));
    return fracture_quantities<2>(
      set,
      tip.axes[0],
      [&](const dealii::Point<2> &) { return tip; },
      1.,
      constants,
      communicator);
  }

#define INSTANTIATE(dim)                                \
  template FractureQuantities fracture_quantities<dim>( \
    const StressPointSet<dim> &,                        \
    const dealii::Tensor<1, dim> &,                     \
    const FrameField<dim> &,                            \
    double,                                             \
    const std::optional<NearTipConstants> &,            \
    MPI_Comm);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
