#include <perimorph/bonds/bond_search.h>
#include <perimorph/bonds/segment_cutter.h>
#include <perimorph/coupling/segment_residual.h>
#include <perimorph/materials/linear_elastic.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/peridynamics/bond_based.h>

#include "test_meshes.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Perimorph;
using Materials::PlaneState;

namespace
{
  template <int dim>
  constexpr PlaneState state =
    dim == 2 ? PlaneState::plane_stress : PlaneState::three_dimensional;

  /// 1 in a ball around the middle of the mesh, cubic to 0; 0/1 if equal radii.
  template <int dim>
  std::vector<double>
  ball(const Mesh::NodalMesh<dim> &mesh, const double inner, const double outer)
  {
    dealii::Point<dim> centre;
    for (int d = 0; d < dim; ++d)
      centre[d] = 0.5;
    std::vector<double> alpha;
    for (const auto &node : mesh.nodes)
      {
        const double r = node.distance(centre);
        const double t =
          std::min(1., std::max(0., (outer - r) / (outer - inner)));
        alpha.push_back(outer > inner ? t * t * (3. - 2. * t) : r < inner);
      }
    return alpha;
  }

  /// A bond that stays inside the body.
  template <int dim>
  struct Spring
  {
    std::array<unsigned int, 2>           nodes;
    double                                stiffness;
    dealii::Tensor<1, dim>                xi;
    std::vector<Bonds::SegmentPiece<dim>> pieces;
  };

  template <int dim>
  std::vector<Spring<dim>>
  springs_of(const Mesh::NodalMesh<dim> &mesh,
             const std::vector<double>  &alpha,
             const double                horizon_ratio)
  {
    std::vector<double> horizon, c;
    for (const double h : mesh.spacing)
      {
        horizon.push_back(horizon_ratio * h);
        c.push_back(Peridynamics::calibration_factor<dim>(horizon_ratio) *
                    Peridynamics::micromodulus(1., horizon.back(), state<dim>));
      }
    const auto pairs = Bonds::find_bond_pairs(mesh, alpha, horizon);
    Bonds::SegmentCutter<dim> cutter(mesh);
    std::vector<Spring<dim>>  springs;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        Spring<dim> spring;
        spring.nodes      = pairs.nodes[p];
        const auto [i, j] = spring.nodes;
        spring.xi         = mesh.nodes[j] - mesh.nodes[i];
        if (!cutter.cut(i, j, spring.pieces))
          continue;
        spring.stiffness = Peridynamics::pair_stiffness(
          {alpha[i], c[i], pairs.beta[p][0], mesh.volume[i]},
          {alpha[j], c[j], pairs.beta[p][1], mesh.volume[j]},
          spring.xi.norm());
        springs.push_back(spring);
      }
    return springs;
  }

  template <int dim>
  Coupling::SegmentResidual<dim>
  residual_of(const Mesh::NodalMesh<dim>     &mesh,
              const std::vector<Spring<dim>> &springs)
  {
    Coupling::SegmentResidual<dim> residual(mesh);
    for (const auto &spring : springs)
      residual.add_bond(spring.xi / spring.xi.norm(),
                        spring.stiffness,
                        spring.xi.norm(),
                        spring.pieces);
    return residual;
  }

  template <int dim>
  using Forces = std::vector<dealii::Tensor<1, dim>>;

  /// Adds sign * sum_q w_q stress(q) grad N_l of one cell.
  template <int dim, typename Stress>
  void
  add_cell_forces(const Mesh::NodalMesh<dim> &mesh,
                  const unsigned int          cell,
                  const Stress               &stress,
                  const double                sign,
                  Forces<dim>                &forces)
  {
    const Mesh::CellGeometry<dim> geometry(mesh.corners(cell));
    for (unsigned int q = 0; q < geometry.n_points; ++q)
      for (unsigned int l = 0; l < geometry.n_nodes; ++l)
        forces[mesh.cells[cell][l]] +=
          sign * geometry.jxw[q] *
          (dealii::Tensor<2, dim>(stress(q)) * geometry.gradients[q][l]);
  }

  /// Largest difference between the forces of a linear displacement in the
  /// coupled and in the pure finite-element model, relative to |stress|
  /// h^(d-1).
  template <int dim>
  double
  ghost_force(const Mesh::NodalMesh<dim> &mesh,
              const std::vector<double>  &alpha,
              const double                horizon_ratio)
  {
    const auto springs  = springs_of(mesh, alpha, horizon_ratio);
    auto       residual = residual_of(mesh, springs);
    residual.solve();

    dealii::Tensor<2, dim> gradient;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        gradient[a][b] = 0.7 - 0.9 * a + 0.4 * b * (a + 1.);
    const auto strain = symmetrize(gradient);

    // Elements of both models have C_0, so only bonds and C_q remain.
    Forces<dim> forces(mesh.n_nodes());
    double      bond_force = 0.;
    for (const auto &spring : springs)
      {
        const dealii::Tensor<1, dim> force =
          Peridynamics::small_bond_force(spring.stiffness,
                                         spring.xi,
                                         gradient * spring.xi);
        forces[spring.nodes[1]] += force;
        forces[spring.nodes[0]] -= force;
        bond_force += force.norm();
      }
    EXPECT_GT(bond_force, 0.);
    for (unsigned int k = 0; k < residual.touched_cells().size(); ++k)
      add_cell_forces(
        mesh,
        residual.touched_cells()[k],
        [&](const unsigned int q) {
          return residual.tensors(k)[q].contract(strain);
        },
        -1.,
        forces);

    const Materials::LinearElastic<dim> material(
      1.,
      Peridynamics::allowed_poissons_ratio(state<dim>),
      state<dim>);
    const auto stress  = material.first_piola_kirchhoff(gradient);
    double     largest = 0.;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      largest =
        std::max(largest,
                 forces[n].norm() /
                   (stress.norm() * std::pow(mesh.spacing[n], dim - 1)));
    return largest;
  }
} // namespace

