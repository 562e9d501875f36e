"""Cracks (correspondence model, plane stress, nu = 1/3): stress intensity
factors of centre and slant cracks, growth of an edge crack at the Griffith
load, kinks, energy balance.

Limits are those of the acceptance. References: complex-potential collocation
(reference/centre_crack_F.csv of the development tables), the exact field of a
crack in an infinite plate, and the energy of a strip with a slit by finite
elements. Errors of K are means over both tips, as in the tables of the
numerical study, whose numbers the limits come from. --extent long adds
meshes, horizon ratios, angles and h/a = 1/10.
"""

import json
import math
import os

import crack_fields
from verification import MESHES as SHIPPED, Study, write_parameters

NU = 1. / 3.
# K_I/(sigma sqrt(pi a)): a/b = 0.4, h/b = 3 (Tada's strip: 1.1090); square
# plate, a/b = 0.2. Collocation, six digits.
CENTRE_CRACK_STRIP = 1.109384265
CENTRE_CRACK_SQUARE = 1.055377645
# The same at a/b = 0.1, 0.2 ... 0.5.
SQUARE_FACTORS = (1.013946159, 1.055377645, 1.123191107, 1.216049761,
                  1.333712151)
# -dE1/da of the strip 1.5 x 1.03125, ends moved by -1 and 1, free to contract,
# at a = 0.5, 0.55 ...: half strip of 4-node elements, h = 1/80 and 1/160, E1
# extrapolated to h = 0 (a = 0.5, 0.6, 0.7, 0.8: 1.897, 1.903, 1.916, 1.929 in
# an independent study, +- 0.1 %).
STRIP = (1.5, 33. / 32.)
STRIP_RELEASE = (1.897, 1.8997, 1.9039, 1.9097, 1.9161, 1.9226, 1.9289, 1.9351,
                 1.9416, 1.9487, 1.9569, 1.9666, 1.9777, 1.9897, 2.0008,
                 2.0086, 2.0117)
MESHES = ("uniform", "distorted", "gmsh")
# row -> largest distance from the reference (from 0 for limits).
KNOWN_MISSES = {
    "centre crack, distorted, m 1.5, h/a 0.1: domain dependence %": .4,
    "centre crack, gmsh, m 1.5, h/a 0.1": .014,
    "centre crack, gmsh, m 2, h/a 0.1: domain dependence %": .45,
}


def percent(measured, reference, scale=None):
    return 100. * (measured - reference) / (scale or reference)


def write_mesh(folder, kind, width, height, spacing, low=None, **more):
    """Returns the name of the file."""
    if kind == "gmsh":
        crack_fields.unstructured(folder + "/mesh.geo", width, height,
                                  spacing, low)
        return "mesh.geo"
    path = folder + "/mesh.msh"
    if kind == "turned":
        crack_fields.twisted_strip(path, width, height, spacing, (.75, 0.), .3,
                                   .51, low)
    else:
        crack_fields.rectangle(path, width, height, spacing,
                               .2 if kind == "distorted" else 0., low=low,
                               **more)
    return "mesh.msh"


