"""Laws with material axes: homogeneous states to round-off at any angle of the
fibres, two laws in one body, axes that vary in space, bending.

References: compliance of an off-axis lamina (Jones, Mechanics of Composite
Materials, Eq. (2.97)); a ring of cylindrical orthotropy under pressure
(Lekhnitskii, u = A r^k + B r^-k with k^2 = E2 / E1); pure bending off the axes,
whose strain is the compliance times a stress linear in y, exact; strength by
Tsai and Hill (Hattori et al. (2017), Eq. (26)) and by the largest stress; where a plate
of two layers breaks (section 6.4 there).
"""

import math
import os

from msh_writer import structured, unit_box, write_msh
from verification import (MESHES, PARAMETER_FILES, Study, read_table,
                          write_parameters)

PLY = {"E1": 144.8, "E2": 11.7, "nu12": .21, "G12": 9.66}
ANGLES = (0, 30, 45, 60, 90)
LIMIT = 1e-10


def law(angle):
    return {
        "Material/law": "orthotropic",
        "Material/constants": ", ".join("%s = %r" % one
                                        for one in PLY.items()),
        "Material/orientation": angle,
        "Material/state": "plane stress",
        "Output/fields": "false"
    }


def compliance(angle):
    """Strains xx, yy and engineering shear xy of a unit stress along x."""
    E1, E2, nu12, G12 = PLY.values()
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return (c**4 / E1 + (1 / G12 - 2 * nu12 / E1) * c**2 * s**2 + s**4 / E2,
            -nu12 / E1 * (s**4 + c**4) +
            (1 / E1 + 1 / E2 - 1 / G12) * s**2 * c**2,
            (2 / E1 + 2 * nu12 / E1 - 1 / G12) * s * c**3 -
            (2 / E2 + 2 * nu12 / E1 - 1 / G12) * s**3 * c)


def off_axis_tension(study):
    if not study.part("off-axis tension, traction on both ends", "error in u"):
        return
    for number, angle in enumerate((0, 17) + ANGLES[1:] + (-30, )):
        xx, yy, xy = compliance(angle)
        for support in ("adjacent cells", "horizon"):
            solution = study.solve(write_parameters(
                os.path.join(study.folder(), "tension.prm"),
                dict(law(angle), **{
                    "Mesh/file": os.path.join(MESHES, "patch_test.geo"),
                    "Mesh/geometry parameters": "n = 16",
                    "Peridynamics/around": ("ball 0.5 0.5 0.15", "right",
                                            "point 1 1; left")[number % 3],
                    "Peridynamics/core size": "0.1",
                    "Peridynamics/blending width": "0.15",
                    "Peridynamics/horizon ratio": (1.5, 2, 3)[number % 3],
                    "Peridynamics/gradient support": support,
                    "Boundary conditions/traction": "right: x = 1; left: x = -1",
                    "Boundary conditions/point displacement":
                    "0 0: x = 0, y = 0; 1 0: y = 0",
                    "Reference/displacement":
                    "x = %.17g*x + %.17g*y, y = %.17g*y" % (xx, xy, yy)
                })))
            study.below("%g degrees, %s" % (angle, support),
                        max(solution["relative_displacement_error"],
                            solution["ghost_force"]), LIMIT)


def uneven(i, j):
    """Unit square whose nodes are moved, those on its sides and on x = 0.5
    along them."""
    x, y = i / 16., j / 16.
    wave = math.sin(2. * math.pi * y) * math.sin(2. * math.pi * x)
    return x + .03 * wave, y + .02 * math.cos(7. * x) * math.sin(
        3. * math.pi * y)


def write_bars(folder):
    """Two volumes, resin for x < 0.5 and fibres."""
    points, cells, surfaces = structured((16, 16), uneven)
    volumes = ["fibres" if sum(points[p][0] for p in cell) > 2. else "resin"
               for cell in cells]
    write_msh(os.path.join(folder, "bars.msh"), 2, points, cells, surfaces,
              volumes)


def two_laws(study):
    """Bars in series, no lateral strain: the stress is the same in both."""
    if not study.part("isotropic beside orthotropic", "error in u"):
        return
    for angle, E in ((0, PLY["E1"]), (90, PLY["E2"])):
        E1, E2, nu12, _ = PLY.values()
        stiff = E / (1 - nu12**2 * E2 / E1)
        soft = 3. / (1. - .3**2)
        folder = study.folder()
        write_bars(folder)
        solution = study.solve(write_parameters(
            os.path.join(folder, "bars.prm"), {
                "Mesh/file": "bars.msh",
                "Material/Young's modulus": 3, "Material/Poisson's ratio": .3,
                "Material/state": "plane stress",
                "Material/by volume": "fibres: %s, orientation = %g" % (
                    law(0)["Material/constants"], angle),
                "Peridynamics/around": "segment 0.5 0.4 0.5 0.6",
                "Peridynamics/core size": "0.1",
                "Peridynamics/blending width": "0.15",
                "Boundary conditions/symmetry": "x-, y-, y+",
                "Boundary conditions/traction": "x+: x = 1",
                "Reference/displacement":
                "x = min(x, 0.5)/%.17g + max(x - 0.5, 0)/%.17g, y = 0" % (
                    soft, stiff)
            }))
        study.below("fibres at %g degrees" % angle,
                    solution["relative_displacement_error"], LIMIT)


