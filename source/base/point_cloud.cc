#include <perimorph/base/point_cloud.h>

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>

namespace Perimorph::Base
{
  template <int dim>
  struct PointCloud<dim>::Tree
  {
    // Interface that nanoflann asks for.
    std::size_t
    kdtree_get_point_count() const
    {
      return points.size();
    }
    double
    kdtree_get_pt(const std::size_t index, const std::size_t component) const
    {
      return points[index][component];
    }
    template <class BoundingBox>
    bool
    kdtree_get_bbox(BoundingBox &) const
    {
      return false;
    }

    using Index = nanoflann::KDTreeSingleIndexAdaptor<
      nanoflann::L2_Simple_Adaptor<double, Tree>,
      Tree,
      dim,
      unsigned int>;

    explicit Tree(std::vector<dealii::Point<dim>> cloud)
      : points(std::move(cloud))
      , index(dim, *this, nanoflann::KDTreeSingleIndexAdaptorParams(10))
    {
      index.buildIndex();
    }

    std::vector<dealii::Point<dim>> points;
    Index                           index;
  };

  namespace
  {
    /// Points within a distance, without their distances.
    struct Found
    {
      double                     squared_distance;
      std::vector<unsigned int> &indices;

      // Interface that nanoflann asks for.
      std::size_t
      size() const
      {
        return indices.size();
      }
      bool
      full() const
      {
        return true;
      }
      bool
      addPoint(const double squared, const unsigned int index)
      {
        if (squared < squared_distance)
          indices.push_back(index);
        return true;
      }
      double
      worstDist() const
      {
        return squared_distance;
      }
    };
  } // namespace

  template <int dim>
  PointCloud<dim>::PointCloud(std::vector<dealii::Point<dim>> points)
    : tree(std::make_unique<Tree>(std::move(points)))
  {}

  template <int dim>
  PointCloud<dim>::~PointCloud() = default;
  template <int dim>
  PointCloud<dim>::PointCloud(PointCloud &&) noexcept = default;
  template <int dim>
  PointCloud<dim> &
  PointCloud<dim>::operator=(PointCloud &&) noexcept = default;

  template <int dim>
  void
  PointCloud<dim>::within(const dealii::Point<dim>  &center,
                          const double               radius,
                          std::vector<unsigned int> &indices) const
  {
    indices.clear();
    // nanoflann excludes the radius itself and compares squares.
    const double inclusive = radius * radius * (1. + 1e-14);
    Found        found{inclusive, indices};
    tree->index.radiusSearchCustomCallback(&center[0], found);
    std::sort(indices.begin(), indices.end());
  }

  template <int dim>
  std::pair<unsigned int, double>
  PointCloud<dim>::nearest(const dealii::Point<dim> &point) const
  {
    unsigned int index   = 0;
    double       squared = 0.;
    tree->index.knnSearch(&point[0], 1, &index, &squared);
    return {index, std::sqrt(squared)};
  }

  template <int dim>
  const std::vector<dealii::Point<dim>> &
  PointCloud<dim>::points() const
  {
    return tree->points;
  }

  template class PointCloud<2>;
  template class PointCloud<3>;
} // namespace Perimorph::Base
