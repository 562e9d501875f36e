#include <perimorph/application/simulation_parameters.h>

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
      region.core_size = {pre_cracks.empty() || texts.crack_growth == "bonds"
                            ? 2.
                          : texts.crack_growth == "segments" ? 4.
                                                             : 5.,
                          true,
                          false};
    growth.active           = texts.crack_growth != "none";
    growth.bonds            = texts.crack_growth == "bonds";
    growth.events           = growth.active && texts.growth_control == "events";
    growth.fracture_energy  = texts.fracture_energy;
    growth.maximum_advances = texts.maximum_advances;
    growth.advance = Parameters::parse_length("Cracks / advance length",
                                              texts.advance_length,
                                              false,
                                              errors);
    if (!pre_cracks.empty() && region.mode == Mesh::Mode::finite_elements)
      errors.add_parameter("Cracks / pre-cracks",
                           "cracks with Mode = finite elements",
                           "coupled, peridynamics",
                           "Elements cannot be cut; a crack in the mesh needs "
                           "no entry here.");
    if (!pre_cracks.empty() && compare_with_finite_elements)
      errors.add_parameter("Quantities / compare with finite elements",
                           "true with cracks",
                           "false",
                           "Elements cannot be cut.");
    if (!pre_cracks.empty() &&
        coupling.scheme == Coupling::Scheme::force_blending)
      errors.add_parameter("Peridynamics / coupling",
                           "'force blending' with cracks",
                           "consistent, energy blending");
    if (!growth.active)
      return;
    if (growth.bonds)
      check_bond_breaking(texts, errors);
    if (dim == 3 && !growth.bonds)
      errors.add_parameter("Cracks / growth",
                           "'" + texts.crack_growth + "' in 3D",
                           "none",
                           "Cracks grow in 2D only.");
    if (!growth.bonds && pre_cracks.empty() && texts.pre_cracks.empty())
      errors.add_parameter("Cracks / growth",
                           "'" + texts.crack_growth + "' without a crack",
                           "at least one crack in 'Cracks / pre-cracks'");
    if (!(growth.fracture_energy > 0.))
      errors.add_parameter("Cracks / fracture energy",
                           "nothing or 0",
                           "a number > 0");
    if (growth.advance.value <= 0.)
      errors.add_parameter("Cracks / advance length",
                           "'" + texts.advance_length + "'",
                           "a length > 0");
    if (pre_cracks.empty() && region.mode == Mesh::Mode::finite_elements)
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
    growth.calibration = texts.energy_calibration;
    growth.criterion   = texts.criterion == "critical stretch"
                           ? Damage::Criterion::critical_stretch
                           : Damage::Criterion::critical_energy;
    if (coupling.model == Coupling::Model::bond_based &&
        texts.criterion == "critical energy")
      errors.add_parameter("Cracks / criterion",
                           "'critical energy' with model 'bond based'",
                           "critical stretch",
                           "Bonds of this model break by their stretch.");
    if (coupling.model == Coupling::Model::bond_based)
      errors.add_parameter("Cracks / growth",
                           "'bonds' with model 'bond based'",
                           "model = correspondence");
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

  template void
  SimulationParameters<2>::read_cracks(const ParameterTexts &,
                                       Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::read_cracks(const ParameterTexts &,
                                       Base::InputErrorCollector &);
  template void
  SimulationParameters<2>::check_bond_breaking(const ParameterTexts &,
                                               Base::InputErrorCollector &);
  template void
  SimulationParameters<3>::check_bond_breaking(const ParameterTexts &,
                                               Base::InputErrorCollector &);
} // namespace Perimorph::Application
