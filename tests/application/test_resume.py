"""A run killed at a random moment goes on from its checkpoint to the results of
one that was never stopped, on any number of ranks; what does not fit to the
checkpoint is named and ends with exit code 2."""

import csv
import math
import os
import random
import re
import signal
import subprocess
import sys
import time

from case_files import SOLID, parameter_text, square
from harness import MESHES, Failures, Runner, finish, parse_arguments

SAME_RANKS = 1e-10
OTHER_RANKS = 1e-8

HENCKY = {"Material/law": "hencky", "Material/state": "plane strain",
          "Quantities/point": "middle: 0.5 0.5"}
# A strip under tension whose crack runs (numerics-damage, the edge crack).
STRIP = {
    "Mesh/file": os.path.join(MESHES, "beam_rectangle.geo"),
    "Mesh/geometry parameters":
    "L = 1.5, d = 1.03125, nx = 24, ny = 17",
    "Material/Young's modulus": "1",
    "Material/Poisson's ratio": "0.3333333333",
    "Peridynamics/around": None,
    "Peridynamics/core size": None,
    "Peridynamics/blending width": None,
    "Cracks/pre-cracks": "edge: 0 0.01 to 0.5 0.01",
    "Cracks/growth": "segments",
    "Cracks/fracture energy": "1",
    "Cracks/maximum advances": "4",
    "Boundary conditions/symmetry": None,
    "Boundary conditions/traction": None,
    "Boundary conditions/displacement": "top: y = t; bottom: y = -t",
    "Boundary conditions/point displacement": "1.5 -0.515625: x = 0",
    "Output/fields": "true",
    "Output/stress": "false",
}

# The same strip, torn apart by a velocity.
PULLED = dict(STRIP, **{
    "Material/density": "1",
    "Cracks/growth": "bonds",
    "Cracks/criterion": "critical stretch",
    "Cracks/maximum advances": None,
    "Boundary conditions/displacement": None,
    "Boundary conditions/point displacement": None,
    "Time integration/initial velocity": "y = 5*y",
    "Time integration/field interval": "0.08",
    "Load steps/end time": "1.6",
    "Load steps/number of steps": "20",
})

# Split along its fibres.
COMPOSITE = {
    "Material/law": "orthotropic",
    "Material/Young's modulus": None,
    "Material/Poisson's ratio": None,
    "Material/constants": "E1 = 5, E2 = 1, nu12 = 0.3, G12 = 0.4",
    "Material/orientation": "30",
    "Cracks/criterion": "tsai-hill",
    "Cracks/fracture energy": None,
    "Cracks/strengths": "X = 50, Y = 2, S = 2",
}

