#include <perimorph/coupling/bond_states.h>
#include <perimorph/coupling/failure_planes.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bgi = boost::geometry::index;

namespace Perimorph::Coupling
{
  namespace
  {
    /// On lattices many distances are equal but for round-off, which depends on
    /// the number of ranks: comparisons look beyond it.
    constexpr double slack = 1. + 1e-6;

    template <int dim>
    using Tree =
      bgi::rtree<std::pair<dealii::Point<dim>, std::size_t>, bgi::linear<16>>;

    template <int dim>
    dealii::BoundingBox<dim>
    box_around(const dealii::Point<dim> &point, const double distance)
    {
      dealii::BoundingBox<dim> box(std::make_pair(point, point));
      box.extend(distance);
      return box;
    }

    template <int dim>
    dealii::Point<dim>
    middle(const dealii::Point<dim> &first, const dealii::Point<dim> &second)
    {
      return first + 0.5 * (second - first);
    }

    /// Where a bond crosses a plane through a place. Ends on the plane lie on
    /// the side of the normal.
    /// @return  false if it does not
    template <int dim>
    bool
    crossing(const dealii::Point<dim>     &first,
             const dealii::Point<dim>     &second,
             const dealii::Point<dim>     &place,
             const dealii::Tensor<1, dim> &normal,
             dealii::Point<dim>           &result)
    {
      constexpr double on_plane = 1e-9;

      const double tolerance = on_plane * first.distance(second);
      const double a         = normal * (first - place);
      const double b         = normal * (second - place);
      if ((a < -tolerance) == (b < -tolerance))
        return false;
      result = first + (a / (a - b)) * (second - first);
      return true;
    }
  } // namespace

  template <int dim>
  bool
  FailurePlane<dim>::cuts(const dealii::Point<dim> &first,
                          const dealii::Point<dim> &second) const
  {
    dealii::Point<dim> place;
    return crossing(first, second, center, normal, place) &&
           place.distance(center) <= slack * radius;
  }

  template <int dim>
  struct FailurePlanes<dim>::Trees
  {
    Tree<dim> tips, places, planes;
  };

  template <int dim>
  FailurePlanes<dim>::FailurePlanes()
    : trees(std::make_unique<Trees>())
  {}

  template <int dim>
  FailurePlanes<dim>::~FailurePlanes() = default;

  template <int dim>
  void
  FailurePlanes<dim>::add_tip(const dealii::Point<dim> &tip)
  {
    trees->tips.insert(std::make_pair(tip, std::size_t(0)));
  }

  template <int dim>
  void
  FailurePlanes<dim>::add_place(const dealii::Point<dim> &center)
  {
    trees->places.insert(std::make_pair(center, all_places.size()));
    all_places.push_back(center);
  }

  template <int dim>
  const std::vector<dealii::Point<dim>> &
  FailurePlanes<dim>::places() const
  {
    return all_places;
  }