class Cracks(Study):
    """Bodies with one crack."""

    @property
    def long(self):
        return self.arguments.extent == "long"

    def cracked(self, kind, box, spacing, ratio, crack, entries, **mesh):
        folder = self.folder()
        name = write_mesh(folder, kind, *box, spacing, **mesh)
        return self.solve(
            write_parameters(
                folder + "/case.prm", {
                    "Mesh/file": name,
                    "Material/Young's modulus": 1,
                    "Material/Poisson's ratio": "%.17g" % NU,
                    "Material/state": "plane stress",
                    "Peridynamics/horizon ratio": ratio,
                    "Cracks/pre-cracks":
                    "crack: %.16g %.16g to %.16g %.16g" % crack,
                    **entries
                }))

    def infinite(self, kind, spacing, ratio, angle, half=1., remote=(0., 1.,
                                                                     0.),
                 growth=None):
        """Crack in the middle of a square of half width 2.5 with the
        tractions of an infinite plate. Returns the solution, and K_I, K_II."""
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        entries = {
            "Boundary conditions/traction":
            crack_fields.infinite_plate_tractions(
                half, angle, *remote, "t" if growth else "1")
        }
        entries.update(growth or {})
        solution = self.cracked(
            kind, (5., 5.), spacing, ratio,
            (-half * c, -half * s, half * c, half * s), entries)
        normal, _, shear = crack_fields.remote_stresses(angle, *remote)
        root = math.sqrt(math.pi * half)
        return solution, normal * root, shear * root

    def check_domain(self, what, solution):
        worst = max(solution["crack_tip%d_domain_dependence" % tip]
                    for tip in (1, 2))
        self.below(what + ": domain dependence %", 100. * worst, .3)

    def note_integral(self, solution, mode_1, mode_2=0.):
        """K from J, which the limits do not ask for."""
        ratio = [math.sqrt(solution["crack_tip%d_J" % tip]) /
                 math.hypot(mode_1, mode_2) for tip in (1, 2)]
        self.note("tips: K_I %+.2f %+.2f %%, K from J %.4f %.4f" %
                  (*(percent(solution["crack_tip%d_K_I" % tip], mode_1)
                     for tip in (1, 2)), *ratio))


def mean(solution, name):
    return .5 * sum(solution["crack_tip%d_%s" % (tip, name)]
                    for tip in (1, 2))


