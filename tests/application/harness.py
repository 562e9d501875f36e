"""Runs the real program and judges what it left behind.

Standard library only. Every test file holds tables of cases, calls
`parse_arguments` and ends with `finish(failures)`.
"""

import argparse
import concurrent.futures
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(
    os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PARAMETER_FILES = os.path.join(ROOT, "parameter_files")
MESHES = os.path.join(ROOT, "meshes")

# What a user must never see, whatever goes wrong.
FORBIDDEN = [
    r"Traceback", r"terminate", r"what\(\)", r"Exception", r"\bnan\b",
    r"internal failure", r"Segmentation", r"MPI_ABORT", r"An error occurred in"
]


def environment():
    """The environment of scripts/lib/environment on top of our own."""
    values = dict(os.environ)
    with open(os.path.join(ROOT, "scripts", "lib", "environment")) as file:
        for line in file:
            if re.match(r"[A-Z]", line):
                name, value = line.strip().split("=", 1)
                values[name] = value
    return values


def parse_arguments(description, **groups):
    """The command line shared by all test files."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument(
        "--program",
        default=os.path.join(ROOT, "build", "release", "perimorph"))
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--only", help="regular expression for case names")
    parser.add_argument("--show", action="store_true", help="print all output")
    for name, choices in groups.items():
        parser.add_argument("--" + name, choices=choices)
    return parser.parse_args()


class Outcome:
    """Exit code, texts and results of one run."""

    def __init__(self, code, stdout, stderr, folder, seconds=None):
        self.code = code
        self.seconds = seconds
        self.stdout = stdout
        self.stderr = stderr
        self.folder = folder

    @property
    def text(self):
        return self.stdout + self.stderr

    def path(self, name):
        return os.path.join(self.folder, name)

    def results(self):
        with open(self.path("results.json")) as file:
            return json.load(file, parse_constant=lambda name: math.nan)

    def value(self, name):
        return self.results()["quantities"][name]["value"]


class Runner:
    """Starts the program in a temporary folder of its own."""

    def __init__(self, arguments):
        self.program = os.path.abspath(arguments.program)
        self.mpirun = arguments.mpirun
        self.environment = environment()
        self.temporary = tempfile.TemporaryDirectory(prefix="perimorph_test_")

    def new_folder(self):
        return tempfile.mkdtemp(prefix="run", dir=self.temporary.name)

    def together(self, function, items, n_together=2):
        """function(item) of all items, in their order. Two runs at a time:
        the start of a small one is mostly waiting for MPI."""
        with concurrent.futures.ThreadPoolExecutor(n_together) as pool:
            yield from pool.map(function, items)

    def run(self, words, ranks=1, folder=None, output="out", timeout=1200):
        """Runs with these arguments; folder is where we start, and the
        results are expected in folder/output."""
        folder = folder or self.new_folder()
        command = [self.program] + list(words)
        if ranks > 1:
            command = [
                self.mpirun, "--quiet", "--oversubscribe", "-np",
                str(ranks)
            ] + command
        started = time.time()
        done = subprocess.run(
            command,
            cwd=folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            timeout=timeout)
        return Outcome(done.returncode,
                       done.stdout.decode(errors="replace"),
                       done.stderr.decode(errors="replace"),
                       os.path.join(folder, output),
                       time.time() - started)

    def run_case(self, file, overrides=(), ranks=1, options=()):
        """Runs a shipped parameter file; overrides: "Section/entry=value"."""
        words = [os.path.join(PARAMETER_FILES, file), "--output", "out"]
        for override in overrides:
            words += ["--set", override]
        return self.run(words + list(options), ranks)


class Failures:
    """Collects what is wrong, case by case."""

    def __init__(self):
        self.n_cases = 0
        self.failed = []
        self.messages = []
        self.started = 0.

    def begin(self, name):
        self.name = name
        self.messages = []
        self.n_cases += 1
        self.started = time.time()

    def check(self, condition, message):
        if not condition:
            self.messages.append(message)
        return condition

    def end(self, outcome=None):
        seconds = time.time() - self.started
        if outcome is not None and outcome.seconds is not None:
            seconds = outcome.seconds
        word = "FAILED" if self.messages else "ok"
        print("%-6s %s (%.1f s)" % (word, self.name, seconds))
        for message in self.messages:
            print("       " + message)
        if self.messages:
            self.failed.append(self.name)
            if outcome is not None:
                print(indented(outcome.text))
        sys.stdout.flush()

    def check_clean(self, text):
        for pattern in FORBIDDEN:
            found = re.search(pattern, text)
            self.check(not found, "the output contains %r" % pattern)

    def check_close(self, name, value, expected, tolerance):
        """Relative, or absolute for an expected 0."""
        scale = abs(expected) or 1.
        self.check(
            abs(value - expected) <= tolerance * scale,
            "%s is %.12g, not %.12g within %g" % (name, value, expected,
                                                  tolerance))

    def check_below(self, name, value, limit):
        self.check(value <= limit, "%s is %g, above %g" % (name, value, limit))


def indented(text, most=40):
    lines = text.splitlines()
    if len(lines) > most:
        lines = lines[:most] + ["... (%d lines)" % len(lines)]
    return "\n".join("       | " + line for line in lines)


def finish(failures):
    """Says what failed; ends the program."""
    print("%d cases, %d failed" % (failures.n_cases, len(failures.failed)))
    for name in failures.failed:
        print("  " + name)
    if failures.n_cases == 0:
        print("no case was selected")
    sys.exit(1 if failures.failed or failures.n_cases == 0 else 0)
