#include "stability_specimen.h"

#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/base/timing.h>
#include <perimorph/fem/face_geometry.h>
#include <perimorph/materials/material_factory.h>
#include <perimorph/peridynamics/bond_based.h>
#include <perimorph/solvers/equilibrium.h>

#include <harness/distributed_meshes.h>
#include <harness/expressions.h>
#include <harness/test_meshes.h>

#include <cmath>
#include <sstream>

namespace Perimorph::Studies
{
  namespace
  {
    template <int dim>
    constexpr Materials::PlaneState state =
      dim == 2 ? Materials::PlaneState::plane_strain
               : Materials::PlaneState::three_dimensional;

    using Testing::expression;

    /// The checks of the reader and of the parameters that a mesh and a
    /// material made here do not pass through.
    template <int dim>
    void
    check_input(const Mesh::NodalMesh<dim> &mesh,
                const double                poissons_ratio,
                const bool                  bonds)
    {
      unsigned int n_bad = 0;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (!(Mesh::smallest_relative_jacobian<dim>(mesh.corners(c)) > 1e-6))
          ++n_bad;
      if (n_bad > 0)
        throw Base::InputError(std::to_string(n_bad) +
                               " inverted or non-convex cells");
      const double allowed = Peridynamics::allowed_poissons_ratio(state<dim>);
      if (bonds && std::abs(poissons_ratio - allowed) > 1e-3)
        throw Base::InputError("bonds allow no other Poisson's ratio than 1/4");
    }

    Eigen::MatrixXd
    reduced(const Eigen::MatrixXd           &matrix,
            const std::vector<unsigned int> &unknowns)
    {
      Eigen::MatrixXd result(unknowns.size(), unknowns.size());
      for (unsigned int r = 0; r < unknowns.size(); ++r)
        for (unsigned int c = 0; c < unknowns.size(); ++c)
          result(r, c) = matrix(unknowns[r], unknowns[c]);
      return result;
    }

    /// Lowest squared frequency and its mode, for a lumped mass.
    std::pair<double, Eigen::VectorXd>
    softest_mode(const Eigen::MatrixXd &stiffness, const Eigen::VectorXd &mass)
    {
      const Eigen::VectorXd scale = mass.cwiseSqrt().cwiseInverse();
      const Eigen::MatrixXd scaled =
        scale.asDiagonal() * stiffness * scale.asDiagonal();
      const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
      if (factor.info() != Eigen::Success)
        {
          const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
          return {solver.eigenvalues()[0],
                  scale.cwiseProduct(solver.eigenvectors().col(0))};
        }
      // inverse iteration; the start contains every mode
      Eigen::VectorXd mode = Eigen::VectorXd::LinSpaced(mass.size(), 1., 2.);
      for (Eigen::Index k = 0; k < mode.size(); k += 3)
        mode[k] *= -0.7;
      double value = 0.;
      for (unsigned int iteration = 0; iteration < 200; ++iteration)
        {
          mode                = factor.solve(mode).normalized();
          const double before = value;
          value               = mode.dot(scaled * mode);
          if (std::abs(value - before) < 1e-9 * value)
            break;
        }
      return {value, scale.cwiseProduct(mode)};
    }
  } // namespace

  std::string
  method_name(const Method method)
  {
    switch (method)
      {
        case Method::finite_elements:
          return "finite elements";
        case Method::correspondence:
          return "correspondence";
        case Method::correspondence_coupled:
          return "correspondence coupled";
        case Method::bond_based:
          return "bond based";
        case Method::bond_based_coupled:
          return "bond based coupled";
      }
    return "";
  }

  bool
  is_bond_based(const Method method)
  {
    return method == Method::bond_based || method == Method::bond_based_coupled;
  }

  template <int dim>
  Specimen<dim>::Specimen(const Combination &combination,
                          const Method       method,
                          const Shape        shape,
                          const Law          law)
    : combination(combination)
    , finite_strain(law == Law::finite_strain)
    , method(method)
    , shape(shape)
  {
    make_mesh();
    check_input(mesh(), combination.poissons_ratio, is_bond_based(method));
    make_region();
    materials.laws.push_back(Materials::make_material<dim>(
      law == Law::small_strain ? "linear elastic"
      : is_bond_based(method)  ? "prototype microelastic"
                               : "hencky",
      1.,
      combination.poissons_ratio,
      state<dim>));
    materials.bond_constants.push_back({1., state<dim>});
    parameters.model     = is_bond_based(method) ? Coupling::Model::bond_based
                                                 : Coupling::Model::correspondence;
    parameters.influence = combination.influence;
    parameters.gamma     = combination.gamma;
    problem = std::make_unique<Coupling::CoupledProblem<dim>>(*distributed_mesh,
                                                              region,
                                                              materials,
                                                              parameters);
  }

