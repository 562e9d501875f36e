#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/coupling/bond_set.h>
#include <perimorph/coupling/consistent_families.h>
#include <perimorph/fem/cell_stiffness.h>
#include <perimorph/fem/elastic_cells.h>
#include <perimorph/fem/nodal_springs.h>
#include <perimorph/mesh/region_map.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Perimorph::Coupling
{
  enum class Model
  {
    correspondence,
    bond_based
  };

  /// How peridynamics and finite elements share the energy.
  enum class Scheme
  {
    consistent,      ///< exact patch test on any mesh
    energy_blending, ///< classical: alpha and 1 - alpha as energy weights
    force_blending   ///< classical: equations weighted; not symmetric
  };

  const std::vector<std::string> &
  model_names();
  const std::vector<std::string> &
  scheme_names();

  struct CouplingParameters
  {
    Model  model  = Model::correspondence;
    Scheme scheme = Scheme::consistent;
    /// None: see influence_function_of().
    std::optional<Peridynamics::InfluenceFunction> influence = std::nullopt;
    double                                         gamma     = 1.;
    /// None: bending, but in 3D for gradients over the horizon, where it meets
    /// the bending fields too loosely, the shear modulus.
    std::optional<StabilizationScale> scale   = std::nullopt;
    GradientSupport                   support = GradientSupport::adjacent_cells;
    CrackRule                         crack_rule = CrackRule::consistent;
    /// Whether SharedParts::intact is kept.
    bool bonds_may_break = false;
    /// Whether inertia holds what broke off, instead of weak springs.
    bool is_in_motion = false;
  };

  /// Whether gradients of families reach over the horizon: as chosen, and the
  /// classical ones.
  inline bool
  has_wide_gradients(const CouplingParameters &parameters)
  {
    return parameters.support == GradientSupport::horizon ||
           parameters.scheme != Scheme::consistent;
  }

  /// The influence function as given. Otherwise gaussian, or in 2D, above a
  /// mean horizon ratio of 2.5, cubic spline (numerics.md, D4): wide families
  /// bend too softly where distant nodes weigh much. In 3D, with the other
  /// scale of the stabilisation, the cubic spline is too stiff (doc/stability).
  template <int dim>
  Peridynamics::InfluenceFunction
  influence_function_of(const CouplingParameters   &parameters,
                        const Mesh::NodalMesh<dim> &mesh,
                        const Mesh::RegionMap      &region);

  /// What families are built from.
  template <int dim>
  FamilyParameters
  family_parameters(const CouplingParameters   &parameters,
                    const Mesh::NodalMesh<dim> &mesh,
                    const Mesh::RegionMap      &region,
                    const typename Fem::ElasticCells<dim>::MaterialList &laws);

  /// The materials of the body: laws for elements and families, constants for
  /// bonds; index = NodalMesh::cell_material. A material whose orientation
  /// varies has one law per orientation.
  template <int dim>
  struct BodyMaterials
  {
    typename Fem::ElasticCells<dim>::MaterialList laws;
    /// Without meaning for anisotropic laws.
    std::vector<BondMaterial> bond_constants;

    // Of each law; the problem of statics does not ask.
    std::vector<unsigned int> material_of_law; ///< index into names
    /// Material axes in rows (Materials::material_axes()).
    std::vector<dealii::Tensor<2, 3>> axes;
    std::vector<double> density; ///< [mass / volume], 0: not given

    std::vector<std::string> names; ///< of the materials
  };

  /// Peridynamics of a body before bonds broke one by one: what takes time to
  /// find, and stays while neither the core nor cracks change.
  template <int dim>
  struct IntactBonds
  {
    Peridynamics::FamilySet<dim> families; ///< correspondence model
    BondCoupling<dim>            coupling; ///< bond-based model
    CrackReport                  cracked;
  };

  /// What a problem of the same body, with other cracks or broken bonds, may
  /// share with an earlier one.
  template <int dim>
  struct SharedParts
  {
    /// Of a problem that differs in broken bonds only; none if bonds cannot
    /// break.
    std::shared_ptr<const IntactBonds<dim>>        intact;
    std::shared_ptr<const Fem::NodePartition<dim>> partition;
    std::shared_ptr<Fem::ElasticCells<dim>>        all_cells;
    /// The elements with their weights, where these are the same.
    std::shared_ptr<Fem::ElasticCells<dim>> elements;
    std::vector<double>                     element_weight;
    std::vector<bool>                       replaced;
  };

  /// The internal energy of the coupled body as a list of contributions. What a
  /// scene does not have is not in the list.
  template <int dim>
  class CoupledProblem
  {
  public:
    using Term     = Fem::Contribution<dim>;
    using Vector   = Fem::Vector;
    using Progress = std::function<void(std::size_t, std::size_t)>;

    /// @param more_nodes  nodes that every rank must see (constraints)
    /// @param cracks      only needed by the constructor
    /// @param broken      the same
    /// @param shared      what an earlier problem knows
    /// @param loose       nodes that springs too weak to matter hold, because
    ///        a crack cut them off; on all ranks
    CoupledProblem(const Mesh::DistributedMesh<dim> &mesh,
                   const Mesh::RegionMap            &region,
                   const BodyMaterials<dim>         &materials,
                   const CouplingParameters         &parameters,
                   const Progress                   &progress   = {},
                   std::vector<unsigned int>         more_nodes = {},
                   const Bonds::CrackSet<dim>       &cracks     = {},
                   const Bonds::BrokenBonds         &broken     = {},
                   SharedParts<dim>                  shared     = {},
                   const std::vector<unsigned int>  &loose      = {});

    /// For a problem with the same mesh, materials and parameters; without
    /// `intact` if more than broken bonds differ.
    const SharedParts<dim> &
    shared() const
    {
      return parts_to_share;
    }

    const Fem::NodePartition<dim> &
    partition() const
    {
      return *parts_to_share.partition;
    }

    /// All contributions, or only those that may be applied without a matrix
    /// (families or bonds) or must be assembled (the others).
    std::vector<const Term *>
    terms() const;
    std::vector<const Term *>
    particle_terms() const;
    std::vector<const Term *>
    assembled_terms() const;

    /// Bonds are those of families, not springs between two particles.
    bool
    has_families() const
    {
      return families_exist;
    }

    /// Plain finite elements everywhere, the reference of the patch test.
    const Fem::ElasticCells<dim> &
    full_elements() const
    {
      return *parts_to_share.all_cells;
    }

    /// Adds the inertia of a time step; it has no strain energy.
    void
    set_inertia(std::shared_ptr<Fem::NodalSprings<dim>> springs)
    {
      contributions.push_back(springs);
      inertia = std::move(springs);
    }

    /// Elements whose stiffness is close to that of the coupled problem.
    const Fem::ElasticCells<dim> &
    preconditioner_elements() const
    {
      return *preconditioner;
    }

    /// These and the inertia.
    std::vector<const Term *>
    preconditioner_terms() const;

    /// What stays the same while families change; none, on all ranks, if no
    /// element works.
    std::shared_ptr<const Term>
    elements() const;

    bool
    is_linear() const;

    bool
    is_symmetric() const;

    /// For runs that evaluate forces very often: from now on the stiffness of
    /// cells that are linear is kept (Fem::CellStiffness).
    void
    keep_cell_stiffness();

    /// Cells lose their work, by their numbers in the mesh.
    void
    remove_cells(const std::vector<bool> &goes);

    /// Internal forces into a vector with ghosts; exchanged and complete.
    /// @throws Base::InadmissibleState  on all ranks
    /// @param displacement  ghosts up to date
    void
    internal_forces(const Vector &displacement, Vector &forces) const;

    /// Adds the tangent of all terms at a displacement times a direction, also
    /// into ghost entries.
    void
    add_tangent_product(const Vector &displacement,
                        const Vector &direction,
                        Vector       &product) const;

    /// Contribution::extrapolate_stress() of all terms; part of the solution
    /// procedure, not of the problem.
    /// @param of_preconditioner  also of preconditioner_elements()
    /// @throws Base::InadmissibleState  on all ranks
    void
    extrapolate_stress(const Vector &displacement,
                       const Vector &step,
                       bool          of_preconditioner) const;
    void
    forget_stress() const;

    /// Strain energy of all ranks.
    double
    strain_energy(const Vector &displacement) const;

    /// Families of this rank with global nodes; empty without families.
    Peridynamics::FamilySet<dim>
    correspondence_families() const;

    /// The term of a type, to be changed in place where bonds break; null if
    /// there is none.
    template <typename SomeTerm>
    SomeTerm *
    find_term() const
    {
      for (const auto &term : contributions)
        if (const auto found = dynamic_cast<SomeTerm *>(term.get()))
          return found;
      return nullptr;
    }

    /// Bonds of the bond-based model that this rank owns, with what stiffness
    /// they have left; empty with the correspondence model.
    const BondSet &
    bonds() const
    {
      return bond_set;
    }

    /// Parts of the body that nothing holds together, see find_parts().
    std::vector<unsigned int>
    parts(const Mesh::RegionMap &region) const;

    /// nodal_virial_stress() of the bonds; empty without bonds.
    /// @param displacement  ghosts up to date
    std::vector<dealii::Tensor<2, dim>>
    virial_stress(const Vector          &displacement,
                  const Mesh::RegionMap &region) const;

    /// The affine patch test on this mesh: largest difference between internal
    /// forces and finite-element forces over unit strains (strains of 0.1 if
    /// the problem is not linear), relative to |stress| spacing^(dim - 1).
    /// Nodes whose forces cracks change count with their residual of the
    /// consistency condition, which bounds them for every stress that leaves
    /// the crack free.
    /// @param excluded  degrees of freedom that do not count (Dirichlet)
    double
    ghost_force(const std::function<bool(unsigned int)> &excluded) const;

    struct Counts
    {
      std::size_t particles    = 0;
      std::size_t bonds        = 0;
      std::size_t dropped      = 0; ///< bonds that would leave the body
      std::size_t active_cells = 0;
      std::size_t isolated     = 0; ///< particles without enough intact bonds
    };

    /// Sums over all ranks.
    Counts
    counts() const;

    /// What cracks did; zeros without cracks.
    const CrackReport &
    crack_report() const
    {
      return cracked;
    }

  private:
    /// @param needed  nodes that families or bonds of this rank touch
    void
    make_partition(std::vector<unsigned int> needed);
    /// Adds the elements (none where nothing is left for them) and the
    /// peridynamic term.
    /// @param replaced  cells that something else stands in for, or empty
    void
    add_terms(const Mesh::RegionMap &region,
              Scheme                 scheme,
              std::vector<double>    element_weight,
              std::vector<bool>      replaced,
              std::unique_ptr<Term>  particles);
    void
    make_elements(std::vector<double> weight, std::vector<bool> skip);
    void
    make_correspondence(const Mesh::RegionMap      &region,
                        const CouplingParameters   &parameters,
                        const Bonds::CrackSet<dim> &cracks,
                        const Bonds::BrokenBonds   &broken,
                        const Progress             &progress);
    /// Holds what broke off, so that the problem stays regular.
    /// @param parts  of the body, see find_parts()
    /// @param more   nodes that must be held too: few bonds are a mechanism
    void
    ground_loose_parts(const std::vector<unsigned int> &parts,
                       const std::vector<bool>         &more = {});
    void
    ground(const std::vector<unsigned int> &nodes);
    void
    make_bonds(const Mesh::RegionMap      &region,
               const CouplingParameters   &parameters,
               const Bonds::CrackSet<dim> &cracks,
               const Bonds::BrokenBonds   &broken,
               const Progress             &progress);

    /// Whether the cell stiffness that is kept stands for a term.
    bool
    is_kept(const Term &term) const
    {
      return cell_stiffness && Fem::CellStiffness<dim>::can_hold(term);
    }

    const Mesh::DistributedMesh<dim>        &mesh;
    const BodyMaterials<dim>                &materials;
    std::vector<unsigned int>                more_nodes;
    SharedParts<dim>                         parts_to_share;
    std::vector<std::shared_ptr<Term>>       contributions;
    std::vector<const Term *>                of_particles;
    bool                                     families_exist = false;
    std::shared_ptr<Fem::ElasticCells<dim>>  preconditioner;
    std::shared_ptr<Fem::NodalSprings<dim>>  inertia;        ///< or none
    std::unique_ptr<Fem::CellStiffness<dim>> cell_stiffness; ///< or none
    BondSet                                  bond_set;
    Counts                                   local_counts;
    CrackReport                              cracked;
  };
} // namespace Perimorph::Coupling