  template <int dim>
  void
  FailurePlanes<dim>::open(const std::vector<OverloadedBond>     &bonds,
                           const std::vector<dealii::Point<dim>> &nodes,
                           const std::vector<double>             &horizon)
  {
    // Load factors that differ by little over the lowest count as equal; then
    // the place decides, as the numbers of nodes depend on the number of ranks.
    constexpr double digits = 1e6;
    constexpr double half   = 0.5; // a plane is one horizon wide

    planes.clear();
    trees->planes.clear();
    largest_radius = 0.;

    struct Candidate
    {
      double                      load;
      std::array<unsigned int, 2> nodes;
      dealii::Tensor<1, dim>      normal;
      double                      horizon;
    };
    const OrderByPlace<dim> order{nodes};
    double                  lowest = std::numeric_limits<double>::infinity();
    for (const auto &bond : bonds)
      lowest = std::min(lowest, bond.load_factor);
    std::vector<Candidate> candidates;
    for (const auto &bond : bonds)
      {
        Candidate one;
        for (int d = 0; d < dim; ++d)
          one.normal[d] = bond.normal[d];
        if (one.normal.norm_square() == 0.)
          continue;
        one.load    = std::round(bond.load_factor / lowest * digits);
        one.nodes   = bond.nodes;
        one.horizon = 0.5 * (horizon[bond.nodes[0]] + horizon[bond.nodes[1]]);
        std::sort(one.nodes.begin(), one.nodes.end(), order);
        candidates.push_back(one);
      }
    std::sort(candidates.begin(),
              candidates.end(),
              [&](const Candidate &a, const Candidate &b) {
                return a.load == b.load ? order(a.nodes, b.nodes)
                                        : a.load < b.load;
              });

    const auto open_at = [&](const dealii::Point<dim> &center,
                             const Candidate          &bond) {
      planes.push_back({center, bond.normal, half * bond.horizon});
      largest_radius = std::max(largest_radius, planes.back().radius);
      trees->planes.insert(std::make_pair(center, planes.size() - 1));
    };
    std::vector<const Candidate *> elsewhere;
    for (const auto &bond : candidates)
      {
        const auto &first  = nodes[bond.nodes[0]];
        const auto &second = nodes[bond.nodes[1]];
        if (cut(first, second))
          continue;
        // A horizon beyond the edge of a plane.
        const double reach    = slack * (1. + half) * bond.horizon;
        const auto   center   = middle(first, second);
        auto         next     = center;
        double       distance = std::numeric_limits<double>::infinity();
        bool         is_alone = true;
        const auto   box      = box_around(center, 2. * bond.horizon);
        for (const auto *tree : {&trees->tips, &trees->places, &trees->planes})
          for (auto entry = tree->qbegin(bgi::intersects(box));
               entry != tree->qend();
               ++entry)
            {
              dealii::Point<dim> at;
              const auto         away   = center - entry->first;
              const double       beside = std::abs(away * bond.normal);
              // Ahead: less beside the plane than along it.
              is_alone =
                is_alone && (tree == &trees->tips || away.norm() > reach ||
                             away.norm_square() < slack * 2. * beside * beside);
              if (!crossing(first, second, entry->first, bond.normal, at))
                continue;
              const double d = at.distance(entry->first);
              if (d <= reach && slack * d < distance)
                {
                  distance = d;
                  next     = at;
                }
            }
        if (distance <= reach)
          open_at(next, bond);
        else if (is_alone)
          elsewhere.push_back(&bond);
      }
    for (const auto *bond : elsewhere)
      {
        const auto center =
          middle(nodes[bond->nodes[0]], nodes[bond->nodes[1]]);
        if (!is_near(center, bond->horizon))
          open_at(center, *bond);
      }
  }

  template <int dim>
  const std::vector<FailurePlane<dim>> &
  FailurePlanes<dim>::open_planes() const
  {
    return planes;
  }

  template <int dim>
  bool
  FailurePlanes<dim>::is_near(const dealii::Point<dim> &point,
                              const double              distance) const
  {
    return trees->planes.qbegin(bgi::intersects(
             box_around(point, slack * (distance + largest_radius)))) !=
           trees->planes.qend();
  }

  template <int dim>
  bool
  FailurePlanes<dim>::cut(const dealii::Point<dim> &first,
                          const dealii::Point<dim> &second) const
  {
    const auto box =
      box_around(middle(first, second),
                 slack * (0.5 * first.distance(second) + largest_radius));
    for (auto entry = trees->planes.qbegin(bgi::intersects(box));
         entry != trees->planes.qend();
         ++entry)
      if (planes[entry->second].cuts(first, second))
        return true;
    return false;
  }

  template <int dim>
  void
  FailurePlanes<dim>::keep()
  {
    for (const auto &plane : planes)
      add_place(plane.center);
    planes.clear();
    trees->planes.clear();
  }

  template struct FailurePlane<2>;
  template struct FailurePlane<3>;
  template class FailurePlanes<2>;
  template class FailurePlanes<3>;
} // namespace Perimorph::Coupling
