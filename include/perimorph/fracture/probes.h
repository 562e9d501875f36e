#pragma once

#include <perimorph/fracture/nodal_stress.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Fracture
{
  /// Values at a list of points, by named columns.
  struct ProbeTable
  {
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows; ///< one per point

    /// Values of one column; the name must exist (see probe_columns()).
    std::vector<double>
    column(const std::string &name) const;
  };

  /// x, y[, z], ux, ..., sxx, ..., stt, mises, principal_max. szz is in 2D the
  /// stress out of the plane, stt the hoop stress about the center given.
  template <int dim>
  const std::vector<std::string> &
  probe_columns();

  /// Equally spaced points, both ends included (one point: the start).
  template <int dim>
  std::vector<dealii::Point<dim>>
  line_points(const dealii::Point<dim> &from,
              const dealii::Point<dim> &to,
              unsigned int              n_points);

  /// Points of an arc, angles in degrees from the x axis, both ends included;
  /// in 3D in the plane z = center z.
  template <int dim>
  std::vector<dealii::Point<dim>>
  circle_points(const dealii::Point<dim> &center,
                double                    radius,
                double                    from_degrees,
                double                    to_degrees,
                unsigned int              n_points);

  /// Displacement and recovered stress at any point of the body. The answers
  /// are the same on every rank; nothing is communicated.
  template <int dim>
  class PointProbe
  {
  public:
    /// Where a point lies.
    struct Location
    {
      unsigned int       cell;
      dealii::Point<dim> unit_point; ///< outside [0,1]^dim: extrapolation
    };

    /// @param recovery  kept as a reference, its mesh as well
    explicit PointProbe(const NodalStress<dim> &recovery);
    ~PointProbe();

    /// The cell around a point (the lowest number of several). A point outside
    /// by at most 0.2 of the local spacing, say on a curved boundary beside the
    /// straight edges of the mesh, gets the nearest cell.
    /// @throws Base::InputError  further outside; names the nearest node
    Location
    locate(const dealii::Point<dim> &point) const;

    /// Finite-element interpolation (extrapolation just outside).
    dealii::Tensor<1, dim>
    displacement_at(
      const dealii::Point<dim>                  &point,
      const std::vector<dealii::Tensor<1, dim>> &displacement) const;

    /// Recovered on the side of the cell around the point, with nodes of its
    /// material.
    Stress<dim>
    stress_at(const dealii::Point<dim>                  &point,
              const std::vector<dealii::Tensor<1, dim>> &displacement) const;

    /// All columns of probe_columns().
    /// @param center  axis of the hoop stress
    ProbeTable
    evaluate(const std::vector<dealii::Point<dim>>     &points,
             const std::vector<dealii::Tensor<1, dim>> &displacement,
             const dealii::Point<dim>                  &center = {}) const;

  private:
    /// Bounding boxes of the cells in a tree.
    struct CellSearch;

    const NodalStress<dim>     &recovery;
    std::unique_ptr<CellSearch> search;

    /// The nearest node of the mesh if it is on the cell, else that of the
    /// cell.
    unsigned int
    nearest_node_of(unsigned int cell, const dealii::Point<dim> &point) const;
  };

  /// Writes <folder>/probe_<name>.csv with 12 digits; rank 0 only.
  /// @throws Base::InputError  on rank 0: the file cannot be written
  void
  write_probe(const ProbeTable  &table,
              const std::string &folder,
              const std::string &name,
              MPI_Comm           communicator);
} // namespace Perimorph::Fracture
