#pragma once

#include <perimorph/application/body_materials.h>
#include <perimorph/base/exceptions.h>
#include <perimorph/coupling/bond_strengths.h>
#include <perimorph/coupling/coupled_problem.h>
#include <perimorph/damage/breaking_rule.h>
#include <perimorph/fem/boundary_conditions.h>
#include <perimorph/mesh/refinement_rule.h>
#include <perimorph/parameters/lists.h>
#include <perimorph/parameters/polylines.h>
#include <perimorph/parameters/probes.h>
#include <perimorph/solvers/linear_solver.h>
#include <perimorph/solvers/load_stepping.h>
#include <perimorph/solvers/newton.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace Perimorph::Application
{
  /// The texts of a parameter file as they were read: one member per entry.
  struct ParameterTexts
  {
    void
    declare(dealii::ParameterHandler &prm);
    /// The section 'Cracks' of declare().
    void
    declare_cracks(dealii::ParameterHandler &prm);
    /// The section 'Time integration'.
    void
    declare_time_integration(dealii::ParameterHandler &prm);

    std::string  title, mode = "coupled", output_folder;
    unsigned int dimension = 2;

    std::string mesh_file, geometry_parameters;

    double target_spacing = 0., grading = 0.2, error_tolerance = 0.,
           refined_fraction   = 0.5;
    unsigned int error_cycles = 0;
    std::string  refined_places, refined_distance = "1 horizons",
                                curved_boundaries = "automatic";

    std::string law = "linear elastic", state = "automatic", by_volume;
    double      youngs_modulus = 0., poissons_ratio = 0., density = 0.;
    std::string material_constants, orientation;

    std::string model = "correspondence", around, core_size = "automatic",
                blending_width = "automatic", blending_function = "cubic",
                influence_function = "automatic", coupling = "consistent",
                stabilization_scale = "automatic",
                gradient_support    = "automatic";
    double horizon_ratio = 2., horizon = 0., stabilization = 1.;

    std::string pre_cracks,
      crack_treatment = "consistent", crack_growth = "none",
      advance_length = "1 horizons", growth_control = "load steps",
      criterion = "automatic", hand_over_length = "never";
    double fracture_energy = 0., energy_calibration = 0., critical_stretch = 0.,
           softening_stretch = 0., softening_steepness = 3.,
           critical_bond_strain = 0., critical_equivalent_strain = 0.,
           critical_volumetric_strain = 0., tensile_strength = 0.,
           cohesion = 0., friction_angle = 0.;
    unsigned int maximum_advances = 1000, softening_teeth = 6;
    std::string  strengths, strengths_by_volume, interface_strengths;
    std::string  strength_failure = "planes";
    std::string  protected_boundaries, protected_materials, protected_regions;

    std::string symmetry, displacement, mean_displacement, rigid_plate,
      traction, pressure, follower_pressure, body_force, point_displacement,
      point_force;
    bool remove_rigid_motion = true;

    unsigned int n_steps = 1, maximum_cuts = 10, maximum_arc_steps = 200;
    double       end_time = 1.;
    std::string  control  = "load";

    std::string scheme    = "static", initial_displacement, initial_velocity;
    double      time_step = 0., safety_factor = 0.9, spectral_radius = 1.,
           output_interval = 0., field_interval = 0.;
    unsigned int maximum_relaxation_steps = 200000;

    std::string constants;

    std::string linear_solver = "automatic", tangent = "automatic",
                line_search       = "inadmissible";
    double       linear_tolerance = 1e-12, newton_tolerance = 1e-9;
    unsigned int maximum_newton_iterations = 20;

    std::string stress_concentration, nominal_stress, deflection, stress_ratio,
      point, line, circle, reaction;
    bool compare_with_finite_elements = false;

    std::string reference_values, reference_displacement, reference_data,
      reference_source;

    bool write_fields = true, write_stress = true, write_particles = true,
         write_virial_stress = false, write_checkpoints = true;
  };

  /// A CSV file with reference values at points.
  struct ReferenceData
  {
    std::string name;
    std::string file;
  };

  /// Growth of cracks by segments, or bond by bond.
  struct GrowthParameters
  {
    bool              active = false;
    bool              bonds  = false; ///< else by segments
    bool              events = false; ///< else by load steps
    Damage::Criterion criterion;
    Damage::Limits    limits; ///< of bonds
    /// Of criteria with Damage::uses_strengths().
    Coupling::StrengthTable strengths;
    unsigned int            n_teeth = 1; ///< of each bond
    double                  fracture_energy;
    Parameters::Length      advance;
    unsigned int            maximum_advances;
    /// Length from which on a crack of broken bonds grows by segments.
    std::optional<Parameters::Length> hand_over;
    /// Bonds with an end there never break.
    std::vector<Parameters::Feature> protected_features;
  };

  /// How t is followed.
  enum class TimeScheme
  {
    equilibrium, ///< static: Newton's method at each load step
    explicit_motion,
    implicit_motion,
    relaxation ///< static: a damped motion at each load step
  };

  /// Names in the order of TimeScheme.
  const std::vector<std::string> &
  time_scheme_names();

  template <int dim>
  struct TimeIntegrationParameters
  {
    TimeScheme                     scheme;
    double                         time_step;       ///< 0: automatic
    double                         safety_factor;   ///< of the stable time step
    double                         spectral_radius; ///< of implicit motion
    double                         field_interval; ///< time between field files
    unsigned int                   maximum_relaxation_steps;
    Fem::ComponentExpressions<dim> initial_displacement, initial_velocity;

    bool
    has_inertia() const
    {
      return scheme == TimeScheme::explicit_motion ||
             scheme == TimeScheme::implicit_motion;
    }

    /// Without matrices.
    bool
    is_by_nodes() const
    {
      return scheme == TimeScheme::explicit_motion ||
             scheme == TimeScheme::relaxation;
    }
  };

  /// Everything a run needs to know, checked and typed.
  template <int dim>
  struct SimulationParameters
  {
    /// Reads the texts; all problems go into `errors`.
    /// @param parameter_file  its folder is where relative paths start
    SimulationParameters(const ParameterTexts      &texts,
                         const std::string         &parameter_file,
                         Base::InputErrorCollector &errors);

    std::string case_name; ///< title, or the name of the parameter file
    std::string output_folder;

    std::string                   mesh_file;
    std::map<std::string, double> geometry_parameters;
    Mesh::RefinementParameters    refinement;

    Materials::PlaneState                    state;
    MaterialConstants                        material; ///< rest_of_body
    std::map<std::string, MaterialConstants> volume_materials;

    Mesh::RegionParameters            region;
    Coupling::CouplingParameters      coupling;
    std::vector<Parameters::Polyline> pre_cracks;
    GrowthParameters                  growth;
    Fem::BoundaryConditions<dim>      boundary_conditions;

    unsigned int                    n_steps;
    double                          end_time;
    bool                            arc_length;
    unsigned int                    maximum_arc_steps;
    Solvers::LoadSteppingParameters load_stepping;
    TimeIntegrationParameters<dim>  time_integration;

    Solvers::LinearSolverKind linear_solver;
    Solvers::TangentKind      tangent;
    double                    linear_tolerance;
    Solvers::NewtonParameters newton;

    std::string                          stress_concentration; ///< boundary
    Parameters::NominalStress            nominal_stress;
    std::vector<Parameters::ProbePoint>  deflections, stress_ratios, points;
    std::vector<Parameters::ProbeLine>   lines;
    std::vector<Parameters::ProbeCircle> circles;
    std::vector<std::string>             reactions;
    bool                                 compare_with_finite_elements;

    std::vector<std::pair<std::string, double>> reference_values;
    Fem::ComponentExpressions<dim>              reference_displacement;
    bool                                        has_reference_displacement;
    std::vector<ReferenceData>                  reference_data;

    bool write_fields, write_stress, write_particles, write_virial_stress,
      write_checkpoints;

    /// True if the laws are not those of small strain.
    bool
    finite_strain() const;
    bool
    has_anisotropic_laws() const;

    /// Bonds break while the body moves.
    bool
    breaks_in_motion() const
    {
      return growth.bonds && time_integration.has_inertia();
    }

    /// Times of the load steps, or of the states of a motion that are kept.
    std::vector<double>
    times() const;

  private:
    void
    read_materials(const ParameterTexts      &texts,
                   Base::InputErrorCollector &errors);
    void
    read_rest_of_body(const ParameterTexts      &texts,
                      Base::InputErrorCollector &errors);
    /// @param of  " of NAME", or empty: the rest of the body
    bool
    check_material(const std::string         &path,
                   const std::string         &of,
                   const MaterialConstants   &constants,
                   Base::InputErrorCollector &errors) const;
    /// True unless a law in plane stress lacks constants for it.
    bool
    knows_thickness_strain() const;
    void
    check_orientation(Base::InputErrorCollector &errors) const;
    /// An expression of constants only.
    double
    number(const std::string         &path,
           const std::string         &name,
           const std::string         &text,
           Base::InputErrorCollector &errors) const;
    void
    read_refinement(const ParameterTexts      &texts,
                    Base::InputErrorCollector &errors);
    void
    read_region(const ParameterTexts &texts, Base::InputErrorCollector &errors);
    void
    read_boundary_conditions(const ParameterTexts      &texts,
                             Base::InputErrorCollector &errors);
    void
    read_time_integration(const ParameterTexts      &texts,
                          Base::InputErrorCollector &errors);
    void
    read_quantities(const ParameterTexts      &texts,
                    const std::string         &parameter_file,
                    Base::InputErrorCollector &errors);
    /// Expressions for components x, y, z.
    Fem::ComponentExpressions<dim>
    component_expressions(
      const std::string                                      &path,
      const std::vector<std::pair<std::string, std::string>> &components,
      Base::InputErrorCollector                              &errors) const;
    void
    check_law(Base::InputErrorCollector &errors) const;
    void
    read_cracks(const ParameterTexts &texts, Base::InputErrorCollector &errors);
    void
    check_bond_breaking(const ParameterTexts      &texts,
                        Base::InputErrorCollector &errors);
    /// What the criterion of bonds needs is given, and nothing else.
    void
    read_bond_limits(const ParameterTexts      &texts,
                     Base::InputErrorCollector &errors);
    void
    read_strengths(const ParameterTexts      &texts,
                   Base::InputErrorCollector &errors);
    void
    read_hand_over(const ParameterTexts      &texts,
                   Base::InputErrorCollector &errors);
    void
    read_protection(const ParameterTexts      &texts,
                    Base::InputErrorCollector &errors);

    Parameters::Constants constants;
  };
} // namespace Perimorph::Application