# name, entries, rows of the table of steps at which it may be killed
CASES = [
    # The plate turns, Newton's few iterations make cuts: both have a memory.
    ("load steps at finite strain", dict(HENCKY, **{
        "Boundary conditions/symmetry": None,
        "Boundary conditions/traction": None,
        "Boundary conditions/displacement": "left: x = 0, y = 0",
        "Boundary conditions/rigid plate": "right: x = 0.4*t, y = 0",
        "Boundary conditions/follower pressure": "top: 150*t",
        "Mesh/geometry parameters": "n = 16",
        "Load steps/number of steps": "5",
        "Solver/maximum Newton iterations": "3",
        "Quantities/reaction": "left, right",
        "Output/fields": "true",
    }), (2, 4)),
    ("load steps of a linear solid", dict(SOLID, **{
        "Load steps/number of steps": "6",
        "Mesh/geometry parameters": "n = 6",
        "Boundary conditions/traction": "right: x = t^2",
        "Quantities/deflection": "end: 1 1 1, x",
        "Quantities/compare with finite elements": "true",
    }), (1, 4)),
    ("arc length over a limit point", dict(HENCKY, **{
        "Mode": "finite elements",
        "Material/Poisson's ratio": "0",
        "Mesh/geometry parameters": "n = 16",
        "Boundary conditions/traction": "right: x = 1000*t",
        "Load steps/number of steps": "20",
        "Load steps/control": "arc length",
        "Load steps/maximum arc steps": "20",
    }), (1, 18)),
    ("growth of a crack by events", dict(STRIP, **{
        "Cracks/growth control": "events",
    }), (1, 6)),
    ("growth of a crack in load steps", dict(STRIP, **{
        "Load steps/end time": "2",
        "Load steps/number of steps": "4",
    }), (1, 6)),
    ("growth of a crack on a refined mesh", dict(STRIP, **{
        "Cracks/growth control": "events",
        "Mesh/Refinement/target spacing": "%.17g" % (1. / 32.),
        "Mesh/Refinement/error cycles": "1",
    }), (1, 6)),
    ("bonds that break by events", dict(STRIP, **{
        "Cracks/growth": "bonds",
        "Cracks/growth control": "events",
        "Cracks/maximum advances": "5",
    }), (1, 8)),
    # Killed before, at or behind the hand-over in row 15.
    ("bonds, then segments, by events", dict(STRIP, **{
        "Cracks/growth": "bonds",
        "Cracks/growth control": "events",
        "Cracks/hand over length": "1 horizons",
        "Cracks/advance length": "0.5 horizons",
        "Cracks/maximum advances": "8",
    }), (1, 28)),
    ("bonds that soften by events", dict(STRIP, **{
        "Cracks/growth": "bonds",
        "Cracks/growth control": "events",
        "Peridynamics/model": "bond based",
        "Cracks/maximum advances": "8",
    }), (1, 14)),
    ("bonds that break in load steps", dict(STRIP, **{
        "Cracks/growth": "bonds",
        "Cracks/maximum advances": "12",
        "Load steps/end time": "1.6",
        "Load steps/number of steps": "4",
    }), (1, 6)),
    ("planes that open by events", dict({**STRIP,
        "Cracks/growth": "bonds",
        "Cracks/growth control": "events",
        "Cracks/maximum advances": "5",
    }, **COMPOSITE), (1, 8)),
    ("explicit motion with families that break", dict(PULLED, **{
        "Time integration/scheme": "explicit",
    }), (2, 10)),
    ("explicit motion with bonds that break", dict(PULLED, **{
        "Time integration/scheme": "explicit",
        "Peridynamics/model": "bond based",
    }), (2, 10)),
    ("explicit motion with planes that open", dict({**PULLED,
        "Time integration/scheme": "explicit",
    }, **COMPOSITE), (2, 10)),
    ("explicit motion from its initial state", dict(PULLED, **{
        "Time integration/scheme": "explicit",
        "Time integration/field interval": "1.6",
    }), (3, 15)),
    ("explicit motion at finite strain", dict(HENCKY, **{
        "Material/density": "1",
        "Boundary conditions/symmetry": None,
        "Boundary conditions/traction": None,
        "Boundary conditions/displacement":
        "bottom: x = 0, y = 0; top: x = 0, y = -0.4*t",
        "Time integration/scheme": "explicit",
        "Time integration/field interval": "0.15",
        "Load steps/number of steps": "20",
    }), (2, 16)),
    ("implicit motion with families that break", dict(PULLED, **{
        "Time integration/scheme": "implicit",
        "Time integration/time step": "0.05",
    }), (2, 10)),
]

# Columns that hold only round-off.
ROUND_OFF = ("imbalance", "relative_residual", "residual", "energy_balance",
             "energy_of_core_growth")


