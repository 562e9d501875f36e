"""Named measurements, each with a target: ratios between runs of one session."""

import math
import os

from cases import CASES, crack, error, hole
from explicit import row_15
from runs import Run

# Cells along a half of the hole (plate) or a quarter circle (cavity) per size,
# whose nodes are about 3.9 nt^2 and 0.95 n^3.
SIZES = {
    "small": dict(plate=51, solid=16, full=16, ranks=(72, 20), elements=(51, 72),
                  growth=(25, 51, 88), particles=(51, 51)),
    "medium": dict(plate=160, solid=64, full=36, ranks=(253, 56),
                   elements=(160, 253), growth=(51, 88, 160, 277),
                   particles=(102, 88)),
    "large": dict(plate=160, solid=64, full=64, ranks=(253, 56),
                  elements=(160, 253), growth=(51, 88, 160, 277, 506),
                  particles=(102, 88)),
}
# Seconds that other programs took on this class of machine.
FENICSX = (1.9, 4.)
PERIDIGM = {"bond based": 54., "correspondence": 54., "cantilever": 250.}

ELEMENTS = (("Mode", "finite elements"),)


def method(ratio, mode="coupled", model="correspondence"):
    return (("Mode", mode), ("Peridynamics/model", model),
            ("Peridynamics/horizon ratio", ratio))


def plate(nt, entries, part=None, ranks=1):
    return Run("plate_with_hole", (("nt", nt), ("nr", round(1.944 * nt))),
               entries, ranks, part, 2.5)


def solid(n, entries, part=None, ranks=1):
    return Run("spherical_cavity", (("n", n), ("nr", round(1.266 * n))),
               entries, ranks, part, 1.)


class Rows:
    """Collects rows of reach.csv and the runs behind them."""

    def __init__(self, size):
        self.size = size
        self.rows = []
        self.runs = []

    def add(self, number, what, target, limit, value, wall=None, detail="",
            least=False):
        """value: what is compared with the limit (none: shown only); wall: the
        same by wall clock."""
        met = ""
        # Targets name sizes: small runs get no verdict (rows 8 and 14 have
        # their own sizes).
        judged = self.size != "small" or number in ("8", "14")
        if limit is not None and judged and not math.isnan(value):
            met = "yes" if (value >= limit if least else value <= limit) else "no"
        self.rows.append(dict(row=number, size=self.size, what=what,
                              target=target, measured="%.4g" % value,
                              wall="" if wall is None else "%.4g" % wall,
                              met=met, detail=detail))

    def keep(self, label, result):
        self.runs.append((label, result))

    def compare(self, number, what, limit, other, base, detail="",
                quantity=None):
        """Time of a run over that of another, by processor and by wall clock."""
        if other.failed or base.failed:
            self.add(number, what, "<= %g" % limit, limit, math.nan,
                     detail=other.failed or base.failed)
            return
        if quantity == "solve":
            stages = ("assembly", "linear_solver")
            self.add(number, what, "<= %g" % limit, limit,
                     other.time_of(*stages) / base.time_of(*stages),
                     sum(other.stages[name] for name in stages) /
                     sum(base.stages[name] for name in stages), detail)
            return
        self.add(number, what, "<= %g" % limit, limit,
                 other.processor / base.processor, other.wall / base.wall, detail)


def counted(result):
    counts = result.counts
    return "%d nodes, %.0f %% of them particles, %d iterations" % (
        counts["nodes"], 100. * counts["particles"] / counts["nodes"],
        counts["linear_iterations"])


def memory(rows, number, what, limit, other, base):
    rows.add(number, what + ", memory", "<= %g" % limit, limit,
             other.memory / base.memory,
             detail="%.0f MB against %.0f MB" % (other.memory, base.memory))


