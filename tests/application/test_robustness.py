"""States and surroundings that once broke a run (found in review)."""

import csv
import os

from case_files import parameter_text
from harness import Failures, Runner, finish, parse_arguments

TWO_SQUARES = """SetFactory("OpenCASCADE");
DefineConstant[ n = {10, Name "n"} ];
Rectangle(1) = {0, 0, 0, 1, 1};
Rectangle(2) = {%(start)s, 0, 0, 1, 1};
%(join)s
Transfinite Curve{:} = n + 1;
Transfinite Surface{:};
Recombine Surface{:};
Physical Surface("A") = {1};
Physical Surface("B") = {2};
Physical Curve("left") = Curve In BoundingBox{-.1, -.1, -.1, .1, 1.1, .1};
Physical Curve("right") = Curve In BoundingBox{1.9, -.1, -.1, 2.1, 1.1, .1};
Physical Curve("facing") = Curve In BoundingBox{.9, -.1, -.1, 1.001, 1.1, .1};
Physical Curve("moved") = Curve In BoundingBox{1.01, -.1, -.1, 1.03, 1.1, .1};
"""
FLAT_CELLS = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Transfinite Curve{1, 3} = 9;
Transfinite Curve{2, 4} = 25;
Transfinite Surface{1};
Recombine Surface{1};
Physical Surface("A") = {1};
Physical Curve("left") = {4};
Physical Curve("right") = {2};
"""
BAR = """subsection Mesh
  set file = %(mesh)s
end
subsection Material
  set Young's modulus = 1
  set Poisson's ratio = 0.25
end
subsection Peridynamics
  set around         = point 1 0.5
  set core size      = 0.3
  set blending width = 0.2
end
subsection Output
  set fields = false
