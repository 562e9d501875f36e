#include <perimorph/application/simulation_parameters.h>
#include <perimorph/materials/material_factory.h>
#include <perimorph/parameters/patterns.h>

namespace Perimorph::Application
{
  using dealii::Patterns::Anything;
  using dealii::Patterns::Bool;
  using dealii::Patterns::Double;
  using dealii::Patterns::Integer;
  using Parameters::automatic_or;
  using Parameters::choice;
  using Parameters::PositiveDouble;

  void
  ParameterTexts::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Title", title, "Name of the case, free text.");
    prm.add_parameter("Mode",
                      mode,
                      "What carries the body: both methods, or one of them.",
                      choice(Mesh::mode_names()));
    prm.add_parameter("Dimension", dimension, "2 or 3.", Integer(2, 3));
    prm.add_parameter("Output folder",
                      output_folder,
                      "Where results go; empty: output/<name of this file>.",
                      Anything());

    prm.enter_subsection("Mesh");
    prm.add_parameter("file",
                      mesh_file,
                      "gmsh mesh (.msh) or geometry (.geo, meshed on the fly); "
                      "relative to the parameter file, else to the working "
                      "folder. Any consistent unit of length.",
                      Anything());
    prm.add_parameter("geometry parameters",
                      geometry_parameters,
                      "Values for DefineConstant of a .geo: nr = 24, nt = 12.",
                      Anything());
    prm.enter_subsection("Refinement");
    prm.add_parameter(
      "target spacing",
      target_spacing,
      "Cells in the peridynamic region (in finite elements: where it would be) "
      "are halved until their edges are not longer than this on average "
      "[length]; 0: the mesh stays as it is.",
      Double(0.));
    prm.add_parameter("around",
                      refined_places,
                      "Other places with this spacing, as in 'Peridynamics / "
                      "around'.",
                      Anything());
    prm.add_parameter("distance",
                      refined_distance,
                      "How far it reaches beyond the peridynamic region and "
                      "these places: a length, or '1 horizons'.",
                      Anything());
    prm.add_parameter("grading",
                      grading,
                      "How much longer cells may be per distance from there "
                      "[-]; 1000: as the file has them, beside a difference of "
                      "one halving between neighbours.",
                      PositiveDouble());
    prm.add_parameter("error cycles",
                      error_cycles,
                      "Solves of the first load step before the run, each "
                      "followed by halving the elements with the largest "
                      "errors (Zienkiewicz and Zhu); 0: none.",
                      Integer(0, 30));
    prm.add_parameter("error tolerance",
                      error_tolerance,
                      "No further cycle once the error of the elements in the "
                      "energy norm is estimated below this part of it [-].",
                      Double(0.));
    prm.add_parameter("refined fraction",
                      refined_fraction,
                      "Part of the squared error in the cells that a cycle "
                      "halves, the fewest that have it [-].",
                      Double(0., 1.));
    prm.add_parameter(
      "curved boundaries",
      curved_boundaries,
      "A mesh has no curves. automatic: new nodes of named boundaries whose "
      "nodes lie on a circle, a sphere or a cylinder along an axis are put on "
      "it, in 2D those of other smooth ones on a spline; straight: all sides "
      "of cells stay as they are.",
      choice({"automatic", "straight"}));
    prm.leave_subsection();
    prm.leave_subsection();

