"""Cracks in motion: under a sudden and a growing stress, in a composite, between
an inclusion and a hole, and between two densities.

References: Freund's formula, an independent program (composite: its integral, and
the fit of another one to the opening), elements with a slit (inclusion and hole),
the mirror image. --extent long adds schemes, tips and cases.
"""

import bisect
import math

from verification import (MESHES, Study, read_table, relative_error,
                          root_mean_square)
from harness import PARAMETER_FILES

BOND_BASED = {"Peridynamics/model": "bond based"}
CRACK = "suddenly_loaded_crack.prm"
DENSITY, STRESS, END_TIME = 7800., 1e6, 16e-6

COMPOSITE_CRACK = "dynamic_edge_crack.prm"
AXES_OF_FIBRES = (0, 90)

# The nodes beside this crack are 0.1 and 0.9 spacings from it: its faces, in the
# middle between them, are 0.4 beside its line.
KNOWN_MISSES = {
    "coupled, explicit, tip at (0, 0.1) h: mean error of K_I %": 1.1
}


def wave_speed(poisson):
    """Modulus of uniaxial strain, speed of pressure waves in the plate."""
    modulus = 200e9 * (1. - poisson) / ((1. + poisson) * (1. - 2. * poisson))
    return modulus, math.sqrt(modulus / DENSITY)


def crack_errors(study, changes, poisson, grows):
    """Error of K_I in % from the time in which a wave runs through 18 horizons
    to 0.95 of the time of the first wave that returns. Of a stress that grows
    as t K_I is 2/3 of that of the stress reached (superposition)."""
    modulus, speed = wave_speed(poisson)
    changes = dict(changes)
    changes["Material/Poisson's ratio"] = poisson
    changes["Expressions/constants"] = "sigma = %g, modulus = %.17g" % (
        STRESS / END_TIME if grows else STRESS, modulus)
    if grows:
        changes.update({
            "Boundary conditions/traction":
            "top: y = sigma*t; bottom: y = -sigma*t",
            "Time integration/initial displacement": "",
            "Time integration/initial velocity": "y = sigma/modulus*y"})
    table = study.solve(CRACK, changes).table("quantities")
    horizon = changes.get("Peridynamics/horizon ratio", 2) * 0.1 / 101
    errors = []
    for time, factor in zip(table.get("time", []),
                            table.get("edge_tip1_K_I", [])):
        if 18. * horizon <= speed * time <= .95 * 0.1:
            stress = STRESS * time / END_TIME * 2. / 3. if grows else STRESS
            exact = 2. * stress / (1. - poisson) * math.sqrt(
                speed * time * (1. - 2. * poisson) / math.pi)
            errors.append(100. * (factor / exact - 1.))
    return errors or [math.nan]


def crack_in_motion(study):
    """A stress that is there at once, and one that grows."""
    explicit = {"Time integration/scheme": "explicit",
                "Time integration/time step": "0"}
    elements = dict(explicit, **{"Mode": "finite elements",
                                 "Mesh/file": MESHES + "/edge_slit.geo"})
    fine = {"Mesh/geometry parameters": "n = 100"}
    coarse = {"Mesh/geometry parameters": "n = 50"}
    at_node = {"Mesh/geometry parameters":
               "L = 0.1, d = 0.1, nx = 100, ny = 100"}
    # Explicit: nothing damps the short waves that the jump of the load leaves
    # beside the crack.
    sudden = {"finite elements, h/a 1/25": (dict(elements, **coarse), .3),
              "coupled, implicit": ({}, .3),
              "coupled, explicit": (explicit, .3),
              "coupled, explicit, tip at a node": (dict(explicit, **at_node),
                                                   .3),
              "bond based, explicit": (dict(explicit, **BOND_BASED), .25)}
    growing = {"coupled, explicit": (explicit, .3)}
    if study.arguments.extent == "long":
        sudden.update({
            "finite elements, h/a 1/50": (dict(elements, **fine), .3),
            "coupled, m 3": ({"Peridynamics/horizon ratio": 3}, .3),
            "coupled, bond based": (BOND_BASED, .25)})
        # A tip anywhere between the nodes.
        for x, y in ((-.25, 0.), (.25, 0.), (0., .1), (.1, .1)):
            sudden["coupled, explicit, tip at (%g, %g) h" % (x, y)] = (
                dict(explicit, **at_node, **{
                    "Cracks/pre-cracks": "edge: 0 %g to %.10g %g" %
                    (1e-3 * y, .05 + 1e-3 * x, 1e-3 * y)}), .3)
        growing.update({
            "finite elements, h/a 1/50": (dict(elements, **fine), .3),
            "bond based, explicit": (dict(explicit, **BOND_BASED), .25)})
    for title, cases in (("suddenly loaded crack", sudden),
                         ("crack under a growing stress", growing)):
        if not study.part(title, "%"):
            continue
        for name, (changes, poisson) in cases.items():
            errors = crack_errors(study, changes, poisson, cases is growing)
            label = "%s%s: " % ("growing, " if cases is growing else "", name)
            study.below(label + "largest error of K_I %",
                        max(abs(error) for error in errors), 3.)
            study.below(label + "mean error of K_I %",
                        abs(sum(errors) / len(errors)), 1.)


