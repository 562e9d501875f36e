#include <perimorph/fem/cell_stiffness.h>
#include <perimorph/fem/elastic_cells.h>
#include <perimorph/materials/material_factory.h>
#include <perimorph/mesh/distributed_mesh.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Fem
{
  namespace
  {
    template <int dim>
    typename ElasticCells<dim>::MaterialList
    laws(const std::string &name)
    {
      typename ElasticCells<dim>::MaterialList list;
      list.push_back(Materials::make_material<dim>(
        name,
        1.,
        0.3,
        dim == 2 ? Materials::PlaneState::plane_strain
                 : Materials::PlaneState::three_dimensional));
      return list;
    }

    /// Largest difference of two vectors, relative to the largest entry.
    double
    difference(const Vector &first, const Vector &second)
    {
      Vector change(first);
      change -= second;
      return change.linfty_norm() / second.linfty_norm();
    }

    template <int dim>
    void
    expect_forces_of_terms(const unsigned int n_cells)
    {
      const Mesh::DistributedMesh<dim> mesh(
        Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(n_cells, 0.2)),
        MPI_COMM_WORLD);
      const auto               &nodal = mesh.nodal();
      std::vector<unsigned int> needed;
      add_cell_nodes(nodal, needed);
      const NodePartition<dim> partition(nodal, needed, mesh.communicator());
      const auto               materials = laws<dim>("linear elastic");

      // The second term has weights, and works in a part of the cells only.
      std::vector<double> weight;
      for (const auto &x : nodal.nodes)
        weight.push_back(x[0] < 0.5 ? 0. : -0.3 * x[1]);
      ElasticCells<dim> all(nodal, partition, materials, {});
      ElasticCells<dim> some(nodal, partition, materials, weight);

      Vector at_rest, u, expected, found;
      for (auto *vector : {&at_rest, &u, &expected, &found})
        partition.initialize(*vector);
      for (unsigned int n = 0; n < partition.n_owned(); ++n)
        for (int d = 0; d < dim; ++d)
          {
            const auto &x = partition.position(n);
            u.local_element(dim * n + d) =
              std::sin(31. * x[0] + 17. * x[1] + 23. * x[dim - 1] + d);
          }
      u.update_ghost_values();

      CellStiffness<dim> stiffness({&all, &some}, at_rest);
      const auto         compare = [&]() {
        for (auto *vector : {&expected, &found})
          {
            vector->zero_out_ghost_values();
            *vector = 0.;
          }
        all.add_residual(u, expected);
        some.add_residual(u, expected);
        stiffness.add_product(u, found);
        expected.compress(dealii::VectorOperation::add);
        found.compress(dealii::VectorOperation::add);
        EXPECT_LT(difference(found, expected), 1e-13);
      };
      compare();

      std::vector<bool> goes(nodal.n_cells());
      for (unsigned int c = 0; c < nodal.n_cells(); c += 3)
        goes[c] = true;
      all.remove(goes);
      some.remove(goes);
      stiffness.remove(goes);
      compare();
    }
  } // namespace

  TEST(CellStiffness, forces_are_those_of_the_terms_in_the_plane)
  {
    expect_forces_of_terms<2>(7);
  }

  TEST(CellStiffness, forces_are_those_of_the_terms_in_space)
  {
    expect_forces_of_terms<3>(5);
  }

  TEST(CellStiffness, holds_linear_and_symmetric_terms_only)
  {
    const Mesh::DistributedMesh<2> mesh(
      Testing::as_gmsh_mesh(Testing::unit_mesh<2>(3)),
      MPI_COMM_WORLD);
    std::vector<unsigned int> needed;
    add_cell_nodes(mesh.nodal(), needed);
    const NodePartition<2> partition(mesh.nodal(), needed, mesh.communicator());
    const auto             linear = laws<2>("linear elastic");
    const auto             finite = laws<2>("neo-hookean");
    ElasticCells<2>        cells(mesh.nodal(), partition, linear, {});
    EXPECT_TRUE(CellStiffness<2>::can_hold(cells));
    cells.set_row_weights(std::vector<double>(partition.n_local(), 0.5));
    EXPECT_FALSE(CellStiffness<2>::can_hold(cells));
    EXPECT_FALSE(CellStiffness<2>::can_hold(
      ElasticCells<2>(mesh.nodal(), partition, finite, {})));
  }
} // namespace Perimorph::Fem
