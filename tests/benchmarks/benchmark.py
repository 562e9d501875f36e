"""The suite: errors of all cases, rows of the table of targets, what is left."""

import os
import re
import time

import plots
import tables
from cases import CASES, error_study, record
from reach import ROWS, SIZES, Rows, row_13
from runs import Session, fail, read_table, write_table

# Seconds after which runs that are compared are not repeated without --repeat.
PATIENCE = {"small": 4., "medium": 40., "large": 400.}


def machine(session, size):
    """What the numbers depend on, without names."""
    with open("/proc/cpuinfo") as file:
        model = re.search(r"model name\s*:\s*(.*)", file.read())
    with open("/proc/meminfo") as file:
        memory = int(file.readline().split()[1]) / 1024**2
    return dict(size=size, processor=model[1] if model else "unknown",
                cores=os.cpu_count(), memory="%.0f GB" % memory,
                load="%.1f" % os.getloadavg()[0],
                start_up="%.2f" % session.start_up,
                date=time.strftime("%Y-%m-%d"))


def main(arguments, folder):
    names = arguments.case or list(CASES) + list(ROWS)
    for name in names:
        if name not in CASES and name not in ROWS:
            fail("case '%s' is unknown; there are: %s" % (
                name, ", ".join(list(CASES) + list(ROWS))))
    output = arguments.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    if not arguments.draw:
        run(arguments, folder, names, output)
    write_table(output / "reach.csv", row_13(read_table(output / "stages.csv")),
                ["row", "size", "what"])
    plots.draw(output)
    tables.write_readme(output)
    print("Written: %s" % output)


def run(arguments, folder, names, output):
    session = Session(arguments.program.resolve(), arguments.mpirun, folder,
                      arguments.repeat or 3,
                      1e9 if arguments.repeat else PATIENCE[arguments.size])
    write_table(output / "machine.csv", [machine(session, arguments.size)],
                ["size"])
    began = time.time()
    for name in names:
        print("%s, %s" % (name, arguments.size), flush=True)
        if name in CASES:
            session.repeat = arguments.repeat or 1
            write_table(output / "errors.csv",
                        error_study(session, name, arguments.size),
                        ["case", "size", "method", "mesh"])
            continue
        session.repeat = arguments.repeat or 3
        rows = Rows(arguments.size)
        ROWS[name](session, rows, SIZES[arguments.size])
        write_table(output / "reach.csv", rows.rows, ["row", "size", "what"])
        stages = [dict(run=label, size=arguments.size, **record(result))
                  for label, result in rows.runs]
        if stages:
            write_table(output / "stages.csv", stages, ["run", "size"])
    print("%.0f s" % (time.time() - began))
