#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/base/timing.h>
#include <perimorph/materials/material_factory.h>
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

    /// A distorted block with peridynamics in the middle, clamped at x-.
    template <int dim>
    struct Block
    {
      Mesh::DistributedMesh<dim>   mesh;
      Coupling::BodyMaterials<dim> materials;
      Fem::BoundaryConditions<dim> conditions;

      std::unique_ptr<Fem::Supports<dim>>            supports;
      std::unique_ptr<Fem::Loads<dim>>               loads;
      std::unique_ptr<Coupling::CoupledProblem<dim>> problem;
      std::unique_ptr<Equilibrium<dim>>              equilibrium;
      std::ostringstream                             console;
      Base::Log                                      log;
      Base::Timing                                   timing;
      Vector                                         displacement;
      std::vector<NewtonIteration>                   iterations;

      explicit Block(const std::string &law)
        : mesh(Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(6, 0.2)),
               MPI_COMM_WORLD)
        , log(MPI_COMM_WORLD, console)
      {
        const auto state = dim == 2 ? Materials::PlaneState::plane_strain
                                    : Materials::PlaneState::three_dimensional;
        materials.laws.push_back(
          Materials::make_material<dim>(law, 10., 0.3, state));
        materials.bond_constants.push_back({10., state});
      }

      NewtonRecord
      solve(const double time)
      {
        if (!equilibrium)
          {
            supports =
              std::make_unique<Fem::Supports<dim>>(mesh,
                                                   conditions,
                                                   std::vector<double>{1.});
            loads = std::make_unique<Fem::Loads<dim>>(mesh,
                                                      conditions,
                                                      std::vector<double>{1.});
            Mesh::RegionParameters region;
            region.features      = {{Parameters::FeatureKind::point,
                                     "",
                                     std::vector<double>(dim, 0.5)}};
            region.horizon_ratio = 1.5;
            region.core_size     = {0.5, true, false};
            problem = std::make_unique<Coupling::CoupledProblem<dim>>(
              mesh,
              make_region_map(mesh, region),
              materials,
              Coupling::CouplingParameters(),
              typename Coupling::CoupledProblem<dim>::Progress(),
              supports->coupled_nodes());
            EquilibriumParameters parameters;
            parameters.newton.tolerance = 1e-12;
            equilibrium = std::make_unique<Equilibrium<dim>>(mesh,
                                                             *problem,
                                                             *supports,
                                                             *loads,
                                                             parameters,
                                                             log,
                                                             timing);
            problem->partition().initialize(displacement);
          }
        iterations.clear();
        const auto record =
          equilibrium->solve(time,
                             displacement,
                             [&](const NewtonIteration &iteration) {
                               iterations.push_back(iteration);
                             });
        displacement.update_ghost_values();
        return record;
      }

      dealii::Tensor<1, dim>
      at(const unsigned int node) const
      {
        dealii::Tensor<1, dim> value;
        for (int d = 0; d < dim; ++d)
          value[d] = displacement.local_element(
            dim * problem->partition().local(node) + d);
        return value;
      }

      /// Largest change of a distance between nodes of a boundary.
      double
      distortion(const std::string &boundary) const
      {
        const auto nodes = mesh.boundary_nodes(boundary, "test");
        double     worst = 0.;
        for (const unsigned int a : nodes)
          for (const unsigned int b : nodes)
            {
              const dealii::Tensor<1, dim> before =
                mesh.nodal().nodes[a] - mesh.nodal().nodes[b];
              worst = std::max(
                worst,
                std::abs((before + at(a) - at(b)).norm() - before.norm()));
            }
        return worst;
      }

      /// Best order of convergence seen in the residuals.
      double
      order() const
      {
        double best = 0.;
        for (unsigned int k = 2; k < iterations.size(); ++k)
          {
            const double a = iterations[k - 2].relative_residual;
            const double b = iterations[k - 1].relative_residual;
            const double c = iterations[k].relative_residual;
            if (c > 1e-13 && b < 1e-2)
              best = std::max(best, std::log(c / b) / std::log(b / a));
          }
        return best;
      }
    };

    template <int dim>
    Fem::ComponentExpressions<dim>
    components(const std::string &each)
    {
      Fem::ComponentExpressions<dim> result;
      for (auto &component : result)
        component = expression(each);
      return result;
    }
  } // namespace

  template <typename Dimension>
  class ConstraintsIn : public ::testing::Test
  {};
  using Dimensions = ::testing::Types<std::integral_constant<int, 2>,
                                      std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(ConstraintsIn, Dimensions);

  TYPED_TEST(ConstraintsIn, free_plate_turns_rigidly_with_quadratic_convergence)
  {
    constexpr int dim = TypeParam::value;
    Block<dim>    block("hencky");
    block.conditions.displacement.push_back({"x-", {}, components<dim>("0")});
    block.conditions.rigid_plates.push_back({"x+", {}, {}});
    Fem::SurfaceLoad<dim> load{"x+", {}, {}};
    load.traction[1] = expression("0.5*t");
    load.traction[0] = expression("-0.3*t");
    block.conditions.surface_loads.push_back(load);
    const auto record = block.solve(1.);
    ASSERT_TRUE(record.converged) << record.reason;
    EXPECT_LE(record.n_iterations(), 8u);
    EXPECT_GT(block.order(), 1.7);
    EXPECT_LT(block.distortion("x+"), 1e-13);
    // It did turn and move.
    const auto nodes = block.mesh.boundary_nodes("x+", "test");
    double     turn  = 0.;
    for (const unsigned int a : nodes)
      turn = std::max(turn, (block.at(a) - block.at(nodes[0])).norm());
    EXPECT_GT(turn, 0.05);
  }

  TYPED_TEST(ConstraintsIn, pinned_plate_keeps_its_center)
  {
    constexpr int dim = TypeParam::value;
    Block<dim>    block("hencky");
    block.conditions.displacement.push_back({"x-", {}, components<dim>("0")});
    Fem::ComponentExpressions<dim> motion = components<dim>("0");
    motion[0]                             = expression("0.1*t");
    block.conditions.rigid_plates.push_back({"x+", motion, {}});
    Fem::SurfaceLoad<dim> load{"y+", {}, {}};
    load.traction[1] = expression("t");
    block.conditions.surface_loads.push_back(load);
    for (const double time : {0.5, 1.})
      {
        const auto record = block.solve(time);
        ASSERT_TRUE(record.converged) << record.reason;
        EXPECT_LT(block.distortion("x+"), 1e-13);
        // The centroid of the face is the mean of its corners.
        dealii::Tensor<1, dim> mean;
        unsigned int           corners = 0;
        for (const unsigned int n : block.mesh.boundary_nodes("x+", "test"))
          {
            bool corner = true;
            for (int d = 1; d < dim; ++d)
              corner = corner &&
                       std::abs(std::abs(block.mesh.nodal().nodes[n][d] - 0.5) -
                                0.5) < 1e-12;
            if (corner)
              {
                mean += block.at(n);
                ++corners;
              }
          }
        mean /= corners;
        mean[0] -= 0.1 * time;
        EXPECT_LT(mean.norm(), 1e-12);
      }
  }

  TYPED_TEST(ConstraintsIn, means_are_what_was_asked_for)
  {
    constexpr int dim = TypeParam::value;
    for (const auto *law : {"linear elastic", "hencky"})
      {
        Block<dim> block(law);
        // Held by means alone: translation and rotation of x-, pulled at x+.
        block.conditions.mean_displacement.push_back(
          {"x-", components<dim>("0.01*t"), expression("0")});
        Fem::SurfaceLoad<dim> load{"x+", {}, {}};
        load.traction[0] = expression("t");
        load.traction[1] = expression("0.2*t");
        block.conditions.surface_loads.push_back(load);
        const auto record = block.solve(1.);
        ASSERT_TRUE(record.converged) << law << ": " << record.reason;
        for (const auto &mean : block.supports->mean_constraints())
          {
            double sum = -mean.value->value(mean.center, 1.);
            for (const auto &[dof, factor] : mean.factors)
              sum += factor * block.at(dof / dim)[dof % dim];
            EXPECT_LT(std::abs(sum), 1e-12);
          }
      }
  }

  TEST(Constraints2D, prescribed_rotation_of_a_plate_is_exact)
  {
    Block<2> block("hencky");
    block.conditions.displacement.push_back({"x-", {}, components<2>("0")});
    Fem::ComponentExpressions<2> held = components<2>("0");
    block.conditions.rigid_plates.push_back({"x+", held, expression("0.6*t")});
    for (const double time : {0.25, 0.5, 0.75, 1.})
      ASSERT_TRUE(block.solve(time).converged);
    const auto nodes = block.mesh.boundary_nodes("x+", "test");
    for (const unsigned int n : nodes)
      {
        const double y = block.mesh.nodal().nodes[n][1] - 0.5;
        EXPECT_NEAR(block.at(n)[0], -std::sin(0.6) * y, 1e-12);
        EXPECT_NEAR(block.at(n)[1], (std::cos(0.6) - 1.) * y, 1e-12);
      }
  }

  TEST(Constraints2D, what_holds_twice_is_refused)
  {
    const auto message = [](const Fem::BoundaryConditions<2> &conditions) {
      Block<2> block("hencky");
      block.conditions = conditions;
      try
        {
          block.solve(1.);
        }
      catch (const Base::InputError &error)
        {
          return std::string(error.what());
        }
      return std::string("nothing");
    };
    Fem::BoundaryConditions<2> conditions;
    conditions.displacement.push_back({"y-", {}, components<2>("0")});
    conditions.rigid_plates.push_back({"x+", {}, {}});
    EXPECT_NE(message(conditions).find("held by the displacement of 'y-'"),
              std::string::npos);
    conditions = {};
    conditions.displacement.push_back({"x-", {}, components<2>("0")});
    conditions.mean_displacement.push_back({"x-", components<2>("0"), {}});
    EXPECT_NE(message(conditions).find("all held by other supports"),
              std::string::npos);
  }

  TEST(ArcLength, passes_the_limit_load_of_a_bar)
  {
    // A bar without lateral contraction: nominal stress E ln(stretch) /
    // stretch, at most E / e at the stretch e.
    const Mesh::DistributedMesh<2> mesh(
      Testing::as_gmsh_mesh(Testing::unit_mesh<2>(3, 0.2)),
      MPI_COMM_WORLD);
    Coupling::BodyMaterials<2> materials;
    const auto                 state = Materials::PlaneState::plane_strain;
    materials.laws.push_back(
      Materials::make_material<2>("hencky", 1., 0., state));
    materials.bond_constants.push_back({1., state});
    Mesh::RegionParameters region;
    region.mode = Mesh::Mode::finite_elements;
    const Coupling::CoupledProblem<2> problem(mesh,
                                              make_region_map(mesh, region),
                                              materials,
                                              Coupling::CouplingParameters());
    Fem::BoundaryConditions<2>        conditions;
    conditions.symmetry      = {"x-", "y-"};
    Fem::SurfaceLoad<2> load = {"x+", {}, {}};
    load.traction[0]         = expression("0.5*t");
    conditions.surface_loads.push_back(load);
    const Fem::Supports<2> supports(mesh, conditions, {1.});
    const Fem::Loads<2>    loads(mesh, conditions, {1.});
    std::ostringstream     console;
    Base::Log              log(MPI_COMM_WORLD, console);
    Base::Timing           timing;
    EquilibriumParameters  parameters;
    Equilibrium<2>
           equilibrium(mesh, problem, supports, loads, parameters, log, timing);
    Vector displacement;
    problem.partition().initialize(displacement);
    double    time = 0., peak = 0., worst = 0.;
    ArcLength arc;
    for (unsigned int step = 0; step < 40; ++step)
      {
        const auto record =
          equilibrium.solve_arc_step(time,
                                     displacement,
                                     arc,
                                     0.1,
                                     [](const NewtonIteration &) {});
        if (!record.converged)
          continue;
        peak                 = std::max(peak, time);
        const double stretch = 1. + displacement.linfty_norm();
        worst =
          std::max(worst, std::abs(0.5 * time - std::log(stretch) / stretch));
        if (stretch > 5.)
          break;
      }
    EXPECT_LT(worst, 1e-8);
    EXPECT_LE(0.5 * peak, std::exp(-1.) + 1e-10);
    EXPECT_GT(0.5 * peak, 0.99 * std::exp(-1.));
    EXPECT_LT(time, 0.95 * peak); // on the way down
  }
} // namespace Perimorph::Solvers