def row_1(session, rows, at):
    base, other = session.measure([
        plate(at["plate"], ELEMENTS), plate(at["plate"], method(2), .05)])
    what = "plate with hole, 5 % in PD, m = 2, against FE"
    rows.compare("1", what, 1.6, other, base, counted(other))
    memory(rows, "1", what, 1.5, other, base)
    rows.keep("plate, FE", base)
    rows.keep("plate, 5 %, m = 2", other)


def row_2(session, rows, at):
    base, other = session.measure([
        plate(at["plate"], ELEMENTS), plate(at["plate"], method(3), .25)])
    rows.compare("2", "plate with hole, 25 % in PD, m = 3, against FE", 2.5,
                 other, base, counted(other))
    rows.keep("plate, 25 %, m = 3", other)


def row_3(session, rows, at):
    results = session.measure([solid(at["solid"], ELEMENTS)] + [
        solid(at["solid"], method(m), .25) for m in (2, 3)])
    rows.keep("cavity, FE", results[0])
    for m, limit, most, other in zip((2, 3), (2.2, 3.2), (2., 3.), results[1:]):
        what = "cavity in 3D, 25 %% in PD, m = %d, against FE" % m
        rows.compare("3", what, limit, other, results[0], counted(other))
        if not other.failed:
            memory(rows, "3", what, most, other, results[0])
        rows.keep("cavity, 25 %%, m = %d" % m, other)


def row_4(session, rows, at):
    results = session.measure([solid(at["full"], ELEMENTS)] + [
        solid(at["full"], method(m, "peridynamics")) for m in (2, 3)])
    rows.keep("cavity of row 4, FE", results[0])
    for m, limit, other in zip((2, 3), (3.3, 5.5), results[1:]):
        rows.compare("4", "cavity in 3D, PD everywhere, m = %d, solve against FE"
                     % m, limit, other, results[0], counted(other)
                     if not other.failed else "", "solve")
        rows.keep("cavity, PD, m = %d" % m, other)


def row_5(session, rows, at):
    """Iterations to 1e-8. With the exact factors of the elements as
    preconditioner m = 2 takes 14, and 28 with a crack whose elements are
    softened (numerics.md, Q5); multigrid for them takes its own besides."""
    entries = (("Solver/linear solver", "iterative"),
               ("Solver/linear tolerance", 1e-8),
               ("Solver/Newton tolerance", 1e-7))
    uncracked = ELEMENTS + (("Cracks/pre-cracks", ""), ("Reference/values", ""))
    runs = [("coupled", 14, plate(nt, ELEMENTS + entries),
             plate(nt, method(2) + entries, .05))
            for nt in at["growth"][:2] + at["growth"][-1:]]
    runs += [("centre crack", 28,
              Run("centre_crack_square_plate", crack(n), uncracked + entries),
              Run("centre_crack_square_plate", crack(n), method(2) + entries))
             for n in ((32, 64) if rows.size == "small" else (64, 128, 256))]
    for name, exact, elements, coupled in runs:
        base, other = session.measure([elements, coupled], 1)
        own, count = (result.counts["linear_iterations"]
                      for result in (base, other))
        limit = 1.3 * exact + own
        rows.add("5", "iterations, %s, %d nodes" % (name, other.counts["nodes"]),
                 "<= %g" % limit, limit, count,
                 detail="%d of elements alone" % own)


def row_6(session, rows, at):
    for nt, seconds in zip(at["elements"], FENICSX):
        base, = session.measure([plate(nt, ELEMENTS)])
        ours = base.time_of("assembly", "linear_solver")
        rows.add("6", "FE, %d unknowns, assembly and solve against FEniCSx"
                 % base.counts["dofs"], "<= 1", 1., ours / seconds,
                 detail="%.2g s against %g s from the issue, another mesh%s" % (
                     ours, seconds, "; the size is not that of the target"
                     if rows.size == "small" else ""))
        rows.keep("plate, FE, %d unknowns" % base.counts["dofs"], base)