  template <int dim>
  void
  Specimen<dim>::make_mesh()
  {
    std::array<unsigned int, dim> n_cells;
    dealii::Point<dim>            upper;
    if (shape == Shape::block)
      {
        n_cells.fill(dim == 2 ? 12 : 4);
        for (int d = 0; d < dim; ++d)
          upper[d] = d == 0 ? 1. : 1. / combination.aspect;
      }
    else
      {
        const unsigned int layers = dim == 2 ? 6 : 4;
        const double       length = dim == 2 ? 4. : 3.;
        n_cells.fill(layers);
        n_cells[0] = std::lround(length * layers / combination.aspect);
        for (int d = 0; d < dim; ++d)
          upper[d] = d == 0 ? length : 1.;
      }
    size             = upper;
    distributed_mesh = std::make_unique<Mesh::DistributedMesh<dim>>(
      Testing::as_gmsh_mesh(
        Testing::structured_mesh<dim>(n_cells,
                                      dealii::Point<dim>(),
                                      upper,
                                      combination.perturbation,
                                      combination.grading)),
      MPI_COMM_WORLD);
  }

  template <int dim>
  void
  Specimen<dim>::make_region()
  {
    // The shape of the ball follows the body, so that a flat body has as many
    // particles as a square one.
    constexpr double core = 0.18, band = 0.2;
    const auto      &nodal = mesh();
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      {
        double square = 0.;
        for (int d = 0; d < dim; ++d)
          square += std::pow(nodal.nodes[n][d] / size[d] - 0.5, 2);
        double alpha = 0.;
        if (method == Method::correspondence || method == Method::bond_based)
          alpha = 1.;
        else if (method != Method::finite_elements)
          alpha = Mesh::blending_weight(Mesh::BlendingFunction::cubic,
                                        (std::sqrt(square) - core) / band);
        region.alpha.push_back(alpha);
        region.horizon.push_back(combination.horizon_ratio * nodal.spacing[n]);
        ++(alpha == 1.  ? region.n_core
           : alpha > 0. ? region.n_blending
                        : region.n_elements);
      }
  }

  template <int dim>
  Application::CellShapes
  Specimen<dim>::cell_shapes() const
  {
    return Application::peridynamic_cell_shapes(mesh(), region);
  }

  template <int dim>
  std::vector<std::string>
  Specimen<dim>::warnings() const
  {
    return Application::stability_advice(
      mesh(),
      region,
      parameters,
      {combination.poissons_ratio, combination.poissons_ratio},
      finite_strain);
  }

  template <int dim>
  double
  Specimen<dim>::ghost_force() const
  {
    return problem->ghost_force([](unsigned int) { return false; });
  }

  template <int dim>
  Eigen::MatrixXd
  Specimen<dim>::tangent(const Fem::Vector &displacement) const
  {
    const unsigned int n_unknowns = dim * mesh().n_nodes();
    Eigen::MatrixXd    result = Eigen::MatrixXd::Zero(n_unknowns, n_unknowns);
    dealii::FullMatrix<double> block;
    std::vector<unsigned int>  nodes;
    for (const auto *term : problem->terms())
      for (unsigned int b = 0; b < term->n_blocks(); ++b)
        {
          term->block_nodes(b, nodes);
          term->block_tangent(b, displacement, block);
          for (unsigned int r = 0; r < block.m(); ++r)
            for (unsigned int c = 0; c < block.n(); ++c)
              result(dim * nodes[r / dim] + r % dim,
                     dim * nodes[c / dim] + c % dim) += block(r, c);
        }
    return result;
  }

  template <int dim>
  Eigen::MatrixXd
  Specimen<dim>::stiffness() const
  {
    Fem::Vector rest;
    problem->partition().initialize(rest);
    return tangent(rest);
  }

