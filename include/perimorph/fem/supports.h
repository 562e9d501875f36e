#pragma once

#include <perimorph/fem/boundary_conditions.h>
#include <perimorph/mesh/distributed_mesh.h>

#include <deal.II/base/tensor.h>

#include <map>
#include <string>
#include <vector>

namespace Perimorph::Fem
{
  /// Plane of a symmetry support.
  template <int dim>
  struct SymmetryPlane
  {
    dealii::Point<dim>        point;
    dealii::Tensor<1, dim>    normal; ///< unit, outward
    std::vector<unsigned int> nodes;  ///< that are held
  };

  /// Prescribed displacements of all nodes, identical on every rank.
  template <int dim>
  class Supports
  {
  public:
    /// @param times  all times of the run: every value is evaluated once, so
    ///               that bad input is found before the solve
    /// @throws Base::InputError  boundaries not in the mesh, a symmetry
    ///         boundary that is not a plane along an axis, contradicting or
    ///         non-finite values, a point outside the body
    Supports(const Mesh::DistributedMesh<dim> &mesh,
             const BoundaryConditions<dim>    &conditions,
             const std::vector<double>        &times);

    struct Entry
    {
      const Parameters::Expression *expression; ///< null: zero
      std::string                   label;      ///< of the condition
      std::string                   boundary;   ///< empty: a point, a pin
    };

    /// Prescribed degrees of freedom (dim * node + component).
    const std::map<unsigned int, Entry> &
    entries() const
    {
      return prescribed;
    }

    double
    value(unsigned int dof, double time) const;

    /// Fixes a degree of freedom at zero (removal of rigid motion).
    void
    pin(unsigned int dof);

    const std::vector<SymmetryPlane<dim>> &
    symmetry_planes() const
    {
      return planes;
    }

  private:
    void
    add(unsigned int dof, const Entry &entry, const std::vector<double> &times);

    const Mesh::DistributedMesh<dim> &mesh;
    BoundaryConditions<dim>           conditions; ///< owns the expressions
    std::map<unsigned int, Entry>     prescribed;
    std::vector<SymmetryPlane<dim>>   planes;
  };

  /// Node nearest to a point.
  /// @throws Base::InputError  the point is farther from the body than the
  ///                           spacing there
  template <int dim>
  unsigned int
  node_at(const Mesh::NodalMesh<dim> &mesh,
          const std::vector<double>  &point,
          const std::string          &used_by);
} // namespace Perimorph::Fem
