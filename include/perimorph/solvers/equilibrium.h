#pragma once

#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/fem/follower_pressure.h>
#include <perimorph/fem/loads.h>
#include <perimorph/fem/supports.h>
#include <perimorph/solvers/constraints.h>
#include <perimorph/solvers/direct_solver.h>
#include <perimorph/solvers/inexact_newton.h>
#include <perimorph/solvers/newton.h>
#include <perimorph/solvers/tangent.h>

#include <algorithm>
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
    /// What problems that differ in few equations share, of direct solvers of
    /// linear problems; may be none.
    std::shared_ptr<FactorMemory> memory;
  };

  /// Where a path of equilibrium is followed by its arc length.
  struct ArcLength
  {
    double radius = 0.; ///< of the next step; zero: from the first time step
    Vector direction;   ///< increment of the last step
  };

  /// Finds the displacement whose internal forces balance the loads of a time:
  /// Newton's method on the coupled problem. A linear problem keeps its
  /// factorisation (or preconditioner) over all steps and needs one iteration;
  /// other problems keep a preconditioner while it pays, and their linear
  /// solves go as far as Newton's method has use for.
  template <int dim>
  class Equilibrium
  {
  public:
    using Report = std::function<void(const NewtonIteration &)>;

    Equilibrium(const Mesh::DistributedMesh<dim>    &mesh,
                const Coupling::CoupledProblem<dim> &problem,
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

    bool
    is_symmetric() const
    {
      return problem.is_symmetric() && !follower.acts();
    }

    bool
    is_linear() const
    {
      return problem.is_linear() && !follower.acts();
    }

    /// Linear systems solved, and how many factorisations or preconditioners
    /// they took.
    unsigned int
    linear_solves() const
    {
      return n_linear_solves;
    }
    unsigned int
    linear_solvers_made() const
    {
      return n_linear_solvers;
    }

    /// Solves at a time, starting from the displacement given, which is what it
    /// was before if the record says that there was no convergence.
    NewtonRecord
    solve(double time, Vector &displacement, const Report &report);

    /// One step along the path of equilibrium: time and displacement are both
    /// unknown, their distance from the start is given (Ramm's normal plane).
    /// @param time       in: of the state given, out: of the state found
    /// @param first_step time step that sets the radius of the first arc step
    NewtonRecord
    solve_arc_step(double       &time,
                   Vector       &displacement,
                   ArcLength    &arc,
                   double        first_step,
                   const Report &report);

    /// The stiffness has changed.
    void
    forget_tangent()
    {
      linear_solver.reset();
    }

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

    /// What the next solve needs of the earlier ones besides the displacement.
    struct Memory
    {
      double                           largest_force = 0.;
      typename Constraints<dim>::State supports;
    };

    Memory
    memory() const
    {
      return {largest_force, constraints.state()};
    }

    /// Goes on from a state of equilibrium that was found before; its forces
    /// are evaluated anew.
    void
    restore(const Memory &memory, double time, Vector &displacement);

    /// Largest norm of loads, reactions or first residuals over the solves so
    /// far.
    double
    largest_force_met() const
    {
      return largest_force;
    }

    /// A force that an earlier problem of the same body met: residuals count
    /// relative to it too, so that a body without load is in equilibrium.
    void
    remember_force(const double force)
    {
      largest_force = std::max(largest_force, force);
    }

  private:
    using Terms = typename TangentAssembler<dim>::Terms;

    void
    evaluate_loads(double time);
    /// Residual of the free equations at a state into rhs; also what the
    /// supports still have to move, in `particular`.
    ResidualNorms
    evaluate(double time, Vector &displacement, bool first);
    /// Adds the tangent times a direction to the product; owned entries.
    void
    tangent_product(const Vector &displacement,
                    const Vector &direction,
                    Vector       &result);
    void
    prepare_linear_solver(const Vector &displacement);
    void
    prepare_direct_solver(const Vector &displacement);
    /// Solves with the tangent that was prepared; once more with a new
    /// preconditioner if the one kept fails.
    /// @param tolerance  relative residual
    /// @return  linear iterations
    unsigned int
    solve_tangent(const Vector &displacement,
                  Vector       &solution,
                  const Vector &right_hand_side,
                  double        tolerance);
    Terms
    tangent_terms() const;
    template <typename AnyMatrix>
    void
    assemble_tangent(const Terms  &terms,
                     const Vector &displacement,
                     AnyMatrix    &tangent_matrix);
    std::shared_ptr<const MatrixPart>
    assemble_part(const Terms &terms, const Vector &displacement);
    /// Newton's method whose failures of any kind end up in the record and
    /// leave displacement and constraints as they were.
    NewtonRecord
    guarded(Vector &displacement, const std::function<NewtonRecord()> &solve);

    const Coupling::CoupledProblem<dim>  &problem;
    const Fem::Loads<dim>                &loads;
    EquilibriumParameters                 parameters;
    Base::Log                            &log;
    Base::Timing                         &timing;
    Fem::FollowerPressure<dim>            follower;
    LinearSolverChoice                    solver_choice;
    Constraints<dim>                      constraints;
    TangentAssembler<dim>                 assembler;
    Matrix                                matrix;
    Matrix                                preconditioner_matrix;
    LocalMatrix                           local_matrix; ///< of a direct solver
    std::unique_ptr<TangentOperator<dim>> tangent;
    std::unique_ptr<LinearSolver>         linear_solver;
    PreconditionerAge                     preconditioner_age;
    bool                                  preconditioner_is_kept = false;
    unsigned int                          n_linear_solves        = 0;
    unsigned int                          n_linear_solvers       = 0;
    bool                                  pattern_is_made        = false;
    Vector internal, external, dead_loads, out_of_balance, rhs, correction,
      particular, product;
    double largest_force = 0.;
  };
} // namespace Perimorph::Solvers