end
"""


def write(folder, name, text):
    with open(os.path.join(folder, name), "w") as file:
        file.write(text)


def bar(runner, start, join, words, ranks=1):
    folder = runner.new_folder()
    write(folder, "bar.geo", TWO_SQUARES % {"start": start, "join": join})
    write(folder, "bar.prm", BAR % {"mesh": "bar.geo"})
    arguments = ["bar.prm", "--output", "out"]
    for word in words:
        arguments += ["--set", word]
    return runner.run(arguments, ranks, folder)


FRAGMENTS = "BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }"


def tiny_strains(runner, failures):
    """The strain is formed from grad u, not from F - I: any load will do."""
    for load in ("1e-2", "1e-9"):
        failures.begin("K_t at a traction of %s MPa" % load)
        outcome = runner.run_case(
            "plate_with_hole.prm",
            ["Boundary conditions/traction=right: x = " + load,
             "Quantities/nominal stress=" + load, "Output/fields=false",
             "Mesh/geometry parameters=nt = 20, nr = 36"])
        if failures.check(outcome.code == 0, "exit %d" % outcome.code):
            results = outcome.results()
            value = outcome.value("stress_concentration")
            failures.check(results["counts"]["newton_iterations"] == 1,
                           "more than one iteration")
            tiny_strains.first = getattr(tiny_strains, "first", value)
            failures.check_close("K_t", value, tiny_strains.first, 1e-9)
        failures.end(outcome)


def two_materials(runner, failures):
    """An interface inside the region, against finite elements alone."""
    for model in ("correspondence", "bond based"):
        for modulus in ("10", "1000"):
            failures.begin("interface 1:%s, %s" % (modulus, model))
            outcome = bar(runner, "1", FRAGMENTS, [
                "Peridynamics/model=" + model,
                "Material/by volume=B: Young's modulus = " + modulus,
                "Boundary conditions/displacement=left: x = 0, y = 0",
                "Boundary conditions/traction=right: x = 0.1",
                "Quantities/point=end: 2 0.5",
                "Quantities/compare with finite elements=true",
            ])
            if failures.check(outcome.code == 0, "exit %d" % outcome.code):
                results = outcome.results()
                own = outcome.value("end_displacement_x")
                other = results["companion"]["quantities"][
                    "end_displacement_x"]["value"]
                failures.check_close("displacement of the end", own, other,
                                     0.01)
                failures.check_below("ghost force",
                                     results["checks"]["ghost_force"], 1e-10)
                failures.check_below("energy balance",
                                     results["checks"]["energy_balance"],
                                     1e-8)
            failures.end(outcome)


def gap(runner, failures):
    """Two pieces 0.02 apart, one moved rigidly: no stress in either."""
    for coupling in ("consistent", "energy blending"):
        for model in ("correspondence", "bond based"):
            failures.begin("gap, %s, %s" % (model, coupling))
            outcome = bar(runner, "1.02", "", [
                "Peridynamics/model=" + model,
                "Peridynamics/coupling=" + coupling,
                "Boundary conditions/displacement=left: x = 0, y = 0; "
                "moved: x = 0.1, y = 0",
                "Quantities/point=near: 1 0.5; far: 1.02 0.5",
                "Quantities/reaction=left",
            ])
            if failures.check(outcome.code == 0, "exit %d" % outcome.code):
                for name in ("near_stress_xx", "far_stress_xx",
                             "reaction_left_x"):
                    failures.check_below(name, abs(outcome.value(name)), 1e-9)
            failures.end(outcome)


def unloading(runner, failures):
    """A state without load keeps the scale of the earlier ones."""
    failures.begin("unloaded state")
    outcome = bar(runner, "1", FRAGMENTS, [
        "Boundary conditions/displacement=left: x = 0, y = 0",
        "Boundary conditions/traction=right: x = 0.1*sin(pi*t)",
        "Load steps/number of steps=4",
    ])
    if failures.check(outcome.code == 0, "exit %d" % outcome.code):
        failures.check("Warning" not in outcome.text, "a warning")
        with open(outcome.path("load_steps.csv")) as file:
            rows = list(csv.DictReader(file))
        failures.check(len(rows) == 4, "%d rows" % len(rows))
        for row in rows:
            failures.check_below("imbalance", float(row["imbalance"]), 1e-8)
        failures.check_close("work at half the way",
                             float(rows[1]["external_work"]),
                             float(rows[1]["strain_energy"]), 1e-8)
        failures.check_below("work of the cycle",
                             abs(float(rows[3]["external_work"])),
                             1e-8 * float(rows[1]["external_work"]))
    failures.end(outcome)


def unwritable_files(runner, failures):
    """Rank 0 cannot write: all ranks stop."""
    for name in ("newton.csv", "solution_0001.vtu", "probe_points.csv"):
        failures.begin("%s cannot be written, 2 ranks" % name)
        folder = runner.new_folder()
        os.makedirs(os.path.join(folder, "out", name, "full"))
        write(folder, "bar.geo", TWO_SQUARES % {"start": "1",
                                                "join": FRAGMENTS})
        write(folder, "bar.prm", BAR % {"mesh": "bar.geo"})
        outcome = runner.run(
            ["bar.prm", "--output", "out", "--set", "Output/fields=true",
             "--set", "Quantities/point=end: 2 0.5", "--set",
             "Boundary conditions/displacement=left: x = 0, y = 0; "
             "right: x = 0.1"], 2, folder, timeout=60)
        failures.check(outcome.code == 2, "exit %d, not 2" % outcome.code)
        failures.check(name in outcome.text, "the file is not named")
        failures.end(outcome)


def far_from_the_origin(runner, failures):
    """Points are found in a small cell at large coordinates."""
    failures.begin("probes at x = 1000")
    folder = runner.new_folder()
    write(
        folder, "bar.geo", 'SetFactory("OpenCASCADE");\n'
        "Rectangle(1) = {1000, 0, 0, 1, 1};\n"
        "Mesh.CharacteristicLengthMax = 0.1;\nMesh.RecombineAll = 1;\n"
        "Mesh.RecombinationAlgorithm = 3;\n"
        'Physical Surface("A") = {1};\nPhysical Curve("right") = {2};\n'
        'Physical Curve("left") = {4};\n')
    write(folder, "bar.prm", BAR % {"mesh": "bar.geo"})
    outcome = runner.run(
        ["bar.prm", "--output", "out", "--set",
         "Peridynamics/around=point 1000.5 0.5", "--set",
         "Boundary conditions/displacement=left: x = 0, y = 0; right: x = 0.1",
         "--set", "Quantities/line=middle: 1000.01 0.013 to 1000.99 0.987, "
         "101 points"], 1, folder)
    failures.check(outcome.code == 0, "exit %d" % outcome.code)
    failures.end(outcome)


def advice(runner, failures):
    """What harms stability (doc/stability) is said before the solve."""
    loaded = ["Boundary conditions/displacement=left: x = 0, y = 0",
              "Boundary conditions/traction=right: x = 1e-3"]
    bonds = ["Peridynamics/model=bond based"]
    finite = ["Material/law=prototype microelastic"]
    everywhere = ["Mode=peridynamics"]
    for name, words, expected in (
        ("usual entries", [], None),
        ("no stabilisation", ["Peridynamics/stabilization=0"],
         "zero-energy modes"),
        ("strong stabilisation", ["Peridynamics/stabilization=5"],
         "bending becomes too stiff"),
        ("wide families", ["Peridynamics/horizon ratio=4",
                           "Peridynamics/gradient support=horizon"],
         "horizon ratio of 4"),
        ("wide families, narrow gradients", ["Peridynamics/horizon ratio=4"],
         None),
        ("nearly incompressible", ["Material/Poisson's ratio=0.49"],
         "nearly incompressible"),
        ("the same in plane stress", ["Material/Poisson's ratio=0.49",
                                      "Material/state=plane stress"], None),
        ("auxetic", ["Material/Poisson's ratio=-0.5"], None),
        ("wide bonds", bonds + finite + everywhere +
         ["Peridynamics/horizon ratio=3"], "lose stability"),
        ("wide bonds at small strain", bonds + everywhere +
         ["Peridynamics/horizon ratio=3"], None),
    ):
        failures.begin("advice: " + name)
        outcome = bar(runner, "1", FRAGMENTS, loaded + words)
        if failures.check(outcome.code == 0, "exit %d" % outcome.code):
            warnings = outcome.results()["warnings"]
            if expected is None:
                failures.check(not warnings, "warnings: %s" % warnings)
            else:
                failures.check(any(expected in text for text in warnings),
                               "no warning with '%s'" % expected)
        failures.end(outcome)
    for name, model, expected in (
        ("families", "correspondence", "bending along the long sides"),
        ("bonds", "bond based", "indefinite")):
        failures.begin("advice: flat cells, " + name)
        folder = runner.new_folder()
        write(folder, "bar.geo", FLAT_CELLS)
        write(folder, "bar.prm", BAR % {"mesh": "bar.geo"})
        outcome = runner.run(
            ["bar.prm", "--validate", "--set", "Peridynamics/model=" + model,
             "--set", loaded[0], "--set", loaded[1]], 1, folder)
        if failures.check(outcome.code == 0, "exit %d" % outcome.code):
            failures.check(expected in outcome.text,
                           "no warning with '%s'" % expected)
        failures.end(outcome)


MOVING = {"Material/density": "1", "Boundary conditions/symmetry": None,
          "Boundary conditions/traction": None}
PRESSED = dict(MOVING, **{
    "Material/law": "hencky", "Material/state": "plane strain",
    "Boundary conditions/displacement": "bottom: x = 0, y = 0"})


def energies_of_motion(runner, failures):
    """Energy that comes from nothing, little and much, and steps that are too
    long for what a body has become."""
    for name, changes, code, expected in (
        # The limit is known to a tenth of a percent.
        ("no margin", dict(MOVING, **{
            "Material/state": "plane strain",
            "Mesh/geometry parameters": "n = 16",
            "Time integration/scheme": "explicit",
            "Time integration/safety factor": "1",
            "Time integration/initial velocity": "y = sin(9*x)*sin(11*y)",
            "Load steps/end time": "30", "Load steps/number of steps": "4",
        }), 3, "the motion gains energy from nothing: at t = 7.5"),
        ("long steps", dict(PRESSED, **{
            "Time integration/scheme": "implicit",
            "Time integration/spectral radius": "1",
            "Time integration/time step": "0.01",
            "Time integration/initial velocity": "y = -20*y",
            "Load steps/number of steps": "50",
        }), 0, "Warning: the energy drifts by "),
        ("a limit that falls", dict(PRESSED, **{
            "Time integration/scheme": "explicit",
            "Time integration/time step": "0.0018",
            "Boundary conditions/displacement":
            "bottom: x = 0, y = 0; top: x = 0, y = -0.5*t^2",
            "Load steps/number of steps": "20",
        }), 3, "the limit of stable time steps is "),
    ):
        failures.begin("motion: " + name)
        folder = runner.new_folder()
        write(folder, "case.prm", parameter_text(changes))
        outcome = runner.run(["case.prm", "--output", "out"], 1, folder)
        failures.check(outcome.code == code, "exit %d" % outcome.code)
        failures.check(expected in outcome.text,
                       "no message with '%s'" % expected)
        # The last state is there and can be gone on from.
        failures.check(os.path.exists(outcome.path("checkpoint")),
                       "no checkpoint")
        failures.check_clean(outcome.text)
        failures.end(outcome)


def main():
    arguments = parse_arguments(__doc__)
    failures = Failures()
    runner = Runner(arguments)
    for case in (tiny_strains, two_materials, gap, unloading,
                 unwritable_files, far_from_the_origin, advice,
                 energies_of_motion):
        case(runner, failures)
    finish(failures)


if __name__ == "__main__":
    main()
