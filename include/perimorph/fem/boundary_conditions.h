#pragma once

#include <perimorph/parameters/expression.h>

#include <deal.II/base/point.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Perimorph::Fem
{
  /// Scalar expressions for some components of a vector.
  template <int dim>
  using ComponentExpressions =
    std::array<std::optional<Parameters::Expression>, dim>;

  /// Zero where a component has no expression.
  template <int dim>
  dealii::Tensor<1, dim>
  evaluate(const ComponentExpressions<dim> &components,
           const dealii::Point<dim>        &point,
           const double                     time)
  {
    dealii::Tensor<1, dim> value;
    for (int d = 0; d < dim; ++d)
      if (components[d])
        value[d] = components[d]->value(point, time);
    return value;
  }

  /// Prescribed displacement on a named boundary or at the node nearest to a
  /// point (boundary empty).
  template <int dim>
  struct DisplacementCondition
  {
    std::string               boundary;
    std::vector<double>       point;
    ComponentExpressions<dim> components;

    std::string
    label() const;
  };

  /// A boundary held as a whole: the mean of its displacement (the reaction is
  /// spread evenly), or a rigid plate glued to it, held at its centroid.
  template <int dim>
  struct BoundaryMotion
  {
    std::string               boundary;
    ComponentExpressions<dim> translation; ///< free where empty
    /// Angle [rad]; in 3D zero, about all axes. Free if empty.
    std::optional<Parameters::Expression> rotation;
  };

  /// Force per reference area on a named boundary; a pressure pushes against
  /// the outward normal, of the deformed surface if it follows.
  template <int dim>
  struct SurfaceLoad
  {
    std::string                           boundary;
    ComponentExpressions<dim>             traction;
    std::optional<Parameters::Expression> pressure;
    bool                                  follows = false;
  };

  /// Force per reference volume, in a named volume or everywhere (empty).
  template <int dim>
  struct BodyForce
  {
    std::string               volume;
    ComponentExpressions<dim> components;
  };

  /// Force at the node nearest to a point.
  template <int dim>
  struct PointForce
  {
    std::vector<double>       point;
    ComponentExpressions<dim> components;
  };

  /// Everything that supports and loads the body.
  template <int dim>
  struct BoundaryConditions
  {
    std::vector<std::string>                symmetry;
    std::vector<DisplacementCondition<dim>> displacement;
    std::vector<BoundaryMotion<dim>>        mean_displacement;
    std::vector<BoundaryMotion<dim>>        rigid_plates;
    std::vector<SurfaceLoad<dim>>           surface_loads;
    std::vector<BodyForce<dim>>             body_forces;
    std::vector<PointForce<dim>>            point_forces;
    bool                                    remove_rigid_motion = true;
  };
} // namespace Perimorph::Fem
