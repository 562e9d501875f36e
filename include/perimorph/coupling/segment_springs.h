#pragma once

#include <perimorph/coupling/segment_residual.h>

#include <array>
#include <vector>

namespace Perimorph::Coupling
{
  /// The part of a bond inside one cell as a spring between its two ends, whose
  /// displacements are those of the element.
  template <int dim>
  struct CellSpring
  {
    /// Shape functions 1, 2, ... at the end minus those at the beginning;
    /// function 0 makes their sum zero.
    std::array<double, (1u << dim) - 1> jump;
    /// Stiffness times length: k |xi|, and the share of the cell where a bond
    /// runs along a face [force].
    double tension;
  };

  /// The springs in one cell and what keeps them from softening the modes that
  /// have no mean gradient.
  template <int dim>
  struct CellSprings
  {
    static constexpr unsigned int n_nodes = 1u << dim;

    unsigned int                 cell;
    std::vector<CellSpring<dim>> springs;
    /// G of the energy 1/2 sum G_lm u_l . u_m [force / length]; G u = 0 for
    /// every affine field.
    std::array<std::array<double, n_nodes>, n_nodes> stabilization;
  };

  /// Finite-strain counterpart of SegmentResidual: what the elements must give
  /// up is a bond of its own in every cell that a bond runs through. Under any
  /// affine deformation such a spring has the force of its bond, so that bonds
  /// minus springs have none, on any mesh and for any law of the elements.
  ///
  /// A spring feels the shape functions at its place, a Gauss point does not:
  /// alone, springs near corners would subtract more than the element has. The
  /// stabilisation returns the difference to the tensors C_q of SegmentResidual
  /// in the modes without mean gradient, averaged over the directions of the
  /// displacement: constant, and blind to any affine deformation.
  template <int dim>
  class SegmentSprings
  {
  public:
    /// Takes pieces in owned cells only. The mesh must outlive the object.
    explicit SegmentSprings(const Mesh::NodalMesh<dim> &mesh);

    /// @param stiffness  pair stiffness k [force / length]
    /// @param length     |xi|
    void
    add_bond(double                                       stiffness,
             double                                       length,
             const std::vector<Bonds::SegmentPiece<dim>> &pieces);

    /// Computes the stabilisation and hands the cells over.
    /// @param residual  of the same bonds, solved
    std::vector<CellSprings<dim>>
    finish(const SegmentResidual<dim> &residual);

  private:
    const Mesh::NodalMesh<dim>   &mesh;
    std::vector<unsigned int>     position_of_cell; ///< in cells
    std::vector<CellSprings<dim>> cells;
  };
} // namespace Perimorph::Coupling
