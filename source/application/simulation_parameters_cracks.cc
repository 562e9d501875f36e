#include <perimorph/application/simulation_parameters.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace Perimorph::Application
{
  template <int dim>
  void
  SimulationParameters<dim>::read_cracks(const ParameterTexts      &texts,
                                         Base::InputErrorCollector &errors)
  {
    coupling.crack_rule = texts.crack_treatment == "consistent"
                            ? Coupling::CrackRule::consistent
                            : Coupling::CrackRule::shape_tensor;
    pre_cracks          = Parameters::parse_polylines("Cracks / pre-cracks",
                                             texts.pre_cracks,
                                             dim,
                                             errors);
    // Domain integrals are best where one method carries all of the annulus
    // (doc/theory, 12).
    if (region.core_size.automatic)
      region.core_size = {texts.crack_growth == "bonds"
                            ? (texts.hand_over_length == "never" ? 2. : 4.)
                          : pre_cracks.empty()               ? 2.
                          : texts.crack_growth == "segments" ? 4.
                                                             : 5.,
                          true,
                          false};
    growth.active            = texts.crack_growth != "none";
    growth.bonds             = texts.crack_growth == "bonds";
    coupling.bonds_may_break = growth.bonds;
    growth.events           = growth.active && texts.growth_control == "events";
    growth.fracture_energy  = texts.fracture_energy;
    growth.maximum_advances = texts.maximum_advances;
    growth.advance = Parameters::parse_length("Cracks / advance length",
                                              texts.advance_length,
                                              false,
                                              errors);
    if (!pre_cracks.empty() && compare_with_finite_elements &&
        region.mode != Mesh::Mode::finite_elements)
      errors.add_parameter("Quantities / compare with finite elements",
                           "true with cracks",
                           "false",
                           "Elements cannot be cut; compare with a run of its "
                           "own whose mesh has a slit.");
    if (!pre_cracks.empty() &&
        coupling.scheme == Coupling::Scheme::force_blending)
      errors.add_parameter("Peridynamics / coupling",
                           "'force blending' with cracks",
                           "consistent, energy blending");
    for (const auto &[entry, text] : std::map<std::string, std::string>{
           {"protected boundaries", texts.protected_boundaries},
           {"protected materials", texts.protected_materials},
           {"protected regions", texts.protected_regions}})
      if (!text.empty() && !growth.bonds)
        errors.add_parameter("Cracks / " + entry,
                             "'" + text + "' with growth '" +
                               texts.crack_growth + "'",
                             "growth = bonds");
    read_hand_over(texts, errors);
    if (!growth.active)
      return;
    if (growth.bonds)
      {
        check_bond_breaking(texts, errors);
        read_bond_limits(texts, errors);
        read_strengths(texts, errors);
        read_protection(texts, errors);
      }
    if (dim == 3 && !growth.bonds)
      errors.add_parameter("Cracks / growth",
                           "'" + texts.crack_growth + "' in 3D",
                           "none",
                           "Cracks grow in 2D only.");
    if (!growth.bonds && pre_cracks.empty() && texts.pre_cracks.empty())
      errors.add_parameter("Cracks / growth",
                           "'" + texts.crack_growth + "' without a crack",
                           "at least one crack in 'Cracks / pre-cracks'");
    if (!growth.bonds && !(growth.fracture_energy > 0.))
      errors.add_parameter("Cracks / fracture energy",
                           "nothing or 0",
                           "a number > 0");
    if (growth.advance.value <= 0.)
      errors.add_parameter("Cracks / advance length",
                           "'" + texts.advance_length + "'",
                           "a length > 0");
    if (region.mode == Mesh::Mode::finite_elements)
      errors.add_parameter("Cracks / growth",
                           "'" + texts.crack_growth +
                             "' with Mode = finite elements",
                           "coupled, peridynamics",
                           "Elements cannot be cut.");
    if (coupling.scheme != Coupling::Scheme::consistent && !growth.bonds)
      errors.add_parameter("Cracks / growth",
                           "'" + texts.crack_growth + "' with coupling '" +
                             texts.coupling + "'",
                           "coupling = consistent");
    if (growth.events && texts.control != "load")
      errors.add_parameter("Cracks / growth control",
                           "'events' with arc length",
                           "load steps",
                           "Events find their own loads.");
  }

  template <int dim>
  void
  SimulationParameters<dim>::check_bond_breaking(
    const ParameterTexts      &texts,
    Base::InputErrorCollector &errors)
  {
    const bool  bond_based = coupling.model == Coupling::Model::bond_based;
    const auto &names      = Damage::criterion_names();
    growth.n_teeth =
      bond_based || texts.softening_stretch > 0. ? texts.softening_teeth : 1;
    growth.criterion =
      texts.criterion == "automatic"
        ? (bond_based ? Damage::Criterion::critical_stretch
                      : Damage::Criterion::critical_energy)
        : static_cast<Damage::Criterion>(
            std::find(names.begin(), names.end(), texts.criterion) -
            names.begin());
    if (bond_based && growth.criterion != Damage::Criterion::critical_stretch)
      errors.add_parameter("Cracks / criterion",
                           "'" + texts.criterion + "' with model 'bond based'",
                           "critical stretch",
                           "Bonds of this model break by their stretch.");
    const bool sees_strain =
      growth.criterion == Damage::Criterion::bond_strain ||
      growth.criterion == Damage::Criterion::equivalent_strain ||
      growth.criterion == Damage::Criterion::volumetric_strain;
    if (sees_strain && !knows_thickness_strain())
      errors.add_parameter("Cracks / criterion",
                           "'" + texts.criterion +
                             "' in plane stress with a law that does not know "
                             "the strain of the thickness",
                           "orthotropic laws with nu13 and nu23",
                           "Or a criterion of stress or energy.");
    if (has_anisotropic_laws() && texts.critical_stretch == 0. &&
        growth.criterion == Damage::Criterion::critical_stretch)
      errors.add_parameter("Cracks / critical stretch",
                           "nothing with a law that is not isotropic",
                           "a number > 0, or another criterion",
                           "The stretch that belongs to a fracture energy is "
                           "known for isotropic laws only.");
    if (coupling.scheme == Coupling::Scheme::force_blending)
      errors.add_parameter("Cracks / growth",
                           "'bonds' with coupling 'force blending'",
                           "coupling = consistent, energy blending",
                           "Forces blended have no energy.");
    if (finite_strain() || texts.control != "load")
      errors.add_parameter("Cracks / growth",
                           "'bonds' in a nonlinear problem",
                           "law = linear elastic, control = load",
                           "Or 'growth = segments' with load steps.");
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_bond_limits(const ParameterTexts      &texts,
                                              Base::InputErrorCollector &errors)
  {
    using Damage::Criterion;
    auto &limits               = growth.limits;
    limits.fracture_energy     = texts.fracture_energy;
    limits.calibration         = texts.energy_calibration;
    limits.stretch             = texts.critical_stretch;
    limits.softening_stretch   = texts.softening_stretch;
    limits.softening_steepness = texts.softening_steepness;
    limits.bond_strain         = texts.critical_bond_strain;
    limits.equivalent_strain   = texts.critical_equivalent_strain;
    limits.volumetric_strain   = texts.critical_volumetric_strain;
    limits.tensile_strength    = texts.tensile_strength;
    limits.cohesion            = texts.cohesion;
    limits.friction_angle      = texts.friction_angle;

    struct Entry
    {
      std::string name;
      double      value;
      bool        used, required;
    };
    const auto is = [this](const Criterion criterion) {
      return growth.criterion == criterion;
    };
    const bool stretch = is(Criterion::critical_stretch);
    const bool given   = stretch && limits.stretch > 0.;
    const bool by_energy =
      (stretch && !given) || is(Criterion::critical_energy);
    const bool        stress = is(Criterion::principal_stress);
    const bool        bond   = is(Criterion::bond_strain);
    const bool        equal  = is(Criterion::equivalent_strain);
    const bool        volume = is(Criterion::volumetric_strain);
    const std::string criterion =
      Damage::criterion_names()[static_cast<int>(growth.criterion)];
    for (const auto &entry : std::vector<Entry>{
           {"fracture energy",
            limits.fracture_energy,
            by_energy || growth.hand_over,
            by_energy || growth.hand_over},
           {"energy calibration", limits.calibration, by_energy, false},
           {"critical stretch", limits.stretch, stretch, false},
           {"softening stretch", limits.softening_stretch, given, false},
           {"critical bond strain", limits.bond_strain, bond, bond},
           {"critical equivalent strain",
            limits.equivalent_strain,
            equal,
            equal},
           {"critical volumetric strain",
            limits.volumetric_strain,
            volume,
            volume},
           {"tensile strength", limits.tensile_strength, stress, stress},
           {"cohesion", limits.cohesion, stress, false},
           {"friction angle",
            limits.friction_angle,
            stress && limits.cohesion > 0.,
            false}})
      if (entry.required && !(entry.value > 0.))
        errors.add_parameter(
          "Cracks / " + entry.name,
          "nothing or 0",
          "a number > 0",
          entry.name == "fracture energy" && !by_energy
            ? "Cracks grow by it behind the 'hand over length'."
            : "The criterion is '" + criterion + "'" +
                (stretch ? "; or give a 'critical stretch'." : "."));
      else if (!entry.used && entry.value > 0.)
        {
          std::ostringstream found;
          found << entry.value << " with criterion '" << criterion << "'"
                << (given ? " and a 'critical stretch'" : "");
          errors.add_parameter("Cracks / " + entry.name,
                               found.str(),
                               "nothing",
                               "The criterion does not ask for it.");
        }
    if (given && limits.softening_stretch >= limits.stretch)
      {
        std::ostringstream found, allowed;
        found << limits.softening_stretch;
        allowed << "less than the critical stretch, " << limits.stretch;
        errors.add_parameter("Cracks / softening stretch",
                             found.str(),
                             allowed.str());
      }
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_hand_over(const ParameterTexts      &texts,
                                            Base::InputErrorCollector &errors)
  {
    if (texts.hand_over_length == "never")
      return;
    const std::string entry    = "Cracks / hand over length";
    const std::string found    = "'" + texts.hand_over_length + "'";
    const auto        n_errors = errors.size();
    const auto        length =
      Parameters::parse_length(entry, texts.hand_over_length, false, errors);
    growth.hand_over = length;
    if (errors.size() > n_errors)
      return;
    if (!growth.bonds)
      errors.add_parameter(entry,
                           found + " with growth '" + texts.crack_growth + "'",
                           "never, or growth = bonds",
                           "Cracks that bonds make are handed over.");
    else if (dim == 3)
      errors.add_parameter(entry,
                           found + " in 3D",
                           "never",
                           "Segments grow in 2D only.");
    else if (coupling.scheme != Coupling::Scheme::consistent)
      errors.add_parameter(entry,
                           found + " with coupling '" + texts.coupling + "'",
                           "never, or coupling = consistent",
                           "Segments need it.");
    else if (length.in_horizons ? length.value < 1. : !(length.value > 0.))
      errors.add_parameter(entry,
                           found,
                           "never, or a length of at least '1 horizons'",
                           "Few broken bonds have no direction.");
  }

  template <int dim>
  void
  SimulationParameters<dim>::read_protection(const ParameterTexts      &texts,
                                             Base::InputErrorCollector &errors)
  {
    using Parameters::Feature;
    using Parameters::FeatureKind;
    auto &features = growth.protected_features;
    features       = Parameters::parse_features("Cracks / protected regions",
                                          texts.protected_regions,
                                          dim,
                                          errors);
    for (const auto &feature : features)
      if (feature.kind == FeatureKind::boundary ||
          feature.kind == FeatureKind::volume)
        errors.add_parameter(
          "Cracks / protected regions",
          "'" + feature.name + "'",
          "point, segment, plane, box, ball",
          feature.kind == FeatureKind::volume
            ? "Volumes belong to 'Cracks / protected materials'."
            : "Names belong to 'Cracks / protected boundaries'.");
    const auto add = [&](const std::string &entry,
                         const std::string &text,
                         const FeatureKind  kind) {
      for (const auto &name :
           Parameters::parse_names("Cracks / " + entry, text, errors))
        features.push_back(Feature{kind, name, {}});
    };
    add("protected boundaries",
        texts.protected_boundaries,
        FeatureKind::boundary);
    add("protected materials", texts.protected_materials, FeatureKind::volume);
  }

  template void
  SimulationParameters<2>::read_cracks(const ParameterTexts &,
                                       Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::read_cracks(const ParameterTexts &,
                                       Base::InputErrorCollector &);
  template void
  SimulationParameters<2>::read_bond_limits(const ParameterTexts &,
                                            Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::read_bond_limits(const ParameterTexts &,
                                            Base::InputErrorCollector &);
  template void
  SimulationParameters<2>::read_hand_over(const ParameterTexts &,
                                          Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::read_hand_over(const ParameterTexts &,
                                          Base::InputErrorCollector &);
  template void
  SimulationParameters<2>::read_protection(const ParameterTexts &,
                                           Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::read_protection(const ParameterTexts &,
                                           Base::InputErrorCollector &);
  template void
  SimulationParameters<2>::check_bond_breaking(const ParameterTexts &,
                                               Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::check_bond_breaking(const ParameterTexts &,
                                               Base::InputErrorCollector &);
} // namespace Perimorph::Application
