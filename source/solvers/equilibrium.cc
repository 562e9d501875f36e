#include <perimorph/base/log.h>
#include <perimorph/base/progress.h>
#include <perimorph/base/timing.h>
#include <perimorph/solvers/equilibrium.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace Perimorph::Solvers
{
  namespace
  {
    template <int dim>
    dealii::AffineConstraints<double>
    make_constraints(const Fem::NodePartition<dim> &partition,
                     const Fem::Supports<dim>      &supports)
    {
      const auto                        relevant = partition.relevant_dofs();
      dealii::AffineConstraints<double> constraints(relevant);
      for (const auto &entry : supports.entries())
        if (relevant.is_element(entry.first))
          constraints.add_line(entry.first);
      constraints.close();
      return constraints;
    }

    template <int dim>
    ProblemSize
    problem_size(const Coupling::CoupledProblem<dim> &problem)
    {
      ProblemSize size;
      const auto  counts = problem.counts();
      size.dim           = dim;
      size.n_dofs        = problem.partition().owned_dofs().size();
      size.symmetric     = problem.is_symmetric();
      if (!problem.family_terms().empty())
        {
          size.n_family_bonds = counts.bonds;
          size.n_particles    = counts.particles;
        }
      return size;
    }
  } // namespace

  template <int dim>
  Equilibrium<dim>::Equilibrium(const Coupling::CoupledProblem<dim> &problem,
                                const Fem::Supports<dim>            &supports,
                                const Fem::Loads<dim>               &loads,
                                const EquilibriumParameters         &parameters,
                                Base::Log                           &log,
                                Base::Timing                        &timing)
    : problem(problem)
    , supports(supports)
    , loads(loads)
    , parameters(parameters)
    , log(log)
    , timing(timing)
    , solver_choice(choose_linear_solver(parameters.linear_solver,
                                         parameters.tangent,
                                         problem_size(problem)))
    , constraints(make_constraints(problem.partition(), supports))
    , assembler(problem.partition(), constraints)
  {
    const auto &partition = problem.partition();
    for (auto *vector : {&internal, &external, &rhs, &correction})
      partition.initialize(*vector);
    for (const auto &line : constraints.get_lines())
      if (partition.owned_dofs().is_element(line.index))
        constrained.push_back(
          partition.owned_dofs().index_within_set(line.index));
  }

  template <int dim>
  Equilibrium<dim>::~Equilibrium() = default;

  template <int dim>
  void
  Equilibrium<dim>::prepare_linear_solver(const Vector &displacement)
  {
    if (linear_solver && problem.is_linear())
      return;
    const auto terms =
      solver_choice.matrix_free ? problem.assembled_terms() : problem.terms();
    const std::vector<const Fem::Contribution<dim> *> full_elements = {
      &problem.full_elements()};
    {
      const auto  timer = timing.scope("assembly");
      std::size_t total = 0;
      for (const auto *term : terms)
        total += term->n_blocks();
      Base::Progress progress(log, "Assembly", total);
      if (!pattern_is_made)
        {
          assembler.make_pattern(terms, matrix);
          if (solver_choice.matrix_free)
            assembler.make_pattern(full_elements, preconditioner_matrix);
          pattern_is_made = true;
        }
      assembler.assemble(
        terms,
        displacement,
        matrix,
        [&](const std::size_t done) { progress.update(done); });
      if (solver_choice.matrix_free)
        assembler.assemble(full_elements, displacement, preconditioner_matrix);
    }
    const auto timer = timing.scope("linear_solver");
    linear_solver.reset();
    if (solver_choice.direct)
      {
        linear_solver = make_direct_solver(matrix);
        return;
      }
    tangent = std::make_unique<TangentOperator<dim>>(
      matrix,
      solver_choice.matrix_free ? problem.family_terms()
                                : std::vector<const Fem::Contribution<dim> *>(),
      displacement,
      constraints,
      solver_choice.matrix_free ? preconditioner_matrix : matrix,
      problem.partition().owned_dofs());
    using Clock       = std::chrono::steady_clock;
    auto last_line    = Clock::now();
    auto on_iteration = [this, last_line](const unsigned int iteration,
                                          const double       residual) mutable {
      if (iteration == 0)
        last_line = Clock::now();
      if (Clock::now() - last_line > std::chrono::seconds(5))
        {
          last_line = Clock::now();
          log << "    linear iteration " << iteration << ", relative residual "
              << residual << std::endl;
        }
    };
    linear_solver = make_iterative_solver<dim>(
      [this](Vector &destination, const Vector &source) {
        tangent->vmult(destination, source);
      },
      solver_choice.matrix_free ? preconditioner_matrix : matrix,
      problem.partition(),
      problem.is_symmetric(),
      parameters.linear_tolerance,
      on_iteration);
  }

  template <int dim>
  NewtonRecord
  Equilibrium<dim>::solve(const double  time,
                          Vector       &displacement,
                          const Report &report)
  {
    const auto &partition = problem.partition();
    displacement.zero_out_ghost_values();
    for (const unsigned int entry : constrained)
      displacement.local_element(entry) =
        supports.value(partition.owned_dofs().nth_index_in_set(entry), time);
    external.zero_out_ghost_values();
    external = 0.;
    loads.add_forces(time, partition, external);
    external.compress(dealii::VectorOperation::add);

    const auto evaluate = [&]() {
      const auto timer = timing.scope("assembly");
      displacement.update_ghost_values();
      problem.internal_forces(displacement, internal);
      rhs.zero_out_ghost_values();
      rhs = external;
      rhs -= internal;
      double reactions = 0.;
      for (const unsigned int entry : constrained)
        {
          reactions += std::pow(rhs.local_element(entry), 2);
          rhs.local_element(entry) = 0.;
        }
      reactions = std::sqrt(
        dealii::Utilities::MPI::sum(reactions, partition.communicator()));
      const double residual = rhs.l2_norm();
      // The out-of-balance of the start counts as a force of the problem: with
      // prescribed displacements alone nothing else may remain at the end.
      for (const double force : {residual, reactions, external.l2_norm()})
        if (std::isfinite(force))
          largest_force = std::max(largest_force, force);
      return ResidualNorms{residual, largest_force};
    };
    const auto solve_and_update = [&]() {
      prepare_linear_solver(displacement);
      const auto timer      = timing.scope("linear_solver");
      const auto iterations = linear_solver->solve(correction, rhs);
      displacement.zero_out_ghost_values();
      displacement += correction;
      return iterations;
    };
    return newton(parameters.newton, evaluate, solve_and_update, report);
  }

  template class Equilibrium<2>;
  template class Equilibrium<3>;
} // namespace Perimorph::Solvers
