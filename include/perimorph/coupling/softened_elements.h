#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/fem/elastic_cells.h>

namespace Perimorph::Coupling
{
  /// Elements everywhere, but nearly without stiffness where a crack or a
  /// broken bond cuts them: what a preconditioner needs, since intact elements
  /// would close the crack (numerics.md, D5).
  /// @param all_cells  elements of full weight, in the order of the owned cells
  /// @param alpha      blending at the nodes: cracks cut where it is not zero
  /// @return           all_cells if none is cut on this rank
  template <int dim>
  std::shared_ptr<Fem::ElasticCells<dim>>
  softened_elements(const Mesh::NodalMesh<dim>                    &mesh,
                    const std::vector<double>                     &alpha,
                    const Bonds::CrackSet<dim>                    &cracks,
                    const Bonds::BrokenBonds                      &broken,
                    const std::shared_ptr<Fem::ElasticCells<dim>> &all_cells);
} // namespace Perimorph::Coupling
