#include <perimorph/base/exact_orientation.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/feature_distance.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Bonds
{
  namespace
  {
    template <int dim>
    double
    distance_to_facet(const dealii::Point<dim> &point,
                      const CrackFacet<dim>    &facet)
    {
      const auto &c = facet.corners;
      if constexpr (dim == 2)
        return point.distance(Mesh::closest_on_segment(point, c[0], c[1]));
      else
        return point.distance(
          Mesh::closest_on_triangle(point, c[0], c[1], c[2]));
    }
  } // namespace

  template <int dim>
  double
  CrackFacet<dim>::measure() const
  {
    if constexpr (dim == 2)
      return corners[0].distance(corners[1]);
    else
      return 0.5 *
             cross_product_3d(corners[1] - corners[0], corners[2] - corners[0])
               .norm();
  }

  template <int dim>
  dealii::Tensor<1, dim>
  CrackFacet<dim>::normal() const
  {
    const dealii::Tensor<1, dim> along = corners[1] - corners[0];
    if constexpr (dim == 2)
      return dealii::Tensor<1, 2>({-along[1], along[0]}) / along.norm();
    else
      {
        const auto area = cross_product_3d(along, corners[2] - corners[0]);
        return area / area.norm();
      }
  }

  template <int dim>
  dealii::BoundingBox<dim>
  CrackFacet<dim>::box() const
  {
    return dealii::BoundingBox<dim>(
      std::vector<dealii::Point<dim>>(corners.begin(), corners.end()));
  }

  template <>
  bool
  crosses(const CrackFacet<2>    &facet,
          const dealii::Point<2> &a,
          const dealii::Point<2> &b)
  {
    using Base::orientation;
    const auto &c = facet.corners;
    return orientation<2>({{c[0], c[1], a}}, {{true, true, false}}) !=
             orientation<2>({{c[0], c[1], b}}, {{true, true, false}}) &&
           orientation<2>({{a, b, c[0]}}, {{false, false, true}}) !=
             orientation<2>({{a, b, c[1]}}, {{false, false, true}});
  }

  template <>
  bool
  crosses(const CrackFacet<3>    &facet,
          const dealii::Point<3> &a,
          const dealii::Point<3> &b)
  {
    using Base::orientation;
    const auto &c    = facet.corners;
    const auto  side = [&](const dealii::Point<3> &point) {
      return orientation<3>({{c[0], c[1], c[2], point}},
                            {{true, true, true, false}});
    };
    if (side(a) == side(b))
      return false;
    const auto turn = [&](const unsigned int k) {
      return orientation<3>({{a, b, c[k], c[(k + 1) % 3]}},
                            {{false, false, true, true}});
    };
    const int first = turn(0);
    return turn(1) == first && turn(2) == first;
  }

  template <int dim>
  struct CrackSet<dim>::Tree
  {
    using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;
    dealii::RTree<Entry> rtree;
  };

  template <int dim>
  CrackSet<dim>::CrackSet() = default;

  template <int dim>
  CrackSet<dim>::CrackSet(std::vector<CrackFacet<dim>> facets)
    : list(std::move(facets))
  {
    index();
  }

  template <int dim>
  CrackSet<dim>::~CrackSet() = default;

  template <int dim>
  CrackSet<dim>::CrackSet(const CrackSet &other)
    : list(other.list)
  {
    index();
  }

  template <int dim>
  CrackSet<dim> &
  CrackSet<dim>::operator=(const CrackSet &other)
  {
    list = other.list;
    index();
    return *this;
  }

  template <int dim>
  CrackSet<dim>::CrackSet(CrackSet &&) noexcept = default;

  template <int dim>
  CrackSet<dim> &
  CrackSet<dim>::operator=(CrackSet &&) noexcept = default;

  template <int dim>
  void
  CrackSet<dim>::append(const std::vector<CrackFacet<dim>> &facets)
  {
    list.insert(list.end(), facets.begin(), facets.end());
    index();
  }

  template <int dim>
  void
  CrackSet<dim>::index()
  {
    std::vector<typename Tree::Entry> entries;
    for (unsigned int k = 0; k < list.size(); ++k)
      entries.emplace_back(list[k].box(), k);
    tree        = std::make_unique<Tree>();
    tree->rtree = dealii::pack_rtree(entries);
  }

  template <int dim>
  void
  CrackSet<dim>::near(const dealii::BoundingBox<dim> &box,
                      std::vector<unsigned int>      &indices) const
  {
    indices.clear();
    if (list.empty())
      return;
    namespace bgi = boost::geometry::index;
    for (auto entry = tree->rtree.qbegin(bgi::intersects(box));
         entry != tree->rtree.qend();
         ++entry)
      indices.push_back(entry->second);
    std::sort(indices.begin(), indices.end());
  }

  template <int dim>
  bool
  CrackSet<dim>::is_within(const dealii::Point<dim> &point,
                           const double              radius) const
  {
    if (list.empty())
      return false;
    dealii::BoundingBox<dim> box(std::make_pair(point, point));
    box.extend(radius);
    namespace bgi = boost::geometry::index;
    return tree->rtree.qbegin(bgi::intersects(box)) != tree->rtree.qend() &&
           distance(point) <= radius;
  }

  template <int dim>
  bool
  CrackSet<dim>::crosses(const dealii::Point<dim> &a,
                         const dealii::Point<dim> &b) const
  {
    if (list.empty())
      return false;
    const dealii::BoundingBox<dim> box(std::vector<dealii::Point<dim>>{a, b});
    namespace bgi = boost::geometry::index;
    for (auto entry = tree->rtree.qbegin(bgi::intersects(box));
         entry != tree->rtree.qend();
         ++entry)
      if (Bonds::crosses(list[entry->second], a, b))
        return true;
    return false;
  }

  template <int dim>
  double
  CrackSet<dim>::distance(const dealii::Point<dim> &point) const
  {
    double result = std::numeric_limits<double>::infinity();
    for (const auto &facet : list)
      result = std::min(result, distance_to_facet(point, facet));
    return result;
  }

  template struct CrackFacet<2>;
  template struct CrackFacet<3>;
  template class CrackSet<2>;
  template class CrackSet<3>;
} // namespace Perimorph::Bonds