    prm.enter_subsection("Material");
    auto law_names = Materials::law_names();
    for (const auto &name : Materials::anisotropic_law_names())
      law_names.push_back(name);
    prm.add_parameter("law",
                      law,
                      "Elastic law: linear elastic (isotropic), orthotropic "
                      "and anisotropic are of small strain, the others "
                      "isotropic and of finite strain. prototype microelastic "
                      "is the continuum of bond-based peridynamics.",
                      choice(law_names));
    prm.add_parameter("Young's modulus",
                      youngs_modulus,
                      "E [stress, any consistent unit] of an isotropic law; "
                      "has no default.",
                      Double());
    prm.add_parameter(
      "Poisson's ratio",
      poissons_ratio,
      "nu [-]. Bond-based peridynamics has a fixed value: 1/3 in "
      "plane stress, 1/4 in plane strain and 3D.",
      Double());
    prm.add_parameter(
      "state",
      state,
      "Assumption on the third direction; automatic: plane "
      "strain in 2D, three-dimensional in 3D.",
      choice(
        {"automatic", "plane stress", "plane strain", "three-dimensional"}));
    prm.add_parameter(
      "constants",
      material_constants,
      "Of the other two laws. orthotropic: E1 = 144.8e9, E2 = 11.7e9, nu12 = "
      "0.21, G12 = 9.66e9 in plane stress; also E3, nu13, nu23 in plane "
      "strain, "
      "also G13, G23 in 3D; nu_ij = -e_jj / e_ii in uniaxial stress along i. "
      "anisotropic: C11, C12, ..., the upper half of the stiffness in the "
      "order xx, yy, zz, yz, xz, xy, of the model as it is: in 2D those of the "
      "plane (C11, C12, C16, C22, C26, C66), and C13, C23, C36 for the stress "
      "across it in plane strain. What is not given is 0.",
      Anything());
    prm.add_parameter(
      "orientation",
      orientation,
      "Of the material axes: angle of axis 1 from x, anticlockwise about z "
      "[degrees], a number or an expression in x, y, z (per cell). In 3D also "
      "x = 90, y = 0, z = 30: turns about the axes, in this order.",
      Anything());
    prm.add_parameter("density",
                      density,
                      "Mass per volume [any consistent unit]; 0: not given.",
                      Double(0.));
    prm.add_parameter(
      "by volume",
      by_volume,
      "Other values in named volumes: inclusion: Young's modulus = 10, "
      "Poisson's ratio = 0.2; ply: E1 = 140, E2 = 10, nu12 = 0.3, G12 = 5, "
      "orientation = 45, density = 1.6; ... The constants say the law; "
      "those of the same law that are not given, density and orientation are "
      "those of the rest. In 3D also orientation x, y, z.",
      Anything());
    prm.leave_subsection();

    prm.enter_subsection("Peridynamics");
    prm.add_parameter("model",
                      model,
                      "Peridynamic model: correspondence (non-ordinary "
                      "state-based, stabilised) or bond based (prototype "
                      "microelastic brittle).",
                      choice(Coupling::model_names()));
    prm.add_parameter(
      "around",
      around,
      "What the peridynamic region surrounds, separated by ';': name of a "
      "boundary | volume NAME | point x y | segment x0 y0 x1 y1 | plane px py "
      "nx ny | box x0 y0 x1 y1 | ball x y r (with z in 3D).",
      Anything());
    prm.add_parameter(
      "core size",
      core_size,
      "Distance from there that is purely peridynamic: a length or '2 "
      "horizons'; automatic: 2 horizons, 4 with cracks that grow by segments "
      "and 5 with cracks that do not grow, whose stress intensity factors need "
      "room.",
      Anything());
    prm.add_parameter("blending width",
                      blending_width,
                      "Width of the band to pure finite elements: a length, '1 "
                      "horizons', or automatic = max(2 spacings, 1 horizon).",
                      Anything());
    prm.add_parameter("blending function",
                      blending_function,
                      "Shape of alpha in the band; splice: no band.",
                      choice(Mesh::blending_function_names()));
    prm.add_parameter(
      "horizon ratio",
      horizon_ratio,
      "m = horizon / local spacing [-]; 1.5 is cheapest, 2 usual, 3 for "
      "free crack paths.",
      Double(1.));
    prm.add_parameter(
      "horizon",
      horizon,
      "One horizon for all particles [length]; 0: horizon ratio "
      "times the local spacing.",
      Double(0.));
    prm.add_parameter(
      "influence function",
      influence_function,
      "Weight of a bond over its length (correspondence model). automatic: "
      "gaussian, or cubic spline in 2D if horizon / spacing is above 2.5 in "
      "the mean.",
      choice(automatic_or(Peridynamics::influence_function_names())));
    prm.add_parameter(
      "coupling",
      coupling,
      "consistent: exact patch test on any mesh. energy blending, force "
      "blending: classical, uncorrected, with ghost forces; for comparison.",
      choice(Coupling::scheme_names()));
    prm.add_parameter(
      "gradient support",
      gradient_support,
      "What the deformation gradient of a particle is averaged over "
      "(correspondence model). adjacent cells: those at the particle; fewer "
      "bonds, smaller errors. horizon: all in the horizon, so that stresses "
      "are nonlocal over it. automatic: adjacent cells, but the horizon with "
      "cracks.",
      choice(automatic_or(Coupling::gradient_support_names())));
    prm.add_parameter("stabilization",
                      stabilization,
                      "gamma [-] of the zero-energy stabilisation; 1 fits all, "
                      "the entry exists for studies.",
                      Double(0.));
    prm.add_parameter(
      "stabilization scale",
      stabilization_scale,
      "bending: the energy of bending fields is exact for gamma "
      "= 1. shear modulus: gamma mu tr(K^-1) / dim. automatic: bending, "
      "but shear modulus in 3D for gradients over the horizon.",
      choice({"automatic", "bending", "shear modulus"}));
    prm.leave_subsection();

