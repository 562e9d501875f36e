#pragma once

#include <perimorph/fem/boundary_conditions.h>
#include <perimorph/fem/contribution.h>
#include <perimorph/mesh/distributed_mesh.h>

namespace Perimorph::Fem
{
  /// Pressure against the outward normal of the deformed surface:
  /// force = - integral of p n da N. One block per face of this rank. It has no
  /// energy in general, and its tangent is not symmetric.
  template <int dim>
  class FollowerPressure : public Contribution<dim>
  {
  public:
    /// @param loads  those that do not follow are left out
    FollowerPressure(const Mesh::DistributedMesh<dim>    &mesh,
                     const NodePartition<dim>            &partition,
                     const std::vector<SurfaceLoad<dim>> &loads);

    /// The pressures are those of this time from now on.
    void
    set_time(double time);

    /// True on every rank if any rank has a face.
    bool
    acts() const
    {
      return acts_somewhere;
    }

    std::string
    name() const override;
    bool
    is_linear() const override;
    bool
    is_symmetric() const override;
    double
    energy(const Vector &displacement) const override;
    void
    add_residual(const Vector &displacement, Vector &residual) const override;
    void
    add_tangent_product(const Vector &displacement,
                        const Vector &direction,
                        Vector       &product) const override;
    unsigned int
    n_blocks() const override;
    void
    block_nodes(unsigned int               block,
                std::vector<unsigned int> &nodes) const override;
    void
    block_tangent(unsigned int                block,
                  const Vector               &displacement,
                  dealii::FullMatrix<double> &matrix) const override;

  private:
    static constexpr unsigned int n_nodes = 1u << (dim - 1);

    struct Face
    {
      std::array<unsigned int, n_nodes> nodes; ///< local nodes
      double                            side;  ///< of the normal: 1 or -1
      unsigned int                      load;
    };

    std::array<dealii::Tensor<1, dim>, n_nodes>
    deformed_positions(const Face &face, const double *displacement) const;
    /// Pressure times weight of a quadrature point; the sign turns the area
    /// vector outward.
    double
    pressure_weight(const Face &face, unsigned int q) const;

    std::vector<Parameters::Expression> pressures;
    const NodePartition<dim>           &partition;
    std::vector<Face>                   faces;
    double                              time           = 0.;
    bool                                acts_somewhere = false;
  };
} // namespace Perimorph::Fem
