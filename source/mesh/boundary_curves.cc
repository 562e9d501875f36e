#include <perimorph/mesh/boundary_curves.h>
#include <perimorph/mesh/spline_curve.h>

#include <deal.II/base/tensor.h>
#include <deal.II/grid/manifold_lib.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

namespace Perimorph::Mesh
{
  namespace
  {
    /// Of a radius or an extent: coordinates of files have round-off.
    constexpr double tolerance = 1e-6;

    /// Sides that turn by more meet at a corner: so that eight sides may be a
    /// circle but six are a hexagon [radian].
    constexpr double corner = 50. * 3.14159 / 180.;

    /// So do sides that turn this much more than their neighbours do: a kink.
    constexpr double kink = 3.;

    /// Three points are always on a circle, those of a chamfer, too.
    constexpr unsigned int fewest_points = 5;

    template <int dim>
    using Face = typename GmshMesh<dim>::Face;
    template <int dim>
    using Points = std::vector<dealii::Point<dim>>;

    template <int dim>
    struct Ball
    {
      dealii::Point<dim> center;
      double             radius;
    };

    /// Circle or sphere through points by least squares of |x|^2 - 2 c x = k;
    /// none if they are not on it. `axis` is left out (dim: none).
    template <int dim>
    std::optional<Ball<dim>>
    fit_ball(const Points<dim> &points, const int axis = dim)
    {
      std::vector<int> used;
      for (int d = 0; d < dim; ++d)
        if (d != axis)
          used.push_back(d);
      const int n = used.size();
      if (points.size() < fewest_points)
        return std::nullopt;
      const auto      start = points[0];
      Eigen::MatrixXd matrix(points.size(), n + 1);
      Eigen::VectorXd right(points.size());
      double          extent = 0.;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          double square = 0.;
          for (int k = 0; k < n; ++k)
            {
              const double x = points[p][used[k]] - start[used[k]];
              matrix(p, k)   = 2. * x;
              square += x * x;
            }
          matrix(p, n) = 1.;
          right[p]     = square;
          extent       = std::max(extent, std::sqrt(square));
        }
      matrix.col(n) *= extent; // alike columns
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
      if (qr.rank() <= n)
        return std::nullopt;
      const Eigen::VectorXd solution = qr.solve(right);
      Ball<dim>             ball;
      ball.center   = dealii::Point<dim>();
      double square = extent * solution[n];
      for (int k = 0; k < n; ++k)
        {
          ball.center[used[k]] = start[used[k]] + solution[k];
          square += solution[k] * solution[k];
        }
      ball.radius = std::sqrt(std::max(0., square));
      for (const int d : used)
        if (std::abs(ball.center[d]) < 1e-9 * ball.radius)
          ball.center[d] = 0.; // reads better
      for (const auto &point : points)
        {
          double distance = 0.;
          for (const int d : used)
            distance += std::pow(point[d] - ball.center[d], 2);
          if (std::abs(std::sqrt(distance) - ball.radius) >
              tolerance * std::min(ball.radius, extent))
            return std::nullopt;
        }
      return ball;
    }

    dealii::Tensor<1, 2>
    normal_of(const Points<2> &points, const Face<2> &face)
    {
      const auto along = points[face[1]] - points[face[0]];
      return along / along.norm();
    }

    dealii::Tensor<1, 3>
    normal_of(const Points<3> &points, const Face<3> &face)
    {
      const auto normal =
        dealii::cross_product_3d(points[face[3]] - points[face[0]],
                                 points[face[2]] - points[face[1]]);
      return normal / normal.norm();
    }

    /// Angle between two neighbours.
    double
    turn_between(const Points<2> &points, const Face<2> &a, const Face<2> &b)
    {
      // Lines may have either direction.
      const double side = a[1] == b[0] || a[0] == b[1] ? 1. : -1.;
      const double turn = side * (normal_of(points, a) * normal_of(points, b));
      return std::acos(std::clamp(turn, -1., 1.));
    }

    double
    turn_between(const Points<3> &points, const Face<3> &a, const Face<3> &b)
    {
      const double turn = std::abs(normal_of(points, a) * normal_of(points, b));
      return std::acos(std::min(turn, 1.));
    }

    /// Whether the faces lie in a line (2D) or a plane.
    template <int dim>
    bool
    is_flat(const Points<dim> &points, const std::vector<Face<dim>> &faces)
    {
      dealii::Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = dealii::cross_product_2d(normal_of(points, faces[0]));
      else
        normal = normal_of(points, faces[0]);
      const auto &start  = points[faces[0][0]];
      double      extent = 0., away = 0.;
      for (const auto &face : faces)
        for (const unsigned int p : face)
          {
            extent = std::max(extent, points[p].distance(start));
            away   = std::max(away, std::abs((points[p] - start) * normal));
          }
      return away <= tolerance * extent;
    }

