#pragma once

#include <perimorph/coupling/cell_parts.h>
#include <perimorph/coupling/crack_target.h>
#include <perimorph/coupling/segment_residual.h>

#include <map>

namespace Perimorph::Coupling
{
  /// Stiffness of the elements next to cracks in the bond-based model at small
  /// strain. Within two horizons of the cracks elements, and the parts of
  /// touched cells, have what the material has more than the bonds of the nodes
  /// around; tensors dC, the shortest ones that do, make the force of every
  /// linear field that of a body with free crack surfaces
  /// (numerics-cracks.md, B1 to B3). The tensors of SegmentResidual would pass
  /// too, but they are rougher: with wide families, dC on top of them makes
  /// some stiffness matrices indefinite.
  ///
  /// The same on every rank, if every rank adds the same bonds.
  template <int dim>
  class CutResidual
  {
  public:
    static constexpr unsigned int n_points = 1u << dim;

    using Tensor4      = FullySymmetricTensor<dim>;
    using PointTensors = std::array<Tensor4, n_points>;

    /// All references must outlive the object.
    /// @param stiffness  C_0 of each material
    CutResidual(const Mesh::NodalMesh<dim> &mesh,
                const std::vector<double>  &horizon,
                const Bonds::CrackSet<dim> &cracks,
                const CellParts<dim>       &parts,
                const std::vector<Tensor4> &stiffness,
                double                      trace_radius_factor);

    /// Cells with other tensors than those of SegmentResidual, touched or not,
    /// in rising order. All bonds that run through them or end at their nodes
    /// must be added.
    const std::vector<unsigned int> &
    cells() const
    {
      return all_cells;
    }

    /// Like SegmentResidual::add_bond(); pieces in other cells do not count.
    /// @param nodes  its ends
    void
    add_bond(const std::array<unsigned int, 2>           &nodes,
             const dealii::Tensor<1, dim>                &direction,
             double                                       stiffness,
             double                                       length,
             const std::vector<Bonds::SegmentPiece<dim>> &pieces);

    void
    solve();

    /// Stiffness of CellParts::parts() [stress].
    const std::vector<Tensor4> &
    part_tensors() const
    {
      return tensors;
    }

    /// What the points of cells() that are not touched must subtract from C_0
    /// [stress].
    const std::map<unsigned int, PointTensors> &
    cell_tensors() const
    {
      return subtracted;
    }

    /// Largest violation of the condition on the forces, relative to the
    /// stiffness and the spacing to the power dim - 1.
    double
    residual() const
    {
      return largest_residual;
    }

    /// Nodes whose target the cracks change, in rising order.
    std::vector<unsigned int>
    target_nodes() const
    {
      return changed_nodes;
    }

  private:
    /// Fully symmetric tensor of rank 3, the force of linear fields. Component
    /// abc has the number of the component 0abc of rank 4.
    static constexpr unsigned int n3 = dim == 2 ? 4 : 10;
    static constexpr unsigned int n4 = Tensor4::n_components;

    using Force = std::array<double, n3>;

    /// Adds factor C . gradient to the force missing at a node.
    void
    add_missing(unsigned int                  node,
                double                        factor,
                const Tensor4                &C,
                const dealii::Tensor<1, dim> &gradient);

    /// The change of the target by the cracks.
    void
    add_target(const Bonds::CrackTraces<dim> &traces);

    void
    find_cells(const std::vector<double> &horizon);

    /// Starts tensors with what bonds of the nodes have, notes what forces
    /// are missing then.
    void
    start();

    const Mesh::NodalMesh<dim> &mesh;
    const Bonds::CrackSet<dim> &cracks;
    const CellParts<dim>       &parts;
    const std::vector<Tensor4> &stiffness;

    std::vector<unsigned int>            all_cells;
    std::vector<bool>                    has_cell;
    std::vector<Tensor4>                 tensors;
    std::map<unsigned int, PointTensors> subtracted;
    std::map<unsigned int, Tensor4>      of_node; ///< half of its bonds / V
    std::map<unsigned int, Force>        missing; ///< per node
    std::vector<unsigned int>            changed_nodes;
    double                               largest_residual = 0.;
  };

  /// lambda = mu: delta_ab delta_cd + delta_ac delta_bd + delta_ad delta_bc
  /// times mu.
  template <int dim>
  FullySymmetricTensor<dim>
  isotropic_tensor(double shear_modulus);
} // namespace Perimorph::Coupling
