"""Crack paths in mixed mode on three meshes, a core that grows with the crack
against a large fixed one, growth at finite strain, and cracks along the fibres
of a composite.

No closed forms: the runs are compared with each other, and the paths in the
composite with its fibres (Hattori et al. (2017), section 6.2). Limits of the
acceptance: paths within one horizon, peak loads within 5 %; loads and
displacements of the two cores within 0.5 % at half the particles; energy
balance 1e-8, at finite strain 1 %; angles of paths in the composite 3 degrees.
"""

import math
import os

from verification import MESHES, Study

BEAM = "notched_beam.prm"
# Depth of the box in which the crack is fine, and the notch.
SPACINGS = (1. / 24, 1. / 32, 1. / 48)
NOTCH = (-1., .3)
# Length over which the load is averaged: single advances scatter.
START = .15

STRIP = {
    "Mesh/file": os.path.join(MESHES, "beam_rectangle.geo"),
    "Mesh/geometry parameters": "L = 1.5, d = 1.03125, nx = 24, ny = 17",
    "Material/state": "plane strain",
    "Cracks/maximum advances": 3,
}


def interpolate(x, xs, ys):
    for k in range(len(xs) - 1):
        if xs[k] <= x <= xs[k + 1]:
            share = (x - xs[k]) / (xs[k + 1] - xs[k])
            return ys[k] + share * (ys[k + 1] - ys[k])
    raise ValueError("%g outside of %g to %g" % (x, xs[0], xs[-1]))


class Path:

    def __init__(self, solution):
        table = solution.table("crack_growth")
        self.y = [NOTCH[1]] + table["y"]
        self.x = [NOTCH[0]] + table["x"]
        self.loads = table["load_factor"]
        left, sum_ = START, 0.
        for length, load in zip(table["length"], self.loads):
            sum_ += min(left, length) * load
            left -= min(left, length)
        self.start_load = sum_ / START


def paths_on_three_meshes(study):
    paths = []
    for h in SPACINGS:
        solution = study.solve(
            BEAM, {
                "Mesh/geometry parameters": "h = %.10g" % h,
                "Cracks/maximum advances": round(.3 / h) })
        study.below("h %.4f: energy balance" % h, solution["energy_balance"],
                    1e-8)
        paths.append(Path(solution))
    top = min(path.y[-1] for path in paths)
    study.above("depth that all paths reach", top, .75)
    heights = [NOTCH[1] + k * (top - NOTCH[1]) / 40. for k in range(1, 40)]
    finest = paths[-1]
    for h, path in zip(SPACINGS[:-1], paths):
        distance = max(
            abs(
                interpolate(y, path.y, path.x) -
                interpolate(y, finest.y, finest.x)) for y in heights)
        study.below("h %.4f: distance to the finest over its horizon" % h,
                    distance / (2. * SPACINGS[-1]), 1.)
        study.within_percent("h %.4f: load of the first %g" % (h, START),
                             path.start_load, finest.start_load, 5.)
    # Towards the load at x = 0, which is on the right of the notch.
    study.above("way to the right", finest.x[-1] - finest.x[0], .1)


def growing_and_fixed_core(study):
    few = {"Cracks/maximum advances": 8 }
    growing = study.solve(BEAM, few)
    fixed = study.solve(
        BEAM, dict(few, **{"Peridynamics/around": "box -1.25 0 0 1"}))
    study.below("particles over those of the fixed core",
                growing["particles"] /
                fixed["particles"], .5)
    for k, (load, reference) in enumerate(
            zip(Path(growing).loads,
                Path(fixed).loads)):
        study.within_percent("load of advance %d" % (k + 1), load, reference,
                             .5)
    for row, (value, reference) in enumerate(
            zip(
                growing.table("quantities")["load_deflection"],
                fixed.table("quantities")["load_deflection"])):
        study.within_percent("deflection of state %d" % (row + 1), value,
                             reference, .5)


