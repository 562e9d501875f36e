"""Plots of doc/performance, from the CSV files in it."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter  # noqa: E402

from cases import CASES  # noqa: E402
from runs import STAGES, read_table  # noqa: E402
from tables import largest  # noqa: E402

# Colour by the way to compute, line by the ratio of the horizon.
COLOURS = {"elements": "black", "coupled NOSB": "tab:blue",
           "coupled bonds": "tab:green", "PD NOSB": "tab:red",
           "PD bonds": "tab:orange"}
LINES = {"": "-", "m = 1.5": ":", "m = 2": "-", "m = 3": "--"}
MARKERS = {"": "s", "m = 1.5": "v", "m = 2": "o", "m = 3": "^"}


def label_two_and_five(value, _):
    """Ticks of logarithmic axes in plain numbers, 1, 2 and 5 of a decade."""
    return "%g" % value if ("%e" % value)[0] in "125" else ""


def logarithmic(axis):
    axis.set_xscale("log")
    axis.set_yscale("log")
    for set_formatter in (axis.xaxis.set_major_formatter,
                          axis.xaxis.set_minor_formatter):
        set_formatter(FuncFormatter(label_two_and_five))
    axis.tick_params(axis="x", which="both", labelsize=8)
    axis.grid(True, which="both", linewidth=.3)


def save(figure, path):
    figure.savefig(path, dpi=90, bbox_inches="tight")
    plt.close(figure)


def draw_errors(folder, name, rows):
    case = CASES[name]
    rows = [row for row in largest(rows, ["case"]) if not row["failed"]]
    columns = [("processor", "time (s)"), ("nodes", "nodes"),
               ("memory", "memory (MB)")]
    figure, axes = plt.subplots(1, 3, figsize=(12, 4.2), sharey=True,
                                layout="constrained")
    for axis, (column, title) in zip(axes, columns):
        for method in dict.fromkeys(row["method"] for row in rows):
            mine = [row for row in rows if row["method"] == method]
            kind, _, ratio = method.partition(", ")
            axis.plot([float(row[column]) for row in mine],
                      [float(row["error 1"]) for row in mine], label=method,
                      color=COLOURS[kind], linestyle=LINES[ratio],
                      marker=MARKERS[ratio], markersize=4, linewidth=1.2)
        logarithmic(axis)
        axis.set_xlabel(title)
        if column == "memory":  # within less than a decade
            axis.set_xscale("linear")
    axes[0].set_ylabel("relative error, " + case.errors[0][0])
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper left", fontsize=8,
                  frameon=False, bbox_to_anchor=(1., .93))
    figure.suptitle(case.title)
    save(figure, folder / (name + ".png"))


def draw_stages(folder, rows):
    rows = [row for row in largest(rows, ["run"]) if not row["failed"]]
    if not rows:
        return
    rows.reverse()
    figure, axis = plt.subplots(figsize=(10, 1.6 + .26 * len(rows)),
                                layout="constrained")
    left = [0.] * len(rows)
    colours = plt.get_cmap("tab10").colors
    for name, colour in zip(STAGES, colours):
        share = [100. * float(row["stage " + name]) / float(row["wall"])
                 for row in rows]
        axis.barh(range(len(rows)), share, left=left, color=colour,
                  label=name.replace("_", " "))
        left = [a + b for a, b in zip(left, share)]
    axis.set_yticks(range(len(rows)), [row["run"] for row in rows], fontsize=8)
    axis.set_xlim(0, 100)
    axis.margins(y=.01)
    axis.set_xlabel("share of the wall clock time (%)")
    figure.legend(loc="lower center", ncol=5, fontsize=8, frameon=False,
                  bbox_to_anchor=(.5, 1.))
    save(figure, folder / "stages.png")


def draw_growth(folder, rows):
    rows = [row for row in rows if row["run"].startswith("plate, 5 %, m = 2, ")
            and not row["failed"]]
    # One point per size of mesh, of the last size of the suite that has it.
    points = {int(row["nodes"]): row for row in largest(rows, ["run"])}
    if len(points) < 2:
        return
    nodes = sorted(points)
    figure, axis = plt.subplots(figsize=(6, 4.2), layout="constrained")
    names = ["mesh", "regions", "families", "patch_test", "assembly",
             "linear_solver"]
    for name in names:
        axis.plot(nodes, [max(float(points[n]["stage " + name]), 1e-4)
                          for n in nodes], marker="o", markersize=3,
                  label=name.replace("_", " "))
    times = [float(points[n]["processor"]) for n in nodes]
    axis.plot(nodes, times, "k-s", markersize=4, label="whole run")
    axis.plot(nodes, [times[0] * n / nodes[0] for n in nodes], "k:",
              linewidth=.8, label="linear")
    logarithmic(axis)
    axis.set_xlabel("nodes")
    axis.set_ylabel("time (s)")
    axis.legend(fontsize=8)
    axis.set_title("Growth: plate with hole, 5 % in PD, m = 2")
    save(figure, folder / "growth.png")


def draw(folder):
    errors = read_table(folder / "errors.csv")
    for name in CASES:
        rows = [row for row in errors if row["case"] == name]
        if rows:
            draw_errors(folder, name, rows)
    stages = read_table(folder / "stages.csv")
    draw_stages(folder, stages)
    draw_growth(folder, stages)
