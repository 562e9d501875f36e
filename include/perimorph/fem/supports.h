#pragma once

#include <perimorph/fem/boundary_conditions.h>
#include <perimorph/mesh/distributed_mesh.h>

#include <deal.II/base/tensor.h>

#include <array>
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

  /// sum of factor * displacement component = value.
  struct LinearConstraint
  {
    std::map<unsigned int, double> factors; ///< of dim * node + component
    const Parameters::Expression  *value;
    dealii::Point<3>               center; ///< of the boundary, for the value
  };

  /// Nodes that move like a rigid body.
  template <int dim>
  struct RigidPlate
  {
    std::string                                     boundary;
    dealii::Point<dim>                              center;
    std::vector<unsigned int>                       nodes;
    std::array<const Parameters::Expression *, dim> translation; ///< null: free
    const Parameters::Expression                   *rotation;    ///< null: free
  };

  /// Prescribed displacements of all nodes, identical on every rank. Hanging
  /// nodes follow their parents and are never held themselves.
  template <int dim>
  class Supports
  {
  public:
    /// @param times  all times of the run: every value is evaluated once, so
    ///               that bad input is found before the solve
    /// @throws Base::InputError  boundaries not in the mesh, a symmetry
    ///         boundary that is not a plane along an axis, contradicting or
    ///         non-finite values, a point outside the body, a boundary that is
    ///         held twice
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

    /// Constraints on the mean motion of boundaries.
    const std::vector<LinearConstraint> &
    mean_constraints() const
    {
      return means;
    }

    const std::vector<RigidPlate<dim>> &
    rigid_plates() const
    {
      return plates;
    }

    /// True if anything is held.
    bool
    act() const
    {
      return !prescribed.empty() || !held_as_a_whole.empty();
    }

    /// True if any prescribed value at a time is not zero.
    bool
    move(double time) const;

    /// True if a support of any kind acts on an unknown.
    bool
    hold(unsigned int dof) const;

    /// Boundary that holds a node as a whole, empty if none.
    const std::string &
    boundary_motion_at(unsigned int node) const;

    /// Nodes whose motion depends on that of other nodes.
    std::vector<unsigned int>
    coupled_nodes() const;

    /// Nodes held by a condition at a point, with its label.
    std::map<unsigned int, std::string>
    point_supports() const;

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

    void
    add_mean(const BoundaryMotion<dim> &motion);
    void
    add_plate(const BoundaryMotion<dim> &motion);
    /// Takes the nodes of a boundary for a motion as a whole.
    /// @param alone  no other support may act there
    std::vector<unsigned int>
    claim(const BoundaryMotion<dim> &motion,
          const std::string         &entry,
          bool                       alone);

    const Mesh::DistributedMesh<dim>   &mesh;
    BoundaryConditions<dim>             conditions; ///< owns the expressions
    std::map<unsigned int, Entry>       prescribed;
    std::vector<SymmetryPlane<dim>>     planes;
    std::vector<LinearConstraint>       means;
    std::vector<RigidPlate<dim>>        plates;
    std::map<unsigned int, std::string> held_as_a_whole; ///< node, boundary
  };

  /// Node nearest to a point, of those that do not hang.
  /// @throws Base::InputError  the point is farther from the body than the
  ///                           spacing there
  template <int dim>
  unsigned int
  node_at(const Mesh::NodalMesh<dim> &mesh,
          const std::vector<double>  &point,
          const std::string          &used_by);
} // namespace Perimorph::Fem
