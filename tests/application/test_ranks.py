"""The same case on 1, 2 and 3 ranks: the same results to round-off."""

import csv
import glob
import os
import re

from harness import Failures, Runner, finish, parse_arguments

TOLERANCE = 1e-10  # relative
FLOOR = 1e-12  # of the largest quantity of the same unit

PLATE = "Mesh/geometry parameters=nt = 16, nr = 28"
BOND_PLATE = "Mesh/geometry parameters=nt = 8, nr = 20"
CAVITY = "Mesh/geometry parameters=n = 8, nr = 9"
# An iterative solver stops at its tolerance: it must be below the differences
# that are looked for.
ITERATIVE = ["Solver/linear solver=iterative", "Solver/linear tolerance=1e-13"]
COARSE_PLATE = "Mesh/geometry parameters=nt = 6, nr = 8, pr = 1.3"
COARSE_CAVITY = "Mesh/geometry parameters=n = 3, nr = 4"
COARSE_STRIP = "Mesh/geometry parameters=L = 1.5, d = 1.03125, h = 0.125"
SLIT = "Mesh/geometry parameters=dx = 0.05, nf = 6"
STRIP = "Mesh/geometry parameters=L = 1.5, d = 1.03125, h = 0.0625"
TWO_ADVANCES = "Cracks/maximum advances=2"
ADVANCES = "Cracks/maximum advances=4"
LOAD_STEPS = ["Cracks/growth control=load steps", "Load steps/end time=1.3"]
BONDS = ["Cracks/growth=bonds"]
# Neither at the end of a period nor on the axis, where all is round-off.
BAR = ["Load steps/end time=60e-6", "Quantities/point=middle: 0.1 0.001",
       "Reference/values="]
COMPOSITE = "Mesh/geometry parameters=L = 0.1, d = 0.1, nx = 40, ny = 40"
GLASS = "Mesh/geometry parameters=L = 0.1, d = 0.04, h = 0.002"
HAND_OVER = ["Cracks/hand over length=1 horizons",
             "Cracks/advance length=0.25 horizons"]
WITH_REACTIONS = "Quantities/reaction=left, bottom"

