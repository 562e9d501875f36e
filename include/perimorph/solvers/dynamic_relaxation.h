#pragma once

#include <perimorph/solvers/newton.h>
#include <perimorph/solvers/nodal_forces.h>

namespace Perimorph::Solvers
{
  struct RelaxationParameters
  {
    double       tolerance     = 1e-9; ///< as of Newton's method
    unsigned int maximum_steps = 200000;
  };

  /// Adaptive dynamic relaxation: a motion with a mass of its own (a bound of
  /// the rows of the stiffness, so that steps of one time unit are stable) and
  /// with damping near the critical one of the slowest motion, whose frequency
  /// comes from the Rayleigh quotients of displacement and velocity. It ends in
  /// equilibrium and needs no matrix. Source: Underwood (1983), as used by
  /// Hashim (2021), section 2.6.
  template <int dim>
  class DynamicRelaxation
  {
  public:
    DynamicRelaxation(NodalForces<dim>           &forces,
                      const RelaxationParameters &parameters);

    /// Solves at a time, starting from the displacement given, which is what it
    /// was before if the record says that there was no convergence. Steps of
    /// the motion count as linear iterations.
    /// @param report  called now and then
    NewtonRecord
    solve(double                                              time,
          Vector                                             &displacement,
          const std::function<void(const NewtonIteration &)> &report);

  private:
    void
    find_mass(const Vector &displacement);

    NodalForces<dim>    &forces;
    RelaxationParameters parameters;
    Vector               mass, inverse_mass;
    double               largest_force = 0.;
  };
} // namespace Perimorph::Solvers
