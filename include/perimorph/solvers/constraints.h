#pragma once

#include <perimorph/fem/supports.h>
#include <perimorph/solvers/tangent.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/affine_constraints.h>

#include <Eigen/Dense>

#include <vector>

namespace Perimorph::Solvers
{
  /// The supports as constraints on increments: a prescribed value has a zero
  /// line, the mean of a boundary makes one of its unknowns depend on the
  /// others, a rigid plate makes all of its unknowns depend on as many as the
  /// plate has free motions, a hanging node follows its parents. Lines are
  /// homogeneous; what the prescribed values change is the particular
  /// increment. Plates turn by finite rotations, so their lines follow the
  /// motion (masters stay).
  template <int dim>
  class Constraints
  {
  public:
    /// @param hanging  nodes of the whole mesh
    /// @param small_rotations  keep plates at the tangent of the reference
    /// state
    Constraints(const Fem::NodePartition<dim> &partition,
                const Fem::Supports<dim>      &supports,
                const Mesh::HangingPoints     &hanging,
                bool                           small_rotations);

    const dealii::AffineConstraints<double> &
    lines() const
    {
      return affine;
    }

    /// Some unknowns depend on others because of supports.
    bool
    couple_unknowns() const
    {
      return !rows.empty() || !plates.empty();
    }

    /// Lines change with the motion.
    bool
    are_linear() const
    {
      return small_rotations || plates.empty();
    }

    /// Norm of a force over all supported unknowns (reactions).
    double
    support_norm(const Vector &force) const;

    /// Hands forces on hanging nodes to their parents; on return owned entries
    /// are complete.
    void
    condense_hanging(Vector &force) const;

    /// Gives hanging nodes the mean displacement of their parents.
    void
    set_hanging(Vector &displacement) const;

    /// Adds the entries of dependent unknowns to those they depend on, sets
    /// them to zero; on return owned entries are complete.
    void
    condense(Vector &force) const;

    /// Sets dependent unknowns of an increment.
    void
    distribute(Vector &increment) const;

    /// Increment that brings all supports to their values at a time while the
    /// free unknowns rest; owned entries.
    /// @return  false if it is zero
    bool
    particular(double        time,
               const Vector &displacement,
               Vector       &increment) const;

    /// displacement += step * increment, plates exactly rigid.
    void
    move(double step, const Vector &increment, Vector &displacement);

    /// Motion of the plates, to come back to.
    struct State
    {
      std::vector<dealii::Tensor<1, dim>> translation;
      std::vector<dealii::Tensor<2, dim>> rotation;
      std::vector<double>                 angle;
    };
    State
    state() const;
    void
    restore(const State &state);

    /// Adds the part of the tangent that stems from the curved motion of plates
    /// under the forces on them.
    /// @param force  external minus internal force, not condensed, ghosts up to
    ///               date
    template <typename AnyMatrix>
    void
    add_geometric_stiffness(const Vector &force, AnyMatrix &matrix) const;

  private:
    static constexpr unsigned int n_motions = dim * (dim + 1) / 2;

    /// A dependent unknown of a mean constraint.
    struct Row
    {
      unsigned int                                 dependent;
      std::vector<std::pair<unsigned int, double>> entries;
      std::vector<double> of_means; ///< its change by the mean that is missing
    };

    struct Plate
    {
      const Fem::RigidPlate<dim> *support;
      dealii::Tensor<1, dim>      translation;
      dealii::Tensor<2, dim>      rotation;
      double                      angle = 0.; ///< 2D
      /// Translations along the axes, then rotations.
      std::vector<unsigned int> free_motions;
      std::vector<unsigned int> masters; ///< as many unknowns
      /// Free motions by the increments of the masters.
      Eigen::MatrixXd free_of_masters;
      /// Unknowns that tell all motions apart, and the motions by them.
      std::vector<unsigned int> markers;
      Eigen::MatrixXd           motions_of_markers;
    };

    void
    reduce_means();
    void
    add_plate(const Fem::RigidPlate<dim> &support);
    void
    linearize(Plate &plate) const;
    void
    make_lines();
    /// Velocity of the unknowns in the motions of a plate.
    Eigen::MatrixXd
    velocities(const Plate                     &plate,
               const std::vector<unsigned int> &dofs,
               const std::vector<unsigned int> &motions) const;
    /// Motions of a plate in a displacement or increment, on every rank.
    Eigen::VectorXd
    motions(const Plate &plate, const Vector &vector) const;
    dealii::Tensor<1, dim>
    arm(const Plate &plate, unsigned int node) const;
    unsigned int
    local(unsigned int dof) const
    {
      return dim * partition.local(dof / dim) + dof % dim;
    }

    const Fem::NodePartition<dim>    &partition;
    const Fem::Supports<dim>         &supports;
    const Mesh::HangingPoints        &hanging;
    bool                              small_rotations;
    std::vector<Row>                  rows;
    std::vector<Plate>                plates;
    dealii::AffineConstraints<double> affine;
    std::vector<unsigned int>         owned_prescribed; ///< unknowns
    std::vector<unsigned int>         owned_supported;  ///< local entries
  };
} // namespace Perimorph::Solvers
