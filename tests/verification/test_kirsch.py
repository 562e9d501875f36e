"""Kirsch problem: hole in an infinite plate, against the tables of the
numerical study (numerics-explicit.md, sections 2 and 3; finite elements:
numerics.md, section 6), which are independent prototypes of the same scheme.

Limits of the acceptance: displacement (L2) and energy error within 5 % of the
table, K_t within 1 percentage point; rates over nt = 32 .. 128 at least 1.75
and 1.3.
"""

import kirsch
from verification import Study, rate

CELLS_AROUND = (32, 64, 128)
ADJACENT = "adjacent cells"
# mode, model or gradient support, m: L2, energy error, K_t error in % (None:
# not in the table)
TABLE = [
    ("finite elements", "correspondence", 2., (4.65e-3, 1.20e-3, 3.05e-4),
     (1.44e-2, 3.88e-3, 1.00e-3), (-4.8, -1.4, -.4)),
    ("coupled", "correspondence", 1.5, (3.49e-3, 1.03e-3, 2.95e-4),
     (2.18e-2, 7.70e-3, 2.89e-3), (-2.1, -1.7, -1.1)),
    ("coupled", "correspondence", 2., (4.66e-3, 1.22e-3, 2.99e-4),
     (4.24e-2, 1.24e-2, 4.21e-3), (.6, -1.3, -.8)),
    ("coupled", "correspondence", 3., (9.31e-3, 2.56e-3, 6.89e-4),
     (9.78e-2, 2.76e-2, 8.89e-3), (3.8, -1.8, -2.1)),
    ("coupled", ADJACENT, 2., (5.41e-3, 1.37e-3, 3.39e-4),
     (1.63e-2, 5.29e-3, 1.85e-3), (-3.7, -1.5, -.7)),
    ("coupled", "bond based", 1.5, (5.4e-3, 1.41e-3, 3.6e-4),
     (1.61e-2, 4.41e-3, 1.16e-3), None),
    ("coupled", "bond based", 2., (4.6e-3, 1.18e-3, 2.9e-4),
     (1.37e-2, 3.85e-3, 1.12e-3), (-4.6, -1.4, -.4)),
    ("coupled", "bond based", 3., (3.2e-3, 8.1e-4, 1.8e-4),
     (2.0e-2, 5.4e-3, 1.9e-3), None),
]


def compare(study, what, measured, expected, ratio):
    """At m = 3 the averaging function of the study is not ours, which is the
    integral of the influence function (cubic spline): our errors are 11 to
    17 % smaller (bond based up to 23 %), so only 'not worse' is asked."""
    if ratio == 3.:
        error = 100. * (measured / expected - 1.)
        study.row(what, measured, expected, "%+.2f < 5 %%" % error,
                  measured <= 1.05 * expected)
    else:
        study.within_percent(what, measured, expected, 5.)


def main():
    study = Study(__doc__)
    for mode, model, ratio, l2, energy, concentration in TABLE:
        name = mode if mode != "coupled" else "%s m %g" % (model, ratio)
        if not study.part(name):
            continue
        errors = []
        for k, cells in enumerate(CELLS_AROUND):
            folder = study.folder()
            adjacent = model == ADJACENT
            kirsch.write_case(folder, cells, mode,
                              "correspondence" if adjacent else model, ratio,
                              ADJACENT if adjacent else "horizon")
            solution = study.solve(folder + "/kirsch.prm")
            what = "%s, nt %d: " % (name, cells)
            errors.append((solution["relative_displacement_error"],
                           solution["relative_energy_error"]))
            compare(study, what + "L2", errors[k][0], l2[k], ratio)
            compare(study, what + "energy", errors[k][1], energy[k], ratio)
            error = 100. * (solution["stress_concentration"] / 3. - 1.)
            if concentration and ratio == 3.:
                study.below(what + "|K_t error| %", abs(error),
                            abs(concentration[k]) + 1.)
            elif concentration:
                study.within(what + "K_t error %", error, concentration[k], 1.)
            else:
                # Not in the table: no worse than finite elements + 1 point.
                study.below(what + "|K_t error| %", abs(error),
                            abs(TABLE[0][5][k]) + 1.)
        study.above(name + ": rate of L2", rate(errors[0][0], errors[2][0], 4.),
                    1.75)
        study.above(name + ": rate of energy",
                    rate(errors[0][1], errors[2][1], 4.), 1.3)
    study.finish()


if __name__ == "__main__":
    main()