def factors_over_time(study, changes):
    """K_I and K_II of inclusion_and_hole.prm beyond its start."""
    table = study.solve("inclusion_and_hole.prm", changes).table("quantities")
    return [table.get("edge_tip1_" + name, [math.nan] * 2)[1:]
            for name in ("K_I", "K_II")]


def inclusion_and_hole(study):
    """Coupled against finite elements alone with a slit, on the same mesh and by the
    same integral. What reflects differs above and below the crack, so fibres along
    or across it do not make K_II zero."""
    if not study.part("inclusion and hole", "%"):
        return
    is_long = study.arguments.extent == "long"
    inclusion = ("inclusion: C11 = 235e9, C12 = 3.69e9, C22 = 24e9, "
                 "C66 = 28.2e9, orientation = 0, density = 5670")
    cases = {
        "0 degrees": (0, "dx = 0.000125, ", {}),
        "45 degrees": (45, "", {})
    }
    if is_long:
        cases["90 degrees"] = (90, "", {})
        cases["45 degrees, C22 = 24 GPa"] = (45, "", {
            "Material/by volume": inclusion})
    for name, (angle, mesh, changes) in cases.items():
        changes = dict(changes, **{
            "Expressions/constants": "theta = %d" % angle})
        if not is_long:
            changes["Load steps/end time"] = 12e-6
            changes["Load steps/number of steps"] = 60
        coupled = factors_over_time(study, dict(changes, **{
            "Mesh/geometry parameters": mesh + "slit = 0"}))
        elements = factors_over_time(study, dict(changes, **{
            "Mode": "finite elements",
            "Mesh/geometry parameters": mesh + "slit = 1"}))
        for symbol, values, reference in zip(("K_I", "K_II"), coupled,
                                             elements):
            study.below("%s: error of %s" % (name, symbol),
                        100. * relative_error(values, reference), 5.)
        study.above("%s: largest K_II over largest K_I" % name,
                    100. * max(map(abs, coupled[1])) / max(coupled[0]), 5.)