  template <int dim>
  std::vector<unsigned int>
  Specimen<dim>::free_unknowns() const
  {
    std::vector<unsigned int> result;
    for (unsigned int n = 0; n < mesh().n_nodes(); ++n)
      if (mesh().nodes[n][0] > 1e-10)
        for (int d = 0; d < dim; ++d)
          result.push_back(dim * n + d);
    return result;
  }

  template <int dim>
  double
  Specimen<dim>::bending_ratio() const
  {
    // Curvature 1 about z: u = (-x y, (x^2 + a (y^2 - z^2)) / 2, a y z) with
    // a = nu in 3D (stress -E y); in plane strain a = nu / (1 - nu) and no
    // z (stress -E y / (1 - nu^2)).
    const double nu    = combination.poissons_ratio;
    const double a     = dim == 2 ? nu / (1. - nu) : nu;
    const double E     = dim == 2 ? 1. / (1. - nu * nu) : 1.;
    const auto   exact = [&](const dealii::Point<dim> &p) {
      const double           x = p[0], y = p[1] - 0.5;
      const double           z = dim == 2 ? 0. : p[dim - 1] - 0.5;
      dealii::Tensor<1, dim> u;
      if (dim == 3)
        u[dim - 1] = a * y * z;
      u[0] = -x * y;
      u[1] = 0.5 * (x * x + a * (y * y - z * z));
      return u;
    };

    const auto     &nodal = mesh();
    Eigen::VectorXd force = Eigen::VectorXd::Zero(dim * nodal.n_nodes());
    for (const unsigned int f : distributed_mesh->boundary("x+", "study"))
      {
        const auto                  &face = nodal.boundary_faces[f];
        const Fem::FaceGeometry<dim> geometry(nodal, face);
        for (unsigned int q = 0; q < geometry.n_points; ++q)
          for (unsigned int v = 0; v < geometry.n_nodes; ++v)
            force[dim * face.nodes[v]] -= E * (geometry.points[q][1] - 0.5) *
                                          geometry.normal_jxw[q][0] *
                                          geometry.shape[q][v];
      }

    const Eigen::MatrixXd K   = stiffness();
    Eigen::VectorXd       u   = Eigen::VectorXd::Zero(force.size());
    unsigned int          tip = 0;
    dealii::Point<dim>    middle;
    for (int d = 0; d < dim; ++d)
      middle[d] = d == 0 ? size[0] : 0.5;
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      {
        if (nodal.nodes[n][0] <= 1e-10)
          for (int d = 0; d < dim; ++d)
            u[dim * n + d] = exact(nodal.nodes[n])[d];
        if (nodal.nodes[n].distance(middle) < nodal.nodes[tip].distance(middle))
          tip = n;
      }
    const auto            unknowns = free_unknowns();
    const Eigen::VectorXd rest     = force - K * u;
    Eigen::VectorXd       rhs(unknowns.size());
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      rhs[k] = rest[unknowns[k]];
    const Eigen::MatrixXd             matrix = reduced(K, unknowns);
    const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
    const Eigen::VectorXd             solution =
      factor.info() == Eigen::Success
                    ? Eigen::VectorXd(factor.solve(rhs))
                    : Eigen::VectorXd(matrix.partialPivLu().solve(rhs));
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      if (unknowns[k] == dim * tip + 1)
        return solution[k] / exact(nodal.nodes[tip])[1];
    return 0.;
  }