TEST(FullySymmetricTensor, components_and_multiplicities)
{
  using Tensor2 = Coupling::FullySymmetricTensor<2>;
  using Tensor3 = Coupling::FullySymmetricTensor<3>;
  EXPECT_EQ(Tensor2::component(0, 1, 0, 1), Tensor2::component(1, 1, 0, 0));
  EXPECT_EQ(Tensor2::multiplicity(Tensor2::component(0, 1, 0, 1)), 6u);
  EXPECT_EQ(Tensor3::multiplicity(Tensor3::component(2, 1, 0, 1)), 12u);
  unsigned int n_indices = 0;
  for (unsigned int c = 0; c < Tensor3::n_components; ++c)
    n_indices += Tensor3::multiplicity(c);
  EXPECT_EQ(n_indices, 81u);
}

TEST(FullySymmetricTensor, contraction_is_that_of_the_full_tensor)
{
  dealii::Tensor<1, 3> direction;
  direction[0] = 0.3;
  direction[1] = -0.5;
  direction[2] = 0.8;
  Coupling::FullySymmetricTensor<3> tensor;
  tensor.add(1.5, Coupling::FullySymmetricTensor<3>::dyad(direction));
  dealii::SymmetricTensor<2, 3> strain;
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = a; b < 3; ++b)
      strain[a][b] = 0.2 + a - 0.3 * b;

  const double along = direction * (dealii::Tensor<2, 3>(strain) * direction);
  const dealii::SymmetricTensor<2, 3> expected =
    1.5 * along * symmetrize(dealii::outer_product(direction, direction));
  EXPECT_LT((tensor.contract(strain) - expected).norm(), 1e-14);

  dealii::Tensor<2, 3> by_full_tensor =
    dealii::double_contract<2, 0, 3, 1>(tensor.full(),
                                        dealii::Tensor<2, 3>(strain));
  EXPECT_LT((by_full_tensor - dealii::Tensor<2, 3>(expected)).norm(), 1e-14);
  EXPECT_NEAR(tensor.norm(), 1.5 * std::pow(direction.norm(), 4), 1e-14);
}

