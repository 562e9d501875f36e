#include <perimorph/fracture/domain_integral.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

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
  } // namespace

  template <int dim>
  FractureQuantities
  fracture_quantities(const StressPointSet<dim>    &set,
                      const dealii::Tensor<1, dim> &direction,
                      const FrameField<dim>        &axes,
                      const double                  area,
                      const NearTipConstants       &constants,
                      const MPI_Comm                communicator)
  {
    constexpr std::array<NearTipField, 4> fields = {
      {NearTipField::opening,
       NearTipField::sliding,
       dim == 3 ? NearTipField::tearing : NearTipField::point_force,
       NearTipField::opening}};
    std::array<double, 4> sums = {}; // three interactions, J
    for (const auto &point : set.points)
      {
        if (point.q_gradient.norm_square() == 0. && (dim == 2 || point.q == 0.))
          continue;
        const auto &H       = point.displacement_gradient;
        const auto &P       = point.first_piola_kirchhoff;
        const auto &slope   = point.q_gradient;
        const auto  u_along = H * direction;
        const auto  flux    = P * slope;
        const auto  forward = slope * direction;
        sums[3] +=
          point.volume * (u_along * flux - point.energy_density * forward);
        const auto frame = axes(point.x);
        for (unsigned int k = 0; k < 3; ++k)
          {
            auto other = near_tip_state(fields[k], constants, frame, point.x);
            if (point.branch < 0. && fields[k] != NearTipField::point_force)
              other.change_sign();
            if (frame.curvature != 0.)
              sums[k] += point.volume * point.q *
                         flux_divergence(point, direction, frame, other);
            sums[k] += point.volume *
                       (other.gradient * direction * flux +
                        u_along * (other.stress * slope) -
                        dealii::scalar_product(P, other.gradient) * forward);
          }
      }
    for (const auto &face : set.face_points)
      {
        if (face.q == 0.)
          continue;
        const double weight  = face.length * face.q;
        const double forward = face.normal * direction;
        const auto   u_along = face.displacement_gradient * direction;
        const auto   frame   = axes(face.x);
        sums[3] += weight * face.energy_density * forward;
        for (unsigned int k = 0; k < 3; ++k)
          {
            auto other = near_tip_state(fields[k], constants, frame, face.x);
            if (face.branch < 0. && fields[k] != NearTipField::point_force)
              other.change_sign();
            sums[k] +=
              weight * (dealii::scalar_product(face.first_piola_kirchhoff,
                                               other.gradient) *
                          forward -
                        (other.stress * face.normal) * u_along);
          }
      }
    std::array<double, 4> all;
    dealii::Utilities::MPI::sum(
      dealii::ArrayView<const double>(sums.data(), sums.size()),
      communicator,
      dealii::ArrayView<double>(all.data(), all.size()));
    for (auto &sum : all)
      sum /= area;

    const double       modulus = constants.plane_modulus();
    FractureQuantities result;
    result.J    = all[3];
    result.K_I  = 0.5 * modulus * all[0];
    result.K_II = 0.5 * modulus * all[1];
    if (dim == 3)
      result.K_III = constants.shear_modulus * all[2];
    else
      result.T_stress = modulus * all[2];
    return result;
  }

  FractureQuantities
  fracture_quantities(StressPointSet<2>        &set,
                      const Mesh::NodalMesh<2> &mesh,
                      const TipFrame<2>        &tip,
                      const Annulus            &annulus,
                      const NearTipConstants   &constants,
                      const MPI_Comm            communicator)
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
    const NearTipConstants &,                           \
    MPI_Comm);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
