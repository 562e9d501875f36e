#pragma once

#include <perimorph/base/point_cloud.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <bitset>
#include <vector>

namespace Perimorph::Coupling
{
  /// What is left of a cell on one side of a crack, with one point of
  /// integration.
  template <int dim>
  struct CellPart
  {
    unsigned int       cell;
    double             volume;
    dealii::Point<dim> center; ///< a point of the part, near its centroid
    /// Nodes on the same side, and weights of their values in the gradient of
    /// the part; exact for linear fields [1 / length]. Empty if too few nodes
    /// are seen: the part does no work.
    std::vector<unsigned int>           nodes;
    std::vector<dealii::Tensor<1, dim>> gradients;
  };

  /// Cells that cracks touch, in parts: points of the cell that see the same
  /// of its nodes belong together (numerics-cracks.md, B2).
  template <int dim>
  class CellParts
  {
  public:
    /// All references must outlive the object.
    /// @param radius_factor  first radius of the least-squares fit of the
    ///                       gradient over the spacing
    CellParts(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::CrackSet<dim> &cracks,
              double                      radius_factor);

    bool
    is_touched(const unsigned int cell) const
    {
      return first_part[cell] != none;
    }

    /// In rising order of cells.
    const std::vector<CellPart<dim>> &
    parts() const
    {
      return list;
    }

    std::vector<CellPart<dim>> &
    parts()
    {
      return list;
    }

    /// Index of the part of a touched cell that holds a point.
    unsigned int
    part_at(unsigned int cell, const dealii::Point<dim> &point) const;

  private:
    static constexpr unsigned int none    = static_cast<unsigned int>(-1);
    static constexpr unsigned int n_nodes = 1u << dim;

    /// Which nodes of the cell a point sees.
    using Sight = std::bitset<n_nodes>;

    Sight
    sight(unsigned int cell, const dealii::Point<dim> &point) const;

    void
    split(unsigned int cell);

    void
    fit_gradient(CellPart<dim> &part, double radius_factor) const;

    const Mesh::NodalMesh<dim> &mesh;
    const Bonds::CrackSet<dim> &cracks;
    const Base::PointCloud<dim> cloud;
    std::vector<CellPart<dim>>  list;
    std::vector<Sight>          sights;     ///< of the parts
    std::vector<unsigned int>   first_part; ///< per cell, or none
  };
} // namespace Perimorph::Coupling
