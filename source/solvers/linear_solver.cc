#include <perimorph/base/exceptions.h>
#include <perimorph/solvers/linear_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <sstream>

namespace Perimorph::Solvers
{
  LinearSolverChoice
  choose_linear_solver(const LinearSolverKind solver,
                       const TangentKind      tangent,
                       const ProblemSize     &size)
  {
    const double neighbors =
      size.n_particles > 0 ? double(size.n_bonds) / size.n_particles : 0.;
    const double share = std::min(1.,
                                  double(size.n_particles) * size.dim /
                                    std::max<std::size_t>(1, size.n_dofs));
    // A row of the assembled tangent of a family reaches two horizons.
    const double two_horizons = size.dim == 2 ? 3.2 : 5.;
    const double reach        = size.families ? two_horizons : 1.;
    const double elements     = size.dim == 2 ? 9. : 27.;
    const auto   fill         = [&](const double rows) {
      return (1. - share) * elements + share * std::max(1., rows * neighbors);
    };

    LinearSolverChoice choice;
    std::ostringstream reason;
    reason << size.n_dofs << " unknowns, about "
           << static_cast<int>(fill(reach) * size.dim) << " entries per row";
    if (solver == LinearSolverKind::automatic)
      {
        // Measured: where both take the same time. A product with bonds is as
        // much cheaper than their matrix as one with families. Iterations gain
        // from ranks, factorisation does not, but from many similar problems.
        const bool   once = !size.reuses_factors;
        const double fill_ratio =
          std::max(1., fill(once ? two_horizons : reach) / elements);
        const double cost =
          size.n_dofs * std::pow(fill_ratio, size.dim == 2 && once ? 2. : 1.);
        const double limit = size.dim == 3 ? 6000.
                             : once
                               ? 800000. / std::pow(double(size.n_ranks), 2)
                               : 150000.;
        choice.direct      = cost < limit;
        reason << (choice.direct ? ": small enough to factorise"
                                 : ": too large to factorise cheaply");
      }
    else
      {
        choice.direct = solver == LinearSolverKind::direct;
        reason << "; as the parameter file says";
      }
    choice.matrix_free = false;
    if (!choice.direct && size.n_particles > 0)
      choice.matrix_free =
        tangent == TangentKind::matrix_free ||
        (tangent == TangentKind::automatic && neighbors > 0.);
    if (choice.direct && tangent == TangentKind::matrix_free &&
        size.n_particles > 0)
      {
        choice.direct      = false;
        choice.matrix_free = true;
        reason << "; no matrix to factorise, since the tangent is matrix-free";
      }
    if (choice.matrix_free)
      choice.entries_saved =
        size.n_particles * reach * neighbors * size.dim * size.dim;
    choice.reason = reason.str();
    return choice;
  }

  void
  check_finite(const Vector &x)
  {
    if (!std::isfinite(x.l2_norm()))
      throw Base::SolveError(
        "the linear solve gave values that are not finite: "
        "the tangent is singular");
  }

  namespace
  {
    struct Operator
    {
      std::function<void(Vector &, const Vector &)> apply;

      void
      vmult(Vector &destination, const Vector &source) const
      {
        apply(destination, source);
      }
    };

    /// Rigid-body motions at the nodes of this rank, one column per motion.
    template <int dim>
    std::unique_ptr<Epetra_MultiVector>
    rigid_body_modes(const Matrix                  &matrix,
                     const Fem::NodePartition<dim> &partition)
    {
      constexpr unsigned int n_modes = dim * (dim + 1) / 2;
      auto                   modes   = std::make_unique<Epetra_MultiVector>(
        matrix.trilinos_matrix().DomainMap(),
        n_modes);
      for (unsigned int n = 0; n < partition.n_owned(); ++n)
        {
          const auto &x = partition.position(n);
          for (int d = 0; d < dim; ++d)
            (*modes)[d][dim * n + d] = 1.;
          unsigned int k = dim;
          for (int a = 0; a < dim; ++a)
            for (int b = a + 1; b < dim; ++b, ++k)
              {
                (*modes)[k][dim * n + a] = -x[b];
                (*modes)[k][dim * n + b] = x[a];
              }
        }
      return modes;
    }

