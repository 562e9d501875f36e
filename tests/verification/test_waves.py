"""Motion: a wave in a bar, waves that meet the interface of the coupling, and
relaxation towards the static answer.

References: d'Alembert's solution (bar_wave.csv), the same run by finite elements
alone (reflection), the static run. --extent long adds wavelengths and cases.
"""

import math

from verification import (MESHES, Study, read_table, relative_error,
                          root_mean_square, write_parameters)
from harness import PARAMETER_FILES

MODELS = {
    "correspondence": {},
    "bond based": {"Peridynamics/model": "bond based"}
}

BAR = {"end": "254", "middle": "127", "near": "051"}
BAR_MODES = {
    "coupled, correspondence": {},
    "coupled, bond based": {"Peridynamics/model": "bond based",
                            "Material/Poisson's ratio": "%.17g" % (1. / 3.)},
    "peridynamics": {"Mode": "peridynamics"},
    "finite elements": {"Mode": "finite elements"}
}
# A little over one period, 201.35 microseconds, at the times of the table.
BAR_TIMES = {
    "Load steps/end time": "201.5e-6",
    "Load steps/number of steps": 403
}
BAR_SCHEMES = {
    "explicit": {},
    "implicit": {"Time integration/scheme": "implicit",
                 "Time integration/time step": "0.5e-6"}
}
BAR_SPACING = 0.254 / 98
N_NEIGHBOURS = 9

# Waves that meet the interface, in units of the spacing: elements on the left,
# peridynamics on the right.
CARRIER = "exp(-((x-a)/l)^2)"
START, MIDDLE, LENGTH = 3.5, 7, 14 # wavelengths
INTERFACE_DISTANCE = 10            # of the core from MIDDLE, spacings


def bar_wave(study):
    if not study.part("wave in a bar", "%"):
        return
    exact = read_table(PARAMETER_FILES + "/reference/bar_wave.csv")
    for mode, changes in BAR_MODES.items():
        for scheme, words in BAR_SCHEMES.items():
            name = "%s, %s: " % (mode, scheme)
            solution = study.solve("bar_wave.prm",
                                   dict(changes, **words, **BAR_TIMES))
            table = solution.table("quantities")
            shift = max(
                (abs(a - b) for a, b in zip(table.get("time", []), exact["t"])),
                default=math.nan)
            study.below(name + "times beside those of the table", shift, 1e-12)
            for column, symbol, limit in (("displacement", "u", 1.),
                                          ("velocity", "v", 3.)):
                worst = max((100. * relative_error(
                    table["%s_%s_x" % (point, column)],
                    exact["%s_%s" % (symbol, place)])
                             for point, place in BAR.items()),
                            default=math.nan) if table else math.nan
                study.below(name + "error of the " + column, worst, limit)
            study.below(name + "energy drift", 100. * solution["energy_drift"],
                        .1)


def alternating_part(study, changes):
    """Of the velocity along the bar: what changes its sign from node to node,
    by fourth differences (1 for such a field, (pi h / l)^4 for a wave of the
    length l), over the velocity; root mean squares over nodes and times."""
    points = "; ".join("p%d: %.17g 0" % (k, (45 + k) * BAR_SPACING)
                       for k in range(N_NEIGHBOURS))
    solution = study.solve(
        "bar_wave.prm", dict(changes, **BAR_TIMES,
                             **{"Quantities/point": points,
                                "Reference/values": ""}))
    table = solution.table("quantities")
    if not table:
        return math.nan
    rows = list(zip(*(table["p%d_velocity_x" % k]
                      for k in range(N_NEIGHBOURS))))
    alternating = [(row[k - 2] - 4. * row[k - 1] + 6. * row[k] -
                    4. * row[k + 1] + row[k + 2]) / 16. for row in rows
                   for k in range(2, N_NEIGHBOURS - 2)]
    return root_mean_square(alternating) / root_mean_square(
        [v for row in rows for v in row[2:-2]])


