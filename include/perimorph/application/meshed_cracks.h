#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/nodal_mesh.h>
#include <perimorph/parameters/polylines.h>

#include <vector>

namespace Perimorph::Application
{
  /// Pre-cracks of a run with finite elements alone: each lies on a slit of the
  /// mesh, which is open already; the facets only say where. Ends at the
  /// surface of the body go on for a tenth of the spacing.
  /// @throws Base::InputError  a crack outside of the body, where the nodes are
  ///         not double, whose sides share a node other than a tip, or that
  ///         ends before its slit does (2D)
  template <int dim>
  Bonds::CrackSet<dim>
  make_meshed_cracks(const Mesh::NodalMesh<dim>              &mesh,
                     const std::vector<Parameters::Polyline> &lines);
} // namespace Perimorph::Application
