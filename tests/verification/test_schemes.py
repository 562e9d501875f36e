"""What the choices in a parameter file do: the consistent coupling against the
classical ones, the influence functions, the solvers.

References: table of patch tests of the numerical study (numerics.md, section
4; m = 2, omega = 1 - r/delta, core r < 0.18, blending to 0.32, 20 % distorted)
and its Kirsch table (section 6, "shape tensor only", "none", "force
blending").
"""

import kirsch
from msh_writer import unit_box
from verification import Study, rate, write_parameters

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
                "Peridynamics/influence function": "triangular",
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
    """The study takes one linear field and other random meshes; the program
    prints the worst over all fields, so a factor of 2 is allowed around its
    range. What matters: the classical ghost forces are there, do not vanish
    with h on distorted meshes, and the consistent coupling has none."""
    if not study.part("ghost force of the couplings", "ghost force", "study"):
        return
    for model, coupling, blending, (low, high), uniform in GHOST_FORCES:
        forces = []
        for k, n in enumerate((16, 32, 64)):
            what = "%s, %s, %s, h 1/%d" % (model, coupling, blending, n)
            solution = patch_case(study, n, .2, model, coupling, blending)
            forces.append(solution["ghost_force"])
            study.between(what + ", distorted", forces[k], .5 * low, 2. * high)
            force = patch_case(study, n, 0., model, coupling,
                               blending)["ghost_force"]
            if uniform:
                study.row(what + ", uniform", force, uniform[k], "factor 2",
                          .5 * uniform[k] <= force <= 2. * uniform[k])
            elif n > 16:
                # At 1/16 families of the band are cut by the outside.
                study.below(what + ", uniform", force, 1e-10)
        study.above("%s, %s, %s: 1/64 over 1/16, distorted" %
                    (model, coupling, blending), forces[2] / forces[0], .5)
    for model in ("correspondence", "bond based"):
        for blending in ("cubic", "splice"):
            solution = patch_case(study, 64, .2, model, "consistent", blending)
            study.below("%s, consistent, %s, h 1/64, distorted" %
                        (model, blending), solution["ghost_force"], 1e-10)


def kirsch_errors(study):
    """Errors around a hole. Correspondence: the study's values within 5 %
    (force blending) and 15 % (energy blending; the study used another
    stabilisation constant, G = 0.2). Bond based, uncorrected: no convergence;
    the study's values (L2 6.6e-3, 3.3e-3, 3.3e-3) belong to a micromodulus
    that is not calibrated, 10 % too stiff, which hides half of it."""
    if not study.part("errors around a hole (Kirsch), m = 2"):
        return
    tables = {
        "energy blending": ((4.93e-3, 1.38e-3, 3.75e-4),
                            (3.4e-2, 1.8e-2, 9.3e-3), 15.),
        "force blending": ((5.7e-3, 1.6e-3, 5.4e-4), (3.1e-2, 1.6e-2, 8.3e-3),
                           5.)
    }
    last = {}
    for model in ("correspondence", "bond based"):
        for coupling in ("energy blending", "force blending", "consistent"):
            runs = []
            for k, cells in enumerate((32, 64, 128)):
                folder = study.folder()
                kirsch.write_case(folder, cells, "coupled", model, 2.)
                solution = study.solve(folder + "/kirsch.prm",
                                       {"Peridynamics/coupling": coupling})
                runs.append((solution["relative_displacement_error"],
                             solution["relative_energy_error"]))
                what = "%s, %s, nt %d: " % (model, coupling, cells)
                if model == "correspondence" and coupling in tables:
                    l2, energy, percent = tables[coupling]
                    study.within_percent(what + "L2", runs[k][0], l2[k],
                                         percent)
                    study.within_percent(what + "energy", runs[k][1],
                                         energy[k], percent)
                study.note("%sL2 %.3g, energy %.3g, K_t error %+.2f %%" %
                           (what, *runs[k], 100. *
                            (solution["stress_concentration"] / 3. - 1.)))
            last[model, coupling] = runs[2]
            what = "%s, %s: rate of " % (model, coupling)
            l2, energy = (rate(runs[0][k], runs[2][k], 4.) for k in (0, 1))
            if coupling == "consistent":
                study.above(what + "L2", l2, 1.75)
                study.above(what + "energy", energy, 1.3)
            else:
                study.below(what + "energy", energy, 1.1)
                if model == "bond based":
                    study.below(what + "L2", l2, 1.)
    for (model, coupling), errors in last.items():
        if coupling != "consistent":
            gain = errors[1] / last[model, "consistent"][1]
            study.above("%s: energy error of %s over consistent, nt 128" %
                        (model, coupling), gain, 2.)


