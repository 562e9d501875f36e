"""Counts of work of small cases against numbers that are committed: what makes
runs slower without changing a result. Seconds would depend on the machine.

Origin of the numbers: this program; --show prints those of today. Those that have a
limit may only get smaller: take smaller ones over, find out what made them larger.
"""

import os
import re
import sys

sys.path.insert(0, os.path.join(
    os.path.dirname(os.path.abspath(__file__)), "..", "application"))
from harness import Failures, Runner, finish, parse_arguments  # noqa: E402

QUIET = ["Quantities/compare with finite elements=false", "Output/fields=false"]

# name: (parameter file, entries, exact counts, largest counts); None: not there.
# Iterations may grow by 10 % of what they are, the number in the comment; "calls of"
# are those of a stage in the table of timings: a linear solver is set up in one,
# solves in another.
CASES = {
    "linear plate, three load steps, direct": (
        "plate_with_hole.prm",
        ["Mesh/geometry parameters=nt = 20, nr = 36",
         "Load steps/number of steps=3", "Solver/linear solver=direct"],
        {"nodes": 1517, "active_cells": 1096, "particles": 682, "bonds": 7275,
         "cells_without_element_work": 344, "nodes_without_particle": 835,
         "damage_pass": "no bond can break"},
        {"newton_iterations": 1, "linear_iterations": 1,
         "calls of linear_solver": 2, "calls of assembly": 5,
         "calls of families": 1, "calls of patch_test": 1}),
    "linear plate, three load steps, iterative": (
        "plate_with_hole.prm",
        ["Mesh/geometry parameters=nt = 20, nr = 36",
         "Load steps/number of steps=3", "Solver/linear solver=iterative"],
        {"nodes": 1517, "bonds": 7275, "nodes_without_particle": 835},
        {"newton_iterations": 1, "linear_iterations": 42,  # 38
         "calls of linear_solver": 2, "calls of assembly": 5}),
    "cavity, iterative": (
        "spherical_cavity.prm",
        ["Mesh/geometry parameters=n = 8, nr = 9",
         "Solver/linear solver=iterative"],
        {"nodes": 610, "active_cells": 336, "particles": 332, "bonds": 6870,
         "cells_without_element_work": 96, "nodes_without_particle": 278,
         "damage_pass": "no bond can break"},
        {"newton_iterations": 1, "linear_iterations": 36,  # 34
         "calls of linear_solver": 2, "calls of assembly": 3}),
    "centre crack, iterative": (
        "centre_crack_square_plate.prm",
        ["Mesh/geometry parameters=nx = 64, ny = 33, fy = 4.125, q = 1.1",
         "Solver/linear solver=iterative"],
        {"nodes": 9266},
        {"newton_iterations": 1, "linear_iterations": 101}),  # 92
    "cavity of a large strain, iterative": (
        "spherical_cavity.prm",
        ["Mesh/geometry parameters=n = 8, nr = 9", "Material/law=neo-hookean",
         "Boundary conditions/displacement="
         "outer: x = -0.05*x*t, y = -0.05*y*t, z = 0.2*z*t",
         "Reference/displacement=", "Reference/values=",
         "Peridynamics/gradient support=horizon",
         "Load steps/number of steps=2", "Solver/linear solver=iterative"],
        {"nodes": 610, "preconditioners": 5},
        {"newton_iterations": 7, "linear_iterations": 85,  # 78
         "calls of linear_solver": 14}),
    "cantilever, large deflection": (
        "cantilever_large_deflection.prm",
        ["Mesh/geometry parameters=L = 10, d = 1, nx = 40, ny = 4",
         "Load steps/number of steps=4"],
        {"nodes": 205, "active_cells": 120, "particles": 65, "bonds": 627,
         "cells_without_element_work": 40, "nodes_without_particle": 140},
        {"newton_iterations": 36,  # 33
         "linear_iterations": 36, "calls of linear_solver": 72,  # 66
         "calls of assembly": 84, "calls of families": 1}),  # 77
    "explicit motion assembles nothing": (
        "bar_wave.prm",
        ["Load steps/end time=2e-5", "Load steps/number of steps=2"],
        {"nodes": 495, "calls of assembly": None,
         "calls of linear_solver": None, "calls of families": 1},
        {"time_steps": 46, "calls of forces": 47}),
    "six events of bonds that break": (
        "centre_crack_fracture.prm",
        ["Cracks/maximum advances=6"],
        {"nodes": 756, "active_cells": 599, "particles": 212, "bonds": 8086,
         "events": 6, "cells_without_element_work": 103,
         "nodes_without_particle": 544},
        {"newton_iterations": 7, "linear_iterations": 7,
         "eliminations_of_far_field": 4, "calls of families": 8,
         "calls of linear_solver": 16, "calls of assembly": 32}),
}


def calls(text):
    """How often each stage began, from the table of timings of the log."""
    part = text[text.index("Timing (wall clock"):]
    return {name: int(count) for name, count in re.findall(
        r"^  (\w+) +[\d.]+ +\d+ % +(\d+)$", part, re.MULTILINE)}


def main():
    arguments = parse_arguments(__doc__.splitlines()[0])
    runner = Runner(arguments)
    failures = Failures()
    for name, (file, entries, exact, most) in CASES.items():
        if arguments.only and not re.search(arguments.only, name):
            continue
        failures.begin(name)
        outcome = runner.run_case(file, QUIET + entries)
        if failures.check(outcome.code == 0, "exit code %d" % outcome.code):
            results = outcome.results()
            counts = dict(results["counts"], **results["skipped"])
            counts.update(("calls of " + stage, count)
                          for stage, count in calls(outcome.stdout).items())
            if arguments.show:
                print(counts)
            for what, expected in exact.items():
                failures.check(counts.get(what) == expected, "%s: %s, not %s" % (
                    what, counts.get(what), expected))
            for what, limit in most.items():
                # A count that is not there would not be guarded.
                failures.check(counts.get(what, limit + 1) <= limit,
                               "%s: %s, more than %d" % (
                                   what, counts.get(what), limit))
        failures.end(outcome)
    finish(failures)


if __name__ == "__main__":
    main()
