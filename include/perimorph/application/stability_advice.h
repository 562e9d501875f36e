#pragma once

#include <perimorph/coupling/coupled_problem.h>

#include <string>
#include <utility>
#include <vector>

namespace Perimorph::Application
{
  /// Shape of the cells where peridynamics acts.
  struct CellShapes
  {
    /// Largest ratio of mean edge lengths of one cell in two of its
    /// directions [-]; 1 without peridynamics.
    double aspect = 1.;
    /// Largest ratio of the spacings of two nodes of one cell [-].
    double spacing_ratio = 1.;
  };

  template <int dim>
  CellShapes
  peridynamic_cell_shapes(const Mesh::NodalMesh<dim> &mesh,
                          const Mesh::RegionMap      &region);

  /// What is known to go wrong with such parameters on such a mesh, one
  /// warning each; the limits are those measured in doc/stability.
  /// @param poissons_ratios  smallest and largest of the body; the largest 0 in
  ///        plane stress, where nothing locks
  template <int dim>
  std::vector<std::string>
  stability_advice(const Mesh::NodalMesh<dim>         &mesh,
                   const Mesh::RegionMap              &region,
                   const Coupling::CouplingParameters &parameters,
                   const std::pair<double, double>    &poissons_ratios,
                   bool                                finite_strain);
} // namespace Perimorph::Application