    class IterativeSolver : public LinearSolver
    {
    public:
      template <int dim>
      IterativeSolver(std::function<void(Vector &, const Vector &)> apply,
                      const Matrix                                 &matrix,
                      const Fem::NodePartition<dim>                &partition,
                      const bool                                    symmetric,
                      std::function<void(unsigned int, double)> on_iteration)
        : op{std::move(apply)}
        , symmetric(symmetric)
        , on_iteration(std::move(on_iteration))
        , modes(rigid_body_modes(matrix, partition))
      {
        using AMG = dealii::TrilinosWrappers::PreconditionAMG;
        AMG::AdditionalData data;
        data.elliptic              = true;
        data.higher_order_elements = false;
        data.n_cycles              = 1;
        data.smoother_sweeps       = 2;
        data.aggregation_threshold = dim == 2 ? 1e-2 : 2e-2;
        data.smoother_type         = "Chebyshev";
        data.coarse_type           = "Amesos-KLU";

        // deal.II 9.4 has no option for rigid modes: they go in through the
        // parameter list.
        Teuchos::ParameterList              parameters;
        std::unique_ptr<Epetra_MultiVector> distributed_modes;
        data.set_parameters(parameters,
                            distributed_modes,
                            matrix.trilinos_matrix());
        parameters.set("null space: type", "pre-computed");
        parameters.set("null space: dimension", modes->NumVectors());
        parameters.set("null space: vectors", modes->Values());
        parameters.set("PDE equations", dim);
        preconditioner.initialize(matrix, parameters);
      }

      unsigned int
      solve(Vector &x, const Vector &b, const double tolerance) override
      {
        const double norm = b.l2_norm();
        x                 = 0.;
        if (norm == 0.)
          return 0;
        dealii::SolverControl control(2000, tolerance * norm, false, false);
        control.enable_history_data();
        const auto monitor = [this, norm](const unsigned int iteration,
                                          const double       residual,
                                          const Vector &) {
          if (on_iteration)
            on_iteration(iteration, residual / norm);
          return dealii::SolverControl::success;
        };
        try
          {
            if (symmetric)
              {
                dealii::SolverCG<Vector> solver(control);
                solver.connect(monitor);
                solver.solve(op, x, b, preconditioner);
              }
            else
              {
                dealii::SolverGMRES<Vector> solver(
                  control,
                  dealii::SolverGMRES<Vector>::AdditionalData(60, true));
                solver.connect(monitor);
                solver.solve(op, x, b, preconditioner);
              }
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {
            std::ostringstream text;
            text << "the linear solver stopped after " << control.last_step()
                 << " iterations at a relative residual of "
                 << control.last_value() / norm << " (allowed: " << tolerance
                 << ")";
            throw Base::SolveError(text.str());
          }
        check_finite(x);
        return control.last_step();
      }

    private:
      Operator                                  op;
      const bool                                symmetric;
      std::function<void(unsigned int, double)> on_iteration;
      std::unique_ptr<Epetra_MultiVector>       modes;

      dealii::TrilinosWrappers::PreconditionAMG preconditioner;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<LinearSolver>
  make_iterative_solver(std::function<void(Vector &, const Vector &)> apply,
                        const Matrix                  &preconditioner_matrix,
                        const Fem::NodePartition<dim> &partition,
                        const bool                     symmetric,
                        std::function<void(unsigned int, double)> on_iteration)
  {
    return std::make_unique<IterativeSolver>(std::move(apply),
                                             preconditioner_matrix,
                                             partition,
                                             symmetric,
                                             std::move(on_iteration));
  }

  template std::unique_ptr<LinearSolver>
  make_iterative_solver<2>(std::function<void(Vector &, const Vector &)>,
                           const Matrix &,
                           const Fem::NodePartition<2> &,
                           bool,
                           std::function<void(unsigned int, double)>);
  template std::unique_ptr<LinearSolver>
  make_iterative_solver<3>(std::function<void(Vector &, const Vector &)>,
                           const Matrix &,
                           const Fem::NodePartition<3> &,
                           bool,
                           std::function<void(unsigned int, double)>);
} // namespace Perimorph::Solvers
