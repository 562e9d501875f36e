"""Large deformation from outside: failures that keep their last state, limit
points, constraints on boundaries on 1, 2 and 3 ranks."""

import csv
import math
import os

from case_files import parameter_text
from harness import Failures, Runner, finish, parse_arguments

LAW = {"Material/law": "hencky", "Material/state": "plane strain"}
# Nominal stress of a bar without lateral contraction: E ln(l) / l <= E / e.
BAR = dict(LAW, **{
    "Mode": "finite elements",
    "Material/Poisson's ratio": "0",
    "Boundary conditions/traction": "right: x = 1000*t",
    "Quantities/deflection": "end: 1 0.5, x",
    "Load steps/number of steps": "5",
})


def write_case(runner, changes):
    """A parameter file with these changes, its path."""
    path = os.path.join(runner.new_folder(), "case.prm")
    with open(path, "w") as file:
        file.write(parameter_text(changes))
    return path


def table(path):
    with open(path) as file:
        return [{name: float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]


def limit_point(runner, failures):
    failures.begin("beyond the limit point: exit 3 and the last state")
    done = runner.run([write_case(runner, BAR), "--output", "out"])
    failures.check(done.code == 3, "exit code %d" % done.code)
    for words in ("load step 2", "cuts", "last converged state", "arc length"):
        failures.check(words in done.text, "no '%s' in the message" % words)
    results = done.results()
    failures.check(results["status"] == "failed", "status not failed")
    last = table(done.path("load_steps.csv"))[-1]
    failures.check_close("last load", last["time"], 1. / math.e, 2e-3)
    stretch = 1. + results["quantities"]["end_deflection"]["value"]
    failures.check_close("state of the last load",
                         math.log(stretch) / stretch, last["time"], 1e-6)
    failures.end(done)

    failures.begin("arc length goes over the limit point")
    done = runner.run([write_case(runner, dict(BAR, **{
        "Load steps/number of steps": "20",
        "Load steps/control": "arc length",
        "Load steps/maximum arc steps": "30"})), "--output", "out"])
    failures.check(done.code == 0, "exit code %d" % done.code)
    failures.check(done.results()["status"] == "stopped", "status not stopped")
    rows = table(done.path("quantities.csv"))
    peak = max(row["time"] for row in rows)
    failures.check_close("limit load", peak, 1. / math.e, 1e-2)
    failures.check(rows[-1]["time"] < 0.95 * peak, "no way down")
    for row in rows:
        stretch = 1. + row["end_deflection"]
        failures.check_close("path", row["time"], math.log(stretch) / stretch,
                             1e-6)
    failures.end(done)


def inverted(runner, failures):
    failures.begin("a step that turns elements inside out")
    done = runner.run([write_case(runner, dict(LAW, **{
        "Boundary conditions/traction": None,
        "Boundary conditions/displacement": "right: x = -1.5*t",
        "Load steps/maximum cuts": "3",
    })), "--output", "out"])
    failures.check(done.code == 3, "exit code %d" % done.code)
    for words in ("load step 1", "did not converge"):
        failures.check(words in done.text, "no '%s' in the message" % words)
    failures.end(done)


RANK_CASES = [
    ("pinned rigid plate, follower pressure", {
        "Boundary conditions/symmetry": None,
        "Boundary conditions/traction": None,
        "Boundary conditions/displacement": "left: x = 0, y = 0",
        "Boundary conditions/rigid plate": "right: x = 0.05*t, y = 0",
        "Boundary conditions/follower pressure": "top: 150*t",
        "Quantities/reaction": "left, right",
    }),
    ("means of boundaries", {
        "Boundary conditions/symmetry": None,
        "Boundary conditions/mean displacement":
        "left: x = 0, y = 0, rotation = 0",
        "Boundary conditions/traction": "right: x = 100*t, y = 40*t",
        "Quantities/reaction": "left",
    }),
    ("prototype microelastic bonds", {
        "Material/law": "prototype microelastic",
        "Material/Poisson's ratio": "0.25",
        "Peridynamics/model": "bond based",
        "Boundary conditions/traction": None,
        "Boundary conditions/displacement": "right: x = 0.2*t",
        "Quantities/reaction": "left, right",
    }),
    ("arc length", {
        "Boundary conditions/traction": "right: x = 300*t",
        "Load steps/control": "arc length",
    }),
]


def ranks(runner, failures):
    for name, changes in RANK_CASES:
        failures.begin("%s on 1, 2 and 3 ranks" % name)
        entries = dict(LAW, **{"Load steps/number of steps": "2",
                               "Quantities/point": "middle: 0.5 0.5"})
        entries.update(changes)
        runs = [runner.run([write_case(runner, entries), "--output", "out"], n)
                for n in (1, 2, 3)]
        for n, done in zip((1, 2, 3), runs):
            if not failures.check(done.code == 0, "exit code %d on %d ranks" %
                                  (done.code, n)):
                continue
            one, many = runs[0].results(), done.results()
            failures.check_below("imbalance", many["checks"]["imbalance"], 1e-7)
            failures.check_below("ghost", many["checks"]["ghost_force"], 1e-11)
            scales = {}
            for entry in one["quantities"].values():
                scales[entry["unit"]] = max(scales.get(entry["unit"], 0.),
                                            abs(entry["value"]))
            for key, entry in one["quantities"].items():
                other = many["quantities"][key]["value"]
                failures.check(
                    abs(other - entry["value"]) <=
                    1e-9 * scales[entry["unit"]],
                    "%s: %.15g on one rank, %.15g on %d" %
                    (key, entry["value"], other, n))
        failures.end(runs[0])


def point_warnings(runner, failures):
    failures.begin("forces and supports in one point are warned of")
    done = runner.run([write_case(runner, dict(LAW, **{
        "Boundary conditions/symmetry": "left",
        "Boundary conditions/traction": None,
        "Boundary conditions/point displacement": "0 0: y = 0",
        "Boundary conditions/point force": "1 1: y = 0.1",
    })), "--output", "out"])
    failures.check(done.code == 0, "exit code %d" % done.code)
    for words in ("the force on the single node", "point displacement at",
                  "carries a force", "mean displacement"):
        failures.check(words in done.text, "no '%s'" % words)
    failures.end(done)


def main():
    arguments = parse_arguments(__doc__)
    runner = Runner(arguments)
    failures = Failures()
    limit_point(runner, failures)
    inverted(runner, failures)
    ranks(runner, failures)
    point_warnings(runner, failures)
    finish(failures)


if __name__ == "__main__":
    main()
