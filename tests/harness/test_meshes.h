#pragma once

#include <perimorph/mesh/nodal_mesh.h>

#include <array>

namespace Perimorph
{
  namespace Testing
  {
    /// Box of quadrilaterals or hexahedra on one rank, compute_derived()
    /// called.
    ///
    /// Boundary ids 0, ..., 2 dim - 1 are x-, x+, y-, y+, z-, z+.
    /// @param n_cells     cells along each axis
    /// @param distortion  every interior node moves by up to distortion times
    /// its
    ///                    cell size along each axis (fixed seed; 0.2 is usual)
    /// @param grading     last over first cell size along each axis (geometric)
    template <int dim>
    Mesh::NodalMesh<dim>
    structured_mesh(const std::array<unsigned int, dim> &n_cells,
                    const dealii::Point<dim>            &lower,
                    const dealii::Point<dim>            &upper,
                    double                               distortion = 0.,
                    double                               grading    = 1.);

    /// The same with n_cells along every axis of the unit square or cube.
    template <int dim>
    Mesh::NodalMesh<dim>
    unit_mesh(unsigned int n_cells,
              double       distortion = 0.,
              double       grading    = 1.);

    /// Full ring around the origin (in 3D a pipe along z from 0 to height), on
    /// one rank. Boundary ids: 0 hole, 1 outside, 2 z-, 3 z+.
    template <int dim>
    Mesh::NodalMesh<dim>
    annulus_mesh(unsigned int n_around,
                 unsigned int n_radial,
                 double       inner_radius,
                 double       outer_radius,
                 unsigned int n_height = 1,
                 double       height   = 1.);
  } // namespace Testing
} // namespace Perimorph