def bending(study):
    """Cantilever 4 x 1 in pure bending, fibres at an angle to its length."""
    if not study.part("bending off the axes, 8 cells deep",
                      "tip deflection error %"):
        return
    # About 1.3 times what was measured; elements: 0.1 to 4.7.
    for angle, limit in ((0, 4.), (30, .7), (45, .1), (60, .65), (90, .7)):
        xx, yy, xy = compliance(angle)
        field = "x = -y*(%.17g*x + (%.17g)*y), y = 0.5*(%.17g*x^2 - (%.17g)*y^2)" % (
            xx, xy / 2, xx, yy)
        solution = study.solve(write_parameters(
            os.path.join(study.folder(), "bending.prm"),
            dict(law(angle), **{
                "Mode": "peridynamics",
                "Mesh/file": os.path.join(MESHES, "beam_rectangle.geo"),
                "Boundary conditions/displacement": "left: " + field,
                "Boundary conditions/traction": "right: x = -y",
                "Quantities/deflection": "tip: 4 0, y"
            })))
        error = solution["tip_deflection"] / (8. * xx) - 1.
        study.below("%d degrees" % angle, 100. * abs(error), limit)


def ring(study):
    """Fibres around the hole (axis 2 radial), pressure 1 inside; 1 < r < 2."""
    if not study.part("ring of cylindrical orthotropy, fibres around it",
                      "u(a) error %"):
        return
    E1, E2, nu12, _ = PLY.values()
    along, across = E1, E2
    nu21 = nu12 * across / along
    factor = 1. / (1. - nu12 * nu21)
    k = math.sqrt(along / across)
    radial = lambda power: factor * (across * power + nu21 * along)
    # sigma_r(1) = -1, sigma_r(2) = 0
    ratio = -radial(k) * 2**(k - 1) / (radial(-k) * 2**(-k - 1))
    A = -1. / (radial(k) + ratio * radial(-k))
    exact = A * (1. + ratio)
    error = {}
    for mode, limit in (("finite elements", 1.4), ("coupled", 3.5)):
        for n in (8, 16):
            folder = study.folder()
            points, cells, surfaces = structured((n, 2 * n), lambda i, j: (
                (1. + i / n) * math.cos(j * math.pi / 4 / n),
                (1. + i / n) * math.sin(j * math.pi / 4 / n)))
            write_msh(os.path.join(folder, "ring.msh"), 2, points, cells,
                      surfaces)
            solution = study.solve(write_parameters(
                os.path.join(folder, "ring.prm"),
                dict(law("90 + atan2(y, x)*180/pi"), **{
                    "Mode": mode,
                    "Mesh/file": "ring.msh",
                    "Peridynamics/around": "x-",
                    "Peridynamics/core size": "0.2",
                    "Peridynamics/blending width": "0.3",
                    "Boundary conditions/symmetry": "y-, y+",
                    "Boundary conditions/pressure": "x-: 1",
                    "Quantities/deflection": "inside: 1 0, x"
                })))
            error[mode, n] = abs(solution["inside_deflection"] / exact - 1.)
            study.below("%s, %d cells across" % (mode, n),
                        100. * error[mode, n], limit / (1 if n == 8 else 3.5))


def strengths(study):
    """Nominal stress at the first broken bond of off_axis_tension.prm, whose
    field is uniform."""
    if not study.part("strength off the axes", "load", "load"):
        return
    path = os.path.join(PARAMETER_FILES, "reference", "tsai_hill_HTA6376.csv")
    table = {row[0]: row[1:] for row in zip(*read_table(path).values())}
    for angle in (0, 25, 30, 45, 60, 90):
        for criterion, expected in zip(("tsai-hill", "maximum stress"),
                                       table[angle]):
            solution = study.solve("off_axis_tension.prm", {
                "Expressions/constants": "theta = %d" % angle,
                "Cracks/criterion": criterion
            })
            load = solution.table("broken_bonds")["load_factor"][0]
            study.within_percent("%d degrees, %s" % (angle, criterion), load,
                                 expected, 1e-6)


