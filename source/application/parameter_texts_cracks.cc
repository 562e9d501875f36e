#include <perimorph/application/simulation_parameters.h>
#include <perimorph/parameters/patterns.h>

namespace Perimorph::Application
{
  using dealii::Patterns::Anything;
  using dealii::Patterns::Double;
  using dealii::Patterns::Integer;
  using Parameters::automatic_or;
  using Parameters::choice;
  using Parameters::PositiveDouble;

  void
  ParameterTexts::declare_cracks(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Cracks");
    prm.add_parameter(
      "pre-cracks",
      pre_cracks,
      "Cracks that are there from the start, not meshed: edge: "
      "0 0 to 0.5 0; bent: 1 0 to 1 0.2 to 1.1 0.3. In 3D the "
      "corners of flat convex polygons. 'edge: group NAME': "
      "the lines or triangles of a physical group of the mesh "
      "file. An end at the surface opens it. Peridynamics is "
      "placed around them. With Mode = finite elements they cut "
      "nothing and must lie on slits of the mesh, along nodes "
      "that are double, the tips excepted.",
      Anything());
    prm.add_parameter(
      "treatment",
      crack_treatment,
      "consistent: cracks are free surfaces to round-off. shape tensor: bonds "
      "that cross are left out, nothing more; for comparison.",
      choice({"consistent", "shape tensor"}));
    prm.add_parameter(
      "growth",
      crack_growth,
      "none; segments: cracks grow by straight advances where the energy that "
      "an advance releases is the fracture energy (2D, linear or not). bonds: "
      "bonds of the core break one by one where 'criterion' says; cracks "
      "start, branch and meet freely, but follow the rows of regular meshes "
      "(linear problems).",
      choice({"none", "segments", "bonds"}));
    prm.add_parameter(
      "criterion",
      criterion,
      "Of growth = bonds: where a bond breaks. critical energy: its energy "
      "over the volumes of its ends is that of a crack of 'fracture energy'. "
      "critical stretch: its stretch is, or is 'critical stretch'; with the "
      "correspondence model load and path depend more on the mesh. bond "
      "strain, equivalent strain, volumetric strain, maximum principal stress: "
      "by strain or stress of the particles at its ends; find where damage "
      "starts, but cracks become wide bands. tsai-hill, maximum stress: by "
      "the stress along and across the fibres (axis 1) of both and "
      "'strengths'; see 'strength failure'. automatic: critical energy; "
      "model = bond based: critical stretch.",
      choice(automatic_or(Damage::criterion_names())));
    prm.add_parameter(
      "energy calibration",
      energy_calibration,
      "Of growth = bonds: kappa, by which the energy of a bond at break is "
      "divided so that cracks grow at the fracture energy: measured with a "
      "known crack and kappa = 1 as its energy release rate at growth over "
      "G_c. 0: measured values for horizon ratios of 2 to 3 in plane stress "
      "(3.04 to 2; coupling = energy blending: 1.75 to 1.26); critical "
      "stretch: 1.",
      Double(0.));
    prm.add_parameter(
      "softening teeth",
      softening_teeth,
      "Of growth = bonds: bonds soften in so many steps. Model = bond based: "
      "from their largest force to none at four times its stretch, with the "
      "energy of a bond that breaks at once (1 step); cracks grow nearer to "
      "the fracture energy. Both models with 'softening stretch': by that law.",
      Integer(1));
    prm.add_parameter("fracture energy",
                      fracture_energy,
                      "G_c [stress * length]; energy per area of crack.",
                      Double(0.));
    prm.add_parameter("critical stretch",
                      critical_stretch,
                      "s_cr [-] of criterion = critical stretch, instead of a "
                      "'fracture energy'; 0: from that.",
                      Double(0.));
    prm.add_parameter(
      "softening stretch",
      softening_stretch,
      "s_min [-], less than 'critical stretch': bonds soften between both as "
      "(1 - tanh(beta (2 s - s_min - s_cr) / (s_cr - s_min))) / 2, in "
      "'softening teeth' steps. 0: they do not.",
      Double(0.));
    prm.add_parameter("softening steepness",
                      softening_steepness,
                      "beta [-] of 'softening stretch'.",
                      PositiveDouble());
    prm.add_parameter("critical bond strain",
                      critical_bond_strain,
                      "Of criterion = bond strain: |eta_d| / |xi| [-], the "
                      "deviatoric strain of the bond, under tension.",
                      Double(0.));
    prm.add_parameter("critical equivalent strain",
                      critical_equivalent_strain,
                      "Of criterion = equivalent strain: sqrt(2/3 e : e) [-] "
                      "of the deviator e.",
                      Double(0.));
    prm.add_parameter("critical volumetric strain",
                      critical_volumetric_strain,
                      "Of criterion = volumetric strain: trace of the strain "
                      "[-].",
                      Double(0.));
    prm.add_parameter("tensile strength",
                      tensile_strength,
                      "Of criterion = maximum principal stress: f_t [stress].",
                      Double(0.));
    prm.add_parameter(
      "cohesion",
      cohesion,
      "Of criterion = maximum principal stress: C [stress]; bonds also break "
      "by shear where (s1 - s3) / 2 = C cos phi - (s1 + s3) / 2 sin phi "
      "(Mohr-Coulomb, tension positive). 0: they do not.",
      Double(0.));
    prm.add_parameter("friction angle",
                      friction_angle,
                      "phi [degrees] of Mohr-Coulomb, with 'cohesion'.",
                      Double(0., 89.));
    prm.add_parameter(
      "strengths",
      strengths,
      "Of criterion = tsai-hill, maximum stress: X = 1670, Y = 60, S = 70 "
      "[stress], tensile strengths along axis 1 of the material and across "
      "it, and of shear along it. Compression does not count.",
      Anything());
    prm.add_parameter("strengths by volume",
                      strengths_by_volume,
                      "Other strengths in volumes of 'Material / by volume': "
                      "inclusion: X = 2100, Y = 120, S = 135; ...",
                      Anything());
    prm.add_parameter(
      "interface strengths",
      interface_strengths,
      "Of bonds with an end between two volumes of 'Material / by volume' (or "
      "'rest', what is in none): rest, inclusion: X = 1670, Y = 48, S = 56; "
      "... As strong as the material of the bond where nothing is given.",
      Anything());
    prm.add_parameter(
      "strength failure",
      strength_failure,
      "Of criterion = tsai-hill, maximum stress: what an overloaded bond "
      "breaks. planes: a plane along the fibres (across them where the fibres "
      "fail) opens through the bond, one horizon wide, and cuts all bonds that "
      "cross it: cracks run along the fibres. bonds: the bond alone; damage "
      "becomes wide bands that hardly follow the fibres.",
      choice({"planes", "bonds"}));
    prm.add_parameter(
      "hand over length",
      hand_over_length,
      "Of growth = bonds in 2D: once broken bonds form a crack of this length "
      "(or in horizons: '3 horizons') it becomes a line, tips where the energy "
      "changes least, and cracks grow by segments while they have tips; needs "
      "the 'fracture energy'. No bond breaks meanwhile. never: bonds only.",
      Anything());
    prm.add_parameter("protected boundaries",
                      protected_boundaries,
                      "Of growth = bonds: bonds with an end within one horizon "
                      "of these boundaries never break: top, bottom.",
                      Anything());
    prm.add_parameter("protected materials",
                      protected_materials,
                      "Of growth = bonds: bonds with an end in these volumes "
                      "never break: inclusion, ...",
                      Anything());
    prm.add_parameter(
      "protected regions",
      protected_regions,
      "Of growth = bonds: bonds with an end there never break, separated by "
      "';': box x0 y0 x1 y1 | ball x y r | within one horizon of point x y | "
      "segment x0 y0 x1 y1 | plane px py nx ny (with z in 3D).",
      Anything());
    prm.add_parameter("advance length",
                      advance_length,
                      "Of one advance: a length, or in horizons: '1 horizons'.",
                      Anything());
    prm.add_parameter(
      "growth control",
      growth_control,
      "load steps: at the loads of each step cracks grow while they can. "
      "events: at the t at which each advance is just possible, past the end "
      "time or below it; snap-back included. Linear problems scale the loads, "
      "which must be multiples of t; others follow them up and down.",
      choice({"load steps", "events"}));
    prm.add_parameter("maximum advances",
                      maximum_advances,
                      "The run stops after so many; with growth = bonds, after "
                      "so many events.",
                      Integer(1));
    prm.leave_subsection();
  }
} // namespace Perimorph::Application
