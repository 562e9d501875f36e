#include <perimorph/base/exceptions.h>
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
    /// Whether families or bonds of any rank have a hanging node.
    template <int dim>
    bool
    particles_hang(const Coupling::CoupledProblem<dim> &problem,
                   const Mesh::HangingPoints           &hanging)
    {
      bool                      found = false;
      std::vector<unsigned int> nodes;
      if (!hanging.empty())
        for (const auto *term : problem.particle_terms())
          for (unsigned int block = 0; block < term->n_blocks(); ++block)
            {
              term->block_nodes(block, nodes);
              for (const unsigned int node : nodes)
                found =
                  found || hanging.count(problem.partition().global(node)) > 0;
            }
      return dealii::Utilities::MPI::max(found ? 1 : 0,
                                         problem.partition().communicator()) ==
             1;
    }

    template <int dim>
    ProblemSize
    problem_size(const Coupling::CoupledProblem<dim> &problem,
                 const bool                           reuses_factors)
    {
      ProblemSize size;
      const auto  counts  = problem.counts();
      size.dim            = dim;
      size.n_dofs         = problem.partition().owned_dofs().size();
      size.n_particles    = counts.particles;
      size.n_bonds        = counts.bonds;
      size.families       = problem.has_families();
      size.reuses_factors = reuses_factors;
      size.n_ranks        = dealii::Utilities::MPI::n_mpi_processes(
        problem.partition().communicator());
      return size;
    }
  } // namespace

  template <int dim>
  Equilibrium<dim>::Equilibrium(const Mesh::DistributedMesh<dim>    &mesh,
                                const Coupling::CoupledProblem<dim> &problem,
                                const Fem::Supports<dim>            &supports,
                                const Fem::Loads<dim>               &loads,
                                const EquilibriumParameters         &parameters,
                                Base::Log                           &log,
                                Base::Timing                        &timing)
    : problem(problem)
    , loads(loads)
    , parameters(parameters)
    , log(log)
    , timing(timing)
    , follower(mesh, problem.partition(), loads.surface_loads())
    , solver_choice(choose_linear_solver(
        parameters.linear_solver,
        parameters.tangent,
        problem_size(problem, parameters.memory != nullptr)))
    , constraints(problem.partition(),
                  supports,
                  mesh.nodal().hanging,
                  problem.is_linear())
    , assembler(problem.partition(), constraints.lines())
    , preconditioner_age(20.)
  {
    if (solver_choice.matrix_free && constraints.couple_unknowns())
      {
        solver_choice.matrix_free = false;
        solver_choice.reason += "; assembled because supports couple unknowns";
      }
    if (solver_choice.matrix_free &&
        particles_hang(problem, mesh.nodal().hanging))
      {
        solver_choice.matrix_free = false;
        solver_choice.reason += "; assembled because of hanging nodes";
      }
    const auto &partition = problem.partition();
    for (auto *vector : {&internal,
                         &external,
                         &dead_loads,
                         &out_of_balance,
                         &rhs,
                         &correction,
                         &particular,
                         &product})
      partition.initialize(*vector);
  }

  template <int dim>
  Equilibrium<dim>::~Equilibrium() = default;

  template <int dim>
  typename TangentAssembler<dim>::Terms
  Equilibrium<dim>::tangent_terms() const
  {
    auto terms =
      solver_choice.matrix_free ? problem.assembled_terms() : problem.terms();
    if (follower.acts())
      terms.push_back(&follower);
    return terms;
  }

  template <int dim>
  template <typename AnyMatrix>
  void
  Equilibrium<dim>::assemble_tangent(const Terms  &terms,
                                     const Vector &displacement,
                                     AnyMatrix    &tangent_matrix)
  {
    std::size_t total = 0;
    for (const auto *term : terms)
      total += term->n_blocks();
    Base::Progress progress(log, "Assembly", total);
    assembler.assemble(terms,
                       displacement,
                       tangent_matrix,
                       [&](const std::size_t done) { progress.update(done); });
    constraints.add_geometric_stiffness(out_of_balance, tangent_matrix);
  }

  template <int dim>
  std::shared_ptr<const MatrixPart>
  Equilibrium<dim>::assemble_part(const Terms  &terms,
                                  const Vector &displacement)
  {
    if (!pattern_is_made)
      assembler.make_pattern(terms, local_matrix);
    pattern_is_made = !is_linear();
    assemble_tangent(terms, displacement, local_matrix.matrix);
    auto part = std::make_shared<const MatrixPart>(
      matrix_part(local_matrix, is_symmetric()));
    if (is_linear())
      local_matrix.clear();
    return part;
  }

  template <int dim>
  void
  Equilibrium<dim>::prepare_direct_solver(const Vector &displacement)
  {
    auto *memory = is_linear() ? parameters.memory.get() : nullptr;

    MatrixParts parts;
    {
      const auto timer = timing.scope("assembly");
      auto       terms = tangent_terms();
      if (const auto elements = memory ? problem.elements() : nullptr)
        {
          if (memory->elements != elements)
            memory->part_of_elements =
              assemble_part({elements.get()}, displacement);
          memory->elements = elements;
          parts.push_back(memory->part_of_elements);
          terms.erase(std::find(terms.begin(), terms.end(), elements.get()));
        }
      parts.push_back(assemble_part(terms, displacement));
    }
    const auto timer = timing.scope("linear_solver");
    linear_solver.reset();
    ++n_linear_solvers;
    linear_solver = make_direct_solver(std::move(parts),
                                       problem.partition().owned_dofs(),
                                       problem.partition().communicator(),
                                       memory);
  }

  template <int dim>
  void
  Equilibrium<dim>::prepare_linear_solver(const Vector &displacement)
  {
    if (linear_solver && is_linear())
      return;
    if (solver_choice.direct)
      {
        prepare_direct_solver(displacement);
        return;
      }
    preconditioner_is_kept = linear_solver && preconditioner_age.still_pays();
    const Terms preconditioner_terms = problem.preconditioner_terms();
    {
      const auto timer = timing.scope("assembly");
      if (!pattern_is_made)
        {
          assembler.make_pattern(tangent_terms(), matrix);
          if (solver_choice.matrix_free)
            assembler.make_pattern(preconditioner_terms, preconditioner_matrix);
          pattern_is_made = true;
        }
      assemble_tangent(tangent_terms(), displacement, matrix);
      if (solver_choice.matrix_free && !preconditioner_is_kept)
        assembler.assemble(preconditioner_terms,
                           displacement,
                           preconditioner_matrix);
      else if (!preconditioner_is_kept && !is_linear())
        // Multigrid smooths with the matrix it was made of.
        preconditioner_matrix.copy_from(matrix);
    }
    const auto  timer             = timing.scope("linear_solver");
    const auto &preconditioner_of = solver_choice.matrix_free || !is_linear()
                                      ? preconditioner_matrix
                                      : matrix;
    const Terms particles =
      solver_choice.matrix_free ? problem.particle_terms() : Terms();
    tangent =
      std::make_unique<TangentOperator<dim>>(matrix,
                                             particles,
                                             displacement,
                                             constraints.lines(),
                                             preconditioner_of,
                                             problem.partition().owned_dofs());
    if (preconditioner_is_kept)
      return;
    ++n_linear_solvers;
    preconditioner_age.renew();
    linear_solver.reset();
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
      preconditioner_of,
      problem.partition(),
      is_symmetric(),
      on_iteration);
  }

  template <int dim>
  unsigned int
  Equilibrium<dim>::solve_tangent(const Vector &displacement,
                                  Vector       &solution,
                                  const Vector &right_hand_side,
                                  const double  tolerance)
  {
    const auto attempt = [&]() {
      const auto timer = timing.scope("linear_solver");
      const auto iterations =
        linear_solver->solve(solution, right_hand_side, tolerance);
      preconditioner_age.count(iterations, tolerance);
      ++n_linear_solves;
      return iterations;
    };
    try
      {
        return attempt();
      }
    catch (const Base::SolveError &)
      {
        if (!preconditioner_is_kept)
          throw;
      }
    preconditioner_age.expire();
    prepare_linear_solver(displacement);
    return attempt();
  }

  template <int dim>
  void
  Equilibrium<dim>::evaluate_loads(const double time)
  {
    dead_loads.zero_out_ghost_values();
    dead_loads = 0.;
    loads.add_forces(time, problem.partition(), dead_loads);
    dead_loads.compress(dealii::VectorOperation::add);
    constraints.condense_hanging(dead_loads);
    follower.set_time(time);
  }

  template <int dim>
  void
  Equilibrium<dim>::tangent_product(const Vector &displacement,
                                    const Vector &direction,
                                    Vector       &result)
  {
    result.zero_out_ghost_values();
    result = 0.;
    direction.update_ghost_values();
    for (const auto *term : problem.terms())
      term->add_tangent_product(displacement, direction, result);
    if (follower.acts())
      follower.add_tangent_product(displacement, direction, result);
    result.compress(dealii::VectorOperation::add);
    direction.zero_out_ghost_values();
  }

  template <int dim>
  ResidualNorms
  Equilibrium<dim>::evaluate(const double time,
                             Vector      &displacement,
                             const bool   first)
  {
    const auto timer = timing.scope("assembly");
    displacement.update_ghost_values();
    problem.internal_forces(displacement, internal);
    constraints.condense_hanging(internal);
    external.zero_out_ghost_values();
    external = 0.;
    if (follower.acts())
      {
        follower.add_residual(displacement, external);
        external.compress(dealii::VectorOperation::add);
        constraints.condense_hanging(external);
      }
    external.sadd(-1., 1., dead_loads);
    out_of_balance.zero_out_ghost_values();
    out_of_balance = external;
    out_of_balance -= internal;
    const double reactions = constraints.support_norm(out_of_balance);

    ResidualNorms norms;
    norms.supports_move =
      constraints.particular(time, displacement, particular);
    rhs.zero_out_ghost_values();
    rhs = out_of_balance;
    if (norms.supports_move)
      {
        tangent_product(displacement, particular, product);
        rhs -= product;
      }
    constraints.condense(rhs);
    norms.residual = rhs.l2_norm();
    // The out-of-balance of the start counts as a force of the problem: with
    // prescribed displacements alone nothing else may remain at the end. Those
    // of later iterations do not: they can be far too large.
    for (const double force : {first ? norms.residual : 0., external.l2_norm()})
      if (std::isfinite(force))
        largest_force = std::max(largest_force, force);
    norms.scale = std::max(largest_force, reactions);
    return norms;
  }

  template <int dim>
  NewtonRecord
  Equilibrium<dim>::guarded(Vector                              &displacement,
                            const std::function<NewtonRecord()> &solve)
  {
    displacement.zero_out_ghost_values();
    const Vector start       = displacement;
    const auto   start_state = constraints.state();
    NewtonRecord record;
    try
      {
        record = solve();
      }
    catch (const Base::SolveError &error)
      {
        record.converged = false;
        record.reason    = error.what();
      }
    problem.forget_stress();
    if (record.converged)
      {
        largest_force =
          std::max(largest_force, constraints.support_norm(out_of_balance));
        return record;
      }
    displacement.zero_out_ghost_values();
    displacement = start;
    constraints.restore(start_state);
    return record;
  }

  template <int dim>
  NewtonRecord
  Equilibrium<dim>::solve(const double  time,
                          Vector       &displacement,
                          const Report &report)
  {
    Vector                           base;
    typename Constraints<dim>::State base_state;
    NewtonActions                    actions;
    ForcingTerm   forcing(parameters.linear_tolerance, is_linear());
    ResidualNorms norms;
    actions.evaluate = [&](const unsigned int iteration) {
      norms = evaluate(time, displacement, iteration == 0);
      return norms;
    };
    double step_length = 0.; // of the step that led here
    actions.solve      = [&]() {
      if (step_length > 0. && !problem.is_linear())
        {
          correction *= step_length;
          correction.update_ghost_values();
          base.update_ghost_values();
          problem.extrapolate_stress(base,
                                     correction,
                                     solver_choice.matrix_free &&
                                       !preconditioner_age.still_pays());
        }
      prepare_linear_solver(displacement);
      const auto iterations =
        solve_tangent(displacement,
                      correction,
                      rhs,
                      forcing.next(norms.residual,
                                   parameters.newton.tolerance * norms.scale));
      constraints.distribute(correction);
      correction += particular;
      displacement.zero_out_ghost_values();
      base       = displacement;
      base_state = constraints.state();
      return iterations;
    };
    actions.move = [&](const double step) {
      displacement.zero_out_ghost_values();
      if (step < 1.)
        {
          displacement = base;
          constraints.restore(base_state);
        }
      constraints.move(step, correction, displacement);
      step_length = step;
    };
    actions.slope  = [&]() { return rhs * correction; };
    actions.report = report;
    return guarded(displacement, [&]() {
      evaluate_loads(time);
      return newton(parameters.newton, actions);
    });
  }

  template <int dim>
  void
  Equilibrium<dim>::restore(const Memory &memory,
                            const double  time,
                            Vector       &displacement)
  {
    constraints.restore(memory.supports);
    evaluate_loads(time);
    evaluate(time, displacement, false);
    displacement.zero_out_ghost_values();
    problem.forget_stress();
    largest_force = memory.largest_force;
  }

  template class Equilibrium<2>;
  template class Equilibrium<3>;
} // namespace Perimorph::Solvers
