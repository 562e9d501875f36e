"""What the verification tests share: runs of the real program whose results
are rows of a table (what, measured, reference, limit, ok).

Limits are never bent to a measurement: they come from a formula, from an
independent computation or from the tables of the numerical studies, named
beside them in each test.
"""

import contextlib
import csv
import io
import math
import os
import re
import sys
import time

sys.path.insert(
    0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..",
                    "application"))
from harness import (Failures, MESHES, PARAMETER_FILES, Runner, finish,
                     indented, parse_arguments)

LAYOUT = "%-62s %11s %11s %15s %s"
WITHOUT_FIELDS = {"Output/fields": "false", "Output/particles": "false"}


def write_parameters(path, entries):
    """A parameter file from {"Section/Subsection/entry": value}."""
    sections = {}
    for name, value in entries.items():
        section, _, entry = name.rpartition("/")
        sections.setdefault(section, []).append("set %s = %s" % (entry, value))
    with open(path, "w") as file:
        for section, lines in sections.items():
            names = section.split("/") if section else []
            file.writelines("subsection %s\n" % name for name in names)
            file.write("\n".join(lines) + "\n")
            file.write("end\n" * len(names))
    return path


def read_table(path):
    """Columns of a .csv file by name, numbers or text; lines that start with #
    are comments."""
    with open(path) as file:
        lines = [line for line in file if line.strip() and line[0] != "#"]
    rows = list(csv.reader(lines))
    return {
        name: [number_or_text(row[k]) for row in rows[1:]]
        for k, name in enumerate(rows[0])
    }


def root_mean_square(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def relative_error(values, reference):
    """Relative L2 error over the rows of a table."""
    return (root_mean_square([a - b for a, b in zip(values, reference)]) /
            root_mean_square(reference))


def number_or_text(cell):
    try:
        return float(cell)
    except ValueError:
        return cell


class Solution(dict):
    """Quantities and checks of a run by name; nan when it has none."""

    folder = None
    quantity_names = ()

    def table(self, name):
        """Columns of a .csv file of the run; none if the run failed."""
        path = os.path.join(self.folder or "", name + ".csv")
        return read_table(path) if os.path.exists(path) else {}

    def __missing__(self, name):
        return math.nan


class Study:
    """Runs the program and judges what it gives, row by row."""

    def __init__(self, description, known_misses=None, **groups):
        """known_misses: row -> largest distance from its reference; such a row
        is beyond its limit, named as that, and fails only further out."""
        self.arguments = parse_arguments(description, **groups)
        self.runner = Runner(self.arguments)
        self.failures = Failures()
        self.known_misses = known_misses or {}
        self.missed = []

    def part(self, name, measured="measured", reference="reference"):
        """False if --only excludes it; else prints its name as a heading."""
        if self.arguments.only and not re.search(self.arguments.only, name):
            return False
        print("\n%s" % name)
        print(LAYOUT % ("what", measured, reference, "limit", ""))
        return True

    def folder(self):
        return self.runner.new_folder()

    def solve(self, file, overrides=None):
        """Runs a shipped case, or the file of an absolute path."""
        overrides = dict(WITHOUT_FIELDS, **(overrides or {}))
        words = ["%s=%s" % item for item in overrides.items()]
        started = time.time()
        outcome = self.runner.run_case(file, words)
        solution = Solution(seconds=time.time() - started)
        solution.folder = outcome.folder
        if self.arguments.show:
            print(indented(outcome.text, 1000))
        if outcome.code != 0:
            print("the program ended with %d:" % outcome.code)
            print(indented(outcome.text))
            return solution
        results = outcome.results()
        for group in ("checks", "counts", "companion"):
            for name, value in results[group].items():
                if isinstance(value, (int, float)):
                    solution[name] = value
        for name, quantity in results["quantities"].items():
            solution[name] = quantity["value"]
        solution.quantity_names = tuple(results["quantities"])
        solution["linear_solver"] = results["solver"]["linear_solver"]
        return solution

    def row(self, what, measured, reference, limit, good):
        """One row of the table; good decides."""
        word = "ok" if good else "FAILED"
        if not good and what in self.known_misses and abs(
                measured - (reference or 0.)) <= self.known_misses[what]:
            self.missed.append(what)
            good, word = True, "known miss"
        # The harness prints case by case; here the row is the print.
        with contextlib.redirect_stdout(io.StringIO()):
            self.failures.begin(what)
            self.failures.check(good, "beyond the limit")
            self.failures.end()
        print(LAYOUT % (what, number(measured), number(reference), limit,
                        word))
        sys.stdout.flush()

    def below(self, what, measured, limit):
        self.row(what, measured, None, "< %.4g" % limit, measured < limit)

    def above(self, what, measured, limit):
        self.row(what, measured, None, "> %.4g" % limit, measured > limit)

    def within(self, what, measured, reference, absolute):
        """Difference from the reference at most this."""
        self.row(what, measured, reference, "+- %.3g" % absolute,
                 abs(measured - reference) <= absolute)

    def within_percent(self, what, measured, reference, percent):
        """Relative difference from the reference at most this."""
        error = 100. * (measured / reference - 1.)
        self.row(what, measured, reference,
                 "%+.2f of %.3g %%" % (error, percent),
                 abs(error) <= percent)

    def between(self, what, measured, low, high):
        self.row(what, measured, None, "%.3g .. %.3g" % (low, high),
                 low <= measured <= high)

    def note(self, text):
        print("  " + text)

    def finish(self):
        print("\n%d rows" % self.failures.n_cases)
        for what in self.missed:
            print("  known miss: " + what)
        finish(self.failures)


def number(value):
    if value is None:
        return ""
    return "%.5g" % value


def rate(coarse, fine, refinement=2.):
    """Order of convergence from two errors."""
    if not (coarse > 0. and fine > 0.):
        return math.nan
    return math.log(coarse / fine) / math.log(refinement)
