#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/materials/material_factory.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Virial stress of all nodes of a 24 x 24 block, bonds everywhere, under a
    /// displacement gradient; and its mesh.
    struct Block
    {
      explicit Block(const std::string &law)
        : mesh(Testing::as_gmsh_mesh(
                 Testing::structured_mesh<2>({{24, 24}},
                                             dealii::Point<2>(),
                                             dealii::Point<2>(1., 1.))),
               MPI_COMM_WORLD)
      {
        Mesh::RegionParameters everywhere;
        everywhere.mode          = Mesh::Mode::peridynamics;
        everywhere.horizon_ratio = 3.;
        region                   = Mesh::make_region_map(mesh, everywhere);
        BodyMaterials<2> materials;
        materials.laws.push_back(
          Materials::make_material<2>(law,
                                      1.,
                                      0.25,
                                      Materials::PlaneState::plane_strain));
        materials.bond_constants.push_back(
          {1., Materials::PlaneState::plane_strain});
        CouplingParameters parameters;
        parameters.model = Model::bond_based;
        const CoupledProblem<2> problem(mesh, region, materials, parameters);

        const auto &partition = problem.partition();
        Fem::Vector displacement;
        partition.initialize(displacement);
        gradient[0][0] = 0.02;
        gradient[0][1] = 0.01;
        gradient[1][1] = -0.005;
        for (unsigned int local = 0; local < partition.n_owned(); ++local)
          {
            const auto u = gradient * partition.position(local);
            for (int d = 0; d < 2; ++d)
              displacement.local_element(2 * local + d) = u[d];
          }
        displacement.update_ghost_values();
        stress   = problem.virial_stress(displacement, region);
        expected = materials.laws[0]->first_piola_kirchhoff(gradient);
      }

      Mesh::DistributedMesh<2>          mesh;
      Mesh::RegionMap                   region;
      dealii::Tensor<2, 2>              gradient, expected;
      std::vector<dealii::Tensor<2, 2>> stress;
    };
  } // namespace

  TEST(VirialField, equals_the_stress_of_the_law_in_the_bulk)
  {
    // On a lattice with m = 3 the ball counts 1.5 % too much (numerics.md,
    // section 7); the printed formula would give 0.58.
    for (const std::string law : {"linear elastic", "prototype microelastic"})
      {
        const Block  block(law);
        const auto  &nodal  = block.mesh.nodal();
        unsigned int n_bulk = 0;
        for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
          {
            double to_surface = 1.;
            for (int d = 0; d < 2; ++d)
              to_surface = std::min(
                {to_surface, nodal.nodes[n][d], 1. - nodal.nodes[n][d]});
            if (to_surface < 2.5 * block.region.horizon[n])
              continue;
            ++n_bulk;
            EXPECT_LT((block.stress[n] - block.expected).norm(),
                      0.025 * block.expected.norm())
              << law << " at " << nodal.nodes[n] << ": " << block.stress[n]
              << " instead of " << block.expected;
          }
        EXPECT_GT(n_bulk, 50u);
      }
  }
} // namespace Perimorph::Coupling
