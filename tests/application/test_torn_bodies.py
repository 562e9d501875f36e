"""Bonds that break by every criterion, protected ones, and what is left of a
body in the end: isolated particles, all bonds broken at once, rigid pieces. Such
a run ends with 0 or 3 and a message, and its numbers are finite.

A unit square in plane stress, E = 1000, nu = 0.3, under a uniform stress of 20 t
along x, so that the load of the first bond is that of a formula (principal
stresses are right to 1e-8).
"""

import csv
import math
import os

from case_files import parameter_text
from harness import Failures, Runner, finish, parse_arguments

SQUARE = {
    "Mode": "peridynamics",
    "Peridynamics/around": None,
    "Peridynamics/core size": None,
    "Peridynamics/blending width": None,
    "Boundary conditions/traction": "right: x = 20*t",
    "Cracks/growth": "bonds",
}
EVENTS = {"Cracks/growth control": "events"}
PULLED = {
    "Boundary conditions/traction": None,
    "Boundary conditions/displacement": "right: x = 0.02*t",
}
STRETCH = {
    "Cracks/criterion": "critical stretch",
    "Cracks/critical stretch": "0.01",
}
# The field is uniform and the criterion knows no direction: every bond breaks.
ALL_AT_ONCE = {
    "Cracks/criterion": "equivalent strain",
    "Cracks/critical equivalent strain": "0.01",
}
AT_ONCE = .01 / (2. / 3. * 1.3 * .02)

# Every node flies away from its neighbours.
THROWN = {
    "Boundary conditions/symmetry": None,
    "Boundary conditions/traction": None,
    "Material/density": "1",
    "Time integration/scheme": "explicit",
    "Time integration/initial velocity": "x = 80*(x - 0.5), y = 80*(y - 0.5)",
    "Load steps/end time": "1",
    "Load steps/number of steps": "8",
}

# Load factor of the first bond. Strains at t = 1: 0.02, -0.006, -0.006.
CRITERIA = [
    ("stretch", STRETCH, .5),
    # the first of six teeth: tanh(x) = 1 - 2 (11/12)
    ("softening", dict(STRETCH, **{"Cracks/softening stretch": "0.0075"}),
     (.00875 + .00125 / 3. * math.atanh(-10. / 12.)) / .02),
    ("equivalent strain", ALL_AT_ONCE, AT_ONCE),
    ("volumetric strain", {
        "Cracks/criterion": "volumetric strain",
        "Cracks/critical volumetric strain": "0.006",
    }, .75),
    # bonds along x have most of the deviator
    ("bond strain", {
        "Cracks/criterion": "bond strain",
        "Cracks/critical bond strain": "0.01",
    }, .01 / (.02 - .008 / 3.)),
    ("tensile strength", {
        "Cracks/criterion": "maximum principal stress",
        "Cracks/tensile strength": "15",
    }, .75),
    ("Mohr-Coulomb under pressure", {
        "Cracks/criterion": "maximum principal stress",
        "Cracks/tensile strength": "1",
        "Cracks/cohesion": "5",
        "Cracks/friction angle": "30",
        "Boundary conditions/traction": "right: x = -40*t",
    }, 5. * math.cos(math.pi / 6.) / (.5 * (40. - 40. * .5))),
]


def solve(runner, *changes, ranks=1):
    folder = runner.new_folder()
    with open(os.path.join(folder, "case.prm"), "w") as file:
        file.write(parameter_text(SQUARE, *changes))
    return runner.run(["case.prm", "--output", "out"], ranks, folder)


