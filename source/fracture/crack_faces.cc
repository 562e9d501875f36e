#include <perimorph/base/exceptions.h>
#include <perimorph/bonds/crack_points.h>
#include <perimorph/fracture/crack_faces.h>
#include <perimorph/mesh/feature_distance.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Fracture
{
  namespace
  {
    // Angle [radians] that is round-off of a straight crack.
    constexpr double round_off = 1e-9;

    /// Angle at the tip from the straight line behind it to a point.
    double
    deviation(const CrackTip &tip, const dealii::Tensor<1, 2> &away)
    {
      return std::atan2(-(away * tip.frame.axes[1]),
                        -(away * tip.frame.axes[0]));
    }
  } // namespace

  bool
  is_bent(const CrackTip &tip)
  {
    return std::any_of(tip.path.begin(),
                       tip.path.end(),
                       [&](const dealii::Point<2> &vertex) {
                         const auto away = vertex - tip.frame.origin;
                         return away.norm() > 0. &&
                                std::abs(deviation(tip, away)) > round_off;
                       });
  }

  double
  branch_sign(const CrackTip &tip, const dealii::Point<2> &point)
  {
    const auto   away = point - tip.frame.origin;
    const double bend = deviation(
      tip,
      place_behind(tip.frame, tip.path, away.norm()) - tip.frame.origin);
    const double angle = deviation(tip, away);
    return (bend > 0. && angle >= 0. && angle < bend) ||
               (bend < 0. && angle < 0. && angle > bend)
             ? -1.
             : 1.;
  }

  void
  add_face_points(const DeformedBody<2>    &body,
                  const DisplacementFit<2> &fit,
                  const CrackTip           &tip,
                  const double              radius,
                  StressPointSet<2>        &set)
  {
    set.face_points.clear();
    const bool bent = is_bent(tip);
    for (auto &point : set.points)
      point.branch = bent ? branch_sign(tip, point.x) : 1.;
    for (auto &point : set.force_points)
      point.branch = bent ? branch_sign(tip, point.owner) : 1.;
    if (!bent)
      return;

    std::vector<Bonds::CrackFacet<2>> facets;
    for (unsigned int k = 1; k < tip.path.size(); ++k)
      {
        const auto &begin = tip.path[k - 1], &end = tip.path[k];
        // The fields leave the line of the tip free of traction.
        const auto along = end - begin;
        if (begin.distance(tip.frame.origin) < radius &&
            std::abs(along * tip.frame.axes[1]) > round_off * along.norm())
          facets.push_back({{{begin, end}}});
      }
    const Bonds::CrackSet<2> faces(facets);
    for (const auto &point : Bonds::crack_points(body.mesh, faces))
      {
        if (!body.mesh.owns_cell(point.cell) ||
            point.position.distance(tip.frame.origin) > radius)
          continue;
        const unsigned int material = body.mesh.cell_material[point.cell];
        const double       spacing  = fit.length_at(point.position);
        for (const double side : {-1., 1.})
          {
            FacePoint<2> face;
            face.length      = point.measure;
            face.normal      = -side * facets[point.facet].normal();
            face.x           = point.position - 1e-6 * spacing * face.normal;
            const auto value = fit.fit(face.x,
                                       spacing,
                                       DisplacementFit<2>::any_material,
                                       body.displacement);
            face.displacement_gradient = value.gradient;
            face.branch                = branch_sign(tip, face.x);
            try
              {
                if (value.n_nodes == 0)
                  throw Base::InadmissibleState("no gradient");
                const auto &law = *body.materials[material];
                face.first_piola_kirchhoff =
                  law.first_piola_kirchhoff(value.gradient);
                face.energy_density = law.energy_density(value.gradient);
              }
            catch (const Base::InadmissibleState &)
              {
                ++set.n_without_stress;
                continue;
              }
            set.face_points.push_back(face);
          }
      }
  }
} // namespace Perimorph::Fracture
