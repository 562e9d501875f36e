"""Cantilever with an end load in pure peridynamics: bending, where models
without stabilisation are too soft and badly stabilised ones lock.

Reference: Timoshenko's tip deflection -0.267; the expected errors are those of
the numerical study (numerics-explicit.md, section 2; finite elements, plane
stress). Limit of the acceptance: 0.2 % (absolute); m = 1.5 and 2 better than
finite elements.
"""

from verification import Study, rate

LAYERS = (4, 8, 16)
# Tip error in %, ny = 4, 8, 16.
TABLE = {
    "finite elements": (-2.87, -.73, -.18),
    1.5: (-.93, -.26, -.07),
    2.: (.26, -.07, -.02),
    3.: (10.4, 1.2, .21)
}


def main():
    study = Study(__doc__)
    errors = {}
    for key, expected in TABLE.items():
        elements = key == "finite elements"
        name = key if elements else "peridynamics m %g" % key
        if not study.part(name):
            continue
        errors[key] = []
        for ny, reference in zip(LAYERS, expected):
            overrides = {
                "Mode": key if elements else "peridynamics",
                "Mesh/geometry parameters":
                "L = 4, d = 1, nx = %d, ny = %d" % (4 * ny, ny),
                "Peridynamics/horizon ratio": 2. if elements else key,
                # what the table was measured with
                "Peridynamics/stabilization scale": "shear modulus",
                "Peridynamics/influence function": "gaussian"
            }
            solution = study.solve("cantilever_small_strain.prm", overrides)
            error = 100. * (solution["tip_deflection"] / -.267 - 1.)
            errors[key].append(error)
            study.within("%s, ny %d: tip error %%" % (name, ny), error,
                         reference, .2)
            if key in (1.5, 2.) and "finite elements" in errors:
                k = LAYERS.index(ny)
                study.below("%s, ny %d: |error| below finite elements" %
                            (name, ny), abs(error),
                            abs(errors["finite elements"][k]))
        if elements:
            study.above("finite elements: rate",
                        rate(-errors[key][0], -errors[key][2], 4.), 1.8)
    study.finish()


if __name__ == "__main__":
    main()
