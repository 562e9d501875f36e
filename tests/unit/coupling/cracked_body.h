#pragma once

#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/coupling/crack_target.h>
#include <perimorph/materials/material_factory.h>

#include <gtest/gtest.h>
#include <harness/distributed_meshes.h>
#include <harness/test_meshes.h>

#include <cmath>

namespace Perimorph::Coupling::CrackTests
{
  using Point2 = dealii::Point<2>;

  inline std::vector<Bonds::CrackFacet<2>>
  polylines(const std::vector<std::vector<Point2>> &lines)
  {
    std::vector<Bonds::CrackFacet<2>> facets;
    for (unsigned int c = 0; c < lines.size(); ++c)
      for (unsigned int k = 0; k + 1 < lines[c].size(); ++k)
        facets.push_back({{{lines[c][k], lines[c][k + 1]}}, c, 0});
    return facets;
  }

  /// Edge, through, two parallel, short, T, crossing, closed.
  inline std::vector<std::vector<std::vector<Point2>>>
  crack_shapes()
  {
    return {
      {{Point2(-.1, .5), Point2(.5, .5)}},
      {{Point2(-.1, .45), Point2(1.1, .57)}},
      {{Point2(.3, .5), Point2(.7, .5)}, {Point2(.4, .6), Point2(.8, .6)}},
      {{Point2(.5, .5), Point2(.55, .5)}},
      {{Point2(.2, .5), Point2(.8, .5)}, {Point2(.5, .5), Point2(.5, .8)}},
      {{Point2(.2, .5), Point2(.8, .5)}, {Point2(.4, .2), Point2(.6, .8)}},
      {{Point2(.3, .3),
        Point2(.7, .33),
        Point2(.66, .7),
        Point2(.29, .7),
        Point2(.31, .28)}}};
  }

  /// The unit square or cube with cracks, peridynamics everywhere or around
  /// the cracks.
  template <int dim>
  struct CrackedBody
  {
    std::vector<Bonds::CrackFacet<dim>> facets;

    double             perturbation   = 0.2;
    double             horizon_ratio  = 2.;
    std::string        law            = "linear elastic";
    double             poissons_ratio = 1. / 3.;
    unsigned int       n_cells        = dim == 2 ? 24 : 8;
    bool               everywhere     = false;
    double             trace_radius   = 1.8; ///< of the target
    CouplingParameters parameters     = {};

    std::unique_ptr<Mesh::DistributedMesh<dim>> mesh      = {};
    Mesh::RegionMap                             region    = {};
    BodyMaterials<dim>                          materials = {};
    std::unique_ptr<CoupledProblem<dim>>        problem   = {};

    void
    build()
    {
      const auto state = dim == 2 ? Materials::PlaneState::plane_stress
                                  : Materials::PlaneState::three_dimensional;
      mesh             = std::make_unique<Mesh::DistributedMesh<dim>>(
        Testing::as_gmsh_mesh(Testing::unit_mesh<dim>(n_cells, perturbation)),
        MPI_COMM_WORLD);
      Mesh::RegionParameters where;
      for (const auto &facet : facets)
        {
          where.features.push_back({dim == 2
                                      ? Parameters::FeatureKind::segment
                                      : Parameters::FeatureKind::triangle,
                                    "",
                                    {}});
          for (const auto &corner : facet.corners)
            for (int d = 0; d < dim; ++d)
              where.features.back().numbers.push_back(corner[d]);
        }
      where.horizon_ratio = horizon_ratio;
      where.core_size     = {3., true, false};
      if (everywhere)
        where.mode = Mesh::Mode::peridynamics;
      region = Mesh::make_region_map(*mesh, where);
      materials.laws.push_back(
        Materials::make_material<dim>(law, 1., poissons_ratio, state));
      materials.bond_constants.push_back({1., state});
      problem = std::make_unique<CoupledProblem<dim>>(
        *mesh,
        region,
        materials,
        parameters,
        typename CoupledProblem<dim>::Progress(),
        std::vector<unsigned int>(),
        Bonds::CrackSet<dim>(facets));
    }