def factor_errors(study, angle, n, changes, reference):
    """Relative L2 errors in % over time: of K_I, of K_II (fibres along an axis:
    K_II over K_I) and of K_I by opening; largest difference of J between two
    domains in %, from a sixth of the time on."""
    table = study.solve(
        COMPOSITE_CRACK,
        dict({"Material/orientation": angle,
              "Mesh/geometry parameters": "L = 0.1, d = 0.1, nx = %d, ny = %d" %
              (n, n),
              "Reference/values": ""}, **changes)).table("quantities")
    rows = [row for row in zip(*(reference[name] for name in
                                 ("angle", "time", "K_I", "K_II")))
            if row[0] == angle]
    times = table.get("time", [])
    if len(times) != len(rows) or any(
            abs(time - row[1]) > 1e-12 for time, row in zip(times, rows)):
        return [math.nan] * 4
    K_I, K_II = ([row[k] for row in rows] for k in (2, 3))
    size = root_mean_square(K_I if angle in AXES_OF_FIBRES else K_II)
    return [
        100. * relative_error(table["edge_tip1_K_I"], K_I),
        100. * root_mean_square([
            a - b for a, b in zip(table["edge_tip1_K_II"], K_II)]) / size,
        100. * relative_error(table["edge_tip1_K_I_opening"], K_I),
        100. * max(table["edge_tip1_domain_dependence"][len(rows) // 6:])]


def crack_in_composite(study):
    """K_I within 2.5 %, K_II at 200 cells; its errors fall as the spacing, so 5 %
    at 100. The opening is a check with three times the error of K_II. Summed with
    other weights than the masses, J differs by 2.7 % (45 degrees) and 30 % (90)
    between the domains."""
    if not study.part("edge crack in a composite", "%"):
        return
    is_long = study.arguments.extent == "long"
    reference = read_table(PARAMETER_FILES +
                           "/reference/dynamic_edge_crack.csv")
    elements = {"Mode": "finite elements",
                "Mesh/file": MESHES + "/edge_slit.geo"}
    for angle in (0, 30, 45, 60, 90) if is_long else (45, ):
        for name, changes in (("coupled", {}), ("slit", elements)):
            if name == "slit" and not is_long:
                continue
            before = None
            for n in (100, 200) if is_long else (50, 100):
                cells = ({"Mesh/geometry parameters": "n = %d" % n}
                         if name == "slit" else {})
                errors = factor_errors(study, angle, n, dict(changes, **cells),
                                       reference)
                label = "%d degrees, %s, %d cells: " % (angle, name, n)
                if n >= 100:
                    limit = 2.5 * 200 / n
                    study.below(label + "K_I", errors[0], 2.5)
                    study.below(label + "K_II", errors[1], limit)
                    study.below(label + "K_I by opening", errors[2],
                                3. * limit)
                    study.below(label + "domain dependence of J", errors[3],
                                2.)
                if before and errors[1] > 1e-6:
                    for k, factor in enumerate(("K_I", "K_II")):
                        study.below(label + factor +
                                    " over twice the spacing",
                                    errors[k] / before[k], .75)
                before = errors


def inverse_barnett_lothe(angle):
    """Rows and columns sliding, opening: 2 J = K . L^-1 K. Of a crack along the
    fibres by G. C. Sih, P. C. Paris, G. R. Irwin (1965), turned with them."""
    s11, s12 = 1. / 144.8e9, -.21 / 144.8e9
    s22, s66 = 1. / 11.7e9, 1. / 9.66e9
    root = math.sqrt(math.sqrt(s22 / s11) + (2. * s12 + s66) / (2. * s11))
    along, across = (math.sqrt(2.) * s11 * root,
                     math.sqrt(2. * s11 * s22) * root)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return ((along * c * c + across * s * s, (along - across) * c * s),
            ((along - across) * c * s, along * s * s + across * c * c))


def first_of_three(terms, values):
    """First factor of three terms by least squares."""
    rows = [[sum(a[i] * a[j] for a in terms) for j in range(3)] +
            [sum(a[i] * b for a, b in zip(terms, values))] for i in range(3)]
    for k in (2, 1):
        for i in range(k):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    return rows[0][3] / rows[0][0]


def factors_of_faces(study, angle):
    """Times, K_I and K_II in MPa m^(1/2) as dynamic_sif_edge_crack.csv takes
    them: from a fit of 1, r, 1/r to L times the opening, 3 of its spacings to
    0.12 crack lengths from the tip. A face is half a spacing from the last nodes
    of its side."""
    n, crack, low, high = 401, .05, 1.25e-3, 6e-3
    h = .1 / n
    places = [k for k in range(n // 2) if low <= (k + .5) * h <= high]
    rows = (1.5, .5, -.5, -1.5)
    names = {(k, y): "face%d%s" % (k, "abcd"[rows.index(y)])
             for k in places for y in rows}
    table = study.solve(COMPOSITE_CRACK, {
        "Material/orientation": angle,
        "Mesh/geometry parameters":
        "L = 0.1, d = 0.1, nx = %d, ny = %d" % (n, n),
        "Quantities/point": "; ".join(
            "%s: %.12g %.12g" % (name, crack - (k + .5) * h, y * h)
            for (k, y), name in names.items()),
        "Reference/values": ""}).table("quantities")
    times = table.get("time", [])
    ((a, b), (_, c)) = inverse_barnett_lothe(angle)
    factors = []
    for t in range(len(times)):
        terms, values = [], []
        for k in places:
            r = (k + .5) * h
            jump = []
            for direction in "xy":
                u = [table["%s_displacement_%s" % (names[k, y], direction)][t]
                     for y in rows]
                jump.append(1.5 * (u[1] - u[2]) - .5 * (u[0] - u[3]))
            size = math.sqrt(math.pi / (8. * r)) / (a * c - b * b) * 1e-6
            terms.append((1., r / high, low / r))
            values.append((size * (a * jump[1] - b * jump[0]),
                           size * (c * jump[0] - b * jump[1])))
        factors.append([first_of_three(terms, [value[k] for value in values])
                        for k in (0, 1)])
    return times, [[row[k] for row in factors] for k in (0, 1)]


def interpolated(times, values, time):
    k = min(max(bisect.bisect(times, time), 1), len(times) - 1)
    share = (time - times[k - 1]) / (times[k] - times[k - 1])
    return (1. - share) * values[k - 1] + share * values[k]


def opening_in_composite(study):
    """The same measure on both sides: that table has the error of its fit, up to
    3.6 % of K_I and 5.4 % of K_II."""
    if study.arguments.extent != "long" or not study.part(
            "faces of the edge crack in a composite", "%"):
        return
    given = read_table(PARAMETER_FILES +
                       "/reference/dynamic_sif_edge_crack.csv")
    for angle in (0, 30, 45, 60, 90):
        grid = max(g for g, a in zip(given["grid"], given["fibre_deg"])
                   if a == angle)
        rows = [row for row in zip(*(given[name] for name in (
            "fibre_deg", "grid", "t", "K_I", "K_II")))
                if row[:2] == (angle, grid)]
        times, factors = factors_of_faces(study, angle)
        if not times:
            study.below("%d degrees" % angle, math.nan, 2.5)
            continue
        K_I = [row[3] for row in rows]
        for k, name in enumerate(("K_I", "K_II")):
            other = [row[3 + k] for row in rows]
            size = K_I if angle in AXES_OF_FIBRES else other
            error = root_mean_square([
                interpolated(times, factors[k], row[2]) - value
                for row, value in zip(rows, other)]) / root_mean_square(size)
            study.below("%d degrees, %d cells there: %s" % (angle, grid, name),
                        100. * error, 2.5)


def mirrored_densities(study):
    """A crack between two materials that differ in their densities only, and the
    same upside down: inertia in the integrals is that of each side."""
    if not study.part("crack between two densities"):
        return
    law = "C11 = 100e9, C12 = 30e9, C22 = 100e9, C66 = 35e9"
    solutions = [
        study.solve("delamination.prm", {
            "Mode": "finite elements",
            "Mesh/geometry parameters": "nx = 80, ny = 20",
            "Material/constants": law,
            "Material/density": below,
            "Material/by volume": "upper: %s, density = %s" % (law, above),
            "Peridynamics/around": "",
            "Cracks/pre-cracks": "edge: -0.075 0 to -0.045 0",
            "Cracks/growth": "none",
            "Cracks/strengths": "",
            "Cracks/strengths by volume": "",
            "Cracks/interface strengths": "",
            "Cracks/criterion": "automatic",
            "Load steps/end time": 30e-6
        }) for below, above in ((1600, 5670), (5670, 1600))
    ]
    for name, sign in (("J", 1.), ("K_I", 1.), ("K_II", -1.)):
        first, second = (solution["edge_tip1_" + name]
                         for solution in solutions)
        study.within(name, first, sign * second, 1e-6 * abs(second))


def main():
    study = Study(__doc__, KNOWN_MISSES, extent=["short", "long"])
    crack_in_motion(study)
    inclusion_and_hole(study)
    crack_in_composite(study)
    opening_in_composite(study)
    mirrored_densities(study)
    study.finish()


if __name__ == "__main__":
    main()
