#pragma once

#include <perimorph/mesh/region_map.h>

#include <vector>

namespace Perimorph::Mesh
{
  /// Where cells of the mesh of the user are too large.
  struct RefinementParameters
  {
    double spacing = 0.; ///< wanted [length]; 0: the mesh stays as it is
    /// Places beside those of the peridynamic region.
    std::vector<Parameters::Feature> features;
    /// How far it reaches beyond the places and the peridynamic region.
    Parameters::Length distance = {1., true, false};
    double grading     = 0.2; ///< growth of the spacing with the distance
    bool   find_curves = true;
    /// Solves whose errors halve cells further, while the relative error is
    /// larger than the tolerance; each the cells of a fraction of the error.
    unsigned int error_cycles    = 0;
    double       error_tolerance = 0.;
    double       error_fraction  = 0.5;
  };

  /// Cells whose mean edge is longer than wanted: the target spacing in the
  /// peridynamic region (or where it would be, in finite elements) and within
  /// the distance of it and of other places, more by the grading beyond; in
  /// pure peridynamics the target in the whole body. Halved as they are, they
  /// may leave others.
  /// @throws Base::InputError  no place, names not in the mesh
  template <int dim>
  std::vector<unsigned int>
  too_large_cells(const DistributedMesh<dim> &mesh,
                  const RegionParameters     &region,
                  const RefinementParameters &refinement);

  /// Cells beside hanging nodes that families could have: such nodes are for
  /// pure finite elements.
  template <int dim>
  std::vector<unsigned int>
  cells_that_disturb_families(const NodalMesh<dim> &mesh,
                              const RegionMap      &region);
} // namespace Perimorph::Mesh