def interface(study):
    """No lateral strain: the stress xx is the traction everywhere. Only the
    interface fails below 10."""
    if not study.part("strength of an interface", "load", "load"):
        return
    for given, expected in (("fibres, rest: X = 3, Y = 3, S = 9", 3.),
                            ("rest, fibres: X = 9, Y = 4, S = 9", 4.),
                            ("", 10.)):
        folder = study.folder()
        write_bars(folder)
        solution = study.solve(write_parameters(
            os.path.join(folder, "bars.prm"), {
                "Mesh/file": "bars.msh",
                "Material/Young's modulus": 3, "Material/Poisson's ratio": .3,
                "Material/state": "plane stress",
                # The fibres lie along y, the axis 1 of the rest along x.
                "Material/by volume": "fibres: %s, orientation = 90" % law(0)[
                    "Material/constants"],
                "Peridynamics/around": "segment 0.5 0 0.5 1",
                "Peridynamics/core size": "0.2",
                "Peridynamics/blending width": "0.15",
                "Cracks/growth": "bonds",
                "Cracks/growth control": "events",
                "Cracks/criterion": "maximum stress",
                "Cracks/strengths": "X = 10, Y = 10, S = 10",
                "Cracks/interface strengths": given,
                "Cracks/protected regions":
                "box 0 0 0.3 1; box 0.7 0 1 1",
                "Cracks/maximum advances": 1,
                "Boundary conditions/symmetry": "x-, y-, y+",
                "Boundary conditions/traction": "x+: x = t"
            }))
        table = solution.table("broken_bonds")
        study.within_percent(given or "as strong as the volumes",
                             table["load_factor"][0], expected, 1e-6)
        if given:
            away = max(min(abs(table["x1"][k] - .5), abs(table["x2"][k] - .5))
                       for k in range(len(table["x1"])))
            study.below("distance of broken bonds from it", away, 1e-12)


def delamination(study):
    """Bonds break along a weak interface, first of all where the crack lies below it;
    in the softer layer where the interface is as strong as both."""
    if not study.part("delamination", "measured"):
        return
    horizon = 3. * .15 / 160
    below = "edge: -0.075 -0.005 to -0.045 -0.005"
    for place, slit, crack in (("at the interface", .03, ""),
                               ("below it", 0, below)):
        for strong in (False, True):
            changes = {
                "Mesh/geometry parameters":
                "nx = 160, ny = 40, slit = %g" % slit,
                "Cracks/pre-cracks": crack,
                "Load steps/end time": 12e-6
            }
            if strong:
                changes["Cracks/interface strengths"] = ""
            table = study.solve("delamination.prm",
                                changes).table("broken_bonds")
            times = {True: [math.inf], False: [math.inf]}
            for time, y1, y2 in zip(*(table.get(name, [])
                                      for name in ("time", "y1", "y2"))):
                times[max(abs(y1), abs(y2)) < 1.001 * horizon].append(time)
            n_along = len(times[True]) - 1
            share = n_along / max(1, n_along + len(times[False]) - 1)
            name = "crack %s, interface %s: " % (
                place, "as strong as the layers" if strong else "weak")
            if strong:
                study.below(name + "share along it", share, .85)
            else:
                study.above(name + "share along it", share, .95)
                study.below(name + "opens first, time ratio",
                            min(times[True]) / min(times[False]), .8)


def turned_in_space(study):
    """Fibres turned to y; the others follow."""
    if not study.part("turned in three dimensions", "error in u"):
        return
    for turn, strains in (("x = 90, y = 0, z = 90", (.3, 1., .21)),
                          ("z = 90", (.21, 1., .3))):
        folder = study.folder()
        unit_box(os.path.join(folder, "box.msh"), (5, 5, 5), distortion=.2,
                 seed=5)
        x, y, z = (strain / 144.8 * (1 if strain == 1. else -1)
                   for strain in strains)
        solution = study.solve(write_parameters(
            os.path.join(folder, "box.prm"), {
                "Dimension": 3,
                "Mesh/file": "box.msh",
                "Material/law": "orthotropic",
                "Material/constants":
                "E1 = 144.8, E2 = 11.7, E3 = 9, nu12 = 0.21, nu13 = 0.3, "
                "nu23 = 0.4, G12 = 9.66, G13 = 8, G23 = 4",
                "Material/orientation": turn,
                "Peridynamics/around": "point 0.5 0.5 0.5",
                "Peridynamics/core size": "0.2",
                "Peridynamics/blending width": "0.2",
                "Boundary conditions/symmetry": "x-, y-, z-",
                "Boundary conditions/traction": "y+: y = 1",
                "Reference/displacement":
                "x = (%.17g)*x, y = %.17g*y, z = (%.17g)*z" % (x, y, z)
            }))
        study.below(turn, solution["relative_displacement_error"], LIMIT)


def main():
    study = Study(__doc__)
    off_axis_tension(study)
    two_laws(study)
    bending(study)
    ring(study)
    strengths(study)
    interface(study)
    delamination(study)
    turned_in_space(study)
    study.finish()


if __name__ == "__main__":
    main()
