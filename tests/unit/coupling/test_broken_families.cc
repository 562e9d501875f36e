#include <perimorph/coupling/bond_energies.h>
#include <perimorph/coupling/broken_families.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/materials/material_factory.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <cmath>
#include <set>

namespace Perimorph::Coupling
{
  namespace
  {
    using Point2 = dealii::Point<2>;

    /// A distorted unit square, peridynamics everywhere or in the middle.
    struct Plate
    {
      std::unique_ptr<Mesh::DistributedMesh<2>> mesh;
      Mesh::RegionMap                           region;
      BodyMaterials<2>                          materials;
      CouplingParameters                        parameters;
      Bonds::BrokenBonds                        broken;

      explicit Plate(const bool         everywhere,
                     const double       horizon_ratio = 2.,
                     const unsigned int n_cells       = 14)
      {
        mesh = std::make_unique<Mesh::DistributedMesh<2>>(
          Testing::as_gmsh_mesh(Testing::unit_mesh<2>(n_cells, 0.2)),
          MPI_COMM_WORLD);
        Mesh::RegionParameters where;
        where.horizon_ratio = horizon_ratio;
        if (everywhere)
          where.mode = Mesh::Mode::peridynamics;
        where.features.push_back(
          {Parameters::FeatureKind::point, "", {0.5, 0.5}});
        region = Mesh::make_region_map(*mesh, where);
        materials.laws.push_back(
          Materials::make_material<2>("linear elastic",
                                      1.,
                                      1. / 3.,
                                      Materials::PlaneState::plane_stress));
        materials.bond_constants.push_back(
          {1., Materials::PlaneState::plane_stress});
      }

      unsigned int
      node_near(const Point2 &point) const
      {
        const auto  &nodes = mesh->nodal().nodes;
        unsigned int best  = 0;
        for (unsigned int n = 0; n < nodes.size(); ++n)
          if (nodes[n].distance(point) < nodes[best].distance(point))
            best = n;
        return best;
      }

      /// Breaks the bonds up to a length between nodes a condition holds for.
      void
      break_where(
        const double                                               length,
        const std::function<bool(const Point2 &, const Point2 &)> &condition)
      {
        const auto &nodes = mesh->nodal().nodes;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          for (unsigned int b = a + 1; b < nodes.size(); ++b)
            if (nodes[a].distance(nodes[b]) < length &&
                condition(nodes[a], nodes[b]))
              broken.add(a, b, 1);
      }

      std::unique_ptr<CoupledProblem<2>>
      problem() const
      {
        return std::make_unique<CoupledProblem<2>>(
          *mesh,
          region,
          materials,
          parameters,
          CoupledProblem<2>::Progress(),
          std::vector<unsigned int>(),
          Bonds::CrackSet<2>(),
          broken);
      }
    };

    /// Across a short slit in the middle.
    bool
    crosses_slit(const Point2 &a, const Point2 &b)
    {
      if ((a[1] > 0.5) == (b[1] > 0.5))
        return false;
      const double x = a[0] + (0.5 - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
      return std::abs(x - 0.5) < 0.1;
    }
  } // namespace

  TEST(BrokenFamilies, stay_exact_for_affine_fields)
  {
    for (const auto scale :
         {StabilizationScale::bending, StabilizationScale::shear_modulus})
      for (const double ratio : {2., 3.})
        {
          Plate plate(true, ratio);
          plate.parameters.scale = scale;
          const auto intact      = plate.problem()->correspondence_families();
          plate.break_where(0.4, crosses_slit);
          ASSERT_GT(plate.broken.size(), 10u);
          const auto   set       = plate.problem()->correspondence_families();
          const auto  &nodes     = plate.mesh->nodal().nodes;
          unsigned int n_changed = 0;
          for (std::size_t p = 0; p < set.n_particles(); ++p)
            {
              dealii::Tensor<2, 2> unit, K;
              for (std::size_t b = set.offsets[p]; b < set.offsets[p + 1]; ++b)
                {
                  ASSERT_FALSE(
                    plate.broken.contains(set.node[p], set.neighbor[b]));
                  const dealii::Tensor<1, 2> xi =
                    nodes[set.neighbor[b]] - nodes[set.node[p]];
                  unit += outer_product(xi, set.gradient_weight[b]);
                  K += set.bond_weight[b] * outer_product(xi, xi);
                }
              for (int d = 0; d < 2; ++d)
                unit[d][d] -= 1.;
              EXPECT_LT(unit.norm(), 1e-12);
              const auto size = [p](const auto &families) {
                return families.offsets[p + 1] - families.offsets[p];
              };
              if (size(set) == size(intact))
                continue;
              // D3 of numerics.md with the shear modulus 3 E / 8.
              ++n_changed;
              EXPECT_NEAR(set.stabilization[p] /
                            (0.375 * trace(invert(K)) / 2.),
                          1.,
                          1e-12);
            }
          EXPECT_GT(dealii::Utilities::MPI::sum(n_changed, MPI_COMM_WORLD), 5u);
        }
  }

