"""Motion at finite strain: blocks pressed to half their height and stretched
to double, of which the stability limit follows the deformation, and blocks
that spin; and an end that moves at once.

References: the static run of the same file (the load rises and stops so
smoothly that waves have less than 1e-4 of the energy), a turn that ends where
it began, and rho c v.
"""

import math
import os

from verification import Study
from case_files import parameter_text

MODES = ("coupled", "finite elements", "peridynamics")
SCHEMES = ("explicit", "implicit")
LAWS = ("hencky", "neo-hookean")
BLOCK = {
    "Material/state": "plane strain",
    "Material/density": "1",
    "Boundary conditions/symmetry": None,
    "Boundary conditions/traction": None,
    "Load steps/number of steps": "20",
}
# Period of the lowest wave over the time of the load: 0.1
HELD = "bottom: x = 0, y = 0; top: x = 0, y = %g*(1 - cos(pi*t))/2"
# Stiff: centrifugal strains are about (omega r)^2 rho / E = 1e-4, and the turn
# lags behind by as much.
SPINNING = {
    "Material/Young's modulus": "1e5",
    "Time integration/initial velocity":
    "x = -2*pi*(y - 0.5), y = 2*pi*(x - 0.5)",
    "Quantities/point": "corner: 1 1",
    "Load steps/number of steps": "8",
}


def solve(study, *changes):
    path = os.path.join(study.folder(), "block.prm")
    with open(path, "w") as file:
        file.write(parameter_text(BLOCK, *changes))
    return study.solve(path)


def pressed_and_stretched(study):
    for law in LAWS:
        for name, height in (("pressed to half", -.5), ("doubled", 1.)):
            if not study.part("%s, %s" % (name, law), "energy", "static"):
                continue
            for mode in MODES:
                held = {"Mode": mode, "Material/law": law,
                        "Boundary conditions/displacement": HELD % height}
                static = solve(study, held)
                for scheme in SCHEMES:
                    moved = solve(study, held,
                                  {"Time integration/scheme": scheme})
                    label = "%s, %s: " % (mode, scheme)
                    study.within_percent(label + "strain energy",
                                         moved["strain_energy"],
                                         static["strain_energy"], .05)
                    study.below(label + "energy drift",
                                100. * moved["energy_drift"], .05)


def one_turn(study):
    if not study.part("one turn", "way", "side"):
        return
    for mode in MODES:
        for scheme in SCHEMES:
            turned = solve(study, SPINNING, {
                "Mode": mode,
                "Material/law": "hencky",
                "Time integration/scheme": scheme})
            label = "%s, %s: " % (mode, scheme)
            study.below(label + "distance of a corner from its place",
                        math.hypot(turned["corner_displacement_x"],
                                   turned["corner_displacement_y"]), .005)
            # Implicit steps damp; that takes 0.06 to 0.13 %.
            study.below(label + "energy drift", 100. * turned["energy_drift"],
                        .2 if scheme == "implicit" else .001)


def driven_at_once(study):
    """A strip at rest whose upper end moves with a constant velocity: rho c v on
    it until the wave comes back from the free end."""
    velocity, modulus = .01, 1000. * .7 / (1.3 * .4)
    speed = math.sqrt(modulus)
    driven = {
        "Material/law": "linear elastic",
        "Mesh/geometry parameters": "n = 16",
        "Boundary conditions/symmetry": "left, right",
        "Boundary conditions/displacement": "top: y = %g*t" % velocity,
        "Quantities/reaction": "top",
        "Load steps/end time": "%.12g" % (1.9 / speed),
        "Load steps/number of steps": "95",
    }
    if not study.part("end that moves at once", "force", "rho c v"):
        return
    for mode in MODES:
        for scheme in SCHEMES:
            moved = solve(study, driven, {
                "Mode": mode, "Time integration/scheme": scheme})
            table = moved.table("quantities")
            forces = [force for time, force in zip(
                table.get("time", []), table.get("reaction_top_y", []))
                      if .2 <= time * speed <= 1.8] or [math.nan]
            label = "%s, %s: " % (mode, scheme)
            study.within_percent(label + "mean force",
                                 sum(forces) / len(forces), speed * velocity,
                                 1.)
            study.below(label + "energy drift", 100. * moved["energy_drift"],
                        .1)


def main():
    study = Study(__doc__)
    pressed_and_stretched(study)
    one_turn(study)
    driven_at_once(study)
    study.finish()


if __name__ == "__main__":
    main()