    /// Smooth connected parts of a group of faces.
    template <int dim>
    std::vector<std::vector<Face<dim>>>
    smooth_parts(const Points<dim> &points, const std::vector<Face<dim>> &faces)
    {
      std::vector<unsigned int> parent(faces.size());
      std::iota(parent.begin(), parent.end(), 0u);
      const auto root = [&parent](unsigned int n) {
        while (parent[n] != n)
          n = parent[n] = parent[parent[n]];
        return n;
      };
      // Faces at each end (2D) or edge.
      std::map<std::vector<unsigned int>, std::vector<unsigned int>> ridges;
      for (unsigned int f = 0; f < faces.size(); ++f)
        if constexpr (dim == 2)
          for (const unsigned int p : faces[f])
            ridges[{p}].push_back(f);
        else
          for (const auto &[a, b] : {std::make_pair(0, 1),
                                     std::make_pair(2, 3),
                                     std::make_pair(0, 2),
                                     std::make_pair(1, 3)})
            ridges[{std::min(faces[f][a], faces[f][b]),
                    std::max(faces[f][a], faces[f][b])}]
              .push_back(f);
      // Turn at each ridge, and the largest at the other ends of its sides.
      std::map<std::vector<unsigned int>, double> turns;
      for (const auto &[ridge, sides] : ridges)
        if (sides.size() == 2)
          turns[ridge] = turn_between(points, faces[sides[0]], faces[sides[1]]);
      for (const auto &[ridge, turn] : turns)
        {
          const auto &sides  = ridges[ridge];
          double      around = -1.; // in 2D, where there are neighbours
          if constexpr (dim == 2)
            for (const unsigned int side : sides)
              for (const unsigned int p : faces[side])
                if (p != ridge[0] && turns.count({p}) > 0)
                  around = std::max(around, turns[{p}]);
          if (turn > corner ||
              (around >= 0. && turn > tolerance && turn > kink * around))
            continue;
          parent[root(sides[0])] = root(sides[1]);
        }
      std::map<unsigned int, std::vector<Face<dim>>> parts;
      for (unsigned int f = 0; f < faces.size(); ++f)
        parts[root(f)].push_back(faces[f]);
      std::vector<std::vector<Face<dim>>> result;
      for (const auto &part : parts)
        result.push_back(part.second);
      return result;
    }

    /// Points of a part in 2D in the order of the line.
    /// @param closed  the line ends where it starts (no point twice)
    std::vector<unsigned int>
    chain_of(const std::vector<Face<2>> &faces, bool &closed)
    {
      std::map<unsigned int, std::vector<unsigned int>> at;
      for (unsigned int f = 0; f < faces.size(); ++f)
        for (const unsigned int p : faces[f])
          at[p].push_back(f);
      unsigned int start = faces[0][0];
      closed             = true;
      for (const auto &[point, sides] : at)
        if (sides.size() == 1 && closed)
          {
            start  = point;
            closed = false;
          }
      std::vector<unsigned int> chain = {start};
      std::vector<bool>         used(faces.size(), false);
      for (bool found = true; found;)
        {
          found = false;
          for (const unsigned int f : at[chain.back()])
            if (!used[f])
              {
                used[f] = found = true;
                chain.push_back(faces[f][0] == chain.back() ? faces[f][1]
                                                            : faces[f][0]);
                break;
              }
        }
      if (closed)
        chain.pop_back();
      return chain;
    }

    template <int dim>
    std::string
    text_of(const Ball<dim> &ball)
    {
      std::ostringstream text;
      text << "(" << ball.center << "), radius " << ball.radius;
      return text.str();
    }

    void
    find_manifold(const GmshMesh<2> &mesh, BoundaryCurve<2> &curve)
    {
      bool       closed;
      const auto chain = chain_of(curve.faces, closed);
      Points<2>  points;
      for (const unsigned int p : chain)
        points.push_back(mesh.points[p]);
      if (const auto circle = fit_ball<2>(points))
        {
          curve.description = "a circle around " + text_of(*circle);
          curve.manifold =
            std::make_unique<dealii::SphericalManifold<2>>(circle->center);
        }
      else if (points.size() >= fewest_points)
        {
          curve.description = "a smooth line through " +
                              std::to_string(points.size()) + " points";
          curve.manifold = std::make_unique<SplineCurve>(points, closed);
        }
    }

    void
    find_manifold(const GmshMesh<3> &mesh, BoundaryCurve<3> &curve)
    {
      std::set<unsigned int> numbers;
      for (const auto &face : curve.faces)
        numbers.insert(face.begin(), face.end());
      Points<3> points;
      for (const unsigned int p : numbers)
        points.push_back(mesh.points[p]);
      if (const auto sphere = fit_ball<3>(points))
        {
          curve.description = "a sphere around " + text_of(*sphere);
          curve.manifold =
            std::make_unique<dealii::SphericalManifold<3>>(sphere->center);
          return;
        }
      for (int axis = 0; axis < 3; ++axis)
        if (const auto circle = fit_ball<3>(points, axis))
          {
            curve.description = std::string("a cylinder along ") + "xyz"[axis] +
                                " through " + text_of(*circle);
            curve.manifold = std::make_unique<dealii::CylindricalManifold<3>>(
              dealii::Point<3>::unit_vector(axis),
              circle->center);
            return;
          }
    }
  } // namespace

  template <int dim>
  std::vector<BoundaryCurve<dim>>
  find_boundary_curves(const GmshMesh<dim> &mesh)
  {
    std::vector<BoundaryCurve<dim>> curves;
    for (const auto &[name, faces] : mesh.surfaces)
      for (const auto &part : smooth_parts<dim>(mesh.points, faces))
        {
          if (is_flat<dim>(mesh.points, part))
            continue;
          BoundaryCurve<dim> curve;
          curve.boundary = name;
          curve.faces    = part;
          find_manifold(mesh, curve);
          curves.push_back(std::move(curve));
        }
    return curves;
  }

  template std::vector<BoundaryCurve<2>>
  find_boundary_curves(const GmshMesh<2> &);
  template std::vector<BoundaryCurve<3>>
  find_boundary_curves(const GmshMesh<3> &);
} // namespace Perimorph::Mesh
