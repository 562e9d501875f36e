"""Every bad input ends with exit code 2 and one clear message, the same on
any number of ranks, and leaves no results behind."""

import os
import re
import sys

import bad_input_body
import bad_input_files
import bad_input_materials
import bad_input_motion
from case_files import BOND_BASED, SOLID, parameter_text
from harness import Failures, Runner, finish, parse_arguments

TABLES = {
    "command_line": bad_input_files.COMMAND_LINE,
    "parameters": bad_input_files.PARAMETERS,
    "mesh": bad_input_files.MESH,
    "refinement": bad_input_body.REFINEMENT,
    "regions": bad_input_body.REGIONS,
    "conditions": bad_input_body.CONDITIONS,
    "quantities": bad_input_body.QUANTITIES,
    "breaking": bad_input_body.BREAKING,
    "materials": bad_input_materials.MATERIALS,
    "motion": bad_input_motion.MOTION,
}
# Rows that are also run on 3 ranks: one for each place in the program that
# finds errors.
ON_RANKS = [
    "unknown option", "unknown entry", "missing parameter file",
    "binary garbage as mesh", "inverted cell", "around an unknown boundary",
    "too few neighbours", "contradicting supports",
    "not a number in a body force", "reference data that is no number",
    "pushed unsupported body", "point outside",
    "unwritable output folder", "many errors in mesh names",
    "time step above the limit", "motion of a rigid plate"
]
# Those found on the rank that owns something, or by one rank for all: another
# number of ranks is another place.
ON_TWO_RANKS = [
    "binary garbage as mesh", "inverted cell", "too few neighbours",
    "not a number in a body force", "pushed unsupported body",
    "point outside", "unwritable output folder"
]


def write(path, content):
    if isinstance(content, str):
        content = content.encode()
    with open(path, "wb") as file:
        file.write(content)


def write_files(row, folder):
    text = row.get("text")
    if text is None:
        text = parameter_text(*row["changes"])
    files = dict(row.get("files", {}))
    files["case.prm"] = text
    for name, content in files.items():
        write(os.path.join(folder, name), content)
    for name in row.get("folders", []):
        os.mkdir(os.path.join(folder, name))


def run(runner, row, ranks=1):
    folder = runner.new_folder()
    write_files(row, folder)
    words = row.get("words", ["case.prm"]) + row.get("options", [])
    before = set(os.listdir(folder))
    outcome = runner.run(words, ranks, folder)
    outcome.written = set(os.listdir(folder)) - before
    outcome.start_folder = folder
    return outcome


def judge(failures, row, outcome):
    check = failures.check
    check(outcome.code == 2, "exit code %d, not 2" % outcome.code)
    text = outcome.stderr
    check(text.startswith("Error: "), "stderr does not begin with 'Error: '")
    for fragment in row["found"]:
        check(fragment in text, "the message lacks %r" % fragment)
    check(row["found"][0] not in outcome.stdout or "'" not in row["found"][0],
          "the message is on stdout")
    errors = re.split(r"^Error: ", text, flags=re.M)[1:]
    n_errors = row.get("n_errors", 1)
    check(len(errors) == 1 if n_errors == 1 else len(errors) >= n_errors,
          "%d messages instead of %d" % (len(errors), n_errors))
    check(len(set(errors)) == len(errors), "a message comes twice")
    for error in errors:
        facts = ("allowed: " in error or re.search(r"\b[Ii]t has: ", error) or
                 "belongs in" in error or "did you mean" in error)
        check(facts or row.get("plain"), "no word on what is allowed")
    visible = outcome.text
    for word in row.get("allow", []):
        visible = visible.replace(word, "")
    failures.check_clean(visible)
    check(row.get("late") or not outcome.written,
          "left behind: %s" % ", ".join(sorted(outcome.written)))
    for place, _, names in os.walk(outcome.start_folder):
        check("results.json" not in names, "results.json in " + place)


def check_base_cases(failures, runner):
    """The rows fail because of what they change, not because of the base."""
    for name, changes in [("plane", []), ("solid", [SOLID]),
                          ("bond based", [BOND_BASED])]:
        failures.begin("base case is valid: " + name)
        outcome = run(runner, dict(changes=changes))
        failures.check(outcome.code == 0, "exit code %d" % outcome.code)
        failures.end(outcome)


def check_on_ranks(failures, runner, selected):
    rows = {row["name"]: row for table in TABLES.values() for row in table}
    runs = [(name, ranks) for name in filter(selected, ON_RANKS)
            for ranks in (1, 2, 3) if ranks != 2 or name in ON_TWO_RANKS]
    one = None
    for (name, ranks), outcome in zip(
            runs,
            runner.together(lambda pair: run(runner, rows[pair[0]], pair[1]),
                            runs)):
        if ranks == 1:
            one = outcome
            continue
        failures.begin("%s on %d ranks" % (name, ranks))
        judge(failures, rows[name], outcome)
        failures.check(outcome.stderr == one.stderr,
                       "another message than on one rank")
        failures.end(outcome)


def main():
    arguments = parse_arguments(__doc__, group=list(TABLES) + ["ranks"])
    runner = Runner(arguments)
    failures = Failures()

    def selected(name):
        return not arguments.only or re.search(arguments.only, name)

    names = [row["name"] for table in TABLES.values() for row in table]
    if len(set(names)) != len(names):
        sys.exit("two rows have the same name")
    if arguments.group in (None, "command_line") and not arguments.only:
        check_base_cases(failures, runner)
    for group, table in TABLES.items():
        rows = [row for row in table
                if arguments.group in (None, group) and selected(row["name"])]
        for row, outcome in zip(
                rows, runner.together(lambda row: run(runner, row), rows)):
            failures.begin(row["name"])
            judge(failures, row, outcome)
            failures.end(outcome)
            if arguments.show and row["name"] not in failures.failed:
                print(outcome.text)
    if arguments.group in (None, "ranks"):
        check_on_ranks(failures, runner, selected)
    finish(failures)


if __name__ == "__main__":
    main()
