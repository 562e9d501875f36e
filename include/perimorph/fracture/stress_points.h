#pragma once

#include <perimorph/bonds/crack_set.h>
#include <perimorph/fracture/displacement_fit.h>
#include <perimorph/fracture/nodal_stress.h>
#include <perimorph/peridynamics/family_set.h>

#include <memory>
#include <vector>

namespace Perimorph::Fracture
{
  /// A piece of the body with constant state, wherever it comes from: a Gauss
  /// point of a cell or a particle.
  template <int dim>
  struct StressPoint
  {
    dealii::Point<dim>     x;
    double                 volume; ///< share of the strain energy included
    dealii::Tensor<2, dim> displacement_gradient; ///< [i][j] = du_i / dX_j
    dealii::Tensor<2, dim> first_piola_kirchhoff;
    double                 energy_density;
    double                 q; ///< weight of a domain integral
    dealii::Tensor<1, dim> q_gradient;
    double                 branch = 1.; ///< branch_sign()
  };

  /// A piece of the body with the divergence of its stress (force_points.h).
  template <int dim>
  struct ForcePoint
  {
    dealii::Point<dim> x;
    /// Of whom the mass is: past the crack from here fields are continued.
    dealii::Point<dim>                  owner;
    double                              volume;
    double                              width; ///< of the square around x
    dealii::Tensor<1, dim>              stress_divergence; ///< of DeformedBody
    dealii::Tensor<2, dim>              displacement_gradient;
    typename Mesh::NodalMesh<dim>::Cell nodes;
    std::array<double, Mesh::NodalMesh<dim>::nodes_per_cell> weights;
    double                                                   q = 0.;
    double branch = 1.; ///< branch_sign() of the owner
  };

  /// A piece of a face of a crack.
  template <int dim>
  struct FacePoint
  {
    dealii::Point<dim>     x;      ///< a hair's breadth inside of the body
    double                 length; ///< area in 3D
    dealii::Tensor<1, dim> normal; ///< outwards
    dealii::Tensor<2, dim> displacement_gradient;
    dealii::Tensor<2, dim> first_piola_kirchhoff;
    double                 energy_density = 0.;
    double                 q              = 0.;
    double                 branch         = 1.;
  };

  /// Stress points of a rank, and how each takes values and gradients.
  template <int dim>
  struct StressPointSet
  {
    std::vector<StressPoint<dim>> points;
    /// Only where a crack bends within the domain: add_face_points().
    std::vector<FacePoint<dim>> face_points;
    /// Only where the stress has a divergence: add_force_points().
    std::vector<ForcePoint<dim>> force_points;

    std::vector<std::size_t>            offsets = {0};   ///< per point
    std::vector<unsigned int>           node;            ///< global
    std::vector<double>                 value_weight;    ///< [-]
    std::vector<dealii::Tensor<1, dim>> gradient_weight; ///< [1 / length]

    /// Points where no gradient could be found (fewer than dim + 1 nodes on
    /// their side of the cracks) or that the law has no answer for: left out.
    unsigned int n_without_stress = 0;

    /// Sets q and q_gradient of all points.
    /// @param q  one value per node of the mesh
    void
    set_weight(const std::vector<double> &q);
  };

  /// What a stress field is made of.
  template <int dim>
  struct DeformedBody
  {
    const Mesh::NodalMesh<dim>                &mesh;
    const MaterialList<dim>                   &materials;
    const std::vector<dealii::Tensor<1, dim>> &displacement; ///< all nodes
    /// Of all nodes, for domain integrals [force / volume]; empty: none.
    std::vector<dealii::Tensor<1, dim>> body_force = {};
    /// Of all nodes; empty: at rest.
    std::vector<dealii::Tensor<1, dim>> acceleration = {};
    std::vector<double>                 density      = {}; ///< of each law

    /// div P of a node in a cell: density of the cell times acceleration less
    /// the body force.
    dealii::Tensor<1, dim>
    stress_divergence(const unsigned int cell, const unsigned int node) const
    {
      dealii::Tensor<1, dim> divergence;
      if (!body_force.empty())
        divergence -= body_force[node];
      if (!acceleration.empty())
        divergence += density[mesh.cell_material[cell]] * acceleration[node];
      return divergence;
    }
  };

  /// Nodes closer to one of the centers than the radius. Cells and particles
  /// that no such node belongs to are left out of a set.
  template <int dim>
  std::vector<bool>
  nodes_within(const Mesh::NodalMesh<dim>            &mesh,
               const std::vector<dealii::Point<dim>> &centers,
               double                                 radius);

  /// Adds the Gauss points of the cells of this rank, with volume times
  /// (1 - alpha).
  /// @param alpha  blending weight per node, 1 = peridynamics
  template <int dim>
  void
  add_element_points(const DeformedBody<dim>   &body,
                     const std::vector<double> &alpha,
                     const std::vector<bool>   &region,
                     StressPointSet<dim>       &set);

  /// Adds the particles of this rank with volume a_i; the gradient is the sum
  /// (u_j - u_i) (x) g_ij, and that of q is taken by the same operator, so that
  /// the sum over all points is the change of energy of the discrete model
  /// under the shift q of its material.
  template <int dim>
  void
  add_family_points(const DeformedBody<dim>            &body,
                    const Bonds::CrackSet<dim>         &cracks,
                    const Peridynamics::FamilySet<dim> &families,
                    const std::vector<bool>            &region,
                    StressPointSet<dim>                &set);

  /// Adds points in all cells of this rank with the full law, whoever carries
  /// the energy: the finite-element gradient at the Gauss points of cells that
  /// no crack touches; in the others the gradient of a one-sided fit, in 2D at
  /// 4 points along each axis. For bond-based peridynamics, whose bonds have no
  /// stress point, and as a check of the families.
  /// @param fit  see visible_fit()
  template <int dim>
  void
  add_cell_points(const DeformedBody<dim>    &body,
                  const Bonds::CrackSet<dim> &cracks,
                  const DisplacementFit<dim> &fit,
                  const std::vector<bool>    &region,
                  StressPointSet<dim>        &set);

  /// A fit that uses the nodes only that a point sees past the cracks.
  /// @param mesh, cracks  kept as references
  /// @param meshed        the cracks lie on slits of the mesh (crack_slits.h)
  template <int dim>
  std::unique_ptr<DisplacementFit<dim>>
  visible_fit(const Mesh::NodalMesh<dim>   &mesh,
              const Bonds::CrackSet<dim>   &cracks,
              std::vector<MirrorPlane<dim>> planes = {},
              bool                          meshed = false);
} // namespace Perimorph::Fracture
