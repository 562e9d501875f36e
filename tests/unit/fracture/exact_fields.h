#pragma once

#include <perimorph/fracture/nodal_stress.h>
#include <perimorph/materials/linear_elastic.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <vector>

// What the tests of the room share: nodal values of exact fields.
namespace Perimorph
{
  namespace Testing
  {
    template <int dim>
    using VectorField =
      std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    nodal_values(const Mesh::NodalMesh<dim> &mesh,
                 const VectorField<dim>     &field)
    {
      std::vector<dealii::Tensor<1, dim>> values;
      for (const auto &node : mesh.nodes)
        values.push_back(field(node));
      return values;
    }

    /// A complete quadratic displacement, or (even = true) one that is
    /// symmetric about all planes x_d = 0.
    template <int dim>
    dealii::Tensor<1, dim>
    quadratic_field(const dealii::Point<dim> &x, const bool even)
    {
      dealii::Tensor<1, dim> u;
      for (int i = 0; i < dim; ++i)
        if (even)
          u[i] = (2. + i) * x[i];
        else
          {
            u[i] = 0.3 - 0.1 * i;
            for (int a = 0; a < dim; ++a)
              {
                u[i] += (0.2 + 0.5 * i - 0.7 * a) * x[a];
                for (int b = 0; b < dim; ++b)
                  u[i] += (0.4 - 0.3 * i + 0.2 * a + 0.1 * b) * x[a] * x[b];
              }
          }
      return u;
    }

    template <int dim>
    dealii::Tensor<2, dim>
    quadratic_gradient(const dealii::Point<dim> &x)
    {
      dealii::Tensor<2, dim> gradient;
      for (int i = 0; i < dim; ++i)
        for (int a = 0; a < dim; ++a)
          {
            gradient[i][a] = 0.2 + 0.5 * i - 0.7 * a;
            for (int b = 0; b < dim; ++b)
              gradient[i][a] += (0.8 - 0.6 * i + 0.3 * a + 0.3 * b) * x[b];
          }
      return gradient;
    }

    constexpr double kirsch_poissons_ratio = 1. / 3.;

    /// Infinite plate with a hole of radius 1, tension 1 along y, E = 1, plane
    /// stress; complex potentials of Kolosov and Muskhelishvili.
    inline dealii::Tensor<1, 2>
    kirsch_displacement(const dealii::Point<2> &p)
    {
      const std::complex<double> z(p[0], p[1]);
      const double               kappa =
        (3. - kirsch_poissons_ratio) / (1. + kirsch_poissons_ratio);
      const double mu    = 0.5 / (1. + kirsch_poissons_ratio);
      const auto   phi   = 0.25 * (z - 2. / z);
      const auto   slope = 0.25 * (1. + 2. / (z * z));
      const auto   psi   = 0.5 * (z - 1. / z - 1. / (z * z * z));
      const auto   u =
        (kappa * phi - z * std::conj(slope) - std::conj(psi)) / (2. * mu);
      dealii::Tensor<1, 2> result;
      result[0] = u.real();
      result[1] = u.imag();
      return result;
    }

    /// The mesh of numerics.md, section 6: rays at equal angles from the hole
    /// to a square of half width 4, n_around / 4 cells along each, in geometric
    /// progression. quarter: only the first quadrant.
    inline Mesh::NodalMesh<2>
    kirsch_mesh(const unsigned int n_around, const bool quarter)
    {
      const unsigned int n_radial  = n_around / 4;
      const unsigned int n_sectors = quarter ? n_around / 4 : n_around;
      const unsigned int n_rays    = quarter ? n_sectors + 1 : n_sectors;

      Mesh::NodalMesh<2> mesh;
      for (unsigned int i = 0; i < n_rays; ++i)
        for (unsigned int k = 0; k <= n_radial; ++k)
          {
            const double angle  = 2. * std::acos(-1.) * i / n_around;
            const double x      = std::cos(angle);
            const double y      = std::sin(angle);
            const double length = 4. / std::max(std::abs(x), std::abs(y)) - 1.;
            const double radius =
              1. + length * (std::pow(4., double(k) / n_radial) - 1.) / 3.;
            mesh.nodes.emplace_back(radius * x, radius * y);
          }
      for (unsigned int i = 0; i < n_sectors; ++i)
        for (unsigned int k = 0; k < n_radial; ++k)
          {
            const unsigned int a = i * (n_radial + 1) + k;
            const unsigned int b = (i + 1) % n_rays * (n_radial + 1) + k;
            mesh.cells.push_back({{a, a + 1, b, b + 1}});
          }
      mesh.cell_material.assign(mesh.n_cells(), 0);
      mesh.cell_owner.assign(mesh.n_cells(), 0);
      mesh.owned_end = mesh.n_nodes();
      mesh.compute_derived();
      return mesh;
    }

    /// Nodes at a distance from the origin.
    template <int dim>
    std::vector<unsigned int>
    nodes_at_radius(const Mesh::NodalMesh<dim> &mesh, const double radius)
    {
      std::vector<unsigned int> nodes;
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        if (std::abs(mesh.nodes[n].norm() - radius) < 1e-9)
          nodes.push_back(n);
      return nodes;
    }

    /// Planes x_d = 0.
    template <int dim>
    std::vector<Fracture::MirrorPlane<dim>>
    coordinate_planes()
    {
      std::vector<Fracture::MirrorPlane<dim>> planes(dim);
      for (int d = 0; d < dim; ++d)
        planes[d].normal[d] = 1.;
      return planes;
    }

    /// One linear elastic material with E = 1.
    template <int dim>
    Fracture::MaterialList<dim>
    unit_material(const double                poissons_ratio,
                  const Materials::PlaneState state)
    {
      Fracture::MaterialList<dim> materials;
      materials.push_back(
        std::make_unique<Materials::LinearElastic<dim>>(1.,
                                                        poissons_ratio,
                                                        state));
      return materials;
    }
  } // namespace Testing
} // namespace Perimorph
