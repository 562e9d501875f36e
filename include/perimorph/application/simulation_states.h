#pragma once

#include <perimorph/application/post_processing.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/solvers/dynamic_relaxation.h>
#include <perimorph/solvers/equilibrium.h>
#include <perimorph/solvers/motion_state.h>

#include <array>
#include <memory>
#include <optional>

namespace Perimorph::Application
{
  /// One method on the mesh: the run itself, or its finite-element companion.
  template <int dim>
  struct Method
  {
    Mesh::RegionMap                                region;
    std::unique_ptr<Coupling::CoupledProblem<dim>> problem;
    std::unique_ptr<Solvers::Equilibrium<dim>>     equilibrium;
    Fem::Vector                                    displacement;
    double                                         time = 0.;
    Solvers::MotionState motion; ///< of bodies that move
    /// Where equilibrium is found by relaxation.
    std::unique_ptr<Solvers::NodalForces<dim>>       forces;
    std::unique_ptr<Solvers::DynamicRelaxation<dim>> relaxation;

    Method()          = default;
    Method(Method &&) = default;
    /// Assigning a distributed vector keeps its old ghosts: swap instead.
    Method &
    operator=(Method &&other)
    {
      std::swap(region, other.region);
      std::swap(equilibrium, other.equilibrium);
      std::swap(problem, other.problem);
      displacement.swap(other.displacement);
      time = other.time;
      std::swap(motion.time, other.motion.time);
      std::swap(motion.work, other.motion.work);
      motion.displacement.swap(other.motion.displacement);
      motion.velocity.swap(other.motion.velocity);
      motion.acceleration.swap(other.motion.acceleration);
      std::swap(relaxation, other.relaxation);
      std::swap(forces, other.forces);
      return *this;
    }
  };

  /// A load step or arc step that was accepted.
  struct Step
  {
    unsigned int number;
    double       time;
    unsigned int n_increments      = 0; ///< more than one after cuts
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    double       relative_residual = 0.;
    bool         between = false; ///< inside of an event: no checkpoint
  };

  /// How far the loads were followed; they are followed from here on.
  struct Progress
  {
    unsigned int       number   = 0;  ///< load steps, arc steps or advances
    double             fraction = 1.; ///< of the next increment of a step
    double             peak     = 0.; ///< largest time of the arc length
    Solvers::ArcLength arc;
    Step               step{0, 0.}; ///< the last one accepted
  };

  /// A state of motion that is kept, and what led to it.
  template <int dim>
  struct Instant
  {
    unsigned int number;
    State<dim>   state          = {};
    double       kinetic_energy = 0., energy_balance = 0.;
    unsigned int time_steps        = 0;
    unsigned int newton_iterations = 0, linear_iterations = 0;
  };

  /// The next advance of one tip, and what it would release.
  template <int dim>
  struct Advance
  {
    Bonds::CrackFacet<dim> facet;
    double                 length; ///< that is new crack in the body
    /// Potential energy at fixed loads; infinite if it cuts off what nothing
    /// holds, so that there is no state after it.
    double      released;
    double      switched; ///< change by the growth of the core
    Method<dim> after;    ///< the state behind it, if there is one
    /// Before it, by the domain integral where that has room.
    std::optional<double> J;
  };

  /// A bond and the factor of the loads at which it breaks.
  struct BondLoad
  {
    std::array<unsigned int, 2> nodes;
    double                      factor;
    double                      energy;
    bool                        in_core; ///< may break
    dealii::Tensor<1, 3>        normal;  ///< of StrengthLoad
  };
} // namespace Perimorph::Application
