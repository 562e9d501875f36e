#pragma once

#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/fem/loads.h>
#include <perimorph/fem/supports.h>
#include <perimorph/solvers/linear_solver.h>
#include <perimorph/solvers/newton.h>
#include <perimorph/solvers/tangent.h>

#include <functional>
#include <memory>

namespace Perimorph::Base
{
  class Log;
  class Timing;
} // namespace Perimorph::Base

namespace Perimorph::Solvers
{
  struct EquilibriumParameters
  {
    LinearSolverKind linear_solver    = LinearSolverKind::automatic;
    TangentKind      tangent          = TangentKind::automatic;
    double           linear_tolerance = 1e-12;
    NewtonParameters newton;
  };

  /// Finds the displacement whose internal forces balance the loads of a time:
  /// Newton's method on the coupled problem. A linear problem keeps its
  /// factorisation (or preconditioner) over all steps and needs one iteration.
  template <int dim>
  class Equilibrium
  {
  public:
    using Report = std::function<void(unsigned int iteration,
                                      double       relative_residual,
                                      unsigned int linear_iterations)>;

    Equilibrium(const Coupling::CoupledProblem<dim> &problem,
                const Fem::Supports<dim>            &supports,
                const Fem::Loads<dim>               &loads,
                const EquilibriumParameters         &parameters,
                Base::Log                           &log,
                Base::Timing                        &timing);
    ~Equilibrium();

    const LinearSolverChoice &
    choice() const
    {
      return solver_choice;
    }

    /// Solves at a time, starting from the displacement given.
    /// @throws Base::SolveError  a singular tangent, no linear convergence
    NewtonRecord
    solve(double time, Vector &displacement, const Report &report);

    /// Forces of the last state evaluated; owned entries.
    const Vector &
    internal_forces() const
    {
      return internal;
    }
    const Vector &
    external_forces() const
    {
      return external;
    }

    /// Largest norm of loads, reactions or residuals over the solves so far.
    double
    largest_force_met() const
    {
      return largest_force;
    }

  private:
    void
    prepare_linear_solver(const Vector &displacement);

    const Coupling::CoupledProblem<dim>  &problem;
    const Fem::Supports<dim>             &supports;
    const Fem::Loads<dim>                &loads;
    EquilibriumParameters                 parameters;
    Base::Log                            &log;
    Base::Timing                         &timing;
    LinearSolverChoice                    solver_choice;
    dealii::AffineConstraints<double>     constraints;
    std::vector<unsigned int>             constrained; ///< owned, local entries
    TangentAssembler<dim>                 assembler;
    Matrix                                matrix;
    Matrix                                preconditioner_matrix;
    std::unique_ptr<TangentOperator<dim>> tangent;
    std::unique_ptr<LinearSolver>         linear_solver;
    bool                                  pattern_is_made = false;
    Vector                                internal, external, rhs, correction;
    double                                largest_force = 0.;
  };
} // namespace Perimorph::Solvers
