#include <perimorph/fracture/crack_faces.h>
#include <perimorph/fracture/crack_quantities.h>
#include <perimorph/fracture/force_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Fracture
{
  namespace
  {
    /// What the mesh and the law are like at a place.
    template <int dim>
    struct Surroundings
    {
      double                          spacing;
      double                          horizon;
      const Materials::Material<dim> &law;
    };

    template <int dim>
    Surroundings<dim>
    surroundings(const CrackedBody<dim>     &cracked,
                 const DisplacementFit<dim> &fit,
                 const dealii::Point<dim>   &point)
    {
      const auto        &mesh = cracked.body.mesh;
      const unsigned int node = fit.nearest_node(point);
      const unsigned int material =
        mesh.cell_material[mesh.node_cells.row(node)[0]];
      return {mesh.spacing[node],
              cracked.alpha[node] > 0. ? cracked.horizon[node] : 0.,
              *cracked.body.materials[material]};
    }

    template <int dim>
    StressPointSet<dim>
    stress_points(const CrackedBody<dim>     &cracked,
                  const DisplacementFit<dim> &fit,
                  const std::vector<bool>    &region)
    {
      StressPointSet<dim> set;
      if (cracked.families == nullptr)
        add_cell_points(cracked.body, cracked.cracks, fit, region, set);
      else
        {
          add_element_points(cracked.body, cracked.alpha, region, set);
          add_family_points(cracked.body,
                            cracked.cracks,
                            *cracked.families,
                            region,
                            set);
        }
      add_force_points(cracked.body,
                       cracked.meshed ? Bonds::CrackSet<dim>() : cracked.cracks,
                       fit,
                       region,
                       set);
      return set;
    }

    double
    largest_radius(const std::vector<Annulus> &annuli)
    {
      double radius = 0.;
      for (const auto &annulus : annuli)
        radius = std::max(radius, annulus.outer);
      return radius;
    }
  } // namespace

  double
  TipQuantities::domain_dependence() const
  {
    if (values.size() < 2)
      return std::numeric_limits<double>::quiet_NaN();
    double largest = 0., size = 0.;
    for (const auto &value : values)
      {
        largest = std::max(largest, std::abs(value.J - values[0].J));
        size    = std::max(size, std::abs(value.J));
      }
    return largest > 0. ? largest / size : 0.;
  }

  std::vector<TipQuantities>
  tip_quantities(const CrackedBody<2>        &cracked,
                 const std::vector<CrackTip> &tips,
                 const std::vector<Annulus>  &annuli,
                 const MPI_Comm               communicator)
  {
    const auto &mesh = cracked.body.mesh;
    const auto  fit =
      visible_fit(mesh, cracked.cracks, cracked.planes, cracked.meshed);
    std::vector<TipQuantities> all;
    for (const auto &tip : tips)
      {
        TipQuantities result;
        const auto    around    = surroundings(cracked, *fit, tip.frame.origin);
        const auto    constants = near_tip_constants(around.law, tip.frame);
        result.tip              = tip;
        result.is_isotropic     = is_isotropic(around.law);
        result.annuli = annuli.empty() ? default_annuli(tip.crack_length,
                                                        tip.free_distance,
                                                        around.horizon,
                                                        around.spacing)
                                       : annuli;
        result.needed_distance =
          least_free_distance(around.horizon, around.spacing);
        auto set =
          stress_points(cracked,
                        *fit,
                        nodes_within<2>(mesh,
                                        {tip.frame.origin},
                                        largest_radius(result.annuli)));
        add_face_points(cracked.body,
                        *fit,
                        tip,
                        largest_radius(result.annuli),
                        set);
        if (constants && around.horizon > 0. &&
            !cracked.body.acceleration.empty())
          smooth_towards_tip(tip.frame,
                             *constants,
                             around.horizon + around.spacing,
                             communicator,
                             set);
        result.n_without_stress =
          dealii::Utilities::MPI::sum(set.n_without_stress, communicator);
        for (const auto &annulus : result.annuli)
          result.values.push_back(fracture_quantities(set,
                                                      mesh,
                                                      tip.frame,
                                                      annulus,
                                                      constants,
                                                      communicator));
        const double length = std::min(tip.crack_length, tip.straight_distance);
        constexpr double missing = std::numeric_limits<double>::quiet_NaN();
        result.opening           = {missing, missing, 0};
        if (constants && length > 5. * around.spacing)
          result.opening = factors_from_opening(
            *fit,
            cracked.body.displacement,
            tip.frame,
            nearest_place(length,
                          std::max(around.horizon, 2. * around.spacing),
                          !cracked.body.acceleration.empty()),
            *constants,
            tip.path);
        all.push_back(std::move(result));
      }
    return all;
  }

  std::vector<FrontQuantities>
  front_quantities(const CrackedBody<3>          &cracked,
                   const std::vector<CrackFront> &fronts,
                   const unsigned int             n_stations,
                   const std::vector<Annulus>    &annuli,
                   const MPI_Comm                 communicator)
  {
    const double pi   = std::acos(-1.);
    const auto  &mesh = cracked.body.mesh;
    const auto   fit =
      visible_fit(mesh, cracked.cracks, cracked.planes, cracked.meshed);
    std::vector<FrontQuantities> all;
    for (const auto &front : fronts)
      {
        FrontQuantities result;
        const auto      around = surroundings(cracked, *fit, front.vertices[0]);
        const auto      constants =
          near_tip_constants(around.law, front.at(0.).frame);
        const double length = front.length();
        result.front        = front;
        result.stations     = front.stations(n_stations);
        result.half_width =
          std::min(0.25 * length,
                   std::max(4. * around.spacing, length / n_stations));
        result.annuli = annuli.empty() ? default_annuli(length / (2. * pi),
                                                        front.free_distance,
                                                        around.horizon,
                                                        around.spacing)
                                       : annuli;
        auto set      = stress_points(
          cracked,
          *fit,
          nodes_near_front(mesh, front, largest_radius(result.annuli)));
        result.n_without_stress =
          dealii::Utilities::MPI::sum(set.n_without_stress, communicator);
        for (const double station : result.stations)
          {
            result.values.emplace_back();
            for (const auto &annulus : result.annuli)
              result.values.back().push_back(
                fracture_quantities(set,
                                    mesh,
                                    front,
                                    {station, result.half_width, annulus},
                                    constants,
                                    communicator));
          }
        all.push_back(std::move(result));
      }
    return all;
  }
} // namespace Perimorph::Fracture
