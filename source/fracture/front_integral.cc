#include <perimorph/fracture/front_integral.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Fracture
{
  namespace
  {
    /// Height of the tent.
    double
    tent(const CrackFront  &front,
         const FrontDomain &domain,
         const double       arc_length)
    {
      double away = std::abs(arc_length - domain.station);
      if (front.closed)
        away = std::min(away, front.length() - away);
      return std::max(0., 1. - away / domain.half_width);
    }
  } // namespace

  std::vector<double>
  front_weights(const Mesh::NodalMesh<3> &mesh,
                const CrackFront         &front,
                const FrontDomain        &domain)
  {
    const auto          center = front.at(domain.station).frame.origin;
    const double        reach  = domain.annulus.outer + domain.half_width;
    std::vector<double> q(mesh.n_nodes(), 0.);
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (mesh.nodes[n].distance_square(center) < reach * reach)
        {
          const auto place = front.nearest(mesh.nodes[n]);
          q[n] =
            tent(front, domain, place.arc_length) *
            domain.annulus.weight(mesh.nodes[n].distance(place.frame.origin));
        }
    Mesh::set_hanging_values(mesh.hanging, q);
    return q;
  }

  double
  advanced_area(const CrackFront &front, const FrontDomain &domain)
  {
    const auto forward = front.at(domain.station).frame.axes[0];
    // Midpoint rule, exact for a straight front: the tent is linear over each
    // of an even number of parts.
    const unsigned int n_parts = 200;
    const double       step    = 2. * domain.half_width / n_parts;
    double             area    = 0.;
    for (unsigned int k = 0; k < n_parts; ++k)
      {
        double position = domain.station - domain.half_width + (k + 0.5) * step;
        if (front.closed)
          position -= front.length() * std::floor(position / front.length());
        else if (position < 0. || position > front.length())
          continue;
        area += step * tent(front, domain, position) *
                (front.at(position).frame.axes[0] * forward);
      }
    return area;
  }

  std::vector<bool>
  nodes_near_front(const Mesh::NodalMesh<3> &mesh,
                   const CrackFront         &front,
                   const double              radius)
  {
    std::vector<bool> near(mesh.n_nodes());
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      near[n] = mesh.nodes[n].distance(
                  front.nearest(mesh.nodes[n]).frame.origin) < radius;
    return near;
  }

  FractureQuantities
  fracture_quantities(StressPointSet<3>                     &set,
                      const Mesh::NodalMesh<3>              &mesh,
                      const CrackFront                      &front,
                      const FrontDomain                     &domain,
                      const std::optional<NearTipConstants> &constants,
                      const MPI_Comm                         communicator)
  {
    set.set_weight(front_weights(mesh, front, domain));
    return fracture_quantities<3>(
      set,
      front.at(domain.station).frame.axes[0],
      [&](const dealii::Point<3> &x) { return front.nearest(x).frame; },
      advanced_area(front, domain),
      constants,
      communicator);
  }
} // namespace Perimorph::Fracture