def zero_energy_oscillations(study):
    """A tenth of the velocity error that is accepted may alternate; without
    stabilisation the measure must see the modes that it is there for."""
    if not study.part("zero-energy oscillations", "% of v"):
        return
    horizon = {"Mode": "peridynamics",
               "Peridynamics/gradient support": "horizon"}
    cases = dict(BAR_MODES,
                 **{"peridynamics, gradients over the horizon": horizon})
    parts = {}
    for name, changes in cases.items():
        parts[name] = alternating_part(study, changes)
        study.below(name, 100. * parts[name], .3)
    stabilised = parts["peridynamics, gradients over the horizon"]
    study.below("gradients over the horizon: over finite elements",
                stabilised / parts["finite elements"], 1.)
    bare = alternating_part(
        study, dict(horizon, **{"Peridynamics/stabilization": 0}))
    study.above("the same without stabilisation, over with",
                bare / stabilised, 10.)


class Strip:
    """Plane waves along a strip whose long sides guide them: a packet that
    travels right, exp(-(x/l)^2) cos(2 pi x / l) of the wavelength l."""

    def __init__(self, study, wavelength, shear):
        self.study = study
        self.wavelength = wavelength
        self.shear = shear

    def displacement(self, changes):
        """At the end, at the nodes of the left half, which is elements."""
        l = self.wavelength
        component = "y" if self.shear else "x"
        # E = 1, nu = 1/4, rho = lambda + 2 mu = 1.2
        speed = 1. / math.sqrt(3.) if self.shear else 1.
        entries = {
            "Mesh/file": MESHES + "/beam_rectangle.geo",
            "Mesh/geometry parameters":
            "L = %d, d = 8, nx = %d, ny = 8" % (LENGTH * l, LENGTH * l),
            "Material/Young's modulus": 1,
            "Material/Poisson's ratio": 0.25,
            "Material/density": 1.2,
            "Peridynamics/around": "box %g -5 %g 5" %
            (MIDDLE * l + INTERFACE_DISTANCE, LENGTH * l),
            "Peridynamics/core size": 0.5,
            "Time integration/scheme": "explicit",
            "Expressions/constants":
            "p = %.17g, l = %g, a = %g, c = %.17g" %
            (math.pi, l, START * l, speed),
            "Time integration/initial displacement":
            "%s = %s*cos(2*p*(x-a)/l)" % (component, CARRIER),
            "Time integration/initial velocity":
            "%s = c*%s*(2*(x-a)/l^2*cos(2*p*(x-a)/l)+2*p/l*sin(2*p*(x-a)/l))" %
            (component, CARRIER),
            "Load steps/end time": "%.17g" % (MIDDLE * l / speed),
            "Load steps/number of steps": 10,
            "Quantities/line": "axis: 0 0 to %d 0, %d points" %
            (MIDDLE * l, MIDDLE * l + 1)
        }
        if self.shear:
            entries["Boundary conditions/displacement"] = (
                "top: x = 0; bottom: x = 0")
        else:
            entries["Boundary conditions/symmetry"] = "top, bottom"
        entries.update(changes)
        path = write_parameters(self.study.folder() + "/strip.prm", entries)
        table = self.study.solve(path).table("probe_axis")
        return table.get("u" + component, [math.nan] * (MIDDLE * l + 1))

    def elements_alone(self):
        self.incident = self.displacement({"Mode": "finite elements"})

    def reflected(self, changes):
        """Part of the energy that comes back, by squares of the strain of what
        differs from finite elements alone."""
        l = self.wavelength
        start = [math.exp(-(x / l - START)**2) *
                 math.cos(2. * math.pi * (x / l - START))
                 for x in range(MIDDLE * l + 1)]
        returned = [a - b for a, b in zip(self.displacement(changes),
                                          self.incident)]
        return strain_squares(returned) / strain_squares(start)


def strain_squares(u):
    return sum((b - a)**2 for a, b in zip(u, u[1:]))