    declare_cracks(prm);

    prm.enter_subsection("Boundary conditions");
    prm.add_parameter("symmetry",
                      symmetry,
                      "Plane boundaries whose normal displacement is zero: "
                      "left, bottom.",
                      Anything());
    prm.add_parameter("displacement",
                      displacement,
                      "Prescribed displacement: top: x = 0, y = 0.1*t; ...",
                      Anything());
    prm.add_parameter("traction",
                      traction,
                      "Force per area on boundaries: right: x = 10; ...",
                      Anything());
    prm.add_parameter("pressure",
                      pressure,
                      "Pressure against the outward normal: hole: 5; ...",
                      Anything());
    prm.add_parameter(
      "follower pressure",
      follower_pressure,
      "Pressure against the normal of the deformed surface (finite strain): "
      "hole: 5*t; ... ('pressure' keeps its reference direction and area.)",
      Anything());
    prm.add_parameter(
      "mean displacement",
      mean_displacement,
      "Mean motion of boundaries, reaction spread evenly: left: x = 0, y = 0, "
      "rotation = 0 [rad]; ... What is not named stays free.",
      Anything());
    prm.add_parameter(
      "rigid plate",
      rigid_plate,
      "Boundaries glued to a rigid plate that is held at their centroid: end: "
      "x = 0, y = 0, rotation = 0 [rad]; ... What is not named stays free: x "
      "and y alone make a pin.",
      Anything());
    prm.add_parameter(
      "body force",
      body_force,
      "Force per volume: y = -9.81, or volume NAME: y = -1; ...",
      Anything());
    prm.add_parameter(
      "point displacement",
      point_displacement,
      "Displacement of the node nearest to a point: 0 0: x = 0, "
      "y = 0; ...",
      Anything());
    prm.add_parameter("point force",
                      point_force,
                      "Force at the node nearest to a point: 4 0: y = -1; ...",
                      Anything());
    prm.add_parameter("remove rigid motion",
                      remove_rigid_motion,
                      "Take out rigid motions that no support prevents (the "
                      "loads must be in balance).",
                      Bool());
    prm.leave_subsection();

    prm.enter_subsection("Load steps");
    prm.add_parameter("number of steps",
                      n_steps,
                      "t runs from 0 to the end time in this many equal steps.",
                      Integer(1));
    prm.add_parameter("end time",
                      end_time,
                      "Last value of t.",
                      PositiveDouble());
    prm.add_parameter("control",
                      control,
                      "load: t is prescribed; a step that fails is cut, and "
                      "grows again. arc length: t is unknown too, to follow "
                      "the path beyond limit points.",
                      choice({"load", "arc length"}));
    prm.add_parameter("maximum cuts",
                      maximum_cuts,
                      "The smallest increment is a step halved this often.",
                      Integer(0, 40));
    prm.add_parameter("maximum arc steps",
                      maximum_arc_steps,
                      "Steps of the arc length after which the run stops if it "
                      "has not reached the end time.",
                      Integer(1));
    prm.leave_subsection();

    declare_time_integration(prm);

    prm.enter_subsection("Expressions");
    prm.add_parameter("constants",
                      constants,
                      "Names usable in every expression: a = 2.5, S = 10.",
                      Anything());
    prm.leave_subsection();