  TEST(BrokenFamilies, change_nothing_elsewhere)
  {
    // Forces under affine displacement are those of finite elements wherever no
    // family reaches that lost a bond.
    Plate plate(false);
    plate.break_where(0.3, crosses_slit);
    const auto                problem   = plate.problem();
    const auto                set       = problem->correspondence_families();
    const auto               &partition = problem->partition();
    std::vector<unsigned int> touched(plate.mesh->nodal().n_nodes(), 0);
    for (std::size_t p = 0; p < set.n_particles(); ++p)
      if (plate.broken.count(set.node[p]) > 0)
        for (std::size_t b = set.offsets[p]; b < set.offsets[p + 1]; ++b)
          touched[set.neighbor[b]] = 1;
    for (const auto &bond : plate.broken.list())
      touched[bond.nodes[0]] = touched[bond.nodes[1]] = 1;
    dealii::Utilities::MPI::max(touched, MPI_COMM_WORLD, touched);

    Fem::Vector displacement, forces, expected;
    partition.initialize(displacement);
    partition.initialize(forces);
    partition.initialize(expected);
    const dealii::Tensor<2, 2> gradient({{0.3, -0.2}, {0.5, 1.}});
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      {
        const auto u = gradient * partition.position(n);
        for (int d = 0; d < 2; ++d)
          displacement.local_element(2 * n + d) = u[d];
      }
    displacement.update_ghost_values();
    problem->internal_forces(displacement, forces);
    problem->full_elements().add_residual(displacement, expected);
    expected.compress(dealii::VectorOperation::add);
    double       elsewhere = 0., near = 0.;
    unsigned int n_elsewhere = 0;
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      for (int d = 0; d < 2; ++d)
        {
          const double error = std::abs(forces.local_element(2 * n + d) -
                                        expected.local_element(2 * n + d));
          if (touched[partition.global(n)])
            near = std::max(near, error);
          else
            {
              elsewhere = std::max(elsewhere, error);
              ++n_elsewhere;
            }
        }
    EXPECT_LT(elsewhere, 1e-13);
    EXPECT_GT(dealii::Utilities::MPI::sum(n_elsewhere, MPI_COMM_WORLD), 100u);
    // The slit is a free surface: it does not transmit this stress.
    EXPECT_GT(dealii::Utilities::MPI::max(near, MPI_COMM_WORLD), 1e-2);
  }

  TEST(BrokenFamilies, isolated_particle_is_held_and_carries_nothing)
  {
    Plate              plate(true);
    const unsigned int lost = plate.node_near(Point2(0.5, 0.5));
    for (unsigned int n = 0; n < plate.mesh->nodal().n_nodes(); ++n)
      if (n != lost)
        plate.broken.add(lost, n, 1);
    const auto problem = plate.problem();
    EXPECT_EQ(problem->counts().isolated, 1u);
    const auto set = problem->correspondence_families();
    for (const unsigned int n : set.node)
      EXPECT_NE(n, lost);
    for (const unsigned int n : set.neighbor)
      EXPECT_NE(n, lost);

    const auto parts =
      find_parts(plate.mesh->nodal(), plate.region.alpha, set, MPI_COMM_WORLD);
    EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 1u);
    // Moving it alone needs force, but next to none.
    const auto &partition = problem->partition();
    Fem::Vector displacement, forces;
    partition.initialize(displacement);
    partition.initialize(forces);
    const bool owned = plate.mesh->nodal().owns_node(lost);
    if (owned)
      displacement.local_element(2 * partition.local(lost)) = 1.;
    displacement.update_ghost_values();
    problem->internal_forces(displacement, forces);
    EXPECT_NEAR(forces.l2_norm(), 1e-11, 1e-20);
    if (owned)
      {
        EXPECT_GT(forces.local_element(2 * partition.local(lost)), 0.);
      }
  }

