#pragma once

#include <perimorph/fem/node_partition.h>

#include <vector>

namespace Perimorph::Solvers
{
  /// A state of motion; owned entries.
  struct MotionState
  {
    Fem::Vector displacement, velocity, acceleration;
    double      time = 0.;
    /// Work of loads and moving supports so far, by the trapezoidal rule.
    double work = 0.;
  };

  /// Mass of every unknown; owned entries.
  /// @param mass  of all nodes of the mesh (Fem::lumped_mass)
  template <int dim>
  Fem::Vector
  mass_of_unknowns(const Fem::NodePartition<dim> &partition,
                   const std::vector<double>     &mass);

  /// 1/2 sum m |v|^2 of all ranks.
  template <int dim>
  double
  kinetic_energy(const Fem::NodePartition<dim> &partition,
                 const std::vector<double>     &mass,
                 const Fem::Vector             &velocity);
} // namespace Perimorph::Solvers