    /// Forces under the affine displacement of a gradient, minus those of
    /// finite elements if asked for.
    Fem::Vector
    forces(const dealii::Tensor<2, dim> &gradient,
           const bool                    minus_elements) const
    {
      const auto &partition = problem->partition();
      Fem::Vector displacement, result, elements;
      partition.initialize(displacement);
      partition.initialize(result);
      partition.initialize(elements);
      for (unsigned int n = 0; n < partition.n_owned(); ++n)
        {
          const auto u = gradient * partition.position(n);
          for (int d = 0; d < dim; ++d)
            displacement.local_element(dim * n + d) = u[d];
        }
      displacement.update_ghost_values();
      problem->internal_forces(displacement, result);
      if (minus_elements)
        {
          problem->full_elements().add_residual(displacement, elements);
          elements.compress(dealii::VectorOperation::add);
          for (unsigned int n = 0; n < dim * partition.n_owned(); ++n)
            result.local_element(n) -= elements.local_element(n);
        }
      return result;
    }

    /// Largest force that is neither the one of finite elements nor stress
    /// times the change of the target by the cracks, relative to stress
    /// times spacing^(dim - 1).
    double
    ghost(const dealii::Tensor<2, dim> &gradient) const
    {
      const auto                   &partition = problem->partition();
      const auto                    found     = forces(gradient, true);
      const Bonds::CrackSet<dim>    cracks(facets);
      const Bonds::CrackTraces<dim> traces(mesh->nodal(), cracks, trace_radius);
      auto       target = crack_target(mesh->nodal(), cracks, traces);
      const auto P      = materials.laws[0]->first_piola_kirchhoff(gradient);
      double     worst  = 0.;
      for (unsigned int n = 0; n < partition.n_owned(); ++n)
        {
          const auto change = P * target[partition.global(n)];
          for (int d = 0; d < dim; ++d)
            worst =
              std::max(worst,
                       std::abs(found.local_element(dim * n + d) - change[d]) *
                         std::pow(n_cells, dim - 1) / P.norm());
        }
      return dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD);
    }

    /// Largest force of interior nodes, relative to the same.
    double
    disturbance(const dealii::Tensor<2, dim> &gradient) const
    {
      const auto  &partition = problem->partition();
      const auto   found     = forces(gradient, false);
      const double stress =
        materials.laws[0]->first_piola_kirchhoff(gradient).norm();
      double worst = 0.;
      for (unsigned int n = 0; n < partition.n_owned(); ++n)
        {
          double to_surface = 1.;
          for (int d = 0; d < dim; ++d)
            to_surface = std::min({to_surface,
                                   partition.position(n)[d],
                                   1. - partition.position(n)[d]});
          if (to_surface > 1e-9)
            for (int d = 0; d < dim; ++d)
              worst = std::max(worst,
                               std::abs(found.local_element(dim * n + d)) *
                                 std::pow(n_cells, dim - 1) / stress);
        }
      return dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD);
    }
  };

  using CrackedPlate = CrackedBody<2>;

  inline dealii::Tensor<1, 2>
  direction(const double degrees)
  {
    const double angle = degrees * std::acos(-1.) / 180.;
    return dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)});
  }

  inline std::vector<Point2>
  segment(const Point2 &center, const double half, const double degrees)
  {
    const auto t = direction(degrees);
    return {center - half * t, center + half * t};
  }

  /// Gradient of uniaxial stress along a direction, plane stress: small
  /// strain, or principal stretches found by Newton's method and a rotation.
  inline dealii::Tensor<2, 2>
  uniaxial(const double                  degrees,
           const Materials::Material<2> &law,
           const double                  strain,
           const double                  rotation)
  {
    const auto t = direction(degrees), n = direction(degrees + 90.);
    double     lateral  = -strain / 3.;
    const auto gradient = [&]() {
      return strain * outer_product(t, t) + lateral * outer_product(n, n);
    };
    for (int k = 0; k < 30; ++k)
      {
        const auto P     = law.first_piola_kirchhoff(gradient());
        const auto A     = law.tangent(gradient());
        double     slope = 0.;
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            for (int c = 0; c < 2; ++c)
              for (int d = 0; d < 2; ++d)
                slope += n[a] * n[b] * A[a][b][c][d] * n[c] * n[d];
        lateral -= n * (P * n) / slope;
      }
    dealii::Tensor<2, 2> R, unit;
    unit[0][0] = unit[1][1] = 1.;
    R[0][0] = R[1][1] = std::cos(rotation);
    R[1][0]           = std::sin(rotation);
    R[0][1]           = -R[1][0];
    return rotation == 0. ? gradient() : R * (unit + gradient()) - unit;
  }
} // namespace Perimorph::Coupling::CrackTests
