#include <perimorph/fracture/segment_growth.h>

#include <deal.II/base/numbers.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Fracture
{
  namespace
  {
    dealii::Tensor<1, 2>
    direction(const CrackTip &tip, const double angle)
    {
      return std::cos(angle) * tip.frame.axes[0] +
             std::sin(angle) * tip.frame.axes[1];
    }

    /// Distance along a ray to a segment; infinity if it is missed.
    double
    distance_along_ray(const dealii::Point<2>     &origin,
                       const dealii::Tensor<1, 2> &along,
                       const dealii::Point<2>     &a,
                       const dealii::Point<2>     &b)
    {
      const dealii::Tensor<1, 2> edge = b - a, to = a - origin;
      const double cross = along[0] * edge[1] - along[1] * edge[0];
      if (std::abs(cross) <= 1e-14 * edge.norm())
        return std::numeric_limits<double>::infinity();
      const double t = (to[0] * edge[1] - to[1] * edge[0]) / cross;
      const double s = (to[0] * along[1] - to[1] * along[0]) / cross;
      return t > 0. && s >= 0. && s <= 1.
               ? t
               : std::numeric_limits<double>::infinity();
    }
  } // namespace

  double
  hoop_angle(const double K_I, const double K_II)
  {
    constexpr double largest = 80. * dealii::numbers::PI / 180.;
    if (K_II == 0.)
      return 0.;
    // The root of the quadratic in tan(t/2) without a difference of like
    // numbers.
    const double root  = std::sqrt(K_I * K_I + 8. * K_II * K_II);
    const double angle = -2. * std::atan2(2. * K_II, K_I + root);
    return std::clamp(angle, -largest, largest);
  }

  std::vector<double>
  probe_angles(const bool first)
  {
    const int           n    = first ? 4 : 2;
    const double        last = (first ? 80. : 45.) * dealii::numbers::PI / 180.;
    std::vector<double> angles;
    for (int k = -n; k <= n; ++k)
      angles.push_back(k * last / n);
    return angles;
  }

  double
  best_angle(const std::vector<double> &angles,
             const std::vector<double> &released)
  {
    Eigen::MatrixXd powers(angles.size(), 3);
    Eigen::VectorXd values(angles.size());
    for (unsigned int k = 0; k < angles.size(); ++k)
      {
        powers.row(k) << 1., angles[k], angles[k] * angles[k];
        values[k] = released[k];
      }
    const Eigen::Vector3d c   = powers.colPivHouseholderQr().solve(values);
    const double          low = angles.front(), high = angles.back();
    if (c[2] < 0.)
      return std::clamp(-0.5 * c[1] / c[2], low, high);
    const auto value = [&](const double x) { return (c[2] * x + c[1]) * x; };
    return value(high) > value(low) ? high : low;
  }

  Bonds::CrackFacet<2>
  advance_facet(const CrackTip    &tip,
                const double       angle,
                const double       length,
                const unsigned int step)
  {
    return {
      {{tip.frame.origin, tip.frame.origin + length * direction(tip, angle)}},
      tip.crack,
      step};
  }

  double
  surface_ahead(const Mesh::NodalMesh<2>   &mesh,
                const dealii::Point<2>     &origin,
                const dealii::Tensor<1, 2> &along)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto &face : mesh.boundary_faces)
      nearest = std::min(nearest,
                         distance_along_ray(origin,
                                            along,
                                            mesh.nodes[face.nodes[0]],
                                            mesh.nodes[face.nodes[1]]));
    return nearest;
  }

  double
  distance_ahead(const Mesh::NodalMesh<2> &mesh,
                 const Bonds::CrackSet<2> &cracks,
                 const CrackTip           &tip,
                 const double              angle)
  {
    const auto along   = direction(tip, angle);
    double     nearest = std::numeric_limits<double>::infinity();
    for (unsigned int f = 0; f < cracks.facets().size(); ++f)
      if (f != tip.facet)
        {
          const auto &c = cracks.facets()[f].corners;
          nearest =
            std::min(nearest,
                     distance_along_ray(tip.frame.origin, along, c[0], c[1]));
        }
    return std::min(nearest, surface_ahead(mesh, tip.frame.origin, along));
  }

  double
  closing_length(const Mesh::NodalMesh<2> &mesh,
                 const Bonds::CrackSet<2> &cracks,
                 const CrackTip           &tip,
                 const double              angle,
                 const double              length,
                 const double              spacing)
  {
    const double nearest = distance_ahead(mesh, cracks, tip, angle);
    return nearest < length + 2.2 * spacing ? nearest + 0.1 * length : length;
  }
} // namespace Perimorph::Fracture
