#pragma once

#include <perimorph/fem/supports.h>

#include <string>
#include <vector>

namespace Perimorph::Fem
{
  /// Antisymmetric generators of the rotations: one in 2D, three in 3D.
  template <int dim>
  const std::vector<dealii::Tensor<2, dim>> &
  rotation_generators();

  /// One rigid motion that the supports leave free: a field over the nodes of
  /// one piece of the body.
  template <int dim>
  struct FreeMotion
  {
    unsigned int           piece;
    dealii::Tensor<1, dim> translation;
    /// Rotation rate times (x - centre): antisymmetric.
    dealii::Tensor<2, dim> rotation;
    dealii::Point<dim>     center;

    dealii::Tensor<1, dim>
    at(const dealii::Point<dim> &point) const
    {
      return translation + rotation * (point - center);
    }

    /// "translation along (1, 0)" or "rotation".
    std::string
    description() const;
  };

  /// Rigid motions of each piece that no support prevents; orthonormal in the
  /// mean over the nodes of their piece, with rotations scaled by its size.
  /// @param pieces  the piece of each node, from 0
  template <int dim>
  std::vector<FreeMotion<dim>>
  free_motions(const Mesh::NodalMesh<dim>      &mesh,
               const std::vector<unsigned int> &pieces,
               const Supports<dim>             &supports);

  /// The same for the pieces of the mesh.
  template <int dim>
  std::vector<FreeMotion<dim>>
  free_motions(const Mesh::DistributedMesh<dim> &mesh,
               const Supports<dim>              &supports)
  {
    return free_motions(mesh.nodal(), mesh.pieces(), supports);
  }

  /// Degrees of freedom that, held at zero, just prevent the free motions; the
  /// choice does not depend on the number of ranks.
  template <int dim>
  std::vector<unsigned int>
  pins_against(const Mesh::DistributedMesh<dim>   &mesh,
               const std::vector<FreeMotion<dim>> &motions);
} // namespace Perimorph::Fem
