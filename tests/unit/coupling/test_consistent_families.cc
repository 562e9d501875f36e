#include <perimorph/coupling/consistent_families.h>
#include <perimorph/materials/linear_elastic.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/region_map.h>

#include <gtest/gtest.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Coupling
{
  namespace
  {
    using Mesh::BlendingFunction;

    /// Poisson's ratio 1/4, of the plane in 2D.
    template <int dim>
    ElasticConstants
    isotropic(const double youngs_modulus)
    {
      return elastic_constants(Materials::LinearElastic<dim>(
        youngs_modulus,
        0.25,
        dim == 2 ? Materials::PlaneState::plane_stress
                 : Materials::PlaneState::three_dimensional));
    }

    /// Alpha of a ball in the middle of the unit square or cube.
    template <int dim>
    std::vector<double>
    ball_alpha(const Mesh::NodalMesh<dim> &mesh,
               const BlendingFunction      function)
    {
      dealii::Point<dim> center;
      for (int d = 0; d < dim; ++d)
        center[d] = 0.5;
      std::vector<double> alpha;
      for (const auto &x : mesh.nodes)
        alpha.push_back(
          Mesh::blending_weight(function, (x.distance(center) - 0.18) / 0.14));
      return alpha;
    }

    template <int dim>
    std::vector<double>
    horizons(const Mesh::NodalMesh<dim> &mesh, const double ratio)
    {
      std::vector<double> horizon;
      for (const double h : mesh.spacing)
        horizon.push_back(ratio * h);
      return horizon;
    }

    struct ConsistencyErrors
    {
      double target; ///< sum_i a_i g_ij - t_j, relative to h^(dim-1)
      double affine; ///< sum_j g_ij (x) xi_ij - I
    };

    template <int dim>
    ConsistencyErrors
    consistency(const Mesh::NodalMesh<dim>         &mesh,
                const std::vector<double>          &alpha,
                const Peridynamics::FamilySet<dim> &set)
    {
      std::vector<dealii::Tensor<1, dim>> sum(mesh.n_nodes());
      ConsistencyErrors                   errors{0., 0.};
      for (std::size_t p = 0; p < set.n_particles(); ++p)
        {
          dealii::Tensor<2, dim> unit;
          for (std::size_t b = set.offsets[p]; b < set.offsets[p + 1]; ++b)
            {
              const auto &g = set.gradient_weight[b];
              sum[set.neighbor[b]] += set.weight[p] * g;
              sum[set.node[p]] -= set.weight[p] * g;
              unit += outer_product(
                dealii::Tensor<1, dim>(mesh.nodes[set.neighbor[b]] -
                                       mesh.nodes[set.node[p]]),
                g);
            }
          for (int d = 0; d < dim; ++d)
            unit[d][d] -= 1.;
          errors.affine = std::max(errors.affine, unit.norm());
        }
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            {
              double weight = 0.;
              for (unsigned int v = 0; v < geometry.n_nodes; ++v)
                weight += geometry.shape_value(q, v) * alpha[mesh.cells[c][v]];
              for (unsigned int v = 0; v < geometry.n_nodes; ++v)
                sum[mesh.cells[c][v]] -=
                  geometry.jxw[q] * weight * geometry.gradients[q][v];
            }
        }
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        errors.target =
          std::max(errors.target,
                   sum[n].norm() / std::pow(mesh.spacing[n], dim - 1));
      return errors;
    }

    template <int dim>
    void
    expect_consistent(const Mesh::NodalMesh<dim> &mesh, const double ratio)
    {
      FamilyParameters parameters;
      parameters.constants = {isotropic<dim>(2.5)};
      for (const auto support :
           {GradientSupport::adjacent_cells, GradientSupport::horizon})
        for (const auto function :
             {BlendingFunction::cubic, BlendingFunction::splice})
          for (const auto influence :
               {Peridynamics::InfluenceFunction::gaussian,
                Peridynamics::InfluenceFunction::constant,
                Peridynamics::InfluenceFunction::cubic_spline})
            {
              parameters.support   = support;
              parameters.influence = influence;
              const auto alpha     = ball_alpha(mesh, function);
              const auto set       = consistent_families(mesh,
                                                   alpha,
                                                   horizons(mesh, ratio),
                                                   parameters);
              ASSERT_GT(set.n_particles(), 0u);
              const auto errors = consistency(mesh, alpha, set);
              EXPECT_LT(errors.target, 1e-13);
              EXPECT_LT(errors.affine, 1e-13);
            }
    }
  } // namespace

  TEST(ConsistentFamilies, meet_both_conditions_on_distorted_meshes)
  {
    for (const double ratio : {1.5, 2., 3.})
      {
        expect_consistent(Testing::unit_mesh<2>(12), ratio);
        expect_consistent(Testing::unit_mesh<2>(12, 0.25), ratio);
        expect_consistent(Testing::unit_mesh<2>(12, 0.1, 8.), ratio);
      }
    expect_consistent(Testing::unit_mesh<3>(7, 0.2), 1.5);
    expect_consistent(Testing::unit_mesh<3>(7, 0.2), 2.);
  }

  TEST(ConsistentFamilies, classical_gradient_misses_the_target)
  {
    const auto       mesh  = Testing::unit_mesh<2>(16, 0.2);
    const auto       alpha = ball_alpha(mesh, BlendingFunction::cubic);
    FamilyParameters parameters;
    parameters.constants = {isotropic<2>(2.5)};
    const auto errors    = consistency(
      mesh,
      alpha,
      classical_families(mesh, alpha, horizons(mesh, 2.), parameters));
    EXPECT_GT(errors.target, 0.05);
    EXPECT_LT(errors.affine, 1e-13);
  }

  TEST(ConsistentFamilies, sizes_on_lattices)
  {
    // Interior nodes: numerics-explicit.md section 2 and numerics.md section 8.
    // For m = 3 the former has 36, but the cells with their centroid at
    // (2.5, 1.5) h are 2.92 h away, so their corners count: 7 x 5 and 5 x 7
    // nodes together, without the particle 44.
    FamilyParameters parameters;
    parameters.constants = {isotropic<2>(2.5)};
    const auto largest   = [](const auto &set) {
      std::size_t size = 0;
      for (std::size_t p = 0; p < set.n_particles(); ++p)
        size = std::max(size, set.offsets[p + 1] - set.offsets[p]);
      return size;
    };
    const auto mesh2 = Testing::unit_mesh<2>(10);
    const auto ones2 = std::vector<double>(mesh2.n_nodes(), 1.);
    const auto mesh3 = Testing::unit_mesh<3>(8);
    const auto ones3 = std::vector<double>(mesh3.n_nodes(), 1.);
    const std::vector<std::array<std::size_t, 2>> plane  = {{{8, 8}},
                                                            {{20, 12}},
                                                            {{44, 28}}};
    const std::vector<std::array<std::size_t, 2>> space  = {{{26, 26}},
                                                            {{80, 32}},
                                                            {{0, 122}}};
    const std::array<double, 3>                   ratios = {{1.5, 2., 3.}};
    for (unsigned int k = 0; k < 3; ++k)
      {
        const auto horizon2 = horizons(mesh2, ratios[k]);
        const auto horizon3 = horizons(mesh3, ratios[k]);
        parameters.support  = GradientSupport::horizon;
        EXPECT_EQ(
          largest(consistent_families(mesh2, ones2, horizon2, parameters)),
          plane[k][0]);
        if (space[k][0] > 0)
          {
            EXPECT_EQ(
              largest(consistent_families(mesh3, ones3, horizon3, parameters)),
              space[k][0]);
          }
        parameters.support = GradientSupport::adjacent_cells;
        EXPECT_EQ(
          largest(consistent_families(mesh2, ones2, horizon2, parameters)),
          plane[k][1]);
        EXPECT_EQ(
          largest(consistent_families(mesh3, ones3, horizon3, parameters)),
          space[k][1]);
        EXPECT_EQ(
          largest(classical_families(mesh2, ones2, horizon2, parameters)),
          plane[k][1]);
      }
  }

  TEST(ConsistentFamilies, shape_tensor_of_a_lattice)
  {
    // m = 2, constant influence: K = 14 h^4 I (numerics.md, section 8), seen
    // through kappa = gamma mu tr(K^-1) / 2 = mu / (14 h^4).
    const auto       mesh = Testing::unit_mesh<2>(10);
    FamilyParameters parameters;
    parameters.constants = {isotropic<2>(7.5)};
    parameters.influence = Peridynamics::InfluenceFunction::constant;
    const auto set       = classical_families(mesh,
                                        std::vector<double>(mesh.n_nodes(), 1.),
                                        horizons(mesh, 2.),
                                        parameters);
    bool       found     = false;
    for (std::size_t p = 0; p < set.n_particles(); ++p)
      if (mesh.nodes[set.node[p]].distance(dealii::Point<2>(0.5, 0.5)) < 1e-10)
        {
          found = true;
          EXPECT_NEAR(set.stabilization[p] * 14. * 1e-4 / 3., 1., 1e-12);
        }
    EXPECT_TRUE(found);
  }

  TEST(ConsistentFamilies, materials_do_not_mix)
  {
    auto mesh = Testing::unit_mesh<2>(10, 0.2);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      mesh.cell_material[c] = mesh.cell_centroid[c][0] > 0.5 ? 1 : 0;
    FamilyParameters parameters;
    parameters.constants = {isotropic<2>(2.5), isotropic<2>(25.)};
    const auto alpha     = std::vector<double>(mesh.n_nodes(), 1.);
    const auto set =
      consistent_families(mesh, alpha, horizons(mesh, 2.), parameters);
    EXPECT_GT(set.n_particles(), mesh.n_nodes());
    for (std::size_t p = 0; p < set.n_particles(); ++p)
      for (std::size_t b = set.offsets[p]; b < set.offsets[p + 1]; ++b)
        {
          bool touches = false;
          for (const unsigned int c : mesh.node_cells.row(set.neighbor[b]))
            touches = touches || mesh.cell_material[c] == set.material[p];
          EXPECT_TRUE(touches);
        }
    const auto errors = consistency(mesh, alpha, set);
    EXPECT_LT(errors.target, 1e-13);
    EXPECT_LT(errors.affine, 1e-13);
  }
} // namespace Perimorph::Coupling
