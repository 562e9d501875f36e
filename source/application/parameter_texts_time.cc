#include <perimorph/application/simulation_parameters.h>
#include <perimorph/parameters/patterns.h>

namespace Perimorph::Application
{
  using dealii::Patterns::Anything;
  using dealii::Patterns::Double;
  using dealii::Patterns::Integer;
  using Parameters::choice;

  void
  ParameterTexts::declare_time_integration(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Time integration");
    prm.add_parameter(
      "scheme",
      scheme,
      "static: equilibrium at each load step, by Newton's method. relaxation: "
      "the same equilibrium by adaptive dynamic relaxation, without a matrix. "
      "explicit: motion by velocity Verlet (central differences) with lumped "
      "mass, without a matrix. implicit: motion by the generalised-alpha "
      "method, through Newton's method. Motion needs 'Material / density'; t "
      "runs from 0 to 'Load steps / end time'.",
      choice(time_scheme_names()));
    prm.add_parameter("time step",
                      time_step,
                      "Of motion [time]; 0: explicit: 'safety factor' times "
                      "the stability limit; implicit: ten times that. Steps "
                      "are shortened so that outputs fall on their times.",
                      Double(0.));
    prm.add_parameter("safety factor",
                      safety_factor,
                      "Part of the stability limit 2 / omega that explicit "
                      "steps use; omega, the highest frequency, is computed "
                      "from the stiffness at the start and again when bonds "
                      "break, the peridynamic region changes or, at finite "
                      "strain, the body deforms.",
                      Double(0.01, 1.));
    prm.add_parameter("spectral radius",
                      spectral_radius,
                      "Of implicit motion at the highest frequencies: 1 keeps "
                      "all energy, less damps what steps cannot follow.",
                      Double(0., 1.));
    prm.add_parameter("output interval",
                      output_interval,
                      "Time between the rows of quantities.csv and "
                      "time_steps.csv of a motion; 0: end time / number of "
                      "steps, or 100 rows if there is one step.",
                      Double(0.));
    prm.add_parameter("field interval",
                      field_interval,
                      "Time between the field files of a motion; 0: end time / "
                      "20.",
                      Double(0.));
    prm.add_parameter("initial displacement",
                      initial_displacement,
                      "Of motion at t = 0: x = ..., y = ...; zero by default.",
                      Anything());
    prm.add_parameter("initial velocity",
                      initial_velocity,
                      "Of motion at t = 0: x = 100*x/0.254; zero by default.",
                      Anything());
    prm.add_parameter("maximum relaxation steps",
                      maximum_relaxation_steps,
                      "Of scheme = relaxation, per load step; they count as "
                      "linear iterations.",
                      Integer(1));
    prm.leave_subsection();
  }
} // namespace Perimorph::Application
