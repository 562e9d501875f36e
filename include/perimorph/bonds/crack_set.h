#pragma once

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <vector>

namespace Perimorph::Bonds
{
  /// A flat piece of a crack: a segment in 2D, a triangle in 3D.
  template <int dim>
  struct CrackFacet
  {
    std::array<dealii::Point<dim>, dim> corners;
    unsigned int                        crack = 0; ///< crack it belongs to
    unsigned int step = 0; ///< advance that made it, 0: there from the start

    /// Length or area.
    double
    measure() const;

    /// Unit normal, from the - to the + side: in 2D on the left of the way
    /// from the first to the second corner.
    dealii::Tensor<1, dim>
    normal() const;

    dealii::BoundingBox<dim>
    box() const;
  };

  /// All cracks of a body as facets, and the exact answer to one question:
  /// does a straight segment cross one of them?
  ///
  /// The predicates are exact. A crack through a node or along a bond is
  /// decided as if all cracks were moved by an infinitesimal vector (e, e^2,
  /// e^3): each node then is on one side, bonds through the joint of two facets
  /// are cut, and the answer does not depend on the order of the two ends.
  template <int dim>
  class CrackSet
  {
  public:
    CrackSet();
    explicit CrackSet(std::vector<CrackFacet<dim>> facets);
    ~CrackSet();
    CrackSet(const CrackSet &other);
    CrackSet &
    operator=(const CrackSet &other);
    CrackSet(CrackSet &&) noexcept;
    CrackSet &
    operator=(CrackSet &&) noexcept;

    bool
    empty() const
    {
      return list.empty();
    }

    const std::vector<CrackFacet<dim>> &
    facets() const
    {
      return list;
    }

    /// Adds facets of an advance.
    void
    append(const std::vector<CrackFacet<dim>> &facets);

    /// True if the segment from a to b crosses a facet.
    bool
    crosses(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const;

    /// Indices of the facets whose boxes meet a box, in rising order.
    void
    near(const dealii::BoundingBox<dim> &box,
         std::vector<unsigned int>      &indices) const;

    /// The same for the box of some corners.
    template <std::size_t n>
    void
    near(const std::array<dealii::Point<dim>, n> &corners,
         std::vector<unsigned int>               &indices) const
    {
      near(dealii::BoundingBox<dim>(
             std::vector<dealii::Point<dim>>(corners.begin(), corners.end())),
           indices);
    }

    /// True if a facet is not further away from a point than the radius.
    bool
    is_within(const dealii::Point<dim> &point, double radius) const;

    /// Smallest distance of a point to a facet; infinity without facets.
    double
    distance(const dealii::Point<dim> &point) const;

  private:
    void
    index();

    struct Tree;
    std::vector<CrackFacet<dim>> list;
    std::unique_ptr<Tree>        tree;
  };

  /// The segment from a to b crosses the facet, in the sense of CrackSet.
  template <int dim>
  bool
  crosses(const CrackFacet<dim>    &facet,
          const dealii::Point<dim> &a,
          const dealii::Point<dim> &b);
} // namespace Perimorph::Bonds
