#pragma once

#include <perimorph/output/vtu_writer.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Perimorph::Mesh
{
  template <int dim>
  struct NodalMesh;
}

namespace Perimorph::Output
{
  /// Named arrays of one step, one entry per node, cell or particle. Values
  /// are copied.
  template <int dim>
  class Fields
  {
  public:
    void
    add(const std::string &name, const std::vector<double> &values);

    /// One array of three components (zero z in 2D): a vector in ParaView.
    void
    add(const std::string                         &name,
        const std::vector<dealii::Tensor<1, dim>> &values);

    /// One scalar array per component: name_xx, name_yy, name_zz, name_xy,
    /// name_xz, name_yz; in 2D those without z.
    void
    add(const std::string                                  &name,
        const std::vector<dealii::SymmetricTensor<2, dim>> &values);

    /// A vector field given like unknowns: component c of entry n is value
    /// dim * n + c.
    void
    add_vector(const std::string &name, const std::vector<double> &values);

    const std::vector<VtuArray> &
    arrays() const;

  private:
    std::vector<VtuArray> list;
  };

  /// Time series for ParaView in one folder: solution.pvd with the mesh,
  /// particles.pvd with the peridynamic particles as points.
  ///
  /// The mesh and all arrays are known completely to every rank, so rank 0
  /// writes one file per step and other ranks return at once.
  template <int dim>
  class FieldOutput
  {
  public:
    /// @param folder   exists already
    /// @param mesh     must outlive this object
    FieldOutput(const std::string &folder, const Mesh::NodalMesh<dim> &mesh);

    /// True on the rank that writes; others need not gather fields.
    bool
    is_active() const;

    /// Writes solution_<step>.vtu, with material and rank of each cell.
    /// @param nodal_fields   one entry per node
    /// @param cell_fields    one entry per cell
    /// @throws Base::InputError   the file cannot be written
    void
    write(const unsigned int step,
          const double       time,
          const Fields<dim> &nodal_fields,
          const Fields<dim> &cell_fields = Fields<dim>());

    /// Writes particles_<step>.vtu: one point per entry of @p nodes.
    /// @param fields   one entry per entry of @p nodes
    /// @throws Base::InputError   the file cannot be written
    void
    write_particles(const unsigned int               step,
                    const double                     time,
                    const std::vector<unsigned int> &nodes,
                    const Fields<dim>               &fields);

    /// Writes cracks_<step>.vtu: segments or triangles.
    /// @param corners  dim points of each
    /// @param fields   one entry per piece
    /// @throws Base::InputError   the file cannot be written
    void
    write_cracks(
      const unsigned int                                      step,
      const double                                            time,
      const std::vector<std::array<dealii::Point<dim>, dim>> &corners,
      const Fields<dim>                                      &fields);

    /// Time and file of each step of a series.
    using Steps = std::vector<std::pair<double, std::string>>;

    /// What has been written, by names of series.
    std::map<std::string, Steps>
    series() const;

    /// Goes on behind the steps of an earlier run; its list is written anew.
    /// @throws Base::InputError   the file cannot be written
    void
    restore(const std::map<std::string, Steps> &earlier);

    /// The series written so far, e.g. {"solution.pvd"}; names in the folder.
    std::vector<std::string>
    files() const;

  private:
    struct Series
    {
      const std::string name;
      Steps             steps;
    };

    void
    write_step(Series            &series,
               const unsigned int step,
               const double       time,
               const VtuGrid     &grid);

    const std::string           folder;
    const Mesh::NodalMesh<dim> &mesh;
    Series                      solution  = {"solution", {}};
    Series                      particles = {"particles", {}};
    Series                      cracks    = {"cracks", {}};
  };
} // namespace Perimorph::Output
