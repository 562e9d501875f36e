#pragma once

#include <perimorph/application/simulation_parameters.h>
#include <perimorph/fem/supports.h>
#include <perimorph/fracture/crack_advance.h>
#include <perimorph/fracture/crack_quantities.h>
#include <perimorph/fracture/error_norms.h>
#include <perimorph/fracture/probes.h>
#include <perimorph/fracture/reference_data.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Application
{
  /// A state of equilibrium, complete on every rank (one entry per node).
  template <int dim>
  struct State
  {
    std::vector<dealii::Tensor<1, dim>> displacement;
    std::vector<dealii::Tensor<1, dim>> internal_force;
    std::vector<dealii::Tensor<1, dim>> external_force;
    double                              strain_energy = 0.;
    double                              time          = 0.;
    /// Of bodies that move, else empty. Inertia counts as internal force.
    std::vector<dealii::Tensor<1, dim>> velocity, acceleration;
  };

  /// One number for results.json.
  struct NamedQuantity
  {
    std::string name;
    double      value;
    std::string unit;
    bool        exists = true; ///< false: this state does not have it
  };

  /// Everything that is read off a state: stress concentration, probes,
  /// reactions, errors. Whatever can be wrong with what the user asks for is
  /// found by the constructor, before the solve.
  template <int dim>
  class PostProcessing
  {
  public:
    /// @throws Base::InputError  boundaries not in the mesh, points outside the
    ///         body, unreadable reference data, references without a quantity
    /// @param cracks  kept as a reference, may grow
    PostProcessing(const SimulationParameters<dim>    &parameters,
                   const Mesh::DistributedMesh<dim>   &mesh,
                   const Coupling::BodyMaterials<dim> &materials,
                   const Fem::Supports<dim>           &supports,
                   const Bonds::CrackSet<dim>         &cracks);
    ~PostProcessing();

    std::vector<NamedQuantity>
    evaluate(const State<dim> &state) const;

    /// J, stress intensity factors and T-stress at the tips (2D) or along the
    /// fronts (3D) that the cracks had at the start, whether they exist (a tip
    /// may be through, or without room for a domain integral) or not. No
    /// cracks: none.
    /// @param families  of this rank; empty: the law in all cells
    /// @param[out] without_room  names of tips, and why they have no factors
    std::vector<NamedQuantity>
    crack_quantities(const State<dim>                   &state,
                     const Mesh::RegionMap              &region,
                     const Peridynamics::FamilySet<dim> &families,
                     std::map<std::string, std::string> &without_room) const;

    /// How far bonds that broke in motion have carried the cracks from their
    /// tips at the start, and how fast; none in 3D. The speed exists from the
    /// second row of the history on.
    /// @param horizon          of each node
    /// @param[in,out] history  gets a row for this time
    std::vector<NamedQuantity>
    crack_advances(double                     time,
                   const std::vector<double> &horizon,
                   const Bonds::BrokenBonds  &broken,
                   Fracture::AdvanceHistory  &history) const;

    /// At the tips of the cracks, in the order of Fracture::find_tips(); none
    /// in 3D.
    /// @param families  as above
    std::vector<Fracture::TipQuantities>
    tip_quantities(const State<dim>                   &state,
                   const Mesh::RegionMap              &region,
                   const Peridynamics::FamilySet<dim> &families) const;

    /// Writes probe_<name>.csv of all lines and circles.
    /// @return names of the files
    std::vector<std::string>
    write_probes(const State<dim> &state, const std::string &folder) const;

    const Fracture::DisplacementFit<dim> &
    displacement_fit() const
    {
      return *fit;
    }

    /// Recovered stress at every node, complete on every rank.
    /// @param progress  called now and then with the nodes done and their
    /// number
    std::vector<Fracture::Stress<dim>>
    nodal_stress(
      const State<dim>                                    &state,
      const std::function<void(std::size_t, std::size_t)> &progress) const;

    /// Exact displacement at the nodes; empty without a reference.
    std::vector<dealii::Tensor<1, dim>>
    reference_displacement(double time) const;

    /// Largest of the force and moment that is left over when loads and
    /// reactions are added up, relative to the sum of their magnitudes.
    /// @param[in,out] largest_force  largest such sum of the run so far
    double
    imbalance(const State<dim> &state, double &largest_force) const;

    /// Force of the loads and supports at a node.
    dealii::Tensor<1, dim>
    outer_force(unsigned int node, const State<dim> &state) const;

  private:
    void
    check(Base::InputErrorCollector &errors);

    std::vector<std::string>
    expected_names() const;

    /// Cracks of elements alone lie on slits of the mesh.
    bool
    has_slits() const;

    /// Name of each tip or front of the cracks at the start.
    void
    name_crack_tips();
    void
    add_crack_names(std::vector<std::string> &names) const;

    Fracture::CrackedBody<dim>
    cracked_body(const State<dim>                   &state,
                 const Mesh::RegionMap              &region,
                 const Peridynamics::FamilySet<dim> &families) const;

    double
    nominal_stress(const State<dim> &state) const;

    /// Integral of the outward normal.
    dealii::Tensor<1, dim>
    vector_area(const std::string &boundary) const;

    /// Force of the supports of a boundary: at a node shared with another
    /// supported boundary each component counts for the condition that set it.
    dealii::Tensor<1, dim>
    reaction(const std::string &boundary, const State<dim> &state) const;

    /// Force of the support at one degree of freedom; zero where it is free.
    double
    reaction_at(unsigned int dof, const State<dim> &state) const;

    void
    add_point(const std::string          &name,
              const dealii::Point<dim>   &point,
              const State<dim>           &state,
              std::vector<NamedQuantity> &list) const;

    const SimulationParameters<dim>    &parameters;
    const Mesh::DistributedMesh<dim>   &mesh;
    const Coupling::BodyMaterials<dim> &materials;
    const Fem::Supports<dim>           &supports;

    std::unique_ptr<Fracture::DisplacementFit<dim>> fit;
    std::unique_ptr<Fracture::NodalStress<dim>>     recovery;
    std::unique_ptr<Fracture::PointProbe<dim>>      probe;
    std::vector<Fracture::ReferenceData<dim>>       reference_data;
    const Bonds::CrackSet<dim>                     &cracks;
    std::vector<std::string>                        tip_names;
    std::vector<Fracture::CrackTip>         first_tips; ///< in 2D, by name
    std::vector<Fracture::MirrorPlane<dim>> planes;

    /// The last tip_quantities() and what they were evaluated for.
    struct Tips
    {
      std::size_t                          n_facets = 0;
      double                               time     = 0.; ///< of the loads
      std::vector<double>                  alpha;
      std::vector<dealii::Tensor<1, dim>>  displacement;
      std::vector<Fracture::TipQuantities> quantities;
    };
    mutable Tips last_tips;
  };
} // namespace Perimorph::Application