def table(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def n_steps_in(folder):
    """Rows of the table of steps, of a body that moves or not."""
    return max(n_rows(os.path.join(folder, name))
               for name in ("load_steps.csv", "time_steps.csv"))


def n_rows(path):
    try:
        with open(path) as file:
            return file.read().count("\n") - 1
    except FileNotFoundError:
        return 0


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def rounded(texts):
    """Texts with their numbers to eight digits."""
    return [re.sub(r"\d+\.\d+(e[+-]\d+)?",
                   lambda found: "%.8g" % float(found[0]), text)
            for text in texts]


def children(pid):
    with open("/proc/%d/task/%d/children" % (pid, pid)) as file:
        return [int(word) for word in file.read().split()]


def run_and_kill(runner, words, folder, ranks, rows, moment):
    """Starts the program and kills it without warning: after this number of
    rows of load_steps.csv, a moment [s] later. Returns true if it was still
    running."""
    command = [runner.program] + words
    if ranks > 1:
        command = [runner.mpirun, "--quiet", "--oversubscribe", "-np",
                   str(ranks)] + command
    process = subprocess.Popen(command, cwd=folder, env=runner.environment,
                               stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    out = os.path.join(folder, "out")
    end = time.time() + 200
    while (process.poll() is None and n_steps_in(out) < rows and
           time.time() < end):
        time.sleep(0.001)
    time.sleep(moment)
    alive = process.poll() is None
    if alive:
        for pid in children(process.pid) if ranks > 1 else [process.pid]:
            os.kill(pid, signal.SIGKILL)
    process.wait(timeout=60)
    return alive


def column_scales(rows, quantities):
    """The largest number of each column; of all columns with the same unit
    (a stress may be zero by symmetry), and of coordinates; degrees."""
    scales = {}
    for column in rows[0]:
        unit = quantities.get(column, {}).get("unit", column)
        unit = "place" if column in ("x", "y") else unit
        values = [number(row[column]) for row in rows]
        scales.setdefault(unit, [90. if column == "direction" else 0.])
        scales[unit] += [abs(v) for v in values
                         if v is not None and math.isfinite(v)]
        scales[column] = scales[unit]
    return {column: max(scales[column]) for column in rows[0]}


def compare_tables(failures, one, other, tolerance):
    """All tables: the same rows; Newton's iterations on as many ranks."""
    names = ["load_steps.csv", "time_steps.csv", "quantities.csv", "crack_growth.csv",
             "broken_bonds.csv",
             "newton.csv"]
    for name in names:
        if not os.path.exists(one.path(name)):
            failures.check(not os.path.exists(other.path(name)),
                           name + " only after the resume")
            continue
        rows, others = table(one.path(name)), table(other.path(name))
        if name == "newton.csv" and tolerance == OTHER_RANKS:
            continue
        if not failures.check(
                len(rows) == len(others), "%s: %d rows, resumed %d" %
                (name, len(rows), len(others))):
            continue
        scales = column_scales(rows, one.results()["quantities"])
        for column in rows[0]:
            if column in ROUND_OFF or (column == "linear_iterations" and
                                       tolerance == OTHER_RANKS):
                continue
            values = [number(row[column]) for row in rows]
            if None in values:
                failures.check(values == [number(r[column]) for r in others],
                               "%s, %s: other words" % (name, column))
                continue
            scale = scales[column]
            worst = max(
                0. if math.isnan(v) and row[column] == "nan" else
                abs(v - float(row[column])) for v, row in zip(values, others))
            failures.check(
                worst <= tolerance * scale, "%s, %s: differs by %.1e of %.1e" %
                (name, column, worst, scale))


def compare(failures, one, other, tolerance):
    """The worst relative difference of a quantity."""
    results, resumed = one.results(), other.results()
    for part in ("case", "mode", "status"):
        failures.check(results[part] == resumed[part], "%s: %s, resumed %s" %
                       (part, results[part], resumed[part]))
    failures.check(
        rounded(results["warnings"]) == rounded(resumed["warnings"]),
        "warnings: %s, resumed %s" % (results["warnings"],
                                      resumed["warnings"]))
    for name, count in results["counts"].items():
        if name != "linear_iterations" or tolerance == SAME_RANKS:
            failures.check(resumed["counts"].get(name) == count,
                           "%s: %s, resumed %s" %
                           (name, count, resumed["counts"].get(name)))
    failures.check(results["checks"].keys() == resumed["checks"].keys(),
                   "other checks")
    tables = [(results["quantities"], resumed["quantities"]),
              (results["companion"].get("quantities", {}),
               resumed["companion"].get("quantities", {}))]
    worst = 0.
    for values, others in tables:
        scales = {}
        for entry in values.values():
            scales[entry["unit"]] = max(scales.get(entry["unit"], 0.),
                                        abs(entry["value"] or 0.))
        failures.check(values.keys() == others.keys(), "other quantities")
        for name, entry in values.items():
            value, again = entry["value"], others[name]["value"]
            if value is None or again is None:
                failures.check(value == again, name + " only in one")
                continue
            difference = abs(value - again) / (scales[entry["unit"]] or 1.)
            worst = max(worst, difference)
            failures.check(difference <= tolerance,
                           "%s: %.15g, resumed %.15g" % (name, value, again))
    compare_tables(failures, one, other, tolerance)
    for name in ("solution", "particles", "cracks"):
        path = name + ".pvd"
        if os.path.exists(one.path(path)):
            series = [re.findall(r'timestep="(\S+)".*file="(\S+)"',
                                 open(run.path(path)).read())
                      for run in (one, other)]
            failures.check(
                [f for _, f in series[0]] == [f for _, f in series[1]],
                path + " lists other files")
            missing = [f for _, f in series[1]
                       if not os.path.exists(other.path(f))]
            failures.check(not missing, "%s lacks %s" % (path, missing))
    return worst


def write_case(folder, changes):
    with open(os.path.join(folder, "case.prm"), "w") as file:
        file.write(parameter_text(changes))


def killed(runner, failures, selected, chance):
    """Killed up to twice, on 1 and 2 ranks, and resumed on 1 and 2."""
    for name, changes, (first, last) in CASES:
        if not selected(name):
            continue
        whole = runner.new_folder()
        write_case(whole, changes)
        one = runner.run(["case.prm", "--output", "out"], 1, whole)
        failures.begin(name + ": never stopped")
        failures.check(one.code == 0, "exit code %d" % one.code)
        failures.check(not os.path.exists(one.path("checkpoint.part")),
                       "checkpoint.part is left")
        failures.end(one)
        duration = one.results()["timings"]["total"]
        n_steps = n_steps_in(os.path.dirname(one.path("log.txt")))
        for before, after in (([1, 1], 1), ([1], 2), ([2], 1)):
            failures.begin("%s: killed on %s, resumed on %d" %
                           (name, before, after))
            folder = runner.new_folder()
            write_case(folder, changes)
            words = ["case.prm", "--output", "out"]
            rows = 0
            for ranks in before:
                rows = chance.randint(max(first, rows), last)
                moment = chance.uniform(0., 1.5 * duration / n_steps)
                alive = run_and_kill(runner, words, folder, ranks, rows,
                                     moment)
                print("       killed at row %d + %.3f s%s" %
                      (rows, moment, "" if alive else ": too late, done"))
                words = ["case.prm", "--resume", "out"]
            # What a run killed while it wrote leaves beside the checkpoint.
            with open(os.path.join(folder, "out", "checkpoint.part"),
                      "wb") as file:
                file.write(b"Perimorph checkpoint 1 100 ")
            other = runner.run(words, after, folder)
            if failures.check(other.code == 0, "exit code %d" % other.code):
                failures.check("Resumed from 'out/checkpoint'" in other.text,
                               "no word on the resume")
                worst = compare(failures, one, other,
                                SAME_RANKS if before == [1, 1] else
                                OTHER_RANKS)
                print("       largest difference of a quantity %.1e" % worst)
            failures.end(other)


def complete(runner, failures):
    """A run that had ended gives its results again, without a solve."""
    failures.begin("resume of a complete run")
    name, changes, _ = CASES[0]
    folder = runner.new_folder()
    write_case(folder, changes)
    one = runner.run(["case.prm", "--output", "out"], 1, folder)
    moved = os.path.join(folder, "moved")
    os.rename(one.folder, moved)
    one.folder = moved
    results = one.results()
    os.mkdir(os.path.join(folder, "out"))
    for file in os.listdir(moved):
        with open(os.path.join(moved, file), "rb") as old:
            with open(os.path.join(folder, "out", file), "wb") as new:
                new.write(old.read())
    # Numbers may be written in another way, files go elsewhere.
    again = runner.run(["case.prm", "--resume", "out", "--set",
                        "Material/Young's modulus=1e3", "--set",
                        "Output folder=elsewhere"], 1, folder)
    failures.check(again.code == 0, "exit code %d" % again.code)
    failures.check("Newton iteration" not in again.stdout, "a solve")
    failures.check(not os.path.exists(os.path.join(folder, "elsewhere")),
                   "it wrote elsewhere")
    compare(failures, one, again, SAME_RANKS)
    failures.check(results["status"] == "converged", "status")
    failures.end(again)

    failures.begin("no checkpoint when none is wanted")
    off = runner.run(["case.prm", "--output", "off", "--set",
                      "Output/checkpoint=false"], 1, folder, "off")
    failures.check(off.code == 0, "exit code %d" % off.code)
    failures.check(not os.path.exists(off.path("checkpoint")), "a checkpoint")
    failures.end(off)


def refused(runner, failures):
    """Named, exit code 2, and the folder stays as it is."""
    folder = runner.new_folder()
    entries = {"Mesh/file": "square.msh", "Mesh/geometry parameters": None,
               "Load steps/number of steps": "2",
               "Quantities/point": "middle: 0.5 0.5"}
    write_case(folder, entries)

    def write(name, content):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(content)

    mesh = square().encode()
    write("square.msh", mesh)
    one = runner.run(["case.prm", "--output", "out"], 1, folder)
    failures.begin("the run to be resumed")
    failures.check(one.code == 0, "exit code %d" % one.code)
    failures.end(one)
    checkpoint = open(one.path("checkpoint"), "rb").read()
    steps = open(one.path("load_steps.csv"), "rb").read()
    flipped = bytearray(checkpoint)
    flipped[len(flipped) // 2] ^= 1
    resume = ["case.prm", "--resume", "out"]
    moved = square(moved={41: (0.51, 0.5, 0.)}).encode()
    renamed = mesh.replace(b'"top"', b'"lid"')
    regrouped = mesh.replace(b" 1 2 13 13 1 2\n", b" 1 2 14 14 1 2\n")

    # name, words, files, fragments of the message, number of messages
    rows = [
        ("a folder that does not exist", ["case.prm", "--resume", "nowhere"],
         {}, ["checkpoint 'nowhere/checkpoint'", "no such file"], 1),
        ("no checkpoint", resume, {"out/checkpoint": None},
         ["checkpoint 'out/checkpoint'", "no such file"], 1),
        ("something else", resume, {"out/checkpoint": b"hello"},
         ["not a checkpoint"], 1),
        ("an empty file", resume, {"out/checkpoint": b""},
         ["not a checkpoint"], 1),
        ("cut off", resume, {"out/checkpoint": checkpoint[:-10]},
         ["damaged"], 1),
        ("cut off in the first line", resume,
         {"out/checkpoint": checkpoint[:24]}, ["damaged"], 1),
        ("one bit", resume, {"out/checkpoint": bytes(flipped)},
         ["damaged"], 1),
        ("another format", resume,
         {"out/checkpoint": checkpoint.replace(b"checkpoint 1 ",
                                               b"checkpoint 2 ", 1)},
         ["format 2", "reads format 1"], 1),
        ("another end time", resume + ["--set", "Load steps/end time=2"], {},
         ["'Load steps / end time' in --set", "found '2'", "allowed: '1"], 1),
        ("two other entries", resume +
         ["--set", "Load steps/number of steps=3", "--set",
          "Solver/linear tolerance=1e-10"], {},
         ["'Load steps / number of steps'", "found '3'", "allowed: '2'",
          "'Solver / linear tolerance'"], 2),
        ("a file changed since", resume,
         {"case.prm": parameter_text(dict(
             entries, **{"Material/Young's modulus": "1001"})).encode()},
         ["'Material / Young's modulus' in case.prm", "found '1001'",
          "allowed: '1000'"], 1),
        ("another mesh", resume, {"square.msh": moved},
         ["mesh '", "square.msh'", "at other places"], 1),
        ("other names", resume, {"square.msh": renamed},
         ["mesh '", "lid", "top"], 1),
        ("other groups", resume, {"square.msh": regrouped},
         ["mesh '", "other groups"], 1),
        ("a table that is gone", resume, {"out/load_steps.csv": None},
         ["table 'out/load_steps.csv'", "no such file"], 1),
        ("a table cut off", resume, {"out/load_steps.csv": steps[:-5]},
         ["table 'out/load_steps.csv'", "%d bytes" % (len(steps) - 5)], 1),
        ("two folders", resume + ["--output", "other"], {},
         ["--resume out", "--output other", "allowed: one"], 1),
        ("no folder", ["case.prm", "--resume"], {},
         ["'--resume'", "no value", "--resume DIR"], 1),
    ]
    original = {"case.prm": parameter_text(entries).encode(),
                "square.msh": mesh, "out/checkpoint": checkpoint,
                "out/load_steps.csv": steps}
    for name, words, files, fragments, n_errors in rows:
        for ranks in (1, 2) if name in ("one bit", "another mesh",
                                        "another end time",
                                        "a table that is gone") else (1, ):
            failures.begin("%s, %d ranks" % (name, ranks))
            changed = dict(original, **files)
            for path, content in changed.items():
                if content is None:
                    if os.path.exists(os.path.join(folder, path)):
                        os.remove(os.path.join(folder, path))
                else:
                    write(path, content)
            before = {file: os.path.getmtime(one.path(file))
                      for file in os.listdir(one.folder)}
            outcome = runner.run(words, ranks, folder)
            failures.check(outcome.code == 2, "exit code %d" % outcome.code)
            failures.check(
                len(re.findall("^Error: ", outcome.stderr, re.M)) == n_errors
                and outcome.stderr.startswith("Error: "),
                "not %d message(s)" % n_errors)
            for fragment in fragments:
                failures.check(fragment in outcome.stderr,
                               "the message lacks %r" % fragment)
            failures.check_clean(outcome.text)
            after = {file: os.path.getmtime(one.path(file))
                     for file in os.listdir(one.folder)}
            failures.check(before == after, "the folder was changed")
            failures.end(outcome)
    for path, content in original.items():
        write(path, content)
    failures.begin("the same folder, whole again: valid")
    outcome = runner.run(resume + ["--validate"], 1, folder)
    failures.check(outcome.code == 0, "exit code %d" % outcome.code)
    failures.end(outcome)


def main():
    arguments = parse_arguments(__doc__, part=["killed", "input"])
    runner = Runner(arguments)
    failures = Failures()
    seed = int(os.environ.get("PERIMORPH_SEED", random.randrange(10**6)))
    print("PERIMORPH_SEED=%d gives these moments again" % seed)
    sys.stdout.flush()

    def selected(name):
        return not arguments.only or re.search(arguments.only, name)

    if arguments.part != "input":
        killed(runner, failures, selected, random.Random(seed))
    if arguments.part != "killed" and not arguments.only:
        complete(runner, failures)
        refused(runner, failures)
    finish(failures)


if __name__ == "__main__":
    main()
