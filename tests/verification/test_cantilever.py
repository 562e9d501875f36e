"""Cantilever with an end load in pure peridynamics: bending, where models
without stabilisation are too soft and badly stabilised ones lock.

Reference: Timoshenko's tip deflection -0.267; the expected errors are those of
the numerical study (numerics-explicit.md, section 2; finite elements, plane
stress). Limit of the acceptance: 0.2 % (absolute); m = 1.5 and 2 better than
finite elements.

Gradients over adjacent cells, not in the study: no error above half of that of
finite elements, for any m; and the same of a beam in pure bending in 3D.
"""

import os

from msh_writer import structured, write_msh
from verification import Study, rate, write_parameters

LAYERS = (4, 8, 16)
# Tip error in %, ny = 4, 8, 16.
TABLE = {
    "finite elements": (-2.87, -.73, -.18),
    1.5: (-.93, -.26, -.07),
    2.: (.26, -.07, -.02),
    3.: (10.4, 1.2, .21)
}


# Curvature 1 about z, uniaxial stress; origin in the middle of the end x-.
BENDING = "x = -x*y, y = 0.5*(x^2 + nu*(y^2 - z^2)), z = nu*y*z"
BEAM = {
    "Dimension": 3,
    "Mesh/file": "beam.msh",
    "Material/Young's modulus": 1.,
    "Material/Poisson's ratio": .3,
    "Peridynamics/around": "",
    "Boundary conditions/displacement": "x-: " + BENDING,
    "Boundary conditions/traction": "x+: x = -y",
    "Expressions/constants": "nu = 0.3",
    "Quantities/deflection": "tip: 4 0 0, y",
    "Output/fields": "false"
}


def beam_in_space(study):
    """Length 4, depth and width 1, 16 x 4 x 4 cells."""
    if not study.part("pure bending in 3D"):
        return
    tip = {}
    for mode, ratio in (("finite elements", 2.), ("peridynamics", 1.5),
                        ("peridynamics", 2.), ("peridynamics", 3.)):
        folder = study.folder()
        points, cells, surfaces = structured(
            (16, 4, 4), lambda i, j, k: (i / 4., j / 4. - .5, k / 4. - .5))
        write_msh(os.path.join(folder, "beam.msh"), 3, points, cells, surfaces)
        solution = study.solve(write_parameters(
            os.path.join(folder, "beam.prm"),
            dict(BEAM, **{"Mode": mode, "Peridynamics/horizon ratio": ratio})))
        tip[ratio if mode == "peridynamics" else mode] = abs(
            solution["tip_deflection"] / 8. - 1.)
    for ratio in (1.5, 2., 3.):
        study.below("peridynamics m %g: error of the tip over that of finite "
                    "elements" % ratio, tip[ratio] / tip["finite elements"],
                    .5)


def narrow(study, elements):
    """Gradients over adjacent cells."""
    for ratio in (1.5, 2., 3.):
        if not elements or not study.part("adjacent cells m %g" % ratio):
            continue
        for ny, reference in zip(LAYERS, elements):
            solution = study.solve("cantilever_small_strain.prm", {
                "Mesh/geometry parameters":
                "L = 4, d = 1, nx = %d, ny = %d" % (4 * ny, ny),
                "Peridynamics/horizon ratio": ratio
            })
            error = solution["tip_deflection"] / -.267 - 1.
            study.below("m %g, ny %d: tip error %%" % (ratio, ny),
                        100. * abs(error), .5 * abs(reference))


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
                "Peridynamics/gradient support": "horizon",
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
    narrow(study, errors.get("finite elements"))
    beam_in_space(study)
    study.finish()


if __name__ == "__main__":
    main()
