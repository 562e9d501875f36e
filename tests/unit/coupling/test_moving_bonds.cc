#include <perimorph/coupling/moving_bonds.h>
#include <perimorph/damage/saw_tooth.h>
#include <perimorph/fem/lumped_mass.h>
#include <perimorph/fem/nodal_values.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <cmath>
#include <limits>

namespace Perimorph::Coupling
{
  namespace
  {
    struct Setup
    {
      Mesh::DistributedMesh<2> mesh;
      BodyMaterials<2>         materials;
      Mesh::RegionMap          region;
      CouplingParameters       parameters;

      explicit Setup(const Model model)
        : mesh(Testing::as_gmsh_mesh(Testing::unit_mesh<2>(12, 0.2)),
               MPI_COMM_WORLD)
      {
        const auto state = Materials::PlaneState::plane_strain;
        materials.laws.push_back(
          std::make_unique<Materials::LinearElastic<2>>(1., 0.25, state));
        materials.bond_constants.push_back({1., state});
        Mesh::RegionParameters around;
        around.features = {
          {Parameters::FeatureKind::box, "", {0.2, 0.35, 0.8, 0.65}}};
        around.core_size           = {0.2, false, false};
        around.may_fill_body       = true;
        region                     = make_region_map(mesh, around);
        parameters.model           = model;
        parameters.support         = GradientSupport::horizon;
        parameters.bonds_may_break = true;
        parameters.is_in_motion    = true;
      }

      CoupledProblem<2>
      problem(const Bonds::BrokenBonds &broken) const
      {
        return CoupledProblem<2>(mesh,
                                 region,
                                 materials,
                                 parameters,
                                 {},
                                 {},
                                 {},
                                 broken);
      }

      /// Opens the middle.
      dealii::Tensor<1, 2>
      displacement(const dealii::Point<2> &x) const
      {
        dealii::Tensor<1, 2> u;
        u[0] = 0.01 * std::sin(3. * x[1]);
        u[1] = 0.1 * std::tanh(20. * (x[1] - 0.5)) *
               std::exp(-10. * (x[0] - 0.5) * (x[0] - 0.5));
        return u;
      }
    };

    /// Largest difference of the forces of a problem whose bonds broke in place
    /// and of one that is built without them, relative to the largest.
    void
    expect_as_built_anew(const Model model)
    {
      const Setup        setup(model);
      Bonds::BrokenBonds broken(1);
      auto               problem = setup.problem(broken);
      problem.keep_cell_stiffness();
      const auto       &nodal = setup.mesh.nodal();
      std::vector<bool> is_protected(nodal.n_nodes(), false);
      const auto        mass = Fem::lumped_mass<2>(nodal, {1.});
      Damage::Limits    limits;
      limits.stretch = 0.3;
      const auto rule =
        Damage::make_saw_tooth_rule<2>(limits,
                                       1,
                                       Materials::PlaneState::plane_strain);
      const MotionDamage damage{*rule,
                                false,
                                nullptr,
                                is_protected,
                                broken,
                                mass,
                                std::numeric_limits<double>::infinity()};
      FailurePlanes<2>   planes;
      const auto         bonds =
        model == Model::bond_based
                  ? make_moving_pairs<2>(setup.mesh,
                                 setup.region,
                                 setup.materials,
                                 damage,
                                 problem)
                  : make_moving_families<2>(setup.mesh,
                                    setup.region,
                                    setup.materials,
                                    family_parameters<2>(setup.parameters,
                                                         nodal,
                                                         setup.region,
                                                         setup.materials.laws),
                                    damage,
                                    planes,
                                    problem);
      // In two events, so that families lose bonds twice.
      for (const double amplitude : {0.7, 1.})
        {
          std::vector<dealii::Tensor<1, 2>> displacement;
          for (const auto &x : nodal.nodes)
            displacement.push_back(amplitude * setup.displacement(x));
          const auto found = bonds->overloaded(displacement);
          ASSERT_GT(found.nodes.size(), 5u);
          for (const auto &bond : found.nodes)
            {
              const auto xi  = nodal.nodes[bond[1]] - nodal.nodes[bond[0]];
              const auto eta = displacement[bond[1]] - displacement[bond[0]];
              EXPECT_GE(xi * eta, 0.3 * xi.norm_square());
              EXPECT_FALSE(broken.contains(bond[0], bond[1]));
              broken.add(bond[0], bond[1], 1);
            }
          bonds->take_away(found.nodes);
          EXPECT_TRUE(bonds->overloaded(displacement).nodes.empty());
        }
      const auto               other = setup.problem(broken);
      Fem::Vector              u[2], f[2];
      const CoupledProblem<2> *problems[2] = {&problem, &other};
      for (int k = 0; k < 2; ++k)
        {
          const auto &partition = problems[k]->partition();
          partition.initialize(u[k]);
          partition.initialize(f[k]);
          std::vector<dealii::Tensor<1, 2>> values;
          for (const auto &x : nodal.nodes)
            values.push_back(setup.displacement(x));
          Fem::set_nodal_values(values, partition, u[k]);
          u[k].update_ghost_values();
          problems[k]->internal_forces(u[k], f[k]);
        }
      const auto one     = Fem::to_nodal_values(f[0], problem.partition());
      const auto two     = Fem::to_nodal_values(f[1], other.partition());
      double     largest = 0., difference = 0.;
      for (unsigned int n = 0; n < one.size(); ++n)
        {
          largest    = std::max(largest, two[n].norm());
          difference = std::max(difference, (one[n] - two[n]).norm());
        }
      EXPECT_LT(difference, 1e-12 * largest);
      EXPECT_NEAR(problem.strain_energy(u[0]) / other.strain_energy(u[1]),
                  1.,
                  1e-12);
    }
  } // namespace

  TEST(MovingBonds, families_broken_in_place_are_those_built_anew)
  {
    expect_as_built_anew(Model::correspondence);
  }

  TEST(MovingBonds, pairs_broken_in_place_are_those_built_anew)
  {
    expect_as_built_anew(Model::bond_based);
  }
} // namespace Perimorph::Coupling
