"""Growth of an edge crack bond by bond in a strip, a = 0.5, W = 1.5, pulled at
its ends: energy release rate at growth over G_c.

Reference: the numerical study (numerics-damage.md, sections 3 and 6): its
strip, its compliance -dE1/da from fine finite elements, its kappa = G / G_c for
nominal thresholds (mean over advances by h of the largest G in each, after a
first advance of one horizon). Limits of the acceptance: kappa within 5 % of the
study, load within 8 % of Griffith after calibration, balance 1e-8.
"""

import math
import os

from verification import MESHES, Study, write_parameters

H = 1. / 32.
# E1(a) at unit displacement of the ends: E1(.5) and -dE1/da (section 6).
ENERGY = 2.1083
SLOPE = ((.5, 1.897), (.6, 1.903), (.7, 1.916), (.8, 1.929))
# First event and kappa of the critical energy and of the critical stretch, and
# bonds to a = .85.
STUDY = {
    ("critical energy", 2): (1.548, 1.834, 53),
    ("critical energy", 3): (.611, 1.319, 195),
    ("critical stretch", 2): (1.338, 1.346, None),
    ("critical stretch", 3): (.689, .922, None),
}
# The first event for m = 3 is not reproduced: -5 % (energy), +2 % (stretch).
FIRST_IS_KNOWN_MISS = (3, )
# Bond-based: first event and kappa of bonds that break at once, kappa in six
# teeth (section 6, +-.04 and +-.03).
BOND_BASED = {2: (1.095, 1.64, 1.14), 3: (.903, 1.31, 1.04)}
# Elements beside the bonds are not those of the study (exact segments for
# averages over nodes): first event 1.075 and .825, with energy blending 1.127
# and .923. In teeth, m 2: 1.21 over a long run, on a crack that stays straight
# where that of the study wanders.
KNOWN_MISSES = {
    "bond based, m 2: first event": .03,
    "bond based, m 3: first event": .09,
    "bond based, m 2: kappa in teeth": .08,
}