def influence_functions(study):
    """All of them: no ghost force, K_t of the plate with a hole (collocation:
    3.086085) within 3 % at m = 1.5 on a mesh where finite elements have
    0.3 % to 1 %."""
    if not study.part("influence functions, plate with a hole"):
        return
    for function in ("constant", "triangular", "cubic spline", "gaussian"):
        for ratio in (1.5, 2., 3.):
            solution = study.solve(
                "plate_with_hole.prm", {
                    "Mesh/geometry parameters": "nt = 24, nr = 44",
                    "Peridynamics/influence function": function,
                    "Peridynamics/horizon ratio": ratio,
                    "Quantities/compare with finite elements": "false"
                })
            what = "%s, m %g: " % (function, ratio)
            study.below(what + "ghost force", solution["ghost_force"], 1e-10)
            if ratio == 1.5:
                study.within_percent(what + "K_t",
                                     solution["stress_concentration"],
                                     3.086085158, 3.)
            else:
                error = solution["stress_concentration"] / 3.086085158 - 1.
                study.note("%sK_t error %+.2f %%, ring %.2f %%" %
                           (what, 100. * error,
                            100. * solution["ring_stt_error"]))


SOLVERS = [("direct", "automatic"), ("iterative", "assembled"),
           ("iterative", "matrix-free")]


def solvers(study):
    """Every solver gives the same quantities to 1e-8."""
    if not study.part("direct, iterative, assembled, matrix-free"):
        return
    plate = {
        "Mesh/geometry parameters": "nt = 20, nr = 36",
        "Quantities/compare with finite elements": "false"
    }
    cavity = {"Mesh/geometry parameters": "n = 8, nr = 9"}
    for file, overrides in (
        ("plate_with_hole.prm", plate),
        ("plate_with_hole.prm",
         dict(plate, **{"Peridynamics/coupling": "force blending"})),
        ("plate_with_hole_bond_based.prm", {
            "Mesh/geometry parameters": "nt = 8, nr = 20"
        }), ("strip_with_hole.prm", {}),
        ("cantilever_small_strain.prm", {}),
        ("spherical_cavity.prm", cavity),
        ("spherical_cavity_bond_based.prm", cavity)):
        runs = []
        for linear, tangent in SOLVERS:
            if "bond_based" in file and tangent == "matrix-free":
                continue
            runs.append(
                study.solve(
                    file,
                    dict(
                        overrides, **{
                            "Solver/linear solver": linear,
                            "Solver/tangent": tangent,
                            "Solver/linear tolerance": "1e-13",
                            "Solver/Newton tolerance": "1e-11"
                        })))
        names = [
            name for name in runs[0] if name.endswith(
                ("_displacement_x", "_displacement_y", "_deflection",
                 "concentration", "strain_energy", "_error", "right_x"))
            and abs(runs[0][name]) > 1e-12
        ]
        for run in runs[1:]:
            worst = max(
                abs(run[name] / runs[0][name] - 1.) for name in names)
            study.below("%s: %s, worst of %d" %
                        (file, run["linear_solver"], len(names)), worst, 1e-8)


if __name__ == "__main__":
    STUDY = Study(__doc__)
    ghost_forces(STUDY)
    kirsch_errors(STUDY)
    influence_functions(STUDY)
    solvers(STUDY)
    STUDY.finish()
