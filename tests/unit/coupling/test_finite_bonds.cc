#include <perimorph/coupling/bond_term.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/coupling/segment_piece_term.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Coupling
{
  namespace
  {
    /// W = lambda (tr E)^2 / 2 + mu E : E with the Green-Lagrange strain E.
    template <int dim>
    class QuadraticLaw : public Materials::Material<dim>
    {
    public:
      using Tensor2 = dealii::Tensor<2, dim>;

      std::string
      name() const override
      {
        return "quadratic";
      }
      bool
      is_linear() const override
      {
        return false;
      }
      double
      energy_density(const Tensor2 &H) const override
      {
        const auto   E = strain(H);
        const double t = trace(E);
        return 0.5 * lambda * t * t + mu * E.norm_square();
      }
      Tensor2
      first_piola_kirchhoff(const Tensor2 &H) const override
      {
        Tensor2 S = 2. * mu * strain(H);
        for (int d = 0; d < dim; ++d)
          S[d][d] += lambda * trace(strain(H));
        return S + H * S;
      }
      dealii::Tensor<4, dim>
      tangent(const Tensor2 &H) const override
      {
        const Tensor2 F = H + unit();
        const Tensor2 S =
          2. * mu * strain(H) + lambda * trace(strain(H)) * unit();
        const Tensor2          left = F * transpose(F);
        dealii::Tensor<4, dim> A;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            for (int k = 0; k < dim; ++k)
              for (int l = 0; l < dim; ++l)
                A[i][j][k][l] =
                  (i == k ? S[j][l] : 0.) + lambda * F[i][j] * F[k][l] +
                  (j == l ? mu * left[i][k] : 0.) + mu * F[i][l] * F[k][j];
        return A;
      }
      double
      out_of_plane_stress(const Tensor2 &) const override
      {
        return 0.;
      }
      double
      out_of_plane_stretch(const Tensor2 &) const
      {
        return 1.;
      }
      double
      shear_modulus() const override
      {
        return mu;
      }

    private:
      static constexpr double lambda = 0.4; ///< E = 1, nu = 1/4
      static constexpr double mu     = 0.4;

      static Tensor2
      unit()
      {
        Tensor2 one;
        for (int d = 0; d < dim; ++d)
          one[d][d] = 1.;
        return one;
      }
      static Tensor2
      strain(const Tensor2 &H)
      {
        return 0.5 * (H + transpose(H) + transpose(H) * H);
      }
    };

    /// The unit square or cube with a ball of bonds.
    template <int dim>
    struct Body
    {
      Body(
        const Mesh::NodalMesh<dim>  &nodal,
        const double                 ratio,
        const Mesh::BlendingFunction blending = Mesh::BlendingFunction::cubic,
        const Scheme                 scheme   = Scheme::consistent,
        const MPI_Comm               communicator = MPI_COMM_WORLD,
        const Mesh::Mode             mode         = Mesh::Mode::coupled)
        : mesh(Testing::as_gmsh_mesh(nodal), communicator)
      {
        materials.laws.push_back(std::make_unique<QuadraticLaw<dim>>());
        materials.bond_constants.push_back(
          {1.,
           dim == 2 ? Materials::PlaneState::plane_strain
                    : Materials::PlaneState::three_dimensional});
        Mesh::RegionParameters region_parameters;
        Parameters::Feature    ball{Parameters::FeatureKind::ball, "", {}};
        ball.numbers.assign(dim, 0.5);
        ball.numbers.push_back(0.18);
        region_parameters.mode              = mode;
        region_parameters.features          = {ball};
        region_parameters.core_size         = {0., false, false};
        region_parameters.blending_width    = {0.14, false, false};
        region_parameters.blending_function = blending;
        region_parameters.horizon_ratio     = ratio;
        CouplingParameters parameters;
        parameters.model  = Model::bond_based;
        parameters.scheme = scheme;
        const auto region = make_region_map(mesh, region_parameters);
        problem           = std::make_unique<CoupledProblem<dim>>(mesh,
                                                        region,
                                                        materials,
                                                        parameters);
      }

      /// H X + amplitude * waves, the same on any number of ranks.
      Fem::Vector
      field(const dealii::Tensor<2, dim> &H,
            const double                  amplitude,
            const double                  phase = 0.) const
      {
        const auto &partition = problem->partition();
        Fem::Vector u;
        partition.initialize(u);
        for (unsigned int n = 0; n < partition.n_owned(); ++n)
          {
            const dealii::Tensor<1, dim> x(partition.position(n));
            const auto                   value = H * x;
            for (int d = 0; d < dim; ++d)
              u.local_element(dim * n + d) =
                value[d] + amplitude * std::sin(31. * x[0] + 17. * x[1] +
                                                23. * x[dim - 1] + d + phase);
          }
        u.update_ghost_values();
        return u;
      }

      Fem::Vector
      forces(const Fem::Vector &u) const
      {
        Fem::Vector result;
        problem->partition().initialize(result);
        problem->internal_forces(u, result);
        return result;
      }

      Fem::Vector
      tangent_product(const Fem::Vector &u, const Fem::Vector &v) const
      {
        Fem::Vector result;
        problem->partition().initialize(result);
        for (const auto *term : problem->terms())
          term->add_tangent_product(u, v, result);
        result.compress(dealii::VectorOperation::add);
        return result;
      }

      Mesh::DistributedMesh<dim>           mesh;
      BodyMaterials<dim>                   materials;
      std::unique_ptr<CoupledProblem<dim>> problem;
    };

    /// A rotation of about 40 degrees.
    template <int dim>
    dealii::Tensor<2, dim>
    rotation()
    {
      dealii::Tensor<2, dim> Q;
      const double           c = std::cos(0.7), s = std::sin(0.7);
      Q[0][0] = Q[1][1] = c;
      Q[0][1]           = -s;
      Q[1][0]           = s;
      if constexpr (dim == 3)
        {
          Q[2][2] = 1.;
          // Another about the first axis.
          dealii::Tensor<2, dim> R;
          R[0][0] = 1.;
          R[1][1] = R[2][2] = c;
          R[1][2]           = -s;
          R[2][1]           = s;
          Q                 = R * Q;
        }
      return Q;
    }

    template <int dim>
    dealii::Tensor<2, dim>
    minus_unit(dealii::Tensor<2, dim> F)
    {
      for (int d = 0; d < dim; ++d)
        F[d][d] -= 1.;
      return F;
    }

    /// F - I of a stretch and shear, with and without a rotation behind it.
    template <int dim>
    std::vector<dealii::Tensor<2, dim>>
    finite_gradients()
    {
      dealii::Tensor<2, dim> stretch;
      for (int d = 0; d < dim; ++d)
        stretch[d][d] = 1.;
      stretch[0][0] = 1.3;
      stretch[1][1] = 0.85;
      stretch[0][1] = 0.2;
      return {minus_unit(stretch), minus_unit(rotation<dim>() * stretch)};
    }

    /// Largest difference between forces and element forces, relative to
    /// |P| spacing^(dim - 1).
    template <int dim>
    double
    ghost_force(const Body<dim> &body)
    {
      const auto &partition = body.problem->partition();
      double      worst     = 0.;
      for (const auto &H : finite_gradients<dim>())
        {
          const auto  u      = body.field(H, 0.);
          const auto  forces = body.forces(u);
          Fem::Vector reference;
          partition.initialize(reference);
          body.problem->full_elements().add_residual(u, reference);
          reference.compress(dealii::VectorOperation::add);
          const double stress =
            body.materials.laws[0]->first_piola_kirchhoff(H).norm();
          for (unsigned int n = 0; n < partition.n_owned(); ++n)
            for (int d = 0; d < dim; ++d)
              worst = std::max(
                worst,
                std::abs(forces.local_element(dim * n + d) -
                         reference.local_element(dim * n + d)) /
                  (stress *
                   std::pow(body.mesh.nodal().spacing[partition.global(n)],
                            dim - 1)));
        }
      return dealii::Utilities::MPI::max(worst, partition.communicator());
    }

    template <int dim>
    void
    expect_derivatives(const Body<dim> &body)
    {
      const auto   H    = finite_gradients<dim>()[1];
      const double wave = 0.3 * body.mesh.nodal().spacing[0];
      const auto   u    = body.field(H, wave);
      const auto   v    = body.field({}, 1., 1.);
      const auto   w    = body.field({}, 1., 2.);

      const auto moved = [&](const double step) {
        Fem::Vector result(u);
        result.zero_out_ghost_values();
        result.add(step, v);
        result.update_ghost_values();
        return result;
      };
      const double step = 1e-5 * wave;
      const auto   plus = moved(step), minus = moved(-step);
      const auto   forces    = body.forces(u);
      const auto   product_v = body.tangent_product(u, v);
      const auto   product_w = body.tangent_product(u, w);
      if (body.problem->is_symmetric())
        {
          EXPECT_NEAR((body.problem->strain_energy(plus) -
                       body.problem->strain_energy(minus)) /
                        (2. * step) / (forces * v),
                      1.,
                      1e-7);
          EXPECT_NEAR((product_v * w - product_w * v) /
                        (product_v.l2_norm() * w.l2_norm()),
                      0.,
                      1e-13);
        }

      auto slope = body.forces(plus);
      slope -= body.forces(minus);
      slope /= 2. * step;
      slope -= product_v;
      EXPECT_LT(slope.l2_norm(), 1e-7 * product_v.l2_norm());

      // Blocks, summed up, are the same operator.
      Fem::Vector assembled;
      body.problem->partition().initialize(assembled);
      dealii::FullMatrix<double> matrix;
      std::vector<unsigned int>  nodes;
      for (const auto *term : body.problem->terms())
        for (unsigned int b = 0; b < term->n_blocks(); ++b)
          {
            term->block_nodes(b, nodes);
            term->block_tangent(b, u, matrix);
            for (unsigned int r = 0; r < matrix.m(); ++r)
              for (unsigned int c = 0; c < matrix.n(); ++c)
                assembled.begin()[dim * nodes[r / dim] + r % dim] +=
                  term->row_weight(nodes[r / dim]) * matrix(r, c) *
                  v.begin()[dim * nodes[c / dim] + c % dim];
          }
      assembled.compress(dealii::VectorOperation::add);
      assembled -= product_v;
      EXPECT_LT(assembled.l2_norm(), 1e-12 * product_v.l2_norm());
    }
  } // namespace

  TEST(FiniteBonds, patch_test_is_exact_in_the_plane)
  {
    for (const auto blending :
         {Mesh::BlendingFunction::cubic, Mesh::BlendingFunction::splice})
      for (const double ratio : {1.5, 2., 3.})
        for (const auto &mesh : {Testing::unit_mesh<2>(12),
                                 Testing::unit_mesh<2>(12, 1e-10),
                                 Testing::unit_mesh<2>(12, 0.25),
                                 Testing::unit_mesh<2>(12, 0.1, 8.)})
          EXPECT_LT(ghost_force(Body<2>(mesh, ratio, blending)), 1e-12)
            << "m = " << ratio;
  }

  TEST(FiniteBonds, patch_test_is_exact_in_space)
  {
    const auto mesh = Testing::unit_mesh<3>(6, 0.25);
    for (const double ratio : {1.5, 2.})
      EXPECT_LT(ghost_force(Body<3>(mesh, ratio)), 1e-12);
    EXPECT_LT(ghost_force(Body<3>(mesh, 1.5, Mesh::BlendingFunction::splice)),
              1e-12);
  }

  TEST(FiniteBonds, affine_fields_have_the_energy_of_elements)
  {
    const Body<2> body(Testing::unit_mesh<2>(12, 0.25), 2.);
    for (const auto &H : finite_gradients<2>())
      {
        const auto   u = body.field(H, 0.);
        const double elements =
          dealii::Utilities::MPI::sum(body.problem->full_elements().energy(u),
                                      MPI_COMM_WORLD);
        EXPECT_NEAR(body.problem->strain_energy(u) / elements, 1., 1e-12);
      }
  }

  TEST(FiniteBonds, uncorrected_coupling_has_ghost_forces)
  {
    EXPECT_GT(ghost_force(Body<2>(Testing::unit_mesh<2>(12, 0.2),
                                  2.,
                                  Mesh::BlendingFunction::cubic,
                                  Scheme::energy_blending)),
              0.01);
  }

  TEST(FiniteBonds, forces_and_tangents_are_derivatives)
  {
    for (const auto scheme :
         {Scheme::consistent, Scheme::energy_blending, Scheme::force_blending})
      expect_derivatives(Body<2>(Testing::unit_mesh<2>(10, 0.2),
                                 2.,
                                 Mesh::BlendingFunction::cubic,
                                 scheme));
    expect_derivatives(Body<3>(Testing::unit_mesh<3>(5, 0.2), 1.5));
  }

  TEST(FiniteBonds, tangent_at_rest_is_as_stiff_as_elements)
  {
    // Nothing but bonds on a bad mesh, boundary held. Without stabilisation
    // the smallest eigenvalue is negative.
    const Body<2>    body(Testing::unit_mesh<2>(14, 0.3),
                       3.,
                       Mesh::BlendingFunction::cubic,
                       Scheme::consistent,
                       MPI_COMM_SELF,
                       Mesh::Mode::peridynamics);
    const auto      &partition = body.problem->partition();
    std::vector<int> free;
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      {
        const auto &x = partition.position(n);
        if (std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5)) < 0.499)
          free.insert(free.end(), {int(2 * n), int(2 * n + 1)});
      }
    const auto rest = body.field({}, 0.);
    const auto smallest =
      [&](const std::vector<const Fem::Contribution<2> *> &terms) {
        Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * partition.n_owned(),
                                                  2 * partition.n_owned());
        dealii::FullMatrix<double> matrix;
        std::vector<unsigned int>  nodes;
        for (const auto *term : terms)
          for (unsigned int b = 0; b < term->n_blocks(); ++b)
            {
              term->block_nodes(b, nodes);
              term->block_tangent(b, rest, matrix);
              for (unsigned int r = 0; r < matrix.m(); ++r)
                for (unsigned int c = 0; c < matrix.n(); ++c)
                  K(2 * nodes[r / 2] + r % 2, 2 * nodes[c / 2] + c % 2) +=
                    matrix(r, c);
            }
        const Eigen::MatrixXd reduced = K(free, free);
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                 reduced,
                 Eigen::EigenvaluesOnly)
          .eigenvalues()[0];
      };
    const double elements = smallest({&body.problem->full_elements()});
    const double ratio    = smallest(body.problem->terms()) / elements;
    EXPECT_GT(ratio, 0.95);
    EXPECT_LT(ratio, 1.02);
  }

  TEST(FiniteBonds, forces_balance)
  {
    const Body<2> body(Testing::unit_mesh<2>(10, 0.2), 2.);
    const auto    u      = body.field(finite_gradients<2>()[0], 0.03);
    const auto    forces = body.forces(u);
    // Moments about the origin, of the deformed body.
    dealii::Tensor<1, 2> sum;
    double               moment = 0.;
    for (unsigned int n = 0; n < body.problem->partition().n_owned(); ++n)
      {
        const auto           &X = body.problem->partition().position(n);
        std::array<double, 2> x, f;
        for (int d = 0; d < 2; ++d)
          {
            f[d] = forces.local_element(2 * n + d);
            x[d] = X[d] + u.local_element(2 * n + d);
            sum[d] += f[d];
          }
        moment += x[0] * f[1] - x[1] * f[0];
      }
    const double size = forces.l2_norm();
    EXPECT_GT(size, 0.01);
    EXPECT_LT(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD).norm(),
              1e-12 * size);
    EXPECT_NEAR(dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD),
                0.,
                1e-12 * size);
  }

  TEST(FiniteBonds, rotations_are_free)
  {
    const Body<2> plane(Testing::unit_mesh<2>(10, 0.2), 2.);
    const Body<3> space(Testing::unit_mesh<3>(5, 0.2), 1.5);
    const auto    in_plane = plane.field(minus_unit(rotation<2>()), 0.);
    const auto    in_space = space.field(minus_unit(rotation<3>()), 0.);
    EXPECT_LT(plane.forces(in_plane).linfty_norm(), 1e-14);
    EXPECT_LT(space.forces(in_space).linfty_norm(), 1e-14);
    EXPECT_LT(std::abs(plane.problem->strain_energy(in_plane)), 1e-14);
    EXPECT_LT(std::abs(space.problem->strain_energy(in_space)), 1e-14);
  }

  TEST(FiniteBonds, energy_does_not_feel_a_rotation)
  {
    // A field that is not affine, before and after a rotation.
    const Body<2>        body(Testing::unit_mesh<2>(10, 0.2), 2.);
    const auto           u = body.field(finite_gradients<2>()[0], 0.03);
    const auto           Q = rotation<2>();
    Fem::Vector          rotated(u);
    dealii::Tensor<1, 2> x;
    for (unsigned int n = 0; n < body.problem->partition().n_owned(); ++n)
      {
        const auto &X = body.problem->partition().position(n);
        for (int d = 0; d < 2; ++d)
          x[d] = X[d] + u.local_element(2 * n + d);
        const auto y = Q * x;
        for (int d = 0; d < 2; ++d)
          rotated.local_element(2 * n + d) = y[d] - X[d];
      }
    rotated.update_ghost_values();
    EXPECT_NEAR(body.problem->strain_energy(rotated) /
                  body.problem->strain_energy(u),
                1.,
                1e-12);
  }

  TEST(FiniteBonds, numbers_do_not_depend_on_the_ranks)
  {
    const auto    mesh = Testing::unit_mesh<2>(10, 0.2);
    const Body<2> all(mesh, 2.);
    const Body<2> alone(mesh,
                        2.,
                        Mesh::BlendingFunction::cubic,
                        Scheme::consistent,
                        MPI_COMM_SELF);
    const auto    H       = finite_gradients<2>()[1];
    const auto    numbers = [&](const Body<2> &body) {
      const auto   u = body.field(H, 0.03), v = body.field({}, 1., 1.);
      const double energy = body.problem->strain_energy(u);
      return std::array<double, 4>{{energy,
                                    body.forces(u).l2_norm(),
                                    body.forces(u) * v,
                                    body.tangent_product(u, v).l2_norm()}};
    };
    const auto together = numbers(all), expected = numbers(alone);
    for (unsigned int k = 0; k < 4; ++k)
      EXPECT_NEAR(together[k] / expected[k], 1., 1e-12);
  }
} // namespace Perimorph::Coupling
