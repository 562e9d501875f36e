#pragma once

#include <perimorph/fem/elastic_cells.h>
#include <perimorph/peridynamics/correspondence.h>
#include <perimorph/peridynamics/family_set.h>

namespace Perimorph::Coupling
{
  /// Energy of the correspondence families of this rank:
  /// E = sum_i a_i [ W(F_i) + stabilisation ]. One block per particle; the
  /// product with the tangent is applied in factored form, through the gradient
  /// of each particle, so that no matrix is needed.
  template <int dim>
  class CorrespondenceTerm : public Fem::Contribution<dim>
  {
  public:
    using Vector       = Fem::Vector;
    using MaterialList = typename Fem::ElasticCells<dim>::MaterialList;

    /// @param families  with global nodes; kept and renumbered to local nodes
    CorrespondenceTerm(Peridynamics::FamilySet<dim>   families,
                       const Fem::NodePartition<dim> &partition,
                       const MaterialList            &materials);

    /// The families of this rank with global nodes.
    Peridynamics::FamilySet<dim>
    global_families(const Fem::NodePartition<dim> &partition) const;

    /// Gives a particle what is left of its family: no bonds, it has lost its
    /// weight.
    /// @param remains  with global nodes; its last row, unless `is_isolated`
    void
    replace_family(unsigned int                        particle,
                   const Peridynamics::FamilySet<dim> &remains,
                   bool                                is_isolated,
                   const Fem::NodePartition<dim>      &partition);

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
    void
    block_tangent(unsigned int                block,
                  const Vector               &displacement,
                  dealii::FullMatrix<double> &matrix) const override;

    void
    extrapolate_stress(const Vector &displacement, const Vector &step) override;
    void
    forget_stress() override;

  private:
    /// Tangent of the law of a particle at its displacement gradient.
    dealii::Tensor<4, dim>
    particle_tangent(unsigned int                  particle,
                     const dealii::Tensor<2, dim> &H) const;

    Peridynamics::Family<dim>
    family(unsigned int particle) const;

    /// Relative displacements of the bonds of a particle, one array per
    /// component.
    void
    relative_displacements(unsigned int  particle,
                           const double *vector,
                           double       *eta) const;

    /// Calls action(particle, eta) for all particles. Relative displacements
    /// are found one family ahead: lanes that are read wait until what was
    /// written to them one by one is in the cache.
    template <typename Action>
    void
    for_families(const Vector &vector, const Action &action) const;

    /// @param forces  per unit weight, as the family has them; are changed
    void
    scatter(unsigned int         particle,
            std::vector<double> &forces,
            double              *vector) const;

    /// Sets xi of a particle.
    void
    find_bond_vectors(unsigned int                   particle,
                      const Fem::NodePartition<dim> &partition);

    /// Moves the bonds of a family without a gradient weight to its end.
    void
    sort_bonds(unsigned int particle);

    /// With local nodes, without gradient weights.
    Peridynamics::FamilySet<dim> families;
    std::vector<unsigned int>    n_gradient_bonds; ///< per particle
    /// Of the bonds, one array per component (Peridynamics::Family).
    std::vector<double>             xi, gradient_weight;
    std::vector<dealii::Point<dim>> position; ///< one per particle
    const MaterialList             &materials;
    unsigned int                    largest_family = 0;
    /// Per particle; empty: none.
    std::vector<dealii::Tensor<2, dim>> extrapolated;
  };

  /// Nodes a rank needs for its families.
  template <int dim>
  void
  add_family_nodes(const Peridynamics::FamilySet<dim> &families,
                   std::vector<unsigned int>          &needed);
} // namespace Perimorph::Coupling
