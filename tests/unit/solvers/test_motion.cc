#include <perimorph/base/log.h>
#include <perimorph/base/timing.h>
#include <perimorph/fem/lumped_mass.h>
#include <perimorph/solvers/dynamic_relaxation.h>
#include <perimorph/solvers/explicit_motion.h>
#include <perimorph/solvers/highest_frequency.h>
#include <perimorph/solvers/implicit_motion.h>

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

    /// A distorted square of density 1, peridynamic in the middle, held on one
    /// side and pulled on the other.
    struct Body
    {
      Mesh::DistributedMesh<2>    mesh;
      Coupling::BodyMaterials<2>  materials;
      Coupling::CoupledProblem<2> problem;
      Fem::Supports<2>            supports;
      Fem::Loads<2>               loads;
      std::vector<double>         mass;
      std::ostringstream          console;
      Base::Log                   log;
      Base::Timing                timing;
      Equilibrium<2>              equilibrium;
      NodalForces<2>              forces;

      explicit Body(const std::string &traction = "t")
        : mesh(Testing::as_gmsh_mesh(Testing::unit_mesh<2>(8, 0.2)),
               MPI_COMM_WORLD)
        , materials(make_materials())
        , problem(mesh, region(), materials, {})
        , supports(mesh, conditions(traction), {1.})
        , loads(mesh, conditions(traction), {1.})
        , mass(Fem::lumped_mass<2>(mesh.nodal(), {1.}))
        , log(MPI_COMM_WORLD, console)
        , equilibrium(mesh, problem, supports, loads, {}, log, timing)
        , forces(mesh, problem, supports, loads, timing)
      {}

      static Coupling::BodyMaterials<2>
      make_materials()
      {
        Coupling::BodyMaterials<2> result;
        const auto                 state = Materials::PlaneState::plane_strain;
        result.laws.push_back(
          std::make_unique<Materials::LinearElastic<2>>(1., 0.25, state));
        result.bond_constants.push_back({1., state});
        return result;
      }

      Mesh::RegionMap
      region() const
      {
        Mesh::RegionParameters parameters;
        parameters.features = {
          {Parameters::FeatureKind::box, "", {0.3, 0.4, 0.5, 0.6}}};
        parameters.core_size = {0.1, false, false};
        return make_region_map(mesh, parameters);
      }

      static Fem::BoundaryConditions<2>
      conditions(const std::string &traction)
      {
        Fem::BoundaryConditions<2> result;
        result.displacement.push_back(
          {"x-", {}, {{expression("0"), expression("0")}}});
        result.surface_loads.push_back(
          {"x+", {{expression(traction), expression("0")}}, {}});
        return result;
      }

      MotionState
      at_rest() const
      {
        MotionState state;
        for (auto *vector :
             {&state.displacement, &state.velocity, &state.acceleration})
          problem.partition().initialize(*vector);
        return state;
      }

      /// A smooth velocity that the support allows.
      MotionState
      pushed() const
      {
        auto        state     = at_rest();
        const auto &partition = problem.partition();
        for (unsigned int n = 0; n < partition.n_owned(); ++n)
          {
            const auto &x                           = partition.position(n);
            state.velocity.local_element(2 * n)     = std::sin(1.5 * x[0]);
            state.velocity.local_element(2 * n + 1) = x[0] * x[1];
          }
        return state;
      }

      double
      energy(const MotionState &state) const
      {
        Vector complete(state.displacement);
        complete.update_ghost_values();
        return problem.strain_energy(complete) +
               kinetic_energy<2>(problem.partition(), mass, state.velocity);
      }
    };

    /// Displacement at t = 1 after so many explicit or implicit steps.
    Vector
    run(const bool by_newton, const unsigned int n_steps, double &drift)
    {
      Body              body("0");
      auto              state = body.pushed();
      ExplicitMotion<2> by_nodes(body.forces, body.mass);
      by_nodes.start(state, 1e-3);
      std::unique_ptr<ImplicitMotion<2>> implicit;
      if (by_newton)
        implicit = std::make_unique<ImplicitMotion<2>>(body.problem,
                                                       body.equilibrium,
                                                       body.forces,
                                                       body.mass,
                                                       1.);
      const double start = body.energy(state);
      drift              = 0.;
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          if (by_newton)
            EXPECT_TRUE(
              implicit
                ->step(1. / n_steps, state, [](const NewtonIteration &) {})
                .converged);
          else
            by_nodes.step(1. / n_steps, state);
          drift = std::max(drift, std::abs(body.energy(state) / start - 1.));
        }
      return state.displacement;
    }

    double
    distance(Vector one, const Vector &other)
    {
      one -= other;
      return one.l2_norm();
    }
  } // namespace

  TEST(Motion, the_mass_is_that_of_the_body)
  {
    const Body body;
    double     sum = 0.;
    for (const double mass : body.mass)
      sum += mass;
    EXPECT_NEAR(sum, 1., 1e-14);
  }

  TEST(Motion, explicit_steps_are_stable_below_the_limit_and_not_above)
  {
    for (const double factor : {0.98, 1.02})
      {
        Body              body("0");
        ExplicitMotion<2> motion(body.forces, body.mass);
        auto              state = body.pushed();
        motion.start(state, 1e-3);
        const double limit = motion.stable_time_step(state);
        const double start = body.energy(state);
        for (unsigned int step = 0; step < 1500; ++step)
          motion.step(factor * limit, state);
        const double growth = body.energy(state) / start;
        if (factor < 1.)
          EXPECT_LT(growth, 1.2);
        else
          EXPECT_GT(growth, 1e6);
      }
  }

  TEST(Motion, both_schemes_converge_to_the_same_with_the_second_order)
  {
    double     drift = 0.;
    const auto exact = run(false, 1600, drift);
    for (const bool by_newton : {false, true})
      {
        const double coarse = distance(run(by_newton, 50, drift), exact);
        const double fine   = distance(run(by_newton, 100, drift), exact);
        EXPECT_GT(coarse, 1e-7);
        EXPECT_NEAR(std::log2(coarse / fine), 2., 0.1);
      }
  }

  TEST(Motion, implicit_steps_keep_the_energy)
  {
    double drift = 0.;
    run(true, 10, drift);
    EXPECT_LT(drift, 1e-10);
  }

  TEST(Motion, work_of_the_loads_is_the_energy)
  {
    for (const bool by_newton : {false, true})
      {
        Body              body("0.1*sin(4*t)");
        ExplicitMotion<2> by_nodes(body.forces, body.mass);
        auto              state = body.at_rest();
        by_nodes.start(state, 1e-3);
        ImplicitMotion<2> implicit(body.problem,
                                   body.equilibrium,
                                   body.forces,
                                   body.mass,
                                   1.);
        if (!by_newton)
          {
            // Without the inertia that belongs to implicit steps.
            Body              alone("0.1*sin(4*t)");
            ExplicitMotion<2> motion(alone.forces, alone.mass);
            state = alone.at_rest();
            motion.start(state, 1e-3);
            for (unsigned int step = 0; step < 200; ++step)
              motion.step(0.01, state);
            EXPECT_NEAR(state.work / alone.energy(state), 1., 1e-3);
            continue;
          }
        for (unsigned int step = 0; step < 200; ++step)
          implicit.step(0.01, state, [](const NewtonIteration &) {});
        EXPECT_NEAR(state.work / body.energy(state), 1., 1e-9);
      }
  }

  TEST(Motion, relaxation_ends_in_the_equilibrium_of_newton)
  {
    Body   body;
    Vector by_newton, by_relaxation;
    body.problem.partition().initialize(by_newton);
    body.problem.partition().initialize(by_relaxation);
    const auto nothing = [](const NewtonIteration &) {};
    ASSERT_TRUE(body.equilibrium.solve(1., by_newton, nothing).converged);
    DynamicRelaxation<2> relaxation(body.forces, {1e-11, 20000});
    const auto           record = relaxation.solve(1., by_relaxation, nothing);
    ASSERT_TRUE(record.converged);
    EXPECT_GT(record.linear_iterations, 10u);
    EXPECT_LT(distance(by_relaxation, by_newton), 1e-8 * by_newton.l2_norm());

    DynamicRelaxation<2> too_short(body.forces, {1e-11, 3});
    Vector               start = by_newton;
    start *= 0.5;
    const Vector before = start;
    const auto   failed = too_short.solve(1., start, nothing);
    EXPECT_FALSE(failed.converged);
    EXPECT_NE(failed.reason.find("after 3 steps"), std::string::npos);
    EXPECT_EQ(distance(start, before), 0.);
  }
} // namespace Perimorph::Solvers
