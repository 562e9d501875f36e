#pragma once

#include <deal.II/base/point.h>

#include <memory>
#include <utility>
#include <vector>

namespace Perimorph::Base
{
  /// Neighbour search among fixed points with a k-d tree (nanoflann).
  template <int dim>
  class PointCloud
  {
  public:
    explicit PointCloud(std::vector<dealii::Point<dim>> points);
    ~PointCloud();
    PointCloud(PointCloud &&) noexcept;
    PointCloud &
    operator=(PointCloud &&) noexcept;

    /// Indices of all points within a distance (inclusive), in rising order.
    void
    within(const dealii::Point<dim>  &center,
           double                     radius,
           std::vector<unsigned int> &indices) const;

    /// Index of the nearest point and its distance.
    /// The cloud must not be empty.
    std::pair<unsigned int, double>
    nearest(const dealii::Point<dim> &point) const;

    const std::vector<dealii::Point<dim>> &
    points() const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree;
  };
} // namespace Perimorph::Base