def row_7(session, rows, at):
    runs = [plate(nt, method(3, "peridynamics", model)) for nt, model in zip(
        at["particles"], ("bond based", "correspondence"))]
    runs.append(Run("cantilever_large_deflection", (("nx", 106), ("ny", 11)),
                    method(2.015, "peridynamics")))
    names = ("bond based", "correspondence", "cantilever")
    for name, least, result in zip(names, (20., 20., 100.),
                                   session.measure(runs)):
        what = "PD everywhere, %s, 10 steps" % name if name == "cantilever" \
            else "PD everywhere, %s plate, m = 3" % name
        value = math.nan if result.failed else (
            PERIDIGM[name] / result.processor)
        rows.add("7", what + ": seconds of Peridigm over ours", ">= %g" % least,
                 least, value, detail=result.failed or
                 "%d particles, %.2g s; %g s from the issue" % (
                     result.counts["particles"], result.processor,
                     PERIDIGM[name]), least=True)
        if not result.failed:
            rows.keep("%s, PD, %d particles" % (name, result.counts["particles"]),
                      result)


def row_8(session, rows, at):
    """The smallest shipped mesh with an error below 1 %."""
    for nt in (20, 30, 40):
        result, = session.measure([Run(
            "plate_with_hole", (("nt", nt), ("nr", round(1.8 * nt))),
            method(2))])
        error = result.quantities["stress_concentration"]["relative_error"]
        if abs(error) < .01:
            break
    seconds = result.processor - result.time_of("mesh")
    detail = "K_t %.2f %% off, %d nodes, %.2g s" % (
        100. * error, result.counts["nodes"], seconds)
    rows.add("8", "K_t of a plate with a hole within 1 %: nodes", "< 10000",
             10000, result.counts["nodes"] if abs(error) < .01 else math.nan,
             detail=detail)
    rows.add("8", "the same: seconds after meshing", "< 1", 1., seconds,
             result.wall - result.stages["mesh"], detail)


def at_equal_error(points, error):
    """Time at this error on the line through the points (time, error) in
    logarithms, its least squares."""
    x = [math.log(e) for _, e in points]
    y = [math.log(t) for t, _ in points]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum(
        (a - mean_x)**2 for a in x)
    return math.exp(mean_y + slope * (math.log(error) - mean_x))


def row_9(session, rows, at):
    """On the same graded meshes; and against peridynamics with cells of equal
    length between the hole and the outside, as a lattice has them."""
    for name in ("kirsch", "cavity"):
        chosen = CASES[name]
        what, quantity = chosen.errors[0]
        meshes = chosen.meshes[:2] if rows.size == "small" else chosen.meshes[:3]
        equal_error(rows, chosen.title, what, {
            label: [(result.processor, error(result, quantity))
                    for result in session.measure(
                        [Run(chosen.file, mesh, entries) for mesh in meshes])]
            for label, entries in (("FE", ELEMENTS), ("coupled", method(2)),
                                   ("PD", method(2, "peridynamics")))})
    chosen = CASES["plate_with_hole"]
    what, quantity = chosen.errors[1]
    cells = (5, 10) if rows.size == "small" else (10, 20, 40)
    # Cells of the hole's edge are pi a / (4 nt) long.
    even = [(("nt", nt), ("nr", round(22.5 / (2.5 * math.pi / 4. / nt))),
             ("pr", 1)) for nt in cells]
    graded = [hole(2 * nt) for nt in cells]
    equal_error(rows, chosen.title + ", PD on even cells", what, {
        label: [(result.processor, error(result, quantity))
                for result in session.measure(
                    [Run(chosen.file, mesh, entries) for mesh in meshes])]
        for label, entries, meshes in (
            ("FE", ELEMENTS, graded), ("coupled", method(2), graded),
            ("PD", method(2, "peridynamics"), even))})


