#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/base/timing.h>
#include <perimorph/solvers/equilibrium.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/expressions.h>
#include <harness/test_meshes.h>

#include <sstream>

namespace Perimorph::Solvers
{
  namespace
  {
    using Testing::expression;

    /// A square, held on one side and pulled on the other, with peridynamics in
    /// the middle; its strain energy and the iterations needed.
    struct Outcome
    {
      double       strain_energy;
      NewtonRecord record;
      bool         matrix_free;
    };

    Outcome
    solve(const EquilibriumParameters &parameters,
          const Coupling::Scheme       scheme = Coupling::Scheme::consistent)
    {
      const Mesh::DistributedMesh<2> mesh(
        Testing::as_gmsh_mesh(Testing::unit_mesh<2>(24, 0.2)),
        MPI_COMM_WORLD);
      Coupling::BodyMaterials<2> materials;
      const auto                 state = Materials::PlaneState::plane_strain;
      materials.laws.push_back(
        std::make_unique<Materials::LinearElastic<2>>(1., 0.25, state));
      materials.bond_constants.push_back({1., state});
      Mesh::RegionParameters region;
      region.features = {
        {Parameters::FeatureKind::box, "", {-1., 0.4, 0.5, 0.6}}};
      Coupling::CouplingParameters coupling;
      coupling.scheme = scheme;
      const Coupling::CoupledProblem<2> problem(mesh,
                                                make_region_map(mesh, region),
                                                materials,
                                                coupling);
      Fem::BoundaryConditions<2>        conditions;
      conditions.displacement.push_back(
        {"x-", {}, {{expression("0"), expression("0")}}});
      conditions.surface_loads.push_back(
        {"x+", {{expression("t"), expression("0.1*y")}}, {}});
      const Fem::Supports<2> supports(mesh, conditions, {1.});
      const Fem::Loads<2>    loads(mesh, conditions, {1.});
      std::ostringstream     console;
      Base::Log              log(MPI_COMM_WORLD, console);
      Base::Timing           timing;
      Equilibrium<2>
        equilibrium(mesh, problem, supports, loads, parameters, log, timing);
      Vector displacement;
      problem.partition().initialize(displacement);
      Outcome outcome;
      outcome.record =
        equilibrium.solve(1., displacement, [](const NewtonIteration &) {});
      displacement.update_ghost_values();
      outcome.strain_energy = problem.strain_energy(displacement);
      outcome.matrix_free   = equilibrium.choice().matrix_free;
      return outcome;
    }
  } // namespace

  TEST(Equilibrium, every_linear_solver_finds_the_same_state)
  {
    EquilibriumParameters parameters;
    parameters.linear_solver = LinearSolverKind::direct;
    const auto direct        = solve(parameters);
    ASSERT_TRUE(direct.record.converged);
    EXPECT_EQ(direct.record.residuals.size(), 2u); // linear: one iteration

    parameters.linear_solver    = LinearSolverKind::iterative;
    parameters.linear_tolerance = 1e-12;
    const auto matrix_free      = solve(parameters);
    ASSERT_TRUE(matrix_free.record.converged);
    EXPECT_TRUE(matrix_free.matrix_free);
    EXPECT_NEAR(matrix_free.strain_energy / direct.strain_energy, 1., 1e-10);

    parameters.tangent   = TangentKind::assembled;
    const auto assembled = solve(parameters);
    ASSERT_TRUE(assembled.record.converged);
    EXPECT_FALSE(assembled.matrix_free);
    EXPECT_NEAR(assembled.strain_energy / direct.strain_energy, 1., 1e-10);
  }

  TEST(Equilibrium, iterations_stay_few_where_supports_cross_the_blending)
  {
    // The support at x- crosses core and blending band: a constrained equation
    // with another diagonal than the preconditioner's would show here.
    EquilibriumParameters parameters;
    parameters.linear_solver = LinearSolverKind::iterative;
    EXPECT_LT(solve(parameters).record.linear_iterations, 60u);
  }

  TEST(Equilibrium, force_blending_is_solved_without_symmetry)
  {
    EquilibriumParameters parameters;
    parameters.linear_solver = LinearSolverKind::direct;
    const auto direct = solve(parameters, Coupling::Scheme::force_blending);
    ASSERT_TRUE(direct.record.converged);
    parameters.linear_solver    = LinearSolverKind::iterative;
    parameters.linear_tolerance = 1e-12;
    const auto iterative = solve(parameters, Coupling::Scheme::force_blending);
    ASSERT_TRUE(iterative.record.converged);
    EXPECT_NEAR(iterative.strain_energy / direct.strain_energy, 1., 1e-9);
  }
} // namespace Perimorph::Solvers