TEST(SegmentResidual, local_systems_are_consistent)
{
  const auto square = Testing::unit_mesh<2>(8, 0.2);
  const auto in_2d =
    residual_of(square, springs_of(square, ball(square, 0.2, 0.4), 2.)).solve();
  EXPECT_LT(in_2d.largest_residual, 1e-12);
  // Null space: constant and rotation-like fields, 4 + 3 in 2D, 10 + 15 in 3D.
  EXPECT_EQ(in_2d.smallest_rank, 9u);
  EXPECT_EQ(in_2d.largest_rank, 9u);

  const auto cube = Testing::unit_mesh<3>(4, 0.2);
  const auto in_3d =
    residual_of(cube, springs_of(cube, ball(cube, 0.3, 0.5), 2.)).solve();
  EXPECT_LT(in_3d.largest_residual, 1e-12);
  EXPECT_EQ(in_3d.smallest_rank, 55u);
  EXPECT_EQ(in_3d.largest_rank, 55u);
}

TEST(SegmentResidual, patch_test_on_perturbed_quadrilaterals)
{
  const auto mesh = Testing::unit_mesh<2>(8, 0.2);
  for (const double ratio : {1.5, 2., 3.})
    {
      EXPECT_LT(ghost_force(mesh, ball(mesh, 0.2, 0.4), ratio), 1e-12);
      EXPECT_LT(ghost_force(mesh, ball(mesh, 0.3, 0.3), ratio), 1e-12);
    }
  // Bonds up to the surface, and nothing but bonds.
  EXPECT_LT(ghost_force(mesh, ball(mesh, 2., 3.), 2.), 1e-12);
}

TEST(SegmentResidual, patch_test_on_graded_and_uniform_quadrilaterals)
{
  const auto uniform = Testing::unit_mesh<2>(8);
  const auto graded  = Testing::unit_mesh<2>(10, 0.2, 4.);
  const auto noisy   = Testing::unit_mesh<2>(8, 1e-10);
  for (const auto *mesh : {&uniform, &graded, &noisy})
    EXPECT_LT(ghost_force(*mesh, ball(*mesh, 0.3, 0.3), 3.), 1e-12);
}

TEST(SegmentResidual, patch_test_around_a_hole)
{
  // Bonds across the hole are gone, and the hole is free of forces still.
  const auto                mesh = Testing::annulus_mesh<2>(24, 6, 0.3, 1.);
  const std::vector<double> alpha(mesh.n_nodes(), 1.);
  EXPECT_LT(ghost_force(mesh, alpha, 3.), 1e-12);
}

TEST(SegmentResidual, patch_test_on_perturbed_hexahedra)
{
  const auto mesh = Testing::unit_mesh<3>(4, 0.2);
  for (const double ratio : {1.5, 2.})
    {
      EXPECT_LT(ghost_force(mesh, ball(mesh, 0.2, 0.5), ratio), 1e-12);
      EXPECT_LT(ghost_force(mesh, ball(mesh, 0.4, 0.4), ratio), 1e-12);
    }
}

TEST(SegmentResidual, full_family_has_the_stiffness_of_the_material)
{
  // Uniform mesh, all bonds: away from the surface C_q is the calibrated
  // stiffness of a full family, whose sum C_abab is that of the material.
  const auto                mesh = Testing::unit_mesh<2>(9);
  const std::vector<double> alpha(mesh.n_nodes(), 1.);
  auto residual = residual_of(mesh, springs_of(mesh, alpha, 2.));
  residual.solve();
  for (unsigned int k = 0; k < residual.touched_cells().size(); ++k)
    if (residual.touched_cells()[k] == 40)
      {
        double mean = 0.;
        for (const auto &tensor : residual.tensors(k))
          mean += 0.25 * (tensor(0, 0, 0, 0) + tensor(1, 1, 1, 1) +
                          2. * tensor(0, 1, 0, 1));
        EXPECT_NEAR(mean, 3., 1e-12); // 8 mu, mu = E / (2 (1 + 1/3)), E = 1
      }
}