def finite_strain(study):
    strip = "edge_crack_growth.prm"
    small = {"Cracks/fracture energy": "1e-8"}
    linear = study.solve(strip, dict(STRIP, **small))
    study.within_percent("K_I from the opening behind a grown tip",
                         linear["edge_tip1_K_I_opening"],
                         linear["edge_tip1_K_I"], 5.)
    hencky = study.solve(strip, dict(STRIP, **small,
                                     **{"Material/law": "hencky"}))
    for k, (load, reference) in enumerate(
            zip(
                hencky.table("crack_growth")["load_factor"],
                linear.table("crack_growth")["load_factor"])):
        study.within_percent("small strain: load of advance %d" % (k + 1),
                             load, reference, .2)
    large = dict(STRIP, **{"Material/law": "hencky",
                           "Cracks/fracture energy": "1e-2"})
    events = study.solve(strip, large)
    study.below("finite strain: energy balance", events["energy_balance"], .01)
    growth = events.table("crack_growth")
    for released, dissipated in zip(growth["released_energy"],
                                    growth["dissipated_energy"]):
        study.within_percent("released over dissipated energy", released,
                             dissipated, .001)
    study.below("stiffer than linear: last load over the first",
                growth["load_factor"][-1] / growth["load_factor"][0], 1.)
    # The same criterion by steps of the load, from below and above.
    for factor, expected in ((.999, 0), (1.001, 1)):
        steps = study.solve(
            strip,
            dict(
                large, **{
                    "Cracks/growth control": "load steps",
                    "Cracks/maximum advances": 1,
                    "Load steps/end time": growth["load_factor"][0] * factor
                }))
        study.within("advances in load steps at %g of the event" % factor,
                     round(steps.table("load_steps")["crack_growth"][-1] /
                           growth["length"][0]), expected, 0)


COMPOSITE = "composite_centre_crack.prm"
HALF_CRACK, HALF_WIDTH, HALF_HEIGHT = .0125, .0625, .125
REGULAR = {
    "Mesh/file": os.path.join(MESHES, "beam_rectangle.geo"),
    "Mesh/geometry parameters": "L = 0.125, d = 0.25, nx = 100, ny = 200"
}


def line_through(points):
    """Angle in degrees, from -90 to 90, of the line with the least sum of
    squared distances to the points."""
    n = len(points)
    mean = [sum(point[k] for point in points) / n for k in (0, 1)]
    xx, yy, xy = (sum((point[j] - mean[j]) * (point[k] - mean[k])
                      for point in points) for j, k in ((0, 0), (1, 1), (0, 1)))
    return math.degrees(.5 * math.atan2(2. * xy, xx - yy))


def branches(solution, angle):
    """Middles of the bonds that broke, on both sides of the crack, of fibres
    along the load above and below it, too."""
    table = solution.table("broken_bonds")
    middles = [(.5 * (table["x1"][k] + table["x2"][k]) - HALF_WIDTH,
                .5 * (table["y1"][k] + table["y2"][k]))
               for k in range(len(table["x1"]))]
    for side in (1., -1.):
        for way in (1., -1.) if angle == 90 else (0., ):
            yield [(x, y) for x, y in middles
                   if side * x > (.75 if angle == 90 else 1.) * HALF_CRACK and
                   way * y >= 0.]


def along_the_fibres(study):
    """Through the whole plate, but for fibres across the load, where all of it
    comes near its strength; along the load one of the four branches may stop a
    little short, once the others have cut their part free."""
    runs = [(0, "regular"), (45, "unstructured")]
    if study.arguments.extent == "long":
        runs = [(angle, mesh) for angle in (0, 45, 60, 90)
                for mesh in ("regular", "unstructured")]
    for angle, mesh in runs:
        changes = {"Material/orientation": angle}
        if angle in (45, 90):
            changes["Load steps/end time"] = 32e-6
        if mesh == "regular":
            changes.update(REGULAR)
        solution = study.solve(COMPOSITE, changes)
        for points in branches(solution, angle):
            name = "fibres at %d, %s: " % (angle, mesh)
            turned = (line_through(points) - angle + 90.) % 180. - 90.
            study.within(name + "path, degrees from them", turned, 0., 3.)
            way = (max(abs(y) for _, y in points) / HALF_HEIGHT
                   if angle == 90 else
                   max(abs(x) for x, _ in points) / HALF_WIDTH)
            study.above(name + "share of the way", way,
                        {0: .6, 90: .85}.get(angle, .95))
        study.below("fibres at %d, %s: energy balance" % (angle, mesh),
                    abs(solution["energy_balance"]), .01)


def main():
    study = Study(__doc__, extent=["short", "long"])
    for name, part in (("three meshes", paths_on_three_meshes),
                       ("growing and fixed core", growing_and_fixed_core),
                       ("finite strain", finite_strain),
                       ("along the fibres", along_the_fibres)):
        if study.part(name):
            part(study)
    study.finish()


if __name__ == "__main__":
    main()
