#include <perimorph/base/log.h>
#include <perimorph/base/timing.h>
#include <perimorph/mesh/local_refinement.h>
#include <perimorph/solvers/equilibrium.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/expressions.h>
#include <harness/test_meshes.h>

#include <cmath>
#include <sstream>

namespace Perimorph::Solvers
{
  namespace
  {
    using Testing::expression;

    struct Outcome
    {
      double error;         ///< of the displacement, against the linear field
      double discontinuity; ///< hanging nodes against their parents
      double ghost_force;
      bool   matrix_free;
    };

    /// A distorted block that is finer in the middle, held on one side of each
    /// axis, pulled with the traction of a constant stress, with peridynamics
    /// in the middle.
    /// @param families_hang  the fine part is smaller than the region
    template <int dim>
    Outcome
    pull(const Coupling::Model  model,
         const LinearSolverKind solver,
         const bool             families_hang)
    {
      Mesh::LocalRefinement<dim> refinement(
        Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(dim == 2 ? 8 : 6, 0.15)),
        true);
      for (int pass = 0; pass < (dim == 2 ? 2 : 1); ++pass)
        {
          const auto                mesh = refinement.mesh();
          std::vector<unsigned int> cells;
          for (unsigned int c = 0; c < mesh.cells.size(); ++c)
            {
              dealii::Point<dim> center;
              for (const unsigned int p : mesh.cells[c])
                center += (1. / (1u << dim)) * mesh.points[p];
              double away = 0.;
              for (int d = 0; d < dim; ++d)
                away = std::max(away, std::abs(center[d] - 0.5));
              if (away < (families_hang ? 0.13 : 0.34))
                cells.push_back(c);
            }
          refinement.refine(cells);
        }
      const Mesh::DistributedMesh<dim> mesh(refinement.mesh(), MPI_COMM_WORLD);
      EXPECT_FALSE(mesh.nodal().hanging.empty());
      // nu = 1/4 in plane strain and 3D: that of bonds.
      const auto   state = dim == 2 ? Materials::PlaneState::plane_strain
                                    : Materials::PlaneState::three_dimensional;
      const double nu    = 0.25;
      Coupling::BodyMaterials<dim> materials;
      materials.laws.push_back(
        std::make_unique<Materials::LinearElastic<dim>>(1., nu, state));
      materials.bond_constants.push_back({1., state});
      Mesh::RegionParameters region;
      region.features = {
        {Parameters::FeatureKind::point, "", std::vector<double>(dim, 0.5)}};
      region.core_size      = {dim == 2 ? 0.08 : 0.05, false, false};
      region.blending_width = {0.08, false, false};
      region.horizon_ratio  = 1.5;
      Coupling::CouplingParameters coupling;
      coupling.model = model;
      const Coupling::CoupledProblem<dim> problem(mesh,
                                                  make_region_map(mesh, region),
                                                  materials,
                                                  coupling);
      Fem::BoundaryConditions<dim>        conditions;
      conditions.displacement.push_back({"x-", {}, {{expression("0")}}});
      conditions.displacement.push_back({"y-", {}, {{{}, expression("0")}}});
      if constexpr (dim == 3)
        conditions.displacement.push_back(
          {"z-", {}, {{{}, {}, expression("0")}}});
      conditions.surface_loads.push_back({"x+", {{expression("t")}}, {}});
      const Fem::Supports<dim> supports(mesh, conditions, {1.});
      const Fem::Loads<dim>    loads(mesh, conditions, {1.});
      std::ostringstream       console;
      Base::Log                log(MPI_COMM_WORLD, console);
      Base::Timing             timing;
      EquilibriumParameters    parameters;
      parameters.linear_solver    = solver;
      parameters.linear_tolerance = 1e-13;
      parameters.newton.tolerance = 1e-11;
      if (solver == LinearSolverKind::iterative)
        parameters.tangent = TangentKind::matrix_free;
      Equilibrium<dim>
        equilibrium(mesh, problem, supports, loads, parameters, log, timing);
      Vector displacement;
      problem.partition().initialize(displacement);
      EXPECT_TRUE(
        equilibrium.solve(1., displacement, [](const NewtonIteration &) {})
          .converged);
      displacement.update_ghost_values();

      Outcome     outcome   = {0., 0., 0., equilibrium.choice().matrix_free};
      const auto &partition = problem.partition();
      const auto  value     = [&](const unsigned int node, const int d) {
        return displacement.local_element(dim * partition.local(node) + d);
      };
      for (unsigned int n = 0; n < partition.n_owned(); ++n)
        {
          const unsigned int node  = partition.global(n);
          const auto         found = mesh.nodal().hanging.find(node);
          for (int d = 0; d < dim; ++d)
            {
              const double strain =
                dim == 2 ? (d == 0 ? 1. - nu * nu : -nu * (1. + nu))
                         : (d == 0 ? 1. : -nu);
              outcome.error =
                std::max(outcome.error,
                         std::abs(value(node, d) -
                                  strain * mesh.nodal().nodes[node][d]));
              if (found == mesh.nodal().hanging.end())
                continue;
              double mean = 0.;
              for (const auto &[parent, weight] : found->second)
                mean += weight * value(parent, d);
              outcome.discontinuity = std::max(outcome.discontinuity,
                                               std::abs(value(node, d) - mean));
            }
        }
      outcome.error =
        dealii::Utilities::MPI::max(outcome.error, MPI_COMM_WORLD);
      outcome.ghost_force = problem.ghost_force(
        [&](const unsigned int dof) { return supports.hold(dof); });
      return outcome;
    }

    template <int dim>
    void
    check_patch_test(const bool families_hang)
    {
      for (const auto model :
           {Coupling::Model::correspondence, Coupling::Model::bond_based})
        for (const auto solver :
             {LinearSolverKind::direct, LinearSolverKind::iterative})
          {
            const auto outcome = pull<dim>(model, solver, families_hang);
            EXPECT_LT(outcome.error, 1e-10);
            EXPECT_LT(outcome.discontinuity, 1e-13);
            EXPECT_LT(outcome.ghost_force, 1e-10);
            if (solver == LinearSolverKind::iterative)
              {
                EXPECT_EQ(outcome.matrix_free, !families_hang);
              }
          }
    }
  } // namespace

  TEST(HangingNodes, do_not_disturb_a_constant_stress)
  {
    check_patch_test<2>(false);
    check_patch_test<3>(false);
  }

  TEST(HangingNodes, may_even_be_in_families)
  {
    // Where a growing region meets them.
    check_patch_test<2>(true);
    check_patch_test<3>(true);
  }
} // namespace Perimorph::Solvers
