#pragma once

#include <perimorph/coupling/bond_set.h>
#include <perimorph/fem/contribution.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/peridynamics/virial_stress.h>

namespace Perimorph::Coupling
{
  enum class Kinematics
  {
    small_strain, ///< k (e . eta)^2 / 2 per bond
    finite_strain ///< k (|xi + eta| - |xi|)^2 / 2 per bond
  };

  /// Who can say what its bonds pull with.
  template <int dim>
  class BondForces
  {
  public:
    virtual ~BondForces() = default;

    /// All bonds of this rank.
    virtual std::vector<Peridynamics::PairForce<dim>>
    pair_forces(const Fem::Vector             &displacement,
                const Fem::NodePartition<dim> &partition) const = 0;
  };

  /// Energy of the bonds of this rank. One block per node that owns bonds.
  template <int dim, Kinematics kinematics = Kinematics::small_strain>
  class BondTerm : public Fem::Contribution<dim>, public BondForces<dim>
  {
  public:
    using Vector = Fem::Vector;

    BondTerm(const BondSet &bonds, const Fem::NodePartition<dim> &partition);

    /// Global nodes of all bonds of this rank, in their order here.
    std::vector<std::array<unsigned int, 2>>
    pairs(const Fem::NodePartition<dim> &partition) const;

    /// Leaves a bond this part of its stiffness.
    void
    soften(const std::size_t bond, const double factor)
    {
      stiffness[bond] *= factor;
    }

    std::string
    name() const override;
    bool
    is_linear() const override;
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
    bool
    has_stars() const override
    {
      return true;
    }
    void
    block_tangent(unsigned int                block,
                  const Vector               &displacement,
                  dealii::FullMatrix<double> &matrix) const override;
    std::vector<Peridynamics::PairForce<dim>>
    pair_forces(const Vector                  &displacement,
                const Fem::NodePartition<dim> &partition) const override;

  private:
    struct Star
    {
      unsigned int node;
      std::size_t  begin, end; ///< bonds to other nodes
    };

    std::vector<Star>                   stars;
    std::vector<unsigned int>           neighbor;
    std::vector<double>                 stiffness;
    std::vector<dealii::Tensor<1, dim>> xi;
  };

  template <int dim>
  using FiniteBondTerm = BondTerm<dim, Kinematics::finite_strain>;

  /// What the elements give up to the bonds that run through them:
  /// E = - 1/2 sum over cells and points of jxw strain : C_q : strain
  /// (numerics-explicit.md, section 3).
  template <int dim>
  class SegmentTerm : public Fem::Contribution<dim>
  {
  public:
    using Vector = Fem::Vector;

    SegmentTerm(const Mesh::NodalMesh<dim>    &mesh,
                const Fem::NodePartition<dim> &partition,
                const BondCoupling<dim>       &coupling);

    /// Leaves out cells, by their numbers in the mesh.
    void
    remove(const std::vector<bool> &goes);

    std::string
    name() const override;
    bool
    is_linear() const override;
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
    bool
    has_cells() const override
    {
      return true;
    }
    unsigned int
    block_cell(const unsigned int block) const override
    {
      return cells[block];
    }
    void
    block_tangent(unsigned int                block,
                  const Vector               &displacement,
                  dealii::FullMatrix<double> &matrix) const override;

  private:
    static constexpr unsigned int n_nodes = 1u << dim;
    using PointTensors = typename SegmentResidual<dim>::PointTensors;

    Mesh::CellGeometry<dim>
    geometry(unsigned int block) const;

    dealii::SymmetricTensor<2, dim>
    strain(unsigned int                   block,
           const Mesh::CellGeometry<dim> &geometry,
           unsigned int                   q,
           const double                  *vector) const;

    const Fem::NodePartition<dim>                 &partition;
    std::vector<unsigned int>                      cells; ///< of the mesh
    std::vector<std::array<unsigned int, n_nodes>> nodes;
    std::vector<PointTensors>                      tensors;
  };

  /// Nodes a rank needs for its bonds.
  void
  add_bond_nodes(const BondSet &bonds, std::vector<unsigned int> &needed);
} // namespace Perimorph::Coupling