# name, parameter file, overrides, ghost forces are expected
CASES = [
    ("plate with hole", "plate_with_hole.prm", [PLATE, WITH_REACTIONS], False),
    ("bond based", "plate_with_hole_bond_based.prm", [BOND_PLATE], False),
    ("patch test", "patch_test.prm", [], False),
    ("cantilever", "cantilever_small_strain.prm",
     ["Quantities/reaction=left"], False),
    ("spherical cavity", "spherical_cavity.prm",
     [CAVITY, "Solver/linear tolerance=1e-13"], False),
    ("spherical cavity, bond based", "spherical_cavity_bond_based.prm",
     [CAVITY], False),
    ("uniaxial plate", "uniaxial_plate.prm", [], False),
    ("strip with hole", "strip_with_hole.prm",
     ["Mesh/geometry parameters=nt = 12, nr = 16, ne = 16"], False),
    ("load steps", "strip_with_hole.prm",
     ["Mesh/geometry parameters=nt = 8, nr = 10, ne = 8",
      "Load steps/number of steps=3",
      "Boundary conditions/displacement=right: x = 0.1*t^2"], False),
    ("peridynamics only", "plate_with_hole.prm",
     [PLATE, "Mode=peridynamics",
      "Quantities/compare with finite elements=false"], False),
    ("finite elements only", "plate_with_hole.prm",
     [PLATE, "Mode=finite elements"], False),
    ("meshed crack", "centre_crack_meshed.prm", [SLIT], False),
    ("refined locally", "plate_with_hole.prm",
     [COARSE_PLATE, "Mesh/Refinement/target spacing=0.25", WITH_REACTIONS],
     False),
    ("refined by errors", "plate_with_hole.prm",
     [COARSE_PLATE, "Mesh/Refinement/target spacing=0.25",
      "Mesh/Refinement/error cycles=3"], False),
    ("refined locally, in 3D", "spherical_cavity.prm",
     [COARSE_CAVITY, "Mesh/Refinement/target spacing=0.25",
      "Peridynamics/core size=0", "Solver/linear solver=direct"], False),
    ("refined locally, iterative", "plate_with_hole.prm",
     [COARSE_PLATE, "Mesh/Refinement/target spacing=0.25",
      "Solver/tangent=matrix-free"] + ITERATIVE, False),
    ("growth into hanging nodes", "edge_crack_growth.prm",
     [COARSE_STRIP, "Mesh/Refinement/target spacing=0.0625", TWO_ADVANCES],
     False),
    ("energy blending", "plate_with_hole.prm",
     [PLATE, "Peridynamics/coupling=energy blending"], True),
    ("force blending", "plate_with_hole.prm",
     [PLATE, "Peridynamics/coupling=force blending"], True),
    ("iterative, matrix-free", "plate_with_hole.prm",
     [PLATE, "Solver/tangent=matrix-free"] + ITERATIVE, False),
    ("iterative, assembled", "plate_with_hole.prm",
     [PLATE, "Solver/tangent=assembled"] + ITERATIVE, False),
    ("iterative, bond based", "plate_with_hole_bond_based.prm",
     [BOND_PLATE] + ITERATIVE, False),
    ("growth by segments", "edge_crack_growth.prm", [STRIP, TWO_ADVANCES], False),
    ("growth by segments in load steps", "edge_crack_growth.prm",
     [STRIP, TWO_ADVANCES] + LOAD_STEPS, False),
    ("growth bond by bond", "edge_crack_growth.prm",
     [STRIP, ADVANCES] + BONDS, False),
    ("growth bond by bond, bond based", "edge_crack_growth.prm",
     [STRIP, "Cracks/maximum advances=8", "Peridynamics/model=bond based"] +
     BONDS, False),
    ("bonds, then segments", "edge_crack_growth.prm",
     [STRIP, "Cracks/maximum advances=14"] + HAND_OVER + BONDS, False),
    ("bonds, then segments until separated", "edge_crack_growth.prm",
     [STRIP, "Cracks/hand over length=2 horizons"] + BONDS, False),
    ("bonds, then segments, bond based", "edge_crack_growth.prm",
     [STRIP, "Cracks/maximum advances=18", "Cracks/softening teeth=1",
      "Peridynamics/model=bond based"] + HAND_OVER + BONDS, False),
    ("bonds, then segments in load steps", "edge_crack_growth.prm",
     [STRIP, "Cracks/maximum advances=14"] + HAND_OVER + BONDS + LOAD_STEPS,
     False),
    ("growth bond by bond in load steps", "edge_crack_growth.prm",
     [STRIP, ADVANCES] + BONDS + LOAD_STEPS, False),
    ("explicit motion", "bar_wave.prm", BAR, False),
    ("implicit motion", "bar_wave.prm",
     BAR + ["Time integration/scheme=implicit", "Time integration/time step=1e-6"],
     False),
    ("motion, bond based", "bar_wave.prm",
     BAR + ["Peridynamics/model=bond based", "Material/Poisson's ratio=0.3333333333"],
     False),
    ("motion with material axes", "dynamic_edge_crack.prm", [COMPOSITE], False),
    ("families that break in motion", "dynamic_edge_crack.prm",
     [COMPOSITE, "Cracks/growth=bonds", "Cracks/criterion=tsai-hill",
      "Cracks/strengths=X = 1670e6, Y = 60e6, S = 70e6"], False),
    ("planes that open one after another", "dynamic_edge_crack.prm",
     [COMPOSITE, "Time integration/scheme=static",
      "Time integration/initial velocity=",
      "Boundary conditions/displacement=top: y = 1e-5*t; bottom: y = -1e-5*t",
      "Boundary conditions/point displacement=0.1 0: x = 0",
      "Load steps/end time=1", "Load steps/number of steps=1",
      "Cracks/growth=bonds", "Cracks/criterion=tsai-hill",
      "Cracks/growth control=events", "Cracks/maximum advances=5",
      "Cracks/strengths=X = 1670e6, Y = 60e6, S = 70e6"], False),
    ("bonds that break in motion", "dynamic_branching.prm", [GLASS], False),
    ("relaxation", "plate_with_hole.prm",
     [PLATE, "Time integration/scheme=relaxation",
      "Solver/Newton tolerance=1e-11"], False),
]


def quantities(results):
    """name -> (unit, value); positions have a scale of their own."""
    values = {}
    companion = dict(results["companion"])
    tables = {"": results["quantities"],
              "companion ": companion.pop("quantities", {})}
    for group, table in tables.items():
        for name, entry in table.items():
            unit = "position" if "_position_" in name else entry["unit"]
            values[group + name] = unit, entry["value"]
    for name, value in companion.items():
        values["companion " + name] = "-", value
    return values


def compare_values(failures, ranks, one, many):
    failures.check(one.keys() == many.keys(),
                   "other quantities on %d ranks" % ranks)
    scales = {"-": 1.}
    for unit, value in one.values():
        scales[unit] = max(scales.get(unit, 0.), abs(value))
    for name, (unit, value) in one.items():
        other = many.get(name, (unit, float("nan")))[1]
        allowed = TOLERANCE * abs(value) + FLOOR * scales[unit]
        failures.check(
            abs(other - value) <= allowed,
            "%s: %.15g on one rank, %.15g on %d (difference %.1e, allowed "
            "%.1e)" % (name, value, other, ranks, abs(other - value), allowed))


def table_of(path):
    with open(path) as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(cell) for cell in row] for row in rows[1:]]


