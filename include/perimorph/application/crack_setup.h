#pragma once

#include <perimorph/bonds/crack_points.h>
#include <perimorph/mesh/distributed_mesh.h>
#include <perimorph/mesh/region_map.h>
#include <perimorph/parameters/polylines.h>

namespace Perimorph::Application
{
  template <int dim>
  std::vector<dealii::Point<dim>>
  points_of_line(const Parameters::Polyline &line);

  /// The pieces of a line in 2D, a fan of triangles and the triangles of a
  /// group in 3D.
  /// @param points  those of the line, or where its ends have been moved
  template <int dim>
  std::vector<Bonds::CrackFacet<dim>>
  facets_of_line(const Parameters::Polyline            &line,
                 const std::vector<dealii::Point<dim>> &points,
                 unsigned int                           crack);

  /// Facets of pre-cracks that cut bonds.
  /// Open ends of lines that lie on the surface of the body (within a
  /// thousandth of the spacing) go on for a tenth of the spacing, so that they
  /// open it; at re-entrant corners and holes, where bonds pass outside of the
  /// body, for one and a half horizons.
  /// @throws Base::InputError  a crack that is nowhere in the body, or that
  ///         starts at a corner as the continuation of a side
  template <int dim>
  Bonds::CrackSet<dim>
  make_cracks(const Mesh::NodalMesh<dim>              &mesh,
              const std::vector<Parameters::Polyline> &lines,
              double                                   horizon_ratio);

  /// What peridynamics is placed around for the cracks.
  template <int dim>
  std::vector<Parameters::Feature>
  crack_features(const Bonds::CrackSet<dim> &cracks);

  /// Part of the body of each node, from 0 on: nodes of a cell are of one part
  /// unless a crack passes between them.
  template <int dim>
  std::vector<unsigned int>
  parts_of_body(const Mesh::NodalMesh<dim> &mesh,
                const Bonds::CrackSet<dim> &cracks);

  /// Number of parts that are more than debris (5 % of the nodes).
  /// @param marked  nodes whose parts count whatever their size; or empty
  unsigned int
  count_large_parts(const std::vector<unsigned int> &parts,
                    const std::vector<bool>         &marked = {});

  /// A face of the surface that a crack opens.
  struct CrackMouth
  {
    unsigned int face;  ///< index into NodalMesh::boundary_faces
    unsigned int facet; ///< of the cracks
  };

  template <int dim>
  std::vector<CrackMouth>
  find_mouths(const Mesh::NodalMesh<dim> &mesh,
              const Bonds::CrackSet<dim> &cracks);

  /// Cracks must run where peridynamics carries all.
  /// @param names  of the cracks
  /// @throws Base::InputError  a crack that leaves the peridynamic core
  template <int dim>
  void
  check_cracks_in_core(const Mesh::NodalMesh<dim>     &mesh,
                       const Mesh::RegionMap          &region,
                       const Bonds::CrackSet<dim>     &cracks,
                       const std::vector<std::string> &names);

  /// Nodes whose bonds never break: those in volumes, boxes and balls, and
  /// those within one horizon of all other features.
  /// @throws Base::InputError  a boundary or volume that is not in the mesh
  template <int dim>
  std::vector<bool>
  protected_nodes(const Mesh::DistributedMesh<dim>       &mesh,
                  const Mesh::RegionMap                  &region,
                  const std::vector<Parameters::Feature> &features);
} // namespace Perimorph::Application
