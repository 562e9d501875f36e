"""What the choices in a parameter file do: the consistent coupling against the
classical ones, the influence functions, the solvers.

References: table of patch tests of the numerical study (numerics.md, section
4; m = 2, core r < 0.18, blending to 0.32, nodes moved by 20 %) and its Kirsch
table (section 6, "shape tensor only", "none", "force blending").
"""

import kirsch
from msh_writer import unit_box
from verification import Study, write_parameters

# model, coupling, blending: range of the ghost force on distorted meshes over
# h = 1/16 .. 1/64, and its value on the uniform mesh of h = 1/16 .. 1/64.
GHOST_FORCES = [
    ("correspondence", "energy blending", "cubic", (.19, .29),
     (2.3e-2, 6.3e-3, 1.8e-3)),
    ("correspondence", "energy blending", "splice", (.22, .29),
     (7.8e-2, 8.1e-2, 8.2e-2)),
    ("correspondence", "force blending", "cubic", (.19, .29), None),
    ("bond based", "energy blending", "cubic", (.17, .20),
     (5.6e-2, 2.4e-2, 1.2e-2)),
    ("bond based", "force blending", "cubic", (.15, .20), None),
]


def patch_case(study, n, distortion, model, coupling, blending):
    folder = study.folder()
    unit_box(folder + "/mesh.msh", (n, n), distortion=distortion, seed=n)
    field = "x = 0.01*x + 0.004*y, y = -0.002*x - 0.006*y"
    return study.solve(
        write_parameters(
            folder + "/case.prm", {
                "Mesh/file": "mesh.msh",
                "Material/Young's modulus": 1,
                "Material/Poisson's ratio": "0.333333333333333333",
                "Material/state": "plane stress",
                "Peridynamics/model": model,
                "Peridynamics/coupling": coupling,
                "Peridynamics/around": "ball 0.5 0.5 0.1",
                "Peridynamics/core size": 0.08,
                "Peridynamics/blending width": 0.14,
                "Peridynamics/blending function": blending,
                "Boundary conditions/displacement":
                "; ".join("%s: %s" % (side, field)
                          for side in ("x-", "x+", "y-", "y+")),
                "Reference/displacement": field
            }))


def ghost_forces(study):
    if not study.part("ghost force of the couplings"):
        return
    for model, coupling, blending, (low, high), uniform in GHOST_FORCES:
        for k, n in enumerate((16, 32, 64)):
            what = "%s, %s, %s, h 1/%d" % (model, coupling, blending, n)
            solution = patch_case(study, n, .2, model, coupling, blending)
            study.between(what + ", distorted", solution["ghost_force"], low,
                          high)
            study.note("error in u %.1e" %
                       solution["relative_displacement_error"])
            solution = patch_case(study, n, 0., model, coupling, blending)
            if uniform:
                study.within_percent(what + ", uniform",
                                     solution["ghost_force"], uniform[k], 10.)
            else:
                study.below(what + ", uniform", solution["ghost_force"], 1e-10)
            solution = patch_case(study, n, .2, model, "consistent", blending)
            study.below("%s, consistent, %s, h 1/%d, distorted" %
                        (model, blending, n), solution["ghost_force"], 1e-10)


if __name__ == "__main__":
    STUDY = Study(__doc__)
    ghost_forces(STUDY)
    STUDY.finish()
