#pragma once

#include <perimorph/fracture/crack_tips.h>
#include <perimorph/fracture/domain_integral.h>

namespace Perimorph::Fracture
{
  /// Weight q of a domain integral at a point of a front: a tent along the
  /// front times the ramp in the planes normal to it.
  struct FrontDomain
  {
    double  station;    ///< arc length of the point
    double  half_width; ///< of the tent
    Annulus annulus;    ///< distances from the front
  };

  /// q of every node.
  std::vector<double>
  front_weights(const Mesh::NodalMesh<3> &mesh,
                const CrackFront         &front,
                const FrontDomain        &domain);

  /// Area by which the crack grows when its front moves by q along the
  /// direction of growth at the station.
  double
  advanced_area(const CrackFront &front, const FrontDomain &domain);

  /// Nodes that the domains of a front at any station reach.
  std::vector<bool>
  nodes_near_front(const Mesh::NodalMesh<3> &mesh,
                   const CrackFront         &front,
                   double                    radius);

  /// Mean values along the tent around a point of a plane front.
  ///
  /// The auxiliary fields are those of plane strain in the plane normal to the
  /// front through its nearest point. Where the front is curved they are
  /// neither in equilibrium nor compatible; the term of the interaction
  /// integral that makes up for it (the change of the axes along the front) is
  /// included, from the curvature of the polyline.
  FractureQuantities
  fracture_quantities(StressPointSet<3>                     &set,
                      const Mesh::NodalMesh<3>              &mesh,
                      const CrackFront                      &front,
                      const FrontDomain                     &domain,
                      const std::optional<NearTipConstants> &constants,
                      MPI_Comm                               communicator);
} // namespace Perimorph::Fracture