def rows(outcome, name):
    with open(outcome.path(name)) as file:
        return [{key: float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


def check_end(failures, outcome):
    """0 or 3 with a reason; no number that is not one."""
    failures.check(outcome.code in (0, 3), "exit %d" % outcome.code)
    if outcome.code == 3:
        failures.check("the solve failed" in outcome.text, "no reason is given")
    for name in ("load_steps.csv", "broken_bonds.csv", "quantities.csv"):
        for row in rows(outcome, name):
            failures.check(all(map(math.isfinite, row.values())),
                           "%s: %s" % (name, row))
    failures.check_clean(outcome.text)


def criteria(runner, failures):
    for name, changes, expected in CRITERIA:
        failures.begin("first bond by " + name)
        outcome = solve(runner, changes, EVENTS, {"Cracks/maximum advances": "1"})
        if failures.check(outcome.code == 0, "exit %d" % outcome.code):
            bonds = rows(outcome, "broken_bonds.csv")
            failures.check_close("load", bonds[0]["load_factor"], expected, 1e-7)
        failures.end(outcome)


def protection(runner, failures):
    def near_right(x, y):
        return x > 1. - 2. / 8. - 1e-9

    def in_box(x, y):
        return x > .3 and y > .3

    for name, changes, inside in (
        ("boundary", {"Cracks/protected boundaries": "right"}, near_right),
        ("region", {"Cracks/protected regions": "box 0.3 0.3 1 1"}, in_box),
        ("material", {"Cracks/protected materials": "domain"},
         lambda x, y: True),
    ):
        failures.begin("protected " + name)
        outcome = solve(runner, STRETCH, PULLED, changes)
        if failures.check(outcome.code == 0, "exit %d" % outcome.code):
            bonds = []
            if name != "material":
                bonds = rows(outcome, "broken_bonds.csv")
                failures.check(bonds, "no bond broke")
            ends = [(bond["x" + k], bond["y" + k]) for bond in bonds
                    for k in "12"]
            failures.check(not any(inside(*end) for end in ends),
                           "a protected bond broke")
        failures.end(outcome)


def ends_of_bodies(runner, failures):
    whole = .5 * 20. * .02
    for ranks, name, changes in (
        (1, "torn by a load", [STRETCH]),
        (1, "torn by a load, events", [STRETCH, EVENTS]),
        (1, "torn by its end", [STRETCH, PULLED]),
        (1, "torn by its end, events", [STRETCH, PULLED, EVENTS]),
        (2, "torn by its end, 2 ranks", [STRETCH, PULLED]),
        (1, "torn by its weight", [STRETCH, {
            "Boundary conditions/traction": None,
            "Boundary conditions/body force": "x = 40*t"}]),
        (1, "torn without supports", [STRETCH, {
            "Boundary conditions/symmetry": None,
            "Boundary conditions/traction":
            "right: x = 20*t; left: x = -20*t"}]),
        (1, "middle held by nothing", [STRETCH, {
            "Cracks/protected regions": "box 0.3 0 0.7 1",
            "Boundary conditions/symmetry": None,
            "Boundary conditions/traction": None,
            "Boundary conditions/displacement":
            "right: x = 0.04*t, y = 0; left: x = -0.04*t, y = 0"}]),
        (1, "all bonds at once, load", [ALL_AT_ONCE]),
        (1, "all bonds at once, end", [ALL_AT_ONCE, PULLED]),
        (1, "all bonds at once, end, events", [ALL_AT_ONCE, PULLED, EVENTS]),
        (2, "all bonds at once, end, 2 ranks", [ALL_AT_ONCE, PULLED]),
        (3, "all bonds at once, end, 3 ranks", [ALL_AT_ONCE, PULLED]),
        (1, "all bonds at once, core that fills the body",
         [ALL_AT_ONCE, PULLED, {
             "Mode": "coupled", "Peridynamics/around": "point 0.5 0.5",
             "Peridynamics/core size": "0.1",
             "Peridynamics/blending width": "0.15"}]),
        (1, "all bonds at once, iterative solver",
         [ALL_AT_ONCE, PULLED, {"Solver/linear solver": "iterative"}]),
        (1, "torn with energy blending",
         [ALL_AT_ONCE, PULLED, {"Peridynamics/coupling": "energy blending"}]),
    ):
        failures.begin(name)
        outcome = solve(runner, *changes, ranks=ranks)
        check_end(failures, outcome)
        if "all bonds at once" in name and failures.check(
                outcome.code == 0, "exit %d" % outcome.code):
            counts = outcome.results()["counts"]
            failures.check(counts["events"] == 1,
                           "%d events" % counts["events"])
            failures.check(counts["isolated_particles"] == counts["nodes"],
                           "particles that are not isolated")
            last = rows(outcome, "load_steps.csv")[-1]
            # at the load at which they break
            failures.check_close(
                "energy of all bonds", last["dissipated_energy"],
                whole * AT_ONCE**2, 1e-9)
            if "load" not in name:
                failures.check_below("energy left", last["strain_energy"],
                                     1e-8 * whole)
        failures.end(outcome)


def thrown_apart(runner, failures):
    """Pieces without any stiffness fly on."""
    for ranks, name, changes in (
        (1, "families", {}),
        (2, "families, 2 ranks", {}),
        (1, "bonds", {"Peridynamics/model": "bond based",
                      "Material/Poisson's ratio": "0.3333333333333333"}),
        (1, "core that grows", {
            "Mode": "coupled", "Peridynamics/around": "point 0.5 0.5",
            "Peridynamics/core size": "0.1",
            "Peridynamics/blending width": "0.15"}),
    ):
        failures.begin("thrown apart, " + name)
        outcome = solve(runner, STRETCH, changes, THROWN, ranks=ranks)
        if failures.check(outcome.code == 0, "exit %d" % outcome.code):
            steps = rows(outcome, "time_steps.csv")
            for row in steps + rows(outcome, "quantities.csv"):
                failures.check(all(map(math.isfinite, row.values())), str(row))
            failures.check_below("strain energy left",
                                 steps[-1]["strain_energy"], 1e-12)
            failures.check_close("kinetic energy of pieces",
                                 steps[-1]["kinetic_energy"],
                                 steps[-2]["kinetic_energy"], 1e-12)
            failures.check_below("energy gained",
                                 steps[-1]["energy_balance"], .01)
        failures.check_clean(outcome.text)
        failures.end(outcome)


def main():
    arguments = parse_arguments(__doc__)
    failures = Failures()
    runner = Runner(arguments)
    for case in (criteria, protection, ends_of_bodies, thrown_apart):
        case(runner, failures)
    finish(failures)


if __name__ == "__main__":
    main()