def equal_error(rows, title, what, points):
    target = points["coupled"][-1][1]
    times = {name: at_equal_error(found, target)
             for name, found in points.items()}
    far = points["PD"][-1][1] / target
    detail = "error %.2g; lines through %d meshes; PD measured down to %.2g" % (
        target, len(points["PD"]), far * target)
    rows.add("9", "%s, equal error (%s): PD over coupled" % (title, what),
             ">= 20", 20., times["PD"] / times["coupled"], detail=detail,
             least=True)
    rows.add("9", "%s, equal error (%s): coupled over FE" % (title, what),
             "<= 1.5", 1.5, times["coupled"] / times["FE"], detail=detail)


def row_10(session, rows, at):
    """A crack as a row of elements taken out, on the grids of the coupled case;
    K_I from the change of energy with the length by two cells, which takes two
    runs: only one is counted, as if a contour gave it."""
    sizes = (32, 64) if rows.size == "small" else (64, 128, 256)
    half, modulus, exact = 5., 192e3, 41.82807
    elements = ELEMENTS + (("Cracks/pre-cracks", ""), ("Reference/values", ""))

    def slotted(cells):
        length = 16. / cells
        shorter, longer = session.measure([
            Run("centre_crack_square_plate", crack(cells), elements,
                slot=half + change) for change in (-length, length)])
        release = (longer.quantities["strain_energy"]["value"] -
                   shorter.quantities["strain_energy"]["value"]) / (4. * length)
        return longer.processor, abs((modulus * release)**.5 / exact - 1.)

    points = [slotted(cells) for cells in sizes]
    for cells in sizes[:-1] if rows.size == "small" else (32, 64, 128):
        coupled, = session.measure([
            Run("centre_crack_square_plate", crack(cells), method(2))])
        target = error(coupled, "centre_tip1_K_I")
        rows.add("10", "centre crack, equal error in K_I: deleted elements over "
                 "coupled with %d nodes" % coupled.counts["nodes"], ">= 10", 10.,
                 at_equal_error(points, target) / coupled.processor,
                 detail="error %.2g; a line through %d meshes, measured down to "
                 "%.2g" % (target, len(points), points[-1][1]), least=True)
        rows.keep("centre crack, coupled, %d nodes" % coupled.counts["nodes"],
                  coupled)


def row_11(session, rows, at):
    results = session.measure([plate(nt, method(2), .05) for nt in at["growth"]])
    nodes = [result.counts["nodes"] for result in results]
    detail = "%d to %d nodes" % (nodes[0], nodes[-1])

    def exponent(times):
        x, y = [math.log(n) for n in nodes], [math.log(t) for t in times]
        mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
        return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum(
            (a - mean_x)**2 for a in x)

    rows.add("11", "growth of time with nodes, all stages: exponent", "<= 1.1",
             1.1, exponent([r.processor for r in results]),
             exponent([r.wall for r in results]), detail)
    for stage in ("mesh", "regions", "families", "patch_test", "assembly",
                  "linear_solver"):
        rows.add("11", "the same, %s alone" % stage, "", None,
                 exponent([max(r.time_of(stage), 1e-4) for r in results]),
                 exponent([max(r.stages[stage], 1e-4) for r in results]), detail)
    for result in results:
        rows.keep("plate, 5 %%, m = 2, %d nodes" % result.counts["nodes"], result)


def row_12(session, rows, at):
    """By wall clock, so without a verdict, good or bad, unless the machine was
    idle before."""
    load = os.getloadavg()[0]
    # What we ran just before is in the mean of a minute: one core.
    idle = load < 1.2
    for name, build, count in zip(("2D", "3D"), (plate, solid), at["ranks"]):
        one, two = session.measure([build(count, method(2), .05, ranks)
                                    for ranks in (1, 2)])
        value = one.wall / two.wall
        rows.add("12", "one rank over two, %s, 5 %% in PD" % name, ">= 1.7",
                 1.7 if idle else None, value, value,
                 "%d unknowns, by wall clock; memory per rank %.2f of one%s" % (
                     one.counts["dofs"], two.memory / one.memory,
                     "" if idle else "; load %.1f before, no verdict" % load),
                 least=True)
        rows.add("12", "the same, linear solver alone", "", None,
                 one.stages["linear_solver"] / two.stages["linear_solver"])
        rows.keep("%s, one rank" % name, one)
        rows.keep("%s, two ranks" % name, two)


