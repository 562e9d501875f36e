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
    std::vector<std::pair<unsigned int, double>> found;
    // nanoflann excludes the radius itself and compares squares.
    const double inclusive = radius * radius * (1. + 1e-14);
    tree->index.radiusSearch(&center[0],
                             inclusive,
                             found,
                             nanoflann::SearchParams(32, 0.f, false));
    for (const auto &entry : found)
      indices.push_back(entry.first);
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
