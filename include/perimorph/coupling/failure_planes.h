#pragma once

#include <perimorph/mesh/nodal_mesh.h>

#include <array>
#include <memory>
#include <vector>

namespace Perimorph::Coupling
{
  /// A bond beyond its strength and how the material fails there.
  struct OverloadedBond
  {
    std::array<unsigned int, 2> nodes; ///< global
    double                      load_factor;
    /// Of the plane that opens, a unit vector; zero: the bond breaks alone.
    dealii::Tensor<1, 3> normal;
  };

  /// A crack of one horizon that opens at once: a disc (2D: a line).
  template <int dim>
  struct FailurePlane
  {
    dealii::Point<dim>     center;
    dealii::Tensor<1, dim> normal; ///< unit vector
    double                 radius;

    /// Whether a bond between two points crosses the disc. Points on its plane
    /// lie on the side of the normal.
    bool
    cuts(const dealii::Point<dim> &first,
         const dealii::Point<dim> &second) const;
  };

  /// Opens planes where bonds are overloaded, and remembers where.
  ///
  /// Composites split along their fibres, whatever the stress around: a bond
  /// that breaks by its stress alone knows nothing of that, since around a tip
  /// criteria of stress hardly depend on the direction. So the plane on which
  /// the material fails opens through the bond, half a horizon to each side,
  /// and cuts all bonds that cross it. Where the bond crosses the continuation
  /// of a tip or of an earlier plane, a horizon beyond its edge, it opens
  /// there: cracks go on instead of beginning anew beside. These come first,
  /// then the others, the most overloaded bonds before the less. No crack
  /// begins ahead of a plane that opened before, within a horizon of its edge,
  /// but not in line with it: that one will relieve the bond.
  ///
  /// The same on all ranks.
  template <int dim>
  class FailurePlanes
  {
  public:
    FailurePlanes();
    ~FailurePlanes();

    /// A tip of a crack that is there from the start.
    void
    add_tip(const dealii::Point<dim> &tip);

    /// A plane that opened before.
    void
    add_place(const dealii::Point<dim> &center);

    /// Centers of all planes that opened before, in their order.
    const std::vector<dealii::Point<dim>> &
    places() const;

    /// Replaces the open planes by those of these bonds.
    /// @param bonds    of all ranks, in any order; those with a normal count
    /// @param horizon  of nodes
    void
    open(const std::vector<OverloadedBond>     &bonds,
         const std::vector<dealii::Point<dim>> &nodes,
         const std::vector<double>             &horizon);

    const std::vector<FailurePlane<dim>> &
    open_planes() const;

    /// Whether an open plane comes nearer to a point than a distance; true for
    /// some that lie a little further.
    bool
    is_near(const dealii::Point<dim> &point, double distance) const;

    /// Whether open planes cut a bond.
    bool
    cut(const dealii::Point<dim> &first,
        const dealii::Point<dim> &second) const;

    /// The planes stay open; cracks go on from there.
    void
    keep();

  private:
    struct Trees;
    std::vector<dealii::Point<dim>> all_places;
    std::vector<FailurePlane<dim>>  planes;
    double                          largest_radius = 0.;
    std::unique_ptr<Trees>          trees;
  };
} // namespace Perimorph::Coupling