    prm.enter_subsection("Solver");
    prm.add_parameter("linear solver",
                      linear_solver,
                      "automatic: by expected cost.",
                      choice({"automatic", "direct", "iterative"}));
    prm.add_parameter("tangent",
                      tangent,
                      "How the peridynamic tangent is applied by an iterative "
                      "solver.",
                      choice({"automatic", "assembled", "matrix-free"}));
    prm.add_parameter("linear tolerance",
                      linear_tolerance,
                      "Relative residual at which the iterative solver stops "
                      "at the latest; Newton steps of problems that are not "
                      "linear go as far as they have use for.",
                      Double(1e-15, 1e-2));
    prm.add_parameter("Newton tolerance",
                      newton_tolerance,
                      "Out-of-balance force relative to the largest load, "
                      "reaction or out-of-balance met so far.",
                      Double(1e-14, 1e-2));
    prm.add_parameter("maximum Newton iterations",
                      maximum_newton_iterations,
                      "Give up after this many.",
                      Integer(1));
    prm.add_parameter("line search",
                      line_search,
                      "inadmissible: Newton steps are shortened only where a "
                      "law has no answer (J <= 0). energy: also until the "
                      "force along the step has fallen.",
                      choice({"inadmissible", "energy"}));
    prm.leave_subsection();

    prm.enter_subsection("Quantities");
    prm.add_parameter(
      "stress concentration",
      stress_concentration,
      "Boundary whose largest principal stress is compared with "
      "the nominal stress: stress_concentration.",
      Anything());
    prm.add_parameter("nominal stress",
                      nominal_stress,
                      "A number, or 'reaction of NAME': mean stress on that "
                      "boundary.",
                      Anything());
    prm.add_parameter("deflection",
                      deflection,
                      "Displacement component at a point: tip: 4 0, y gives "
                      "tip_deflection.",
                      Anything());
    prm.add_parameter(
      "stress ratio",
      stress_ratio,
      "Stress component over nominal stress: root: 22.5 0 0, yy "
      "gives root_stress_ratio.",
      Anything());
    prm.add_parameter(
      "point",
      point,
      "All displacements and stresses at points: corner: 25 25.",
      Anything());
    prm.add_parameter("line",
                      line,
                      "Values along lines: equator: 2.5 0 to 25 0, 101 points.",
                      Anything());
    prm.add_parameter(
      "circle",
      circle,
      "Values along circles: ring: center 0 0, radius 3.5, from "
      "0 to 90, 91 points (degrees).",
      Anything());
    prm.add_parameter(
      "reaction",
      reaction,
      "Boundaries whose reaction force is reported: left, right.",
      Anything());
    prm.add_parameter(
      "compare with finite elements",
      compare_with_finite_elements,
      "Also run pure finite elements on the same mesh and report "
      "the differences.",
      Bool());
    prm.leave_subsection();

    prm.enter_subsection("Reference");
    prm.add_parameter("values",
                      reference_values,
                      "Reference of quantities: stress_concentration = 3.0861.",
                      Anything());
    prm.add_parameter("displacement",
                      reference_displacement,
                      "Exact displacement field x = ..., y = ...: gives "
                      "relative_displacement_error and relative_energy_error.",
                      Anything());
    prm.add_parameter("data",
                      reference_data,
                      "CSV files with reference values at points: ring: "
                      "reference/ring.csv; gives ring_stt_error...",
                      Anything());
    prm.add_parameter("source",
                      reference_source,
                      "Where the references come from, free text.",
                      Anything());
    prm.leave_subsection();

    prm.enter_subsection("Output");
    prm.add_parameter("fields",
                      write_fields,
                      "Write solution.pvd for ParaView.",
                      Bool());
    prm.add_parameter("stress",
                      write_stress,
                      "Recover the stress at every node for the fields.",
                      Bool());
    prm.add_parameter("particles",
                      write_particles,
                      "Write particles.pvd for ParaView.",
                      Bool());
    prm.add_parameter("virial stress",
                      write_virial_stress,
                      "Bond-based model: write the peridynamic stress of the "
                      "bonds (first Piola-Kirchhoff) to particles.pvd. Right "
                      "at one horizon and more from surfaces and elements.",
                      Bool());
    prm.add_parameter("checkpoint",
                      write_checkpoints,
                      "After every accepted step write the file checkpoint: "
                      "perimorph FILE.prm --resume FOLDER goes on from it, on "
                      "any number of ranks.",
                      Bool());
    prm.leave_subsection();
  }
} // namespace Perimorph::Application
