"""The fracture cases of Hashim (2021) and states that bodies end in.

Stretch at the hole of plates: complex-potential collocation, sections 3.3.2 and
6.3.1. Centre crack, 6.3.2: K_I = 16.557 MPa sqrt(m) at t = 1, the energy of bonds
of one horizon in plane strain G_0 = 12 E delta s^2 / (5 pi). Cantilever, 6.3.3:
elastica with Tada's crack hinge (load, deflection, K_I, G below).
"""

import math

from verification import Study

# First bond over the end of the loads: (1 - nu^2) hoop stress / E = s_cr.
PLATE = .02 / ((1. - .33**2) * 6689.499961 / 192e3)
STRIP = .002 / ((1. - .33**2) * 1021.383806 / 210e3)
FIRST = {
    "Cracks/growth control": "events",
    "Cracks/maximum advances": "1",
    "Load steps/number of steps": "1",
}
CANTILEVER = {4200.: (1.391484962, 158223.7689, 2002.780883),
              4800.: (1.581014149, 180136.3744, 2595.929069)}
MODULUS = 192e9 / (1. - .33**2)


def hole(study, name, case, reference, meshes, radius):
    """Start at the side of the hole at the load of the formula, for horizons
    small against the hole, and a straight run to the free side."""
    if study.part(name + ": first bond"):
        for words, percent in meshes:
            solution = study.solve(
                case, dict(FIRST, **{"Mesh/geometry parameters": words}))
            bonds = solution.table("broken_bonds")
            study.within_percent("load of the first bond, " + words[:23],
                                 bonds["load_factor"][0], reference, percent)
            angle = max(
                abs(math.atan2(bonds["y1"][k] + bonds["y2"][k],
                               bonds["x1"][k] + bonds["x2"][k]))
                for k in range(len(bonds["y1"])))
            study.below("degrees from the side of the hole",
                        math.degrees(angle), 15.)
    if study.part(name + ": torn apart"):
        torn(study, study.solve(case), radius, 25., 2.)


def torn(study, solution, start, side, horizon):
    """The way of the crack from x = start; bonds along the rim of a hole break
    too where its stretch is large."""
    table, bonds = (solution.table(name)
                    for name in ("load_steps", "broken_bonds"))
    finite(study, solution)
    study.below("distance of the path from the axis, over the horizon",
                max(
                    abs(bonds["y1"][k] + bonds["y2"][k]) / 2.
                    for k in range(len(bonds["y1"]))
                    if min(bonds["x1"][k], bonds["x2"][k]) > start) / horizon,
                1.)
    study.within("end of the path", max(bonds["x1"] + bonds["x2"]), side, 1e-6)
    study.below("strain energy left over the largest",
                table["strain_energy"][-1] / max(table["strain_energy"]), 1e-8)
    study.below("energy balance", solution["energy_balance"], 1e-8)


def finite(study, solution):
    """Nothing in the tables is nan or infinite."""
    numbers = [
        value for name in ("load_steps", "quantities", "broken_bonds")
        for column in solution.table(name).values() for value in column
    ]
    study.within("numbers that are not finite", sum(
        1 for value in numbers
        if not (isinstance(value, float) and math.isfinite(value))), 0, 0)


def growth_load(bonds, tip, length):
    """Largest load before bonds break further ahead than this."""
    largest = 0.
    for k, load in enumerate(bonds["load_factor"]):
        if min(bonds["x1"][k], bonds["x2"][k]) - tip > length:
            break
        largest = max(largest, load)
    return largest


def centre_crack(study):
    for ratio, words, band in (
            (3.015, {}, 8.),
        # The calibration of the study: load 1.16 of Griffith at m = 2.
            (2., {"Cracks/maximum advances": "1000"}, None)):
        if not study.part("centre crack, horizon of %g mm" % ratio):
            continue
        solution = study.solve(
            "centre_crack_fracture.prm",
            dict(words, **{"Peridynamics/horizon ratio": str(ratio)}))
        bonds = solution.table("broken_bonds")
        energy = 12. * 192e9 * ratio * 1e-3 * .002**2 / (5. * math.pi)
        griffith = math.sqrt(energy * MODULUS) / 16.557e6
        study.note("Griffith at t = %.4g, first bond at %.4g of it" %
                   (griffith, bonds["load_factor"][0] / griffith))
        load = growth_load(bonds, -7.5, ratio) / griffith
        if band:
            study.between("growth load over Griffith, softening to none", load,
                          .75, 1.)
            study.within_percent("growth load over that of the study (.96)",
                                 load, .96, band)
        else:
            study.within_percent("growth load over that of the study (1.16)",
                                 load, math.sqrt(1.35), 8.)
            torn(study, solution, -7.5, 12.5, ratio)