TEST(SegmentResidual, mean_over_a_cell_is_that_of_its_pieces)
{
  // Cbar of numerics-explicit.md, section 3: the constraints fix it already.
  const auto mesh     = Testing::unit_mesh<3>(3, 0.2);
  const auto springs  = springs_of(mesh, ball(mesh, 0.4, 0.7), 2.);
  auto       residual = residual_of(mesh, springs);
  residual.solve();

  std::vector<Coupling::FullySymmetricTensor<3>> difference(mesh.n_cells());
  for (const auto &spring : springs)
    for (const auto &piece : spring.pieces)
      difference[piece.cell].add(
        piece.share * spring.stiffness * spring.xi.norm() * piece.length,
        Coupling::FullySymmetricTensor<3>::dyad(spring.xi / spring.xi.norm()));
  for (unsigned int k = 0; k < residual.touched_cells().size(); ++k)
    {
      const unsigned int          cell = residual.touched_cells()[k];
      const Mesh::CellGeometry<3> geometry(mesh.corners(cell));
      const double                size = difference[cell].norm();
      for (unsigned int q = 0; q < geometry.n_points; ++q)
        difference[cell].add(-geometry.jxw[q], residual.tensors(k)[q]);
      EXPECT_LT(difference[cell].norm(), 1e-10 * size);
    }
}

TEST(SegmentResidual, constant_stiffness_stays_constant)
{
  // A made-up piece with the moments of the constant tensor 3.5 e e e e: the
  // nearest C_q is that tensor at every point of a distorted cell.
  const auto           mesh = Testing::unit_mesh<3>(3, 0.3);
  dealii::Tensor<1, 3> direction;
  direction[0] = 0.48;
  direction[1] = -0.6;
  direction[2] = 0.64;
  Bonds::SegmentPiece<3> piece{13, 1., 1., {}, {}};

  const Mesh::CellGeometry<3> geometry(mesh.corners(piece.cell));
  for (unsigned int q = 0; q < geometry.n_points; ++q)
    for (unsigned int l = 0; l < geometry.n_nodes; ++l)
      piece.shape_end[l] +=
        geometry.jxw[q] * (geometry.gradients[q][l] * direction);

  Coupling::SegmentResidual<3> residual(mesh);
  residual.add_bond(direction, 7., 0.5, {piece});
  residual.solve();
  for (auto tensor : residual.tensors(0))
    {
      tensor.add(-3.5, Coupling::FullySymmetricTensor<3>::dyad(direction));
      EXPECT_LT(tensor.norm(), 1e-10);
    }
}

TEST(SegmentResidual, keeps_only_cells_of_this_rank)
{
  auto       mesh    = Testing::unit_mesh<2>(8, 0.2);
  const auto springs = springs_of(mesh, ball(mesh, 0.3, 0.3), 2.);
  auto       whole   = residual_of(mesh, springs);
  whole.solve();

  for (unsigned int cell = 0; cell < 32; ++cell)
    mesh.cell_owner[cell] = 1;
  auto half = residual_of(mesh, springs);
  half.solve();

  EXPECT_LT(half.touched_cells().size(), whole.touched_cells().size());
  for (unsigned int k = 0; k < half.touched_cells().size(); ++k)
    {
      const unsigned int cell = half.touched_cells()[k];
      EXPECT_TRUE(mesh.owns_cell(cell));
      const auto &cells = whole.touched_cells();
      const auto  same  = std::find(cells.begin(), cells.end(), cell);
      ASSERT_NE(same, cells.end());
      auto difference = half.tensors(k)[0];
      difference.add(-1., whole.tensors(same - cells.begin())[0]);
      EXPECT_LT(difference.norm(), 1e-12);
    }
}