def compare_probes(failures, ranks, one, many):
    for path in glob.glob(one.path("probe_*.csv")):
        name = os.path.basename(path)
        columns, rows = table_of(path)
        other_columns, other_rows = table_of(many.path(name))
        same = columns == other_columns and len(rows) == len(other_rows)
        if not failures.check(same, name + " has another form"):
            continue
        for c, column in enumerate(columns):
            scale = max(abs(row[c]) for row in rows)
            worst = max(
                abs(row[c] - other[c]) for row, other in zip(rows, other_rows))
            # the tables have 12 digits; stresses scale with each other
            if column[0] == "s":
                scale = max(abs(row[k]) for row in rows
                            for k in range(len(columns))
                            if columns[k][0] == "s")
            failures.check(
                worst <= 1e-10 * scale,
                "%s, %s: differs by %.1e on %d ranks (largest value %.1e)" %
                (name, column, worst, ranks, scale))


def compare_growth(failures, ranks, one, many):
    """The same advances and broken bonds; the bonds of an event are listed in
    the order of the nodes, which is that of the ranks."""
    for name in ("crack_growth.csv", "broken_bonds.csv"):
        paths = one.path(name), many.path(name)
        if not os.path.exists(paths[0]):
            continue
        tables = []
        for path in paths:
            with open(path) as file:
                rows = list(csv.DictReader(file))
            if name == "broken_bonds.csv":
                for row in rows:
                    ends = sorted((row["x" + k], row["y" + k]) for k in "12")
                    row.update(zip(("x1", "y1", "x2", "y2"), sum(ends, ())))
                rows.sort(key=lambda row: (int(row["event"]), row["x1"],
                                           row["y1"], row["x2"], row["y2"]))
            tables.append(rows)
        if not failures.check(len(tables[0]) == len(tables[1]) > 0,
                              "%s: %d rows on one rank, %d on %d" %
                              (name, len(tables[0]), len(tables[1]), ranks)):
            continue
        for row, other in zip(*tables):
            for column, text in row.items():
                if column in ("crack", "energy_of_core_growth"):
                    continue
                if text == other[column] == "":  # J of a tip without room
                    continue
                value, second = float(text), float(other[column])
                failures.check(
                    abs(second - value) <= 1e-9 * max(1., abs(value)),
                    "%s, %s: %s on one rank, %s on %d" %
                    (name, column, text, other[column], ranks))


def compare_counts(failures, ranks, one, many):
    for name, count in one["counts"].items():
        if name != "linear_iterations":
            failures.check(
                many["counts"][name] == count,
                "%s: %d on one rank, %d on %d" %
                (name, count, many["counts"][name], ranks))
    for part in ("case", "mode", "status", "warnings"):
        failures.check(one[part] == many[part],
                       "%s: %s, then %s" % (part, one[part], many[part]))
    skipped = [dict(results["skipped"]) for results in (one, many)]
    if one["solver"]["linear_solver"] != many["solver"]["linear_solver"]:
        # The ranks help to choose the solver, which decides about matrices.
        for entries in skipped:
            entries.pop("matrix_entries_of_particles", None)
    failures.check(skipped[0] == skipped[1],
                   "skipped: %s, then %s" % tuple(skipped))


def check_ghost(failures, ranks, one, many, expected):
    ghost, other = one["checks"]["ghost_force"], many["checks"]["ghost_force"]
    if expected:
        failures.check_close("ghost_force on %d ranks" % ranks, other, ghost,
                             TOLERANCE)
    else:
        failures.check_below("ghost_force", ghost, 1e-10)
        failures.check_below("ghost_force on %d ranks" % ranks, other, 1e-10)
    if one["checks"]["imbalance"] is not None: # not of a body that moves
        failures.check_below("imbalance on %d ranks" % ranks,
                             many["checks"]["imbalance"],
                             1e-3 if expected else 1e-9)


def main():
    arguments = parse_arguments(__doc__)
    runner = Runner(arguments)
    failures = Failures()
    cases = [case for case in CASES
             if not arguments.only or re.search(arguments.only, case[0])]
    outcomes = runner.together(
        lambda run: runner.run_case(run[0], run[1] + ["Output/fields=false"],
                                    run[2]),
        [(file, overrides, n) for _, file, overrides, _ in cases
         for n in (1, 2, 3)])
    for name, _, _, ghost in cases:
        failures.begin(name)
        runs = [next(outcomes) for _ in range(3)]
        done = [
            failures.check(run.code == 0, "exit code %d" % run.code)
            for run in runs
        ]
        if all(done):
            results = [run.results() for run in runs]
            one = quantities(results[0])
            for n in (2, 3):
                many = results[n - 1]
                failures.check(many["ranks"] == n,
                               "ran on %d ranks" % many["ranks"])
                compare_values(failures, n, one, quantities(many))
                compare_counts(failures, n, results[0], many)
                compare_probes(failures, n, runs[0], runs[n - 1])
                compare_growth(failures, n, runs[0], runs[n - 1])
                check_ghost(failures, n, results[0], many, ghost)
            failures.end()
        else:
            failures.end(runs[done.index(False)])
    finish(failures)


if __name__ == "__main__":
    main()
