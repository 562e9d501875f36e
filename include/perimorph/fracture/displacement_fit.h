#pragma once

#include <perimorph/fracture/mirrored_nodes.h>
#include <perimorph/mesh/nodal_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>
#include <vector>

namespace Perimorph::Fracture
{
  /// The fitted polynomial at the point asked for.
  template <int dim>
  struct FitResult
  {
    dealii::Tensor<1, dim> displacement;
    dealii::Tensor<2, dim> gradient; ///< [i][j] = du_i / dX_j
    /// Nodes used, mirrored ones included. 0: not even a linear polynomial is
    /// determined (fewer than dim + 1 visible nodes); all values are zero
    /// then.
    unsigned int n_nodes   = 0;
    bool         quadratic = false; ///< false: linear polynomial
  };

  /// Displacement and its gradient at any point of the body by weighted least
  /// squares with a complete quadratic polynomial (6 terms in 2D, 10 in 3D)
  /// over the nodes within a radius, weight exp(-sharpness (r / radius)^2).
  /// Second order up to free surfaces (numerics.md, D6).
  ///
  /// Of the connectivity of the mesh only this matters: the nodes used are
  /// those reached from one of them, the seed, over cells without leaving the
  /// radius. Nothing is mixed across a gap, a notch or a meshed slit, unless
  /// its end lies within the radius.
  ///
  /// Nodes near planes of symmetry also count as mirrored copies, products of
  /// several planes included; a copy is reached if its original is.
  ///
  /// Fits share work arrays: not for several threads at once.
  template <int dim>
  class DisplacementFit
  {
  public:
    /// True if the node may be used for a fit at the point (no crack
    /// between).
    using VisibilityTest =
      std::function<bool(const dealii::Point<dim> &point, unsigned int node)>;

    static constexpr int          any_material = -1;
    static constexpr unsigned int nearest      = static_cast<unsigned int>(-1);
    static constexpr unsigned int n_terms      = (dim + 1) * (dim + 2) / 2;

    /// @param mesh           kept as a reference
    /// @param radius_factor  radius of the fit over the local spacing h
    /// @param sharpness      0 is a constant weight; the default is
    ///                       the one that reproduces the fitted K_t of the
    ///                       Kirsch plate in numerics.md, section 6
    explicit DisplacementFit(const Mesh::NodalMesh<dim>   &mesh,
                             std::vector<MirrorPlane<dim>> planes        = {},
                             double                        radius_factor = 2.6,
                             double                        sharpness     = 5.5);
    ~DisplacementFit();

    /// Restricts later fits; a mirrored copy is asked for as its original. An
    /// empty function takes the restriction away.
    /// @param view_points  of all nodes; a point on a slit is on the side of
    ///                     that of its seed. Empty: there are no slits
    void
    set_visibility(VisibilityTest                  visible,
                   std::vector<dealii::Point<dim>> view_points = {});

    unsigned int
    nearest_node(const dealii::Point<dim> &point) const;

    /// Spacing of the mesh at a point: that of the nearest node.
    double
    length_at(const dealii::Point<dim> &point) const;

    /// @param length        h; all nodes within radius_factor h are used, and
    ///                      1.1 times as far, repeatedly, while they are too
    ///                      few or lie badly
    /// @param material      only nodes on cells of this material, so that the
    ///                      kink at an interface stays sharp; or any_material
    /// @param displacement  one vector per node of the mesh
    /// @param seed          node on the side of the point, on a cell of the
    ///                      material; nearest: the nearest such node that is
    ///                      visible (of two in one place the lower number)
    FitResult<dim>
    fit(const dealii::Point<dim>                  &point,
        double                                     length,
        int                                        material,
        const std::vector<dealii::Tensor<1, dim>> &displacement,
        unsigned int                               seed = nearest) const;

    const Mesh::NodalMesh<dim> &
    mesh() const
    {
      return nodal_mesh;
    }

  private:
    const Mesh::NodalMesh<dim>         &nodal_mesh;
    const double                        radius_factor;
    const double                        sharpness;
    std::unique_ptr<MirroredNodes<dim>> cloud;
    VisibilityTest                      visible;
    std::vector<dealii::Point<dim>>     view_points;

    enum class NodeState : unsigned char
    {
      outside, ///< between two searches: all nodes
      within,  ///< the radius, itself or a copy
      reached
    };
    mutable std::vector<NodeState>    states; ///< of all nodes
    mutable std::vector<unsigned int> within; ///< points in the radius
    mutable std::vector<unsigned int> found;  ///< those of them to be used
    mutable std::vector<unsigned int> front;  ///< nodes reached, in turn

    /// Fills found with the points within the radius that are reached from
    /// the seed and visible.
    void
    find_nodes(const dealii::Point<dim> &point,
               double                    radius,
               int                       material,
               unsigned int              seed) const;

    /// Of the points in the list within, the nearest node on the material that
    /// is visible.
    unsigned int
    nearest_within(const dealii::Point<dim> &point, int material) const;

    template <int n_columns>
    bool
    try_fit(const dealii::Point<dim>                  &point,
            double                                     length,
            double                                     radius,
            int                                        material,
            unsigned int                               seed,
            const std::vector<dealii::Tensor<1, dim>> &displacement,
            FitResult<dim>                            &result) const;

    bool
    touches_material(unsigned int node, int material) const;
  };
} // namespace Perimorph::Fracture