def softening(study):
    """The teeth dissipate sum (f_l - f_l+1) (s_l / s_cr)^2 of the energy that
    a bond bears at s_cr: .77 for s_min / s_cr = .75, so Griffith's load is .88
    of that of bonds that break at once."""
    if not study.part("centre crack with softening, horizon of 2 mm"):
        return
    loads = []
    for words in ({}, {"Cracks/softening stretch": "0.0015"}):
        solution = study.solve(
            "centre_crack_fracture.prm",
            dict(words, **{"Peridynamics/horizon ratio": "2",
                           "Cracks/maximum advances": "60"}))
        finite(study, solution)
        study.below("energy balance", solution["energy_balance"], 1e-8)
        loads.append(growth_load(solution.table("broken_bonds"), -7.5, 2.))
    griffith = math.sqrt(12. * 192e9 * 2e-3 * .002**2 / (5. * math.pi) *
                         MODULUS) / 16.557e6
    study.between("growth load over Griffith at s_cr", loads[1] / griffith,
                  .75, 1.)
    study.above("load of bonds that break at once over it",
                loads[0] / loads[1], 1.)


def tada(a):
    """K_I over sigma sqrt(pi) of an edge crack in bending, depth 1."""
    return math.sqrt(a) * (1.122 - 1.4 * a + 7.33 * a**2 - 13.08 * a**3 +
                           14. * a**4)


def cantilever(study):
    if study.part("cantilever, large deflection, by segments"):
        solution = study.solve("cracked_cantilever.prm")
        table = solution.table("quantities")
        for row, load in ((6, 4200.), (7, 4800.)):
            deflection, K, G = CANTILEVER[load]
            name = "%.1f kN: " % (load / 1e3)
            study.within_percent(name + "deflection",
                                 -table["tip_displacement_y"][row], deflection,
                                 1.)
            study.within_percent(name + "K_I", table["notch_tip1_K_I"][row], K,
                                 2.)
            study.within_percent(name + "J", table["notch_tip1_J"][row], G, 1.5)
        advance = solution.table("crack_growth")
        study.within("load step of the first advance", advance["time"][0], 1.,
                     1e-9)
        # The mean of G over the advance, from that of the crack before it.
        steps = [.15 + .0125 * (k + .5) / 8. for k in range(8)]
        mean = sum((tada(a) / tada(.15))**2 for a in steps) / 8.
        study.within_percent("load of the advance over 4.8 kN",
                             advance["load_factor"][0],
                             math.sqrt(2300. / (2595.929069 * mean)), 2.)
    if study.part("cantilever, small strain, bond by bond"):
        solution = study.solve(
            "cracked_cantilever.prm", {
                "Mesh/geometry parameters": "h = 0.01875",
                "Material/law": "linear elastic",
                "Peridynamics/core size": "2 horizons",
                "Cracks/growth": "bonds",
                "Cracks/growth control": "events",
                "Cracks/maximum advances": "14",
                "Load steps/number of steps": "1",
            })
        # K_I of Tada grows in proportion to the load: 22.9 kPa sqrt(m) at .6 kN.
        griffith = 600. * math.sqrt(2300. / 41.92138344) / 4800.
        steps = [.15 + .01875 * (k + .5) / 8. for k in range(8)]
        mean = sum((tada(a) / tada(.15))**2 for a in steps) / 8.
        loads = solution.table("broken_bonds")["load_factor"]
        study.note("first bond at %.4g of Griffith" % (loads[0] / griffith))
        study.within_percent("load of growth over Griffith's",
                             max(loads) / griffith, 1. / math.sqrt(mean), 8.)


def main():
    study = Study(__doc__)
    hole(study, "plate with a hole", "plate_with_hole_fracture.prm", PLATE, (
        ("nx = 40, nt = 16, ns = 11", 3.),
        ("nx = 80, nt = 32, ns = 21", 1.),
    ), 5.)
    hole(study, "strip with a hole", "strip_with_hole_fracture.prm", STRIP,
         (("nx = 30, nt = 20, ns = 15, w = 3.75, r = 10, hy = 75, ne = 8", 1.),
          ), 10.)
    centre_crack(study)
    softening(study)
    cantilever(study)
    study.finish()


if __name__ == "__main__":
    main()
