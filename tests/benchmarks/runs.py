"""Runs the program repeatedly and measures it: time, memory, counts, errors."""

import csv
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "application"))
from harness import environment  # noqa: E402

# Stages of results.json that do not overlap; "set-up" is what is left of it.
STAGES = ["mesh", "regions", "families", "other set-up", "patch_test",
          "assembly", "linear_solver", "recovery", "output", "rest"]
COUNTS = ["nodes", "dofs", "cells", "active_cells", "particles", "bonds",
          "newton_iterations", "linear_iterations"]


def fail(message):
    sys.exit("Error: " + message)


@dataclass(frozen=True)
class Run:
    """A shipped parameter file on a mesh of its geometry, with other entries.

    geometry, entries: tuples of (name, value); part: share of all nodes that
    peridynamics takes around the hole or cavity at the origin whose radius is
    `radius`, or None; slot: half the length of the row of cells along y = 0 that
    is taken out of the mesh.
    """
    file: str
    geometry: tuple = ()
    entries: tuple = ()
    ranks: int = 1
    part: float = None
    radius: float = 0.
    slot: float = 0.


@dataclass
class Measurement:
    """Medians over the repetitions; seconds, megabytes."""
    wall: float
    processor: float
    memory: float
    counts: dict
    stages: dict
    quantities: dict
    solver: str
    repetitions: int
    failed: str = ""

    def time_of(self, *names):
        """Processor time of stages: their share of the time of the run (what
        else the machine does makes all stages longer)."""
        return self.processor * sum(
            self.stages[name] for name in names) / self.wall


@dataclass
class Session:
    """Runs on this machine; a run that was measured is not measured again.
    Runs are repeated up to `repeat` times, no more once the seconds of
    `patience` are spent on those that are compared with each other."""
    program: pathlib.Path
    mpirun: str
    folder: pathlib.Path
    repeat: int
    patience: float
    known: dict = field(default_factory=dict)

    def __post_init__(self):
        self.environment = environment()
        self.start_up = statistics.median(
            self.spend([self.program, "--version"])[1] for _ in range(3))

    def spend(self, command):
        """Exit code, processor seconds up to the first line of the output and
        after it, text. What is before is start-up: libraries, MPI."""
        process = subprocess.Popen([str(word) for word in command],
                                   stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, cwd=self.folder,
                                   env=self.environment, text=True,
                                   errors="replace")
        text = process.stdout.readline()
        try:
            with open("/proc/%d/schedstat" % process.pid) as file:
                before = 1e-9 * int(file.read().split()[0])
        except (OSError, ValueError, IndexError):
            before = 0.
        text += process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        process.stdout.close()
        return (process.returncode, before,
                usage.ru_utime + usage.ru_stime - before, text)

    def mesh(self, run):
        """The .msh of a run: meshed once, so that no run contains gmsh."""
        text = (ROOT / "parameter_files" / (run.file + ".prm")).read_text()
        text = re.sub(r"#.*", "", text).replace("\\\n", " ")
        geometry = ROOT / "parameter_files" / re.search(
            r"set file\s*=\s*(\S+)", text)[1]
        default = re.search(r"set geometry parameters\s*=\s*(.*)", text)
        values = dict(
            re.findall(r"([\w]+)\s*=\s*([-+.\deE]+)", default[1])
            if default else ())
        values.update((name, "%.17g" % value) for name, value in run.geometry)
        dimension = re.search(r"set Dimension\s*=\s*(\d)", text)
        name = "_".join([geometry.stem] +
                        ["%s%s" % word for word in sorted(values.items())])
        path = self.folder / (name + ".msh")
        if not path.exists():
            command = ["gmsh", "-" + (dimension[1] if dimension else "2"),
                       geometry, "-format", "msh41", "-o", path]
            for word in values.items():
                command += ["-setnumber", *word]
            code, _, _, output = self.spend(command)
            if code != 0 or not path.exists():
                fail("gmsh could not mesh %s:\n%s" % (geometry, output))
        return path

    def command(self, run, output):
        mesh = self.mesh(run)
        if run.slot:
            mesh = without_slot(mesh, run.slot)
        entries = {
            "Mesh/file": mesh, "Mesh/geometry parameters": "",
            "Quantities/compare with finite elements": "false",
            "Output/fields": "false", "Output/checkpoint": "false",
        }
        entries.update(run.entries)
        if run.part:
            reach = distance_of_part(mesh, run.part, run.radius)
            entries["Peridynamics/core size"] = .75 * reach
            entries["Peridynamics/blending width"] = .25 * reach
        words = [self.program, ROOT / "parameter_files" / (run.file + ".prm"),
                 "--output", output]
        for entry in entries.items():
            words += ["--set", "%s=%s" % entry]
        if run.ranks > 1:
            words = [self.mpirun, "--quiet", "--oversubscribe", "-np",
                     run.ranks] + words
        return words

    def once(self, run):
        output = self.folder / "output"
        code, _, seconds, text = self.spend(self.command(run, output))
        if code != 0:
            return None, seconds, text
        return (json.loads((output / "results.json").read_text()),
                max(seconds, 1e-3), text)

    def measure(self, runs, repeat=None):
        """Measures runs that are compared with each other, in turns: what else
        the machine does meets all of them."""
        samples = {run: [] for run in runs if run not in self.known}
        first = time.time()
        for k in range(repeat or self.repeat):
            if k > 0 and time.time() - first > self.patience:
                break
            for run, sample in samples.items():
                if sample and sample[-1][0] is None:
                    continue
                began = time.time()
                sample.append(self.once(run))
                print("  %-28s %s%s: %.1f s" % (
                    run.file, describe(run), " on %d ranks" % run.ranks
                    if run.ranks > 1 else "", time.time() - began), flush=True)
        for run, sample in samples.items():
            self.known[run] = summary(sample)
        return [self.known[run] for run in runs]