def interface_reflection(study):
    is_long = study.arguments.extent == "long"
    for wave in ("pressure", "shear"):
        if not study.part("reflection, %s wave" % wave, "% of energy"):
            continue
        for wavelength in (10, 15, 20, 30, 40) if is_long else (10, 20):
            strip = Strip(study, wavelength, wave == "shear")
            strip.elements_alone()
            for model, changes in MODELS.items():
                for ratio in (2, 3):
                    for band in ("cubic", "splice"):
                        part = strip.reflected(
                            dict(changes, **{
                                "Peridynamics/horizon ratio": ratio,
                                "Peridynamics/blending function": band}))
                        study.below("l = %d h, %s, m %d, %s" %
                                    (wavelength, model, ratio, band),
                                    100. * part, 1.)
        # The measure sees what comes back: all from a free end, for waves so
        # long that the mesh does not disperse them.
        strip = Strip(study, 40, wave == "shear")
        strip.elements_alone()
        length = MIDDLE * 40 + INTERFACE_DISTANCE
        part = strip.reflected({
            "Mode": "finite elements",
            "Mesh/geometry parameters": "L = %d, d = 8, nx = %d, ny = 8" %
            (length, length)})
        study.within_percent("free end", 100. * part, 100., 1.)
    if study.part("reflection, classical coupling", "times"):
        strip = Strip(study, 20, False)
        strip.elements_alone()
        bonds = MODELS["bond based"]
        blended = strip.reflected(
            dict(bonds, **{"Peridynamics/coupling": "energy blending"}))
        study.above("bond based, energy blending over consistent",
                    blended / strip.reflected(bonds), 10.)


def middle_region(study):
    """A small core, both of its interfaces."""
    if not study.part("reflection, core of two horizons in the middle",
                      "% of energy"):
        return
    strip = Strip(study, 20, False)
    strip.elements_alone()
    middle = MIDDLE * 20 + INTERFACE_DISTANCE + 5
    for model, changes in MODELS.items():
        for ratio in (2, 3):
            part = strip.reflected(
                dict(changes, **{
                    "Peridynamics/horizon ratio": ratio,
                    "Peridynamics/around": "plane %d 0 1 0" % middle,
                    "Peridynamics/core size": "2 horizons"}))
            study.below("%s, m %d" % (model, ratio), 100. * part, 1.)


def relaxation(study):
    """The static answer without a matrix. What is zero is compared with the
    largest number of its kind, reactions with the force that does the work;
    errors, small differences of two numbers, are left out."""
    cases = ["plate_with_hole.prm", "cantilever_small_strain.prm"]
    if study.arguments.extent == "long":
        cases.append("cantilever_large_deflection.prm")
    for case in cases:
        if not study.part("relaxation, " + case, "relaxation", "static"):
            continue
        static = study.solve(case)
        relaxed = study.solve(case,
                              {"Time integration/scheme": "relaxation"})
        sizes = {
            kind: max((abs(static[name])
                       for name in static.quantity_names if kind in name),
                      default=0.)
            for kind in ("displacement", "stress", "kirchhoff",
                         "logarithmic_strain")
        }
        if sizes["displacement"] > 0.:
            sizes["reaction"] = (static["strain_energy"] /
                                 sizes["displacement"])
        for name in static.quantity_names:
            if not name.endswith("_error"):
                size = max([abs(static[name])] + [
                    size for kind, size in sizes.items() if kind in name])
                study.within(name, relaxed[name], static[name], 1e-6 * size)
        study.note("%d steps, %.3g times the time" %
                   (relaxed["linear_iterations"],
                    relaxed["seconds"] / static["seconds"]))


def main():
    study = Study(__doc__, extent=["short", "long"])
    bar_wave(study)
    zero_energy_oscillations(study)
    interface_reflection(study)
    middle_region(study)
    relaxation(study)
    study.finish()


if __name__ == "__main__":
    main()