def row_13(stages):
    """Shares of runs of rows 2 and 3, from rows of stages.csv."""
    limits = {"plate, 25 %, m = 3": .15, "cavity, 25 %, m = 2": .25,
              "cavity, 25 %, m = 3": .25}
    found = []
    for row in stages:
        if row["run"] not in limits or row["failed"]:
            continue
        rows = Rows(row["size"])
        share = (float(row["stage families"]) + float(row["stage regions"])) / \
            float(row["wall"])
        rows.add("13", "share of families and regions, " + row["run"],
                 "<= %g" % limits[row["run"]], limits[row["run"]], share, share,
                 "%s nodes, %s iterations" % (row["nodes"],
                                              row["linear_iterations"]))
        found += rows.rows
    return found


def row_14(session, rows, at):
    """From even coarse meshes, halved around the place or everywhere to the
    same spacing. An error counts as reached when finer ones keep it."""
    everywhere = (("Mesh/Refinement/around", "volume domain"),)
    spacing = ("Mesh/Refinement/target spacing",)
    # FE: only where the hole is, with no region of its own.
    narrow = (("Peridynamics/core size", "0"),
              ("Peridynamics/blending width", "0"),
              ("Mesh/Refinement/distance", "1.5"))
    for what, limit, quantity, entries in (
            ("1 % in K_t, coupled", .01, "stress_concentration", ()),
            ("1 % in K_t, FE", .01, "stress_concentration",
             ELEMENTS + narrow)):
        compare_refined(rows, what, limit, [[session.measure([Run(
            "plate_with_hole_refined", (), entries + way +
            (spacing + (1. / 2**k,),))], 1)[0]
            for k in range(1, 4)] for way in ((), everywhere)],
            quantity)
    for what, entries in (
            ("0.5 % in K_I, core of 1 horizon",
             (("Peridynamics/core size", "1 horizons"),
              ("Peridynamics/blending width", "1 horizons"),
              ("Mesh/Refinement/distance", "0"))),
            ("0.5 % in K_I, core as it is by itself (5 horizons)", ())):
        found = []
        for way in ((), everywhere):
            found.append([])
            for k in range(1, 5):
                # The crack is in the middle of a row of cells.
                h = 50. / 16. / 2**k
                found[-1].append(session.measure([Run(
                    "centre_crack_refined", (), entries + way +
                    (spacing + (1.01 * h,), ("Cracks/pre-cracks",
                     "centre: -5 %g to 5 %g" % (h / 2., h / 2.))))], 1)[0])
        compare_refined(rows, what, .005, found, "centre_tip1_K_I")


def compare_refined(rows, what, limit, found, quantity):
    """found: measurements refined locally, then everywhere."""
    nodes, texts = [], []
    for results in found:
        errors = [error(result, quantity) for result in results]
        first = len(errors)
        while first > 0 and errors[first - 1] <= limit:
            first -= 1
        nodes.append(results[first].counts["nodes"] if first < len(errors)
                     else math.nan)
        texts.append(", ".join("%d: %.2f %%" % (result.counts["nodes"], 100. * e)
                               for result, e in zip(results, errors)))
    rows.add("14", "nodes for %s: refined locally over uniform" % what,
             "<= 0.1", .1, nodes[0] / nodes[1],
             detail="locally %s; uniform %s" % tuple(texts))


ROWS = {"row_1": row_1, "row_2": row_2, "row_3": row_3, "row_4": row_4,
        "row_5": row_5, "row_6": row_6, "row_7": row_7, "row_8": row_8,
        "row_9": row_9, "row_10": row_10, "row_11": row_11, "row_12": row_12,
        "row_14": row_14, "row_15": row_15}