UNSTRUCTURED = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, -33/64, 0, 1.5, 33/32};
Mesh.MeshSizeMin = 1/32; Mesh.MeshSizeMax = 1/32;
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 3; Mesh.RecombineAll = 1;
Physical Surface("body") = {1};
Physical Curve("bottom") = {1}; Physical Curve("right") = {2};
Physical Curve("top") = {3}; Physical Curve("left") = {4};
"""
STRIP = {
    "Material/Young's modulus": "1",
    "Material/Poisson's ratio": "0.3333333333333333",
    "Material/state": "plane stress",
    "Cracks/pre-cracks": "edge: 0 0 to 0.5 0",
    "Cracks/growth": "bonds",
    "Cracks/growth control": "events",
    "Cracks/fracture energy": "1",
    "Boundary conditions/displacement": "top: y = t; bottom: y = -t",
    "Boundary conditions/point displacement": "1.5 -0.515625: x = 0",
}
UNIFORM_MESH = {
    "Mesh/file": os.path.join(MESHES, "beam_rectangle.geo"),
    "Mesh/geometry parameters": "L = 1.5, d = 1.03125, nx = 48, ny = 33",
}
# What the study was measured with: families within the horizon.
AS_STUDIED = {
    "Peridynamics/coupling": "energy blending",
    "Peridynamics/stabilization scale": "shear modulus",
    "Cracks/treatment": "shape tensor",
    "Cracks/energy calibration": "1",
}


def slope(a):
    k = min(max(int((a - .5) / .1), 0), 2)
    (a0, s0), (a1, s1) = SLOPE[k:k + 2]
    return s0 + (s1 - s0) * (a - a0) / (a1 - a0)


def length_of(energy):
    """Crack length of a compliance, by the trapezoidal rule."""
    a, left, step = .45, ENERGY + .05 * slope(.475), 1e-4
    while left > energy:
        left -= step * slope(a + .5 * step)
        a += step
    return a


class Growth:
    """Loads and lengths of the states before each event."""

    def __init__(self, solution, m):
        table = solution.table("load_steps")
        times = table["time"][::2]
        self.lengths = [
            length_of(energy / t**2)
            for energy, t in zip(table["strain_energy"][::2], times)
        ]
        self.rates = [t * t * slope(a) for t, a in zip(times, self.lengths)]
        self.first = self.rates[0]
        largest = {}
        for a, rate in zip(self.lengths, self.rates):
            k = int((a - self.lengths[0]) / H + 1e-9)
            largest[k] = max(largest.get(k, 0.), rate)
        last = max(largest)
        plateau = [rate for k, rate in largest.items() if m <= k < last]
        self.kappa = (sum(plateau) / len(plateau) if plateau else math.nan)
        events = solution.table("broken_bonds")["event"]
        self.bonds = sum(1 for event in events
                         if self.lengths[int(event) - 1] < .85)


def solve(study, entries):
    folder = study.folder()
    path = os.path.join(folder, "strip.prm")
    if "Mesh/file" not in entries:
        with open(os.path.join(folder, "strip.geo"), "w") as file:
            file.write(UNSTRUCTURED)
        entries = dict(entries, **{"Mesh/file": "strip.geo"})
    write_parameters(path, dict(STRIP, **entries))
    return study.solve(path)


def bond_based(study, m):
    """The model without calibration: at once and in teeth."""
    base = dict(
        UNIFORM_MESH, **{
            "Peridynamics/model": "bond based",
            "Peridynamics/horizon ratio": m,
            "Cracks/treatment": "shape tensor",
        })
    what = "bond based, m %d: " % m
    first, kappa, in_teeth = BOND_BASED[m]
    solution = solve(
        study,
        dict(
            base, **{
                "Cracks/softening teeth": 1,
                "Cracks/maximum advances": 45 if m == 2 else 90,
            }))
    growth = Growth(solution, m)
    study.within_percent(what + "first event", growth.first, first, 1.)
    study.within(what + "kappa at once", growth.kappa, kappa, .04)
    study.below(what + "energy balance", solution["energy_balance"], 1e-8)
    solution = solve(
        study,
        dict(base,
             **{"Cracks/maximum advances": 130 if m == 2 else 220}))
    growth = Growth(solution, m)
    study.within(what + "kappa in teeth", growth.kappa, in_teeth, .03)
    study.below(what + "energy balance", solution["energy_balance"], 1e-8)


def main():
    study = Study(__doc__, KNOWN_MISSES, extent=["short", "long"])
    is_long = study.arguments.extent == "long"
    for (criterion, m), (first, kappa, bonds) in STUDY.items():
        if not study.part("as in the study: %s, m %d" % (criterion, m)):
            continue
        solution = solve(
            study,
            dict(
                UNIFORM_MESH, **AS_STUDIED, **{
                    "Peridynamics/horizon ratio": m,
                    "Cracks/criterion": criterion,
                    "Cracks/maximum advances": 45 if bonds == 53 else 90,
                }))
        growth = Growth(solution, m)
        if m in FIRST_IS_KNOWN_MISS:
            study.note("first event %.4g, study %.4g: known miss" %
                       (growth.first, first))
        else:
            study.within_percent("G / G_c of the first event", growth.first,
                                 first, 1.)
        study.within_percent("kappa", growth.kappa, kappa,
                             1. if bonds == 53 else 5.)
        if bonds and m == 2:
            study.within("bonds to a = .85", growth.bonds, bonds, 0)
        study.below("energy balance", solution["energy_balance"], 1e-8)

    for name, mesh in (("uniform", UNIFORM_MESH), ("unstructured", {})):
        for m in (2, 3):
            if not study.part("calibrated, %s mesh, m %d" % (name, m)):
                continue
            solution = solve(
                study,
                dict(
                    mesh, **{
                        "Peridynamics/horizon ratio": m,
                        "Cracks/maximum advances": 50,
                    }))
            growth = Growth(solution, m)
            study.within_percent("load over that of Griffith",
                                 math.sqrt(growth.kappa), 1., 8.)
            study.below("energy balance", solution["energy_balance"], 1e-8)

    for m in (2, 3) if is_long else (2, ):
        if study.part("bond based, m %d" % m):
            bond_based(study, m)
        if study.part("bond based, unstructured mesh, m %d" % m):
            solution = solve(
                study, {
                    "Peridynamics/model": "bond based",
                    "Peridynamics/horizon ratio": m,
                    "Cracks/maximum advances": 100 if m == 2 else 180,
                })
            growth = Growth(solution, m)
            study.within_percent("load over that of Griffith",
                                 math.sqrt(growth.kappa), 1., 8.)
            study.below("energy balance", solution["energy_balance"], 1e-8)

    if study.part("strip torn apart"):
        solution = solve(
            study, {
                "Mesh/file": os.path.join(MESHES, "beam_rectangle.geo"),
                "Mesh/geometry parameters":
                "L = 0.5, d = 1.0625, nx = 16, ny = 17",
                "Cracks/pre-cracks": "edge: 0 0 to 0.125 0",
                "Boundary conditions/point displacement":
                "0.5 -0.53125: x = 0",
            })
        table = solution.table("load_steps")
        study.below("strain energy left over the largest",
                    table["strain_energy"][-1] / max(table["strain_energy"]),
                    1e-8)
        study.below("energy balance", solution["energy_balance"], 1e-8)
        study.below("dissipated over released energy",
                    table["dissipated_energy"][-1] /
                    table["released_energy"][-1], 1.)
    study.finish()


if __name__ == "__main__":
    main()