def across_to_normal(angle):
    """Remote stresses of unit tension normal to a crack at this angle."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return s * s, c * c, -s * c


def spacings(study):
    """h with a = 1, and the limit of |dK_I| in %."""
    return ((.1, .6), (.05, .5)) if study.long else ((.05, .5), )


def centre_crack(study):
    exact = CENTRE_CRACK_STRIP * math.sqrt(math.pi)
    for kind in MESHES if study.long else MESHES[:2]:
        for ratio in (1.5, 2) if study.long else (2, ):
            for spacing, limit in spacings(study):
                what = "centre crack, %s, m %g, h/a %g" % (kind, ratio,
                                                           spacing)
                more = {} if kind == "gmsh" else {"graded_from": 2.5}
                solution = study.cracked(
                    kind, (5., 15.), spacing, ratio, (-1., 0., 1., 0.),
                    {"Boundary conditions/traction": "y+: y = 1; y-: y = -1"},
                    **more)
                study.within_percent(what, mean(solution, "K_I"), exact, limit)
                study.note_integral(solution, exact)
                study.check_domain(what, solution)


def oblique_to_mesh(study):
    for kind in MESHES if study.long else MESHES[1:]:
        for ratio in (1.5, 2) if study.long else (2, ):
            for spacing, limit in spacings(study):
                what = "at 30 degrees, %s, m %g, h/a %g" % (kind, ratio,
                                                            spacing)
                solution, mode_1, _ = study.infinite(
                    kind, spacing, ratio, 30., 1., across_to_normal(30.))
                study.within_percent(what, mean(solution, "K_I"), mode_1,
                                     limit)
                study.note_integral(solution, mode_1)
                study.below(what + ": |K_II|/K_I %",
                            100. * abs(mean(solution, "K_II")) / mode_1, .4)
                study.check_domain(what, solution)


def tip_in_cell(study):
    cases = [("uniform", 30., 2, 2.5)]
    if study.long:
        cases += [("uniform", 30., 1.5, 2.5)] + [
            (kind, 0., ratio, 1.2) for kind in MESHES[:2]
            for ratio in (1.5, 2)]
    for kind, angle, ratio, limit in cases:
        errors = []
        for step in range(9):
            solution, mode_1, _ = study.infinite(
                kind, .1, ratio, angle, 1. + .1 * step / 8,
                across_to_normal(angle))
            errors.append(percent(mean(solution, "K_I"), mode_1))
        study.below("%s, %g degrees, m %g: spread of K_I %%" %
                    (kind, angle, ratio), max(errors) - min(errors), limit)
        study.note("mean error %+.2f %%, from %+.2f to %+.2f" %
                   (sum(errors) / 9., min(errors), max(errors)))


def square_plate(study):
    solution = study.solve("centre_crack_square_plate.prm")
    stress, half, modulus = 10., 5., 192e3
    exact = CENTRE_CRACK_SQUARE * stress * math.sqrt(math.pi * half)
    for tip in (1, 2):
        name = "centre_tip%d_" % tip
        study.within_percent("tip %d: interaction integral" % tip,
                             solution[name + "K_I"], exact, .5)
        # J within 0.5 %: J, not its root.
        study.within_percent("tip %d: J" % tip, solution[name + "J"],
                             exact**2 / modulus, .5)
        study.within_percent("tip %d: opening" % tip,
                             solution[name + "K_I_opening"], exact, 3.)


def slant_crack(study):
    """Errors over |K|, as in the study that the limits come from; errors over
    each factor are in the note."""
    for angle in (30., 45.):
        for kind in MESHES if study.long else MESHES[:1]:
            for ratio in (1.5, 2) if study.long else (2, ):
                solution, mode_1, mode_2 = study.infinite(
                    kind, .05, ratio, angle)
                what = "slant %g, %s, m %g: " % (angle, kind, ratio)
                size = math.hypot(mode_1, mode_2)
                own = []
                for name, exact, limit in (("K_I", mode_1, 1.),
                                           ("K_II", mode_2, 1.5)):
                    value = mean(solution, name)
                    error = percent(value, exact, size)
                    study.row(what + name, value, exact,
                              "%+.2f of %g %%" % (error, limit),
                              abs(error) <= limit)
                    own.append(percent(value, exact))
                study.note("over each factor itself: K_I %+.2f, K_II %+.2f %%"
                           % tuple(own))


def wide_plate(study, path):
    """A crack along a path in a plate 80 x 80 under tension along y; cells of
    0.05 around the origin."""
    return study.solve(
        write_parameters(
            study.folder() + "/case.prm", {
                "Mesh/file": os.path.join(SHIPPED, "plate_graded.geo"),
                "Mesh/geometry parameters":
                "hx = 40, hy = 40, fx = 1.5, fy = 1.525, nx = 60, ny = 61, "
                "q = 1.2",
                "Material/Young's modulus": 1,
                "Material/Poisson's ratio": "%.17g" % NU,
                "Material/state": "plane stress",
                "Peridynamics/horizon ratio": 2,
                "Cracks/pre-cracks":
                "crack: " + " to ".join("%.16g %.16g" % point
                                        for point in path),
                "Boundary conditions/traction": "top: y = 1; bottom: y = -1"
            }))


def check_factors(study, what, found, exact, limit):
    """Errors over |K|; the directions they lead to."""
    size = math.hypot(*exact)
    for name, value, reference in zip(("K_I", "K_II"), found, exact):
        error = percent(value, reference, size)
        study.row("%s: %s" % (what, name), value, reference,
                  "%+.2f of %g %%" % (error, limit), abs(error) <= limit)
    study.within(what + ": hoop stress, degrees",
                 crack_fields.hoop_angle(*found),
                 crack_fields.hoop_angle(*exact), .5)


def bent_cracks(study):
    """Domain integrals with terms on the faces: an arc of a circle of 360
    pieces (Cotterell and Rice 1980, tension normal to the chord) and a slant
    crack whose ends have kinked (displacement discontinuities, 40, 80 and 160
    per piece, extrapolated)."""
    half = math.radians(45.)
    radius = 1. / math.sin(half)
    solution = wide_plate(study, [
        (radius * math.sin(t), radius * math.cos(t) - 1.2)
        for t in (half * (k - 180) / 180. for k in range(361))])
    s, c = math.sin(.5 * half), math.cos(.5 * half)
    share = (.5 - .5 * (s * c)**2) / (1. + s * s)
    root = math.sqrt(math.pi)
    exact = (root * (share * c + .5 * math.cos(1.5 * half)),
             root * (share * s + .5 * math.sin(1.5 * half)))
    for tip in (1, 2):
        found = [solution["crack_tip%d_%s" % (tip, name)]
                 for name in ("K_I", "K_II")]
        check_factors(study, "arc, tip %d" % tip, (found[0], abs(found[1])),
                      exact, 1.5)
        study.below("arc, tip %d: domain dependence %%" % tip,
                    100. * solution["crack_tip%d_domain_dependence" % tip], .3)
    turned = half - math.radians(53.1301)
    for length, exact in ((.1, (1.7141, .0433)), (.2, (1.7980, .0182)),
                          (.4, (1.9558, -.0259))):
        end = (math.cos(half), math.sin(half))
        kink = (end[0] + length * math.cos(turned),
                end[1] + length * math.sin(turned))
        solution = wide_plate(study, [(-kink[0], -kink[1]),
                                      (-end[0], -end[1]), end, kink])
        check_factors(study, "45 degrees, kinks of %g" % length,
                      (mean(solution, "K_I"), mean(solution, "K_II")), exact,
                      1.)
        study.check_domain("45 degrees, kinks of %g" % length, solution)


# ------------------------------------------------------------------- growth

def release(length):
    """-dE1/da of the strip."""
    place = (length - .5) / .05
    k = min(max(int(place), 0), len(STRIP_RELEASE) - 2)
    return STRIP_RELEASE[k] + (place - k) * (STRIP_RELEASE[k + 1] -
                                             STRIP_RELEASE[k])


def released_between(start, end, n=100):
    """Drop of E1 by a longer crack."""
    step = (end - start) / n
    return step * sum(release(start + (k + .5) * step) for k in range(n))


def strip(study, kind, ratio, crack, advances, spacing=1. / 32., **entries):
    width, height = STRIP
    base = {
        "Boundary conditions/displacement": "y+: y = t; y-: y = -t",
        "Boundary conditions/point displacement": "1.5 -0.515625: x = 0"
    }
    if advances:
        base.update({
            "Cracks/growth": "segments",
            "Cracks/growth control": "events",
            "Cracks/fracture energy": 1,
            "Cracks/maximum advances": advances
        })
    base.update(entries)
    return study.cracked(kind, STRIP, spacing, ratio, crack, base,
                         low=(0., -.5 * height))


def growth_of_edge_crack(study):
    """Every state is linear: an advance dl at the load factor f takes
    G_c dl = f^2 times the drop of E1."""
    correspondence, bonds = "correspondence", "bond based"
    cases = [("uniform", 2, correspondence), ("turned", 2, correspondence),
             ("uniform", 2, bonds)]
    if study.long:
        cases = [(kind, ratio, model) for model in (correspondence, bonds)
                 for ratio in (2, 3) for kind in MESHES + ("turned", )]
    spacing = 1. / 32.
    for kind, ratio, model in cases:
        what = "%s%s, m %g: " % (model + ", " if model == bonds else "", kind,
                                 ratio)
        solution = strip(study, kind, ratio, (0., 0., .5, 0.),
                         9 if ratio == 2 else 6, spacing,
                         **{"Peridynamics/model": model})
        table = solution.table("crack_growth")
        if not table:
            study.row(what + "growth", math.nan, None, "", False)
            continue
        lengths = [.5]
        for energy in table["dissipated_energy"]:
            lengths.append(lengths[-1] + energy)
        pairs = list(zip(lengths, lengths[1:]))
        factors = table["load_factor"]
        drops = [(b - a) / f**2 for (a, b), f in zip(pairs, factors)]
        study.between(what + "released/(G_c length)",
                      sum(drops) / released_between(.5, lengths[-1]), .95,
                      1.03)
        study.note("single advances %.3f .. %.3f, %d advances to a = %.3f" %
                   (min(d / released_between(*p)
                        for d, p in zip(drops, pairs)),
                    max(d / released_between(*p)
                        for d, p in zip(drops, pairs)), len(drops),
                    lengths[-1]))
        # The first advance, which starts at the pre-crack, is left out.
        griffith = [math.sqrt((b - a) / released_between(a, b))
                    for a, b in pairs]
        errors = [percent(sum(factors[k - 2:k + 1]), sum(griffith[k - 2:k + 1]))
                  for k in range(3, len(factors))]
        study.below(what + "load, 3-advance mean, worst |error| %",
                    max(abs(error) for error in errors), 4.)
        study.below(what + "path off the line, h",
                    max(abs(y) for y in table["y"]) / spacing,
                    .9 if model == bonds else .6)
        study.below(what + "energy balance", solution["energy_balance"], 1e-8)


def square_factor(ratio):
    """K_I/(sigma sqrt(pi a)) of the square plate: Lagrange."""
    total = 0.
    for k, value in enumerate(SQUARE_FACTORS):
        for j in range(len(SQUARE_FACTORS)):
            if j != k:
                value *= (10. * ratio - 1. - j) / (k - j)
        total += value
    return total


def growth_of_centre_crack(study):
    """The square plate of L4: both tips advance in turn, an advance of
    one by dl makes half the crack length a longer by dl/2 and releases
    G dl = f^2 K^2/E dl."""
    stress, half, modulus, spacing = 10., 5., 192e3, .25
    toughness = (CENTRE_CRACK_SQUARE * stress)**2 * math.pi * half / modulus
    solution = study.solve(
        write_parameters(
            study.folder() + "/case.prm", {
                "Mesh/file": os.path.join(SHIPPED, "plate_graded.geo"),
                "Mesh/geometry parameters":
                "hx = 25, hy = 25, fx = 8, fy = 4.125, nx = 64, ny = 33, "
                "q = 1.1",
                "Material/Young's modulus": modulus,
                "Material/Poisson's ratio": "%.17g" % NU,
                "Material/state": "plane stress",
                "Peridynamics/horizon ratio": 2,
                "Cracks/pre-cracks": "crack: -5 0 to 5 0",
                "Cracks/growth": "segments",
                "Cracks/growth control": "events",
                "Cracks/fracture energy": "%.17g" % toughness,
                "Cracks/maximum advances": 10,
                "Boundary conditions/traction":
                "top: y = 10*t; bottom: y = -10*t"
            }))
    table = solution.table("crack_growth")
    a, drops, griffith, exact = half, [], [], []
    for length, factor in zip(table["length"], table["load_factor"]):
        energy = sum(
            (square_factor((a + .5 * length * (k + .5) / 10.) / 25.) *
             stress)**2 * math.pi * (a + .5 * length * (k + .5) / 10.) /
            modulus * length / 10. for k in range(10))
        a += .5 * length
        drops.append(toughness * length / factor**2)
        exact.append(energy)
        griffith.append(math.sqrt(toughness * length / energy))
    factors = table["load_factor"]
    study.between("square plate: released/(G_c length)",
                  sum(drops) / sum(exact), .95, 1.03)
    study.note("single advances %.3f .. %.3f, %d advances to a = %.3f" %
               (min(d / e for d, e in zip(drops, exact)),
                max(d / e for d, e in zip(drops, exact)), len(drops), a))
    # The first advance of each tip is left out.
    errors = [percent(sum(factors[k - 2:k + 1]), sum(griffith[k - 2:k + 1]))
              for k in range(4, len(factors))]
    study.below("square plate: load, 3-advance mean, worst |error| %",
                max(abs(error) for error in errors), 4.)
    study.below("square plate: path off the line, h",
                max(abs(y) for y in table["y"]) / spacing, .6)
    study.below("square plate: energy balance", solution["energy_balance"],
                1e-8)


def growth_by_load_steps(study):
    solution = strip(study, "uniform", 2, (0., 0., .5, 0.), 100, **{
        "Cracks/growth control": "load steps",
        "Load steps/number of steps": 8
    })
    study.below("load steps, cut through: energy balance",
                solution["energy_balance"], 1e-8)


def ends_of_growth(study):
    """A body that is cut through is the end of a run and no failure; the last
    advances, where no domain integral has room, keep to the line."""
    ligament = {"Cracks/maximum advances": 100}
    for what, crack, more in (
        ("events", (0., 0., 1., 0.), {}),
        ("events, inclined", (0., -.1, 1., .1), {}),
        ("load steps", (0., 0., 1., 0.), {
            "Cracks/growth control": "load steps",
            "Load steps/number of steps": 2
        }),
        ("tractions", (0., 0., 1., 0.), {
            "Boundary conditions/displacement": "",
            "Boundary conditions/point displacement": "",
            "Boundary conditions/remove rigid motion": "true",
            "Boundary conditions/traction": "y+: y = t; y-: y = -t"
        })):
        solution = strip(study, "gmsh", 2, crack, 1, **ligament, **more)
        path = os.path.join(solution.folder or "", "results.json")
        end = ""
        if os.path.exists(path):
            with open(path) as file:
                end = json.load(file).get("growth", {}).get("end")
        study.row(what + ": cut through", solution["energy_balance"], None,
                  end, end == "separated")
        ordinates = solution.table("crack_growth").get("y", [math.nan])
        if crack[1] == crack[3]:
            study.below(what + ": path off the line, h",
                        max(abs(y) for y in ordinates) * 32., .6)


def kinks(study):
    """First advance of a crack under mixed mode against the direction of
    the largest hoop stress, from exact factors (slant crack) or from those
    of the run without growth (inclined edge crack)."""
    grow = {
        "Cracks/growth": "segments",
        "Cracks/growth control": "events",
        "Cracks/fracture energy": 1,
        "Cracks/maximum advances": 1
    }
    for angle, kind, spacing in [(15., "uniform", .1)] + ([
            (angle, kind, spacing) for angle in (15., 30., 45., 60.)
            for kind, spacing in (("uniform", .05), ("distorted", .1),
                                  ("gmsh", .1))] if study.long else []):
        solution, mode_1, mode_2 = study.infinite(kind, spacing, 2, angle,
                                                  growth=grow)
        table = solution.table("crack_growth")
        expected = angle + crack_fields.hoop_angle(mode_1, mode_2)
        found = table["direction"][0] if table else math.nan
        # Either tip may be first; the field has the symmetry of a half turn.
        found -= 180. * round((found - expected) / 180.)
        study.within("slant %g, %s, h/a %g: kink, degrees" %
                     (angle, kind, spacing), found, expected, 2.)
        study.below("slant %g, %s, h/a %g: energy balance" %
                    (angle, kind, spacing), solution["energy_balance"], 1e-8)
    crack = (0., 0., .5 * math.cos(math.pi / 6.), .5 * math.sin(math.pi / 6.))
    for kind, ratio in [("gmsh", 2)] + ([
            ("uniform", 2), ("distorted", 2), ("turned", 2), ("uniform", 3),
            ("gmsh", 3)] if study.long else []):
        intact = strip(study, kind, ratio, crack, 0)
        table = strip(study, kind, ratio, crack, 1).table("crack_growth")
        expected = 30. + crack_fields.hoop_angle(intact["crack_tip1_K_I"],
                                                 intact["crack_tip1_K_II"])
        study.within("inclined edge crack, %s, m %g: kink, degrees" %
                     (kind, ratio),
                     table["direction"][0] if table else math.nan, expected,
                     2.)


def main():
    study = Cracks(__doc__, KNOWN_MISSES, extent=["short", "long"])
    for name, part in (
        ("centre crack in a strip (Tada), a/b = 0.4", centre_crack),
        ("crack oblique to the mesh, infinite plate", oblique_to_mesh),
        ("tip moved through a cell", tip_in_cell),
        ("centre crack in a square plate, dx = 0.25 mm", square_plate),
        ("slant crack, infinite plate, h/a = 1/20", slant_crack),
        ("cracks that bend", bent_cracks),
        ("growth of an edge crack in a strip", growth_of_edge_crack),
        ("growth of a centre crack (L4)", growth_of_centre_crack),
        ("growth by load steps", growth_by_load_steps),
        ("ends of growth", ends_of_growth),
        ("kinks", kinks)):
        if study.part(name):
            part(study)
    study.finish()


if __name__ == "__main__":
    main()
