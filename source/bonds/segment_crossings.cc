#include <perimorph/bonds/segment_crossings.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Bonds
{
  namespace
  {
    double
    cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    double
    triple(const dealii::Tensor<1, 3> &a,
           const dealii::Tensor<1, 3> &b,
           const dealii::Tensor<1, 3> &c)
    {
      return a[0] * (b[1] * c[2] - b[2] * c[1]) +
             a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }

    bool
    on_face(const double unit_coordinate)
    {
      return unit_coordinate > -face_tolerance &&
             unit_coordinate < 1. + face_tolerance;
    }

    bool
    between_ends(const double s)
    {
      return s > merge_tolerance && s < 1. - merge_tolerance;
    }

    template <int dim>
    using Crossings = std::vector<typename SegmentCrossings<dim>::Crossing>;

    /// Crossing of the segment (from the origin along d) with an edge. A
    /// parallel edge needs none: the next edge at its ends gives the crossing.
    void
    cross_face(const std::array<dealii::Point<2>, 2> &corners,
               const dealii::Tensor<1, 2>            &d,
               const unsigned int                     face,
               Crossings<2>                          &crossings)
    {
      const dealii::Tensor<1, 2> start       = corners[0] - dealii::Point<2>();
      const dealii::Tensor<1, 2> edge        = corners[1] - corners[0];
      const double               determinant = cross(d, edge);
      if (determinant * determinant <
          1e-28 * d.norm_square() * edge.norm_square())
        return;
      const double u = cross(start, d) / determinant;
      const double s = cross(start, edge) / determinant;
      if (on_face(u) && between_ends(s))
        crossings.push_back({s, face, {{u}}});
    }

    /// Crossings of the segment with a bilinear face, at most two: the face
    /// is p00 + u e + v f + u v g, and det[p00 + u e, f + u g, d] = 0 gives
    /// u.
    void
    cross_face(const std::array<dealii::Point<3>, 4> &corners,
               const dealii::Tensor<1, 3>            &d,
               const unsigned int                     face,
               Crossings<3>                          &crossings)
    {
      const dealii::Tensor<1, 3> p00 = corners[0] - dealii::Point<3>();
      const dealii::Tensor<1, 3> e   = corners[1] - corners[0];
      const dealii::Tensor<1, 3> f   = corners[2] - corners[0];
      const dealii::Tensor<1, 3> g   = (corners[3] - corners[2]) - e;

      const double c0 = triple(p00, f, d);
      const double c1 = triple(e, f, d) + triple(p00, g, d);
      const double c2 = triple(e, g, d);
      const double scale =
        1e-14 * std::sqrt(d.norm_square() * f.norm_square() * e.norm_square());

      // Segment in the face or parallel to it: other faces give the
      // crossings.
      if (std::abs(c1) < scale && std::abs(c2) < scale)
        return;
      std::array<double, 2> roots;
      unsigned int          n_roots = 0;
      if (std::abs(c2) < scale)
        roots[n_roots++] = -c0 / c1;
      else
        {
          // A slightly negative discriminant is a segment that touches the
          // face.
          double discriminant = c1 * c1 - 4. * c0 * c2;
          if (discriminant < -1e-12 * (c1 * c1 + std::abs(4. * c0 * c2)))
            return;
          discriminant = std::max(discriminant, 0.);
          const double sum =
            -0.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
          roots[n_roots++] = sum / c2;
          if (sum != 0.)
            roots[n_roots++] = c0 / sum;
        }

      for (unsigned int r = 0; r < n_roots; ++r)
        if (on_face(roots[r]))
          {
            // (f + u g) v - d s = -(p00 + u e) in the least-squares sense.
            const dealii::Tensor<1, 3> line  = f + roots[r] * g;
            const dealii::Tensor<1, 3> start = p00 + roots[r] * e;

            const double ll          = line.norm_square();
            const double dd          = d.norm_square();
            const double ld          = line * d;
            const double determinant = ll * dd - ld * ld;
            if (determinant < 1e-24 * ll * dd)
              continue;
            const double ls = line * start;
            const double ds = d * start;
            const double v  = (ld * ds - dd * ls) / determinant;
            const double s  = (ll * ds - ld * ls) / determinant;
            if (on_face(v) && between_ends(s))
              crossings.push_back({s, face, {{roots[r], v}}});
          }
    }

    /// Are these corners all on one side of the segment, seen from one of the
    /// directions? Then so is all that lies between them.
    template <typename Views, std::size_t n>
    bool
    misses(const Views &views, const std::array<unsigned int, n> &corners)
    {
      for (const auto &view : views)
        {
          double smallest = view[corners[0]];
          double largest  = smallest;
          for (std::size_t k = 1; k < n; ++k)
            {
              smallest = std::min(smallest, view[corners[k]]);
              largest  = std::max(largest, view[corners[k]]);
            }
          // Faces reach a little over their edges, see on_face().
          const double margin = 4. * face_tolerance * (largest - smallest);
          if (smallest > margin || largest < -margin)
            return true;
        }
      return false;
    }
  } // namespace

  template <int dim>
  SegmentCrossings<dim>::SegmentCrossings(const dealii::Tensor<1, dim> &segment)
    : segment(segment)
  {
    if constexpr (dim == 2)
      across[0] = cross_product_2d(segment);
    else
      {
        int axis = 0;
        for (int d = 1; d < dim; ++d)
          if (std::abs(segment[d]) < std::abs(segment[axis]))
            axis = d;
        dealii::Tensor<1, dim> other;
        other[axis] = 1.;
        across[0]   = cross_product_3d(segment, other);
        across[1]   = cross_product_3d(segment, across[0]) / segment.norm();
        across[2]   = across[0] + across[1];
        across[3]   = across[0] - across[1];
      }
  }

  template <int dim>
  std::array<unsigned int, SegmentCrossings<dim>::n_face_corners>
  SegmentCrossings<dim>::face_corners(const unsigned int face)
  {
    const unsigned int                       axis = face / 2;
    std::array<unsigned int, n_face_corners> corners;
    for (unsigned int k = 0; k < n_face_corners; ++k)
      {
        corners[k] = (face % 2) << axis;
        for (unsigned int d = 0; d + 1 < dim; ++d)
          corners[k] += ((k >> d) & 1u) << ((axis + 1 + d) % dim);
      }
    return corners;
  }

  template <int dim>
  bool
  SegmentCrossings<dim>::add(const Corners         &corners,
                             std::vector<Crossing> &crossings) const
  {
    static const auto all_faces = []() {
      std::array<std::array<unsigned int, n_face_corners>, 2 * dim> result;
      for (unsigned int face = 0; face < 2 * dim; ++face)
        result[face] = face_corners(face);
      return result;
    }();
    std::array<std::array<double, n_corners>, n_views> views;
    std::array<unsigned int, n_corners>                all;
    for (unsigned int v = 0; v < n_corners; ++v)
      {
        all[v] = v;
        for (unsigned int k = 0; k < n_views; ++k)
          views[k][v] = across[k] * dealii::Tensor<1, dim>(corners[v]);
      }
    if (misses(views, all))
      return false;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if (!misses(views, all_faces[face]))
        {
          std::array<dealii::Point<dim>, n_face_corners> of_face;
          for (unsigned int k = 0; k < n_face_corners; ++k)
            of_face[k] = corners[all_faces[face][k]];
          cross_face(of_face, segment, face, crossings);
        }
    return true;
  }

  template class SegmentCrossings<2>;
  template class SegmentCrossings<3>;
} // namespace Perimorph::Bonds