  TEST(BrokenFamilies, too_few_bonds)
  {
    Plate plate(true);
    // Two nodes keep only the bond between them.
    const unsigned int a = plate.node_near(Point2(0.4, 0.4));
    const unsigned int b = plate.node_near(Point2(0.47, 0.4));
    ASSERT_NE(a, b);
    for (unsigned int n = 0; n < plate.mesh->nodal().n_nodes(); ++n)
      if (n != a && n != b)
        {
          plate.broken.add(a, n, 1);
          plate.broken.add(b, n, 1);
        }
    EXPECT_EQ(plate.problem()->counts().isolated, 2u);
  }

  TEST(BrokenFamilies, all_bonds_broken_at_once)
  {
    Plate plate(true, 2., 6);
    plate.break_where(2., [](const Point2 &, const Point2 &) { return true; });
    const auto problem = plate.problem();
    EXPECT_EQ(problem->counts().bonds, 0u);
    EXPECT_EQ(problem->counts().isolated, 49u);
  }

  TEST(BrokenFamilies, parts_of_a_body_cut_in_two)
  {
    Plate plate(true);
    plate.break_where(2., [](const Point2 &a, const Point2 &b) {
      return (a[1] > 0.5) != (b[1] > 0.5);
    });
    const auto             problem = plate.problem();
    const auto            &nodal   = plate.mesh->nodal();
    const auto             parts   = find_parts(nodal,
                                  plate.region.alpha,
                                  problem->correspondence_families(),
                                  MPI_COMM_WORLD);
    std::set<unsigned int> above, below;
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      (nodal.nodes[n][1] > 0.5 ? above : below).insert(parts[n]);
    EXPECT_EQ(above.size(), 1u);
    EXPECT_EQ(below.size(), 1u);
    EXPECT_NE(*above.begin(), *below.begin());
  }

  TEST(BondEnergies, add_up_to_the_strain_energy)
  {
    for (const bool has_broken : {false, true})
      {
        Plate plate(true);
        if (has_broken)
          plate.break_where(0.3, crosses_slit);
        const auto                        problem   = plate.problem();
        const auto                       &partition = problem->partition();
        const auto                       &nodal     = plate.mesh->nodal();
        std::vector<dealii::Tensor<1, 2>> displacement;
        for (const auto &x : nodal.nodes)
          displacement.push_back(dealii::Tensor<1, 2>(
            {std::sin(5. * x[0] + x[1]), std::cos(3. * x[1]) * x[0]}));
        Fem::Vector vector;
        partition.initialize(vector);
        for (unsigned int n = 0; n < partition.n_owned(); ++n)
          for (int d = 0; d < 2; ++d)
            vector.local_element(2 * n + d) =
              displacement[partition.global(n)][d];
        vector.update_ghost_values();
        double     sum   = 0.;
        const auto bonds = bond_energies(nodal,
                                         problem->correspondence_families(),
                                         plate.materials.laws,
                                         displacement,
                                         MPI_COMM_WORLD);
        for (const auto &bond : bonds)
          {
            sum += bond.energy;
            EXPECT_LT(bond.nodes[0], bond.nodes[1]);
            EXPECT_FALSE(plate.broken.contains(bond.nodes[0], bond.nodes[1]));
          }
        EXPECT_NEAR(sum / problem->strain_energy(vector), 1., 1e-12);
      }
  }
} // namespace Perimorph::Coupling
