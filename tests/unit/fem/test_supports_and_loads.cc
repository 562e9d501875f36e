#include <perimorph/base/exceptions.h>
#include <perimorph/fem/body_force.h>
#include <perimorph/fem/elastic_cells.h>
#include <perimorph/fem/face_geometry.h>
#include <perimorph/fem/loads.h>
#include <perimorph/fem/rigid_motion.h>
#include <perimorph/fem/supports.h>
#include <perimorph/materials/linear_elastic.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/expressions.h>
#include <harness/test_meshes.h>

namespace Perimorph::Fem
{
  namespace
  {
    using Testing::expression;

    template <int dim>
    Mesh::DistributedMesh<dim>
    unit_body(const unsigned int n, const double distortion = 0.)
    {
      return Mesh::DistributedMesh<dim>(
        Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(n, distortion)),
        MPI_COMM_WORLD);
    }

    template <int dim>
    NodePartition<dim>
    partition_of(const Mesh::DistributedMesh<dim> &mesh)
    {
      std::vector<unsigned int> needed;
      add_cell_nodes(mesh.nodal(), needed);
      return NodePartition<dim>(mesh.nodal(), needed, MPI_COMM_WORLD);
    }

    /// Total force and its moment about the origin (about z).
    template <int dim>
    std::pair<dealii::Tensor<1, dim>, double>
    resultant(const Mesh::DistributedMesh<dim> &mesh,
              const BoundaryConditions<dim>    &conditions,
              const double                      time = 1.)
    {
      const auto       partition = partition_of(mesh);
      const Loads<dim> loads(mesh, conditions, {time});
      Vector           forces;
      partition.initialize(forces);
      loads.add_forces(time, partition, forces);
      forces.compress(dealii::VectorOperation::add);
      dealii::Tensor<1, dim> sum;
      double                 moment = 0.;
      for (unsigned int n = 0; n < partition.n_owned(); ++n)
        {
          dealii::Tensor<1, dim> force;
          for (int d = 0; d < dim; ++d)
            force[d] = forces.local_element(dim * n + d);
          sum += force;
          moment += partition.position(n)[0] * force[1] -
                    partition.position(n)[1] * force[0];
        }
      return {dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD),
              dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD)};
    }

    template <typename Action>
    std::string
    message_of(const Action &action)
    {
      try
        {
          action();
        }
      catch (const Base::InputError &error)
        {
          return error.what();
        }
      return "no error";
    }
  } // namespace

  TEST(Loads, traction_has_its_resultant_and_moment)
  {
    BoundaryConditions<2> conditions;
    conditions.surface_loads.push_back(
      {"x+", {{expression("2*t"), expression("y^2")}}, {}});
    const auto [force, moment] =
      resultant(unit_body<2>(5, 0.2), conditions, 3.);
    EXPECT_NEAR(force[0], 6., 1e-12);
    EXPECT_NEAR(force[1], 1. / 3., 1e-12);
    EXPECT_NEAR(moment, 1. / 3. - 3., 1e-12);
  }

  TEST(Loads, pressure_pushes_against_the_outward_normal)
  {
    BoundaryConditions<3> conditions;
    conditions.surface_loads.push_back({"z-", {}, expression("5")});
    const auto force = resultant(unit_body<3>(3, 0.2), conditions).first;
    EXPECT_NEAR(force[2], 5., 1e-12);
    EXPECT_NEAR(force[0], 0., 1e-12);

    // On all faces it is in balance.
    for (const char *face : {"x-", "x+", "y-", "y+", "z+"})
      conditions.surface_loads.push_back({face, {}, expression("5")});
    EXPECT_NEAR(resultant(unit_body<3>(3, 0.2), conditions).first.norm(),
                0.,
                1e-12);
  }

  TEST(Loads, body_and_point_forces)
  {
    BoundaryConditions<2> conditions;
    conditions.body_forces.push_back({"body", {{{}, expression("-3*x")}}});
    conditions.point_forces.push_back({{1., 1.}, {{expression("2"), {}}}});
    const auto [force, moment] = resultant(unit_body<2>(4, 0.2), conditions);
    EXPECT_NEAR(force[0], 2., 1e-12);
    EXPECT_NEAR(force[1], -1.5, 1e-12);
    EXPECT_NEAR(moment, -1. - 2., 1e-2); // x^2 is not exact with 2 x 2 points
  }

  // Exact where it is constant, and inside of regular meshes where it is
  // linear.
  TEST(Loads, body_force_density_at_the_nodes)
  {
    const auto mesh = unit_body<2>(4);
    EXPECT_TRUE(body_force_density<2>(mesh, {}, 1.).empty());
    const auto density = body_force_density<2>(
      mesh,
      {{"", {{expression("2*t"), {}}}}, {"body", {{{}, expression("-3*x")}}}},
      0.5);
    ASSERT_EQ(density.size(), mesh.nodal().n_nodes());
    for (unsigned int n = 0; n < density.size(); ++n)
      {
        const auto &x = mesh.nodal().nodes[n];
        EXPECT_NEAR(density[n][0], 1., 1e-14);
        if (x[0] > 0.1 && x[0] < 0.9)
          {
            EXPECT_NEAR(density[n][1], -3. * x[0], 1e-14);
          }
      }
  }

  TEST(Loads, bad_input_is_named)
  {
    BoundaryConditions<2> conditions;
    conditions.surface_loads.push_back({"x*", {{expression("1"), {}}}, {}});
    conditions.surface_loads.push_back(
      {"y+", {{expression("1/(x-x)"), {}}}, {}});
    const auto text =
      message_of([&]() { Loads<2>(unit_body<2>(3), conditions, {1.}); });
    EXPECT_NE(text.find("boundary 'x*' is not in the mesh"), std::string::npos)
      << text;
    EXPECT_NE(text.find("1/(x-x)"), std::string::npos) << text;
  }

  TEST(Supports, contradiction_is_named)
  {
    BoundaryConditions<2> conditions;
    conditions.displacement.push_back({"x-", {}, {{expression("0"), {}}}});
    conditions.displacement.push_back({"y-", {}, {{expression("0.5"), {}}}});
    const auto text =
      message_of([&]() { Supports<2>(unit_body<2>(3), conditions, {1.}); });
    EXPECT_NE(text.find("contradicting supports"), std::string::npos) << text;
    EXPECT_NE(text.find("displacement of 'x-'"), std::string::npos) << text;
    EXPECT_NE(text.find("displacement of 'y-'"), std::string::npos) << text;

    // Equal values do not contradict.
    conditions.displacement[1].components[0] = expression("0*t");
    EXPECT_EQ(
      message_of([&]() { Supports<2>(unit_body<2>(3), conditions, {1.}); }),
      "no error");
  }

  TEST(Supports, symmetry_holds_the_normal_component)
  {
    const auto            mesh = unit_body<2>(4, 0.2);
    BoundaryConditions<2> conditions;
    conditions.symmetry = {"y-"};
    const Supports<2> supports(mesh, conditions, {1.});
    EXPECT_EQ(supports.entries().size(), 5u);
    for (const auto &entry : supports.entries())
      {
        EXPECT_EQ(entry.first % 2, 1u);
        EXPECT_NEAR(mesh.nodal().nodes[entry.first / 2][1], 0., 1e-14);
      }
    ASSERT_EQ(supports.symmetry_planes().size(), 1u);
    EXPECT_NEAR(supports.symmetry_planes()[0].normal[1], -1., 1e-12);
  }

  TEST(RigidMotion, counts_what_is_free)
  {
    const auto count2 = [](const BoundaryConditions<2> &conditions) {
      const auto mesh = unit_body<2>(3);
      return free_motions(mesh, Supports<2>(mesh, conditions, {1.})).size();
    };
    BoundaryConditions<2> conditions;
    EXPECT_EQ(count2(conditions), 3u);
    conditions.symmetry = {"x-"};
    EXPECT_EQ(count2(conditions), 1u);
    conditions.symmetry = {"x-", "y-"};
    EXPECT_EQ(count2(conditions), 0u);

    const auto            mesh = unit_body<3>(2);
    BoundaryConditions<3> in_space;
    EXPECT_EQ(free_motions(mesh, Supports<3>(mesh, in_space, {1.})).size(), 6u);
    in_space.symmetry = {"z-"};
    EXPECT_EQ(free_motions(mesh, Supports<3>(mesh, in_space, {1.})).size(), 3u);
  }

  TEST(RigidMotion, pins_stop_it)
  {
    const auto  mesh = unit_body<3>(3, 0.2);
    Supports<3> supports(mesh, BoundaryConditions<3>(), {1.});
    const auto  motions = free_motions(mesh, supports);
    const auto  pins    = pins_against(mesh, motions);
    EXPECT_EQ(pins.size(), 6u);
    for (const unsigned int pin : pins)
      supports.pin(pin);
    EXPECT_TRUE(free_motions(mesh, supports).empty());
  }

  TEST(ElasticCells, unit_stretch_has_its_energy)
  {
    const auto                    mesh      = unit_body<3>(3, 0.2);
    const auto                    partition = partition_of(mesh);
    ElasticCells<3>::MaterialList laws;
    laws.push_back(std::make_unique<Materials::LinearElastic<3>>(
      2.,
      0.,
      Materials::PlaneState::three_dimensional));
    const ElasticCells<3> elements(mesh.nodal(), partition, laws, {});
    Vector                u, forces;
    partition.initialize(u);
    partition.initialize(forces);
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      u.local_element(3 * n) = 0.1 * partition.position(n)[0];
    u.update_ghost_values();
    const double energy =
      dealii::Utilities::MPI::sum(elements.energy(u), MPI_COMM_WORLD);
    EXPECT_NEAR(energy, 0.5 * 2. * 0.01, 1e-14);
    elements.add_residual(u, forces);
    forces.compress(dealii::VectorOperation::add);
    EXPECT_NEAR(0.5 * (forces * u), energy, 1e-14);
  }
} // namespace Perimorph::Fem