def describe(run):
    words = dict(run.entries)
    text = words.get("Mode", "coupled")
    if text != "finite elements":
        text += ", %s, m = %s" % (words.get("Peridynamics/model", "as shipped"),
                                  words.get("Peridynamics/horizon ratio", "?"))
    return text


def summary(sample):
    results, _, text = sample[-1]
    if results is None:
        lines = [line for line in text.splitlines() if "rror" in line]
        return Measurement(0., 0., 0., {}, {}, {}, "", len(sample),
                           lines[0].strip() if lines else "failed")
    # The stages of the run whose time is the median, which add up to it.
    times = sorted(((one["timings"]["total"], k)
                    for k, (one, _, _) in enumerate(sample)))
    wall, middle = times[len(times) // 2]
    return Measurement(
        wall=wall,
        processor=statistics.median(s[1] for s in sample),
        memory=statistics.median(s[0]["peak_memory_mb"] for s in sample),
        counts=dict(results["counts"]),
        stages=stages_of(sample[middle][0]["timings"]),
        quantities=results["quantities"],
        solver=results["solver"]["linear_solver"],
        repetitions=len(sample))


def stages_of(timings):
    """Stages that do not overlap, whose sum is the total."""
    stages = {name: timings.get(name, 0.) for name in STAGES}
    stages["other set-up"] = timings["setup"] - sum(
        stages[name] for name in ("mesh", "regions", "families"))
    stages["rest"] = timings["total"] - sum(stages.values())
    return stages


def distance_of_part(path, part, radius):
    """The distance from a hole or cavity around the origin within which this
    part of all nodes lies, from the mesh (MSH 4.1)."""
    distances = []
    with open(path) as file:
        for line in file:
            if line.startswith("$Nodes"):
                break
        for _ in range(int(next(file).split()[0])):
            count = int(next(file).split()[3])
            for _ in range(count):
                next(file)
            for _ in range(count):
                x = [float(word) for word in next(file).split()]
                distances.append(sum(c * c for c in x)**.5 - radius)
    distances.sort()
    return distances[int(part * len(distances))]


def without_slot(path, half_length):
    """The mesh without the cells whose centre has |x| < half_length and lies
    within a hundredth of their height of y = 0 (MSH 4.1, quadrilaterals)."""
    found = path.with_name("%s_slot%.12g.msh" % (path.stem, half_length))
    lines = path.read_text().splitlines()
    points = {}
    at = lines.index("$Nodes") + 2
    for _ in range(int(lines[at - 1].split()[0])):
        count = int(lines[at].split()[3])
        for k in range(count):
            points[lines[at + 1 + k]] = [
                float(word) for word in lines[at + 1 + count + k].split()[:2]]
        at += 1 + 2 * count

    def stays(cell):
        corners = [points[node] for node in cell.split()[1:]]
        x, y = (sum(corner) / 4. for corner in zip(*corners))
        height = max(c[1] for c in corners) - min(c[1] for c in corners)
        return abs(x) > half_length or abs(y) > .01 * height

    begin = lines.index("$Elements")
    at, total, blocks = begin + 2, 0, []
    for _ in range(int(lines[at - 1].split()[0])):
        *entity, kind, count = lines[at].split()
        cells = lines[at + 1:at + 1 + int(count)]
        if kind == "3":
            cells = [cell for cell in cells if stays(cell)]
        if cells:
            blocks += [" ".join(entity + [kind, str(len(cells))])] + cells
            total += 1
        at += 1 + int(count)
    sizes = lines[begin + 1].split()
    kept = len(blocks) - total
    found.write_text("\n".join(
        lines[:begin + 1] + ["%d %d %s %s" % (total, kept, *sizes[2:])] + blocks +
        lines[at:]) + "\n")
    return found


def write_table(path, rows, keys):
    """Adds rows (dictionaries) to a CSV file; those that agree in all keys with
    a new one are replaced."""
    if not rows:
        return
    old = read_table(path)
    new = {tuple(str(row[key]) for key in keys) for row in rows}
    rows = [row for row in old
            if tuple(row[key] for key in keys) not in new] + rows
    names = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, names, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_table(path):
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))
