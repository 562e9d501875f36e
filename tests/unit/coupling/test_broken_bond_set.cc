#include <perimorph/coupling/bond_energies.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/materials/material_factory.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Coupling
{
  namespace
  {
    using Point2 = dealii::Point<2>;

    /// A distorted unit square of bonds everywhere.
    struct Plate
    {
      std::unique_ptr<Mesh::DistributedMesh<2>> mesh;
      Mesh::RegionMap                           region;
      BodyMaterials<2>                          materials;
      CouplingParameters                        parameters;
      std::unique_ptr<CoupledProblem<2>>        problem;

      explicit Plate(const double horizon_ratio = 2.)
      {
        mesh = std::make_unique<Mesh::DistributedMesh<2>>(
          Testing::as_gmsh_mesh(Testing::unit_mesh<2>(12, 0.2)),
          MPI_COMM_WORLD);
        Mesh::RegionParameters where;
        where.horizon_ratio = horizon_ratio;
        where.mode          = Mesh::Mode::peridynamics;
        region              = Mesh::make_region_map(*mesh, where);
        parameters.model    = Model::bond_based;
        materials.laws.push_back(
          Materials::make_material<2>("linear elastic",
                                      1.,
                                      1. / 3.,
                                      Materials::PlaneState::plane_stress));
        materials.bond_constants.push_back(
          {1., Materials::PlaneState::plane_stress});
      }

      void
      build(const Bonds::BrokenBonds &broken)
      {
        problem =
          std::make_unique<CoupledProblem<2>>(*mesh,
                                              region,
                                              materials,
                                              parameters,
                                              CoupledProblem<2>::Progress(),
                                              std::vector<unsigned int>(),
                                              Bonds::CrackSet<2>(),
                                              broken);
      }

      std::vector<BondEnergy>
      bonds_under(const std::vector<dealii::Tensor<1, 2>> &u) const
      {
        return bond_energies(mesh->nodal(),
                             problem->bonds(),
                             u,
                             MPI_COMM_WORLD);
      }

      Fem::Vector
      vector_of(const std::vector<dealii::Tensor<1, 2>> &u) const
      {
        const auto &partition = problem->partition();
        Fem::Vector vector;
        partition.initialize(vector);
        for (unsigned int n = 0; n < partition.n_owned(); ++n)
          for (int d = 0; d < 2; ++d)
            vector.local_element(2 * n + d) = u[partition.global(n)][d];
        vector.update_ghost_values();
        return vector;
      }

      bool
      in_one_cell(const std::array<unsigned int, 2> &bond) const
      {
        const auto &cells = mesh->nodal().cells;
        return std::any_of(cells.begin(), cells.end(), [&](const auto &cell) {
          return std::count(cell.begin(), cell.end(), bond[0]) +
                   std::count(cell.begin(), cell.end(), bond[1]) ==
                 2;
        });
      }

      std::vector<dealii::Tensor<1, 2>>
      wavy_field() const
      {
        std::vector<dealii::Tensor<1, 2>> u;
        for (const auto &x : mesh->nodal().nodes)
          u.push_back(dealii::Tensor<1, 2>(
            {std::sin(5. * x[0] + x[1]), std::cos(3. * x[1]) * x[0]}));
        return u;
      }
    };
  } // namespace

  TEST(BrokenBondSet, tooth_takes_its_share_of_the_energy)
  {
    Plate plate;
    plate.build({});
    const auto   u      = plate.wavy_field();
    const auto   intact = plate.bonds_under(u);
    const double before = plate.problem->strain_energy(plate.vector_of(u));
    // No element of its own has a bond of two cells.
    Bonds::BrokenBonds broken(4);
    double             share = 0.;
    for (std::size_t b = 0; b < intact.size(); b += 50)
      if (!plate.in_one_cell(intact[b].nodes))
        {
          broken.add(intact[b].nodes[1], intact[b].nodes[0], 1);
          share += 0.25 * intact[b].energy;
        }
    ASSERT_GT(broken.list().size(), 5u);
    plate.build(broken);
    EXPECT_NEAR(before - plate.problem->strain_energy(plate.vector_of(u)),
                share,
                1e-13);
    const auto weaker = plate.bonds_under(u);
    ASSERT_EQ(weaker.size(), intact.size());
    for (std::size_t b = 0; b < intact.size(); ++b)
      EXPECT_NEAR(weaker[b].energy,
                  intact[b].energy *
                    broken.share_left(intact[b].nodes[0], intact[b].nodes[1]),
                  1e-15);
  }

  TEST(BrokenBondSet, cut_body_transmits_nothing)
  {
    // Elements kept in the cells of the cut would.
    for (const double ratio : {2., 3.})
      {
        Plate plate(ratio);
        plate.build({});
        const auto &nodes = plate.mesh->nodal().nodes;
        const auto  above = [&](const unsigned int n) {
          return nodes[n][1] > 0.5 + 1e-3;
        };
        Bonds::BrokenBonds                broken;
        std::vector<dealii::Tensor<1, 2>> u(nodes.size());
        for (const auto &bond : plate.bonds_under(u))
          if (above(bond.nodes[0]) != above(bond.nodes[1]))
            broken.add(bond.nodes[0], bond.nodes[1], 1);
        plate.build(broken);
        for (unsigned int n = 0; n < nodes.size(); ++n)
          if (above(n))
            u[n] = dealii::Tensor<1, 2>({0.3 - nodes[n][1], nodes[n][0]});
        Fem::Vector forces;
        plate.problem->partition().initialize(forces);
        plate.problem->internal_forces(plate.vector_of(u), forces);
        // What holds loose parts is 1e-11.
        EXPECT_LT(forces.linfty_norm(), 1e-10);

        const auto parts = plate.problem->parts(plate.region);
        for (unsigned int n = 0; n < nodes.size(); ++n)
          EXPECT_EQ(parts[n] == parts[0], above(n) == above(0));
      }
  }

  TEST(BrokenBondSet, all_bonds_broken_at_once)
  {
    Plate plate;
    plate.build({});
    Bonds::BrokenBonds broken;
    for (const auto &bond : plate.bonds_under(plate.wavy_field()))
      broken.add(bond.nodes[0], bond.nodes[1], 1);
    plate.build(broken);
    EXPECT_EQ(plate.problem->counts().bonds, 0u);
    EXPECT_LT(plate.problem->strain_energy(plate.vector_of(plate.wavy_field())),
              1e-8);
  }
} // namespace Perimorph::Coupling
