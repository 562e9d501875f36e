#pragma once

#include <perimorph/fracture/displacement_fit.h>
#include <perimorph/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>
#include <vector>

namespace Perimorph::Fracture
{
  /// Materials by the index that NodalMesh::cell_material holds.
  template <int dim>
  using MaterialList = std::vector<std::unique_ptr<Materials::Material<dim>>>;

  /// Stress at a point, in the units of Young's modulus: Cauchy stress at
  /// finite strain.
  template <int dim>
  struct Stress
  {
    dealii::SymmetricTensor<2, dim> in_plane; ///< in 3D the whole tensor
    double                          out_of_plane = 0.; ///< szz of a 2D model

    /// The other measures of finite strain (zero at small strain).
    dealii::Tensor<2, 3>          first_piola_kirchhoff;
    dealii::SymmetricTensor<2, 3> kirchhoff;
    dealii::SymmetricTensor<2, 3> logarithmic_strain; ///< 1/2 ln(F F^T) [-]
  };

  /// The three principal stresses, largest first (one of them is the stress out
  /// of the plane in 2D).
  template <int dim>
  std::array<double, 3>
  principal_stresses(const Stress<dim> &stress);

  template <int dim>
  double
  von_mises_stress(const Stress<dim> &stress);

  /// Stress along the circle through the point about an axis in z direction
  /// through the center; on the axis itself the stress along y.
  template <int dim>
  double
  hoop_stress(const Stress<dim>        &stress,
              const dealii::Point<dim> &point,
              const dealii::Point<dim> &center);

  /// Stress of a displacement gradient; not a number where the law has no
  /// answer.
  template <int dim>
  Stress<dim>
  stress_of_gradient(const Materials::Material<dim> &material,
                     const dealii::Tensor<2, dim>   &gradient);

  /// Stress from the fitted displacement: accurate up to free surfaces.
  template <int dim>
  class NodalStress
  {
  public:
    /// Both are kept as references.
    NodalStress(const DisplacementFit<dim> &fit,
                const MaterialList<dim>    &materials);

    /// At a node between materials: each fitted on its own side, mean by the
    /// number of cells.
    Stress<dim>
    at_node(unsigned int                               node,
            const std::vector<dealii::Tensor<1, dim>> &displacement) const;

    std::vector<Stress<dim>>
    at_nodes(const std::vector<unsigned int>           &nodes,
             const std::vector<dealii::Tensor<1, dim>> &displacement) const;

    /// @param material  index of the material the point lies in
    /// @param seed      a node of the cell the point lies in; default: the
    ///                  nearest node
    Stress<dim>
    at_point(const dealii::Point<dim>                  &point,
             unsigned int                               material,
             const std::vector<dealii::Tensor<1, dim>> &displacement,
             unsigned int seed = DisplacementFit<dim>::nearest) const;

    const DisplacementFit<dim> &
    fit() const
    {
      return displacement_fit;
    }

  private:
    const DisplacementFit<dim> &displacement_fit;
    const MaterialList<dim>    &materials;
    /// Fits need not ask which material a node touches.
    bool single_material;

    Stress<dim>
    fitted(const dealii::Point<dim>                  &point,
           double                                     length,
           unsigned int                               material,
           unsigned int                               seed,
           const std::vector<dealii::Tensor<1, dim>> &displacement) const;
  };

  /// Stress at nodes without a fit, as a cross check: element stresses averaged
  /// with the shape function, 1 / V_i int N_i stress. First order at surfaces
  /// (numerics.md, section 6, "Kt nodal").
  template <int dim>
  std::vector<Stress<dim>>
  average_element_stress(
    const Mesh::NodalMesh<dim>                &mesh,
    const MaterialList<dim>                   &materials,
    const std::vector<unsigned int>           &nodes,
    const std::vector<dealii::Tensor<1, dim>> &displacement);
} // namespace Perimorph::Fracture