  template <int dim>
  typename Specimen<dim>::NewtonOutcome
  Specimen<dim>::move_top(const double       stretch,
                          const unsigned int n_steps) const
  {
    Fem::BoundaryConditions<dim> conditions;
    std::ostringstream           top;
    top << stretch * size[1] << "*t";
    for (const std::string boundary : {"y-", "y+"})
      {
        Fem::DisplacementCondition<dim> condition;
        condition.boundary = boundary;
        for (int d = 0; d < dim; ++d)
          condition.components[d] =
            expression(boundary == "y+" && d == 1 ? top.str() : "0");
        conditions.displacement.push_back(condition);
      }
    const Fem::Supports<dim> supports(*distributed_mesh, conditions, {1.});
    const Fem::Loads<dim>    loads(*distributed_mesh, conditions, {1.});
    std::ostringstream       console;
    Base::Log                log(MPI_COMM_WORLD, console);
    Base::Timing             timing;
    Solvers::EquilibriumParameters parameters;
    parameters.linear_solver = Solvers::LinearSolverKind::direct;
    Solvers::Equilibrium<dim> equilibrium(*distributed_mesh,
                                          *problem,
                                          supports,
                                          loads,
                                          parameters,
                                          log,
                                          timing);

    NewtonOutcome outcome;
    Fem::Vector   displacement;
    problem->partition().initialize(displacement);
    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        const auto record =
          equilibrium.solve(double(step) / n_steps,
                            displacement,
                            [](const Solvers::NewtonIteration &) {});
        outcome.iterations += record.n_iterations();
        if (!record.converged)
          {
            outcome.failure =
              record.reason.substr(0, record.reason.find(" at the point"));
            return outcome;
          }
      }
    displacement.update_ghost_values();
    std::vector<unsigned int> unknowns;
    for (unsigned int k = 0; k < dim * mesh().n_nodes(); ++k)
      if (!supports.hold(k))
        unknowns.push_back(k);
    outcome.stable =
      Eigen::LLT<Eigen::MatrixXd>(reduced(tangent(displacement), unknowns))
        .info() == Eigen::Success;
    return outcome;
  }

  template <int dim>
  double
  Specimen<dim>::roughness(const Eigen::VectorXd           &field,
                           const std::vector<unsigned int> &unknowns) const
  {
    const auto     &nodal = mesh();
    Eigen::VectorXd full  = Eigen::VectorXd::Zero(dim * nodal.n_nodes());
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      full[unknowns[k]] = field[k];
    double difference = 0., total = 0.;
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      for (int d = 0; d < dim; ++d)
        {
          double       sum      = 0.;
          unsigned int n_values = 0;
          for (const unsigned int c : nodal.node_cells.row(n))
            for (const unsigned int neighbor : nodal.cells[c])
              {
                sum += full[dim * neighbor + d];
                ++n_values;
              }
          const double value = full[dim * n + d];
          difference += nodal.volume[n] * std::pow(value - sum / n_values, 2);
          total += nodal.volume[n] * value * value;
        }
    return std::sqrt(difference / total);
  }

  namespace
  {
    /// Lumped mass of the unknowns, density 1.
    template <int dim>
    Eigen::VectorXd
    lumped_mass(const Mesh::NodalMesh<dim>      &mesh,
                const std::vector<unsigned int> &unknowns)
    {
      Eigen::VectorXd mass(unknowns.size());
      for (unsigned int k = 0; k < unknowns.size(); ++k)
        mass[k] = mesh.volume[unknowns[k] / dim];
      return mass;
    }
  } // namespace

  template <int dim>
  Reference
  finite_element_reference(const Combination &combination)
  {
    const auto make = [&](const Shape shape) {
      return Specimen<dim>(combination,
                           Method::finite_elements,
                           shape,
                           Law::small_strain);
    };
    const auto block    = make(Shape::block);
    const auto unknowns = block.free_unknowns();
    Reference  result;
    result.stiffness = reduced(block.stiffness(), unknowns);
    const auto mode =
      softest_mode(result.stiffness, lumped_mass(block.mesh(), unknowns));
    result.frequency = mode.first;
    result.rough     = block.roughness(mode.second, unknowns);
    result.bending   = make(Shape::beam).bending_ratio();
    return result;
  }

  template <int dim>
  Spectrum
  spectrum(const Specimen<dim> &specimen, const Reference &elements)
  {
    const auto            unknowns = specimen.free_unknowns();
    const Eigen::MatrixXd K        = reduced(specimen.stiffness(), unknowns);
    const auto mode = softest_mode(K, lumped_mass(specimen.mesh(), unknowns));
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      K,
      elements.stiffness,
      Eigen::EigenvaluesOnly);
    Spectrum result;
    result.softest = mode.first / elements.frequency;
    result.rough   = specimen.roughness(mode.second, unknowns);
    result.worst   = solver.eigenvalues().minCoeff();
    result.largest = solver.eigenvalues().maxCoeff();
    return result;
  }

  template class Specimen<2>;
  template class Specimen<3>;
  template Reference
  finite_element_reference<2>(const Combination &);
  template Reference
  finite_element_reference<3>(const Combination &);
  template Spectrum
  spectrum(const Specimen<2> &, const Reference &);
  template Spectrum
  spectrum(const Specimen<3> &, const Reference &);
} // namespace Perimorph::Studies
