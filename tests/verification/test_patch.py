"""Affine patch test: every linear displacement field must come out to
round-off, whatever the mesh, the region, the blending or the loading.

Limits: acceptance of the coupling (numerics-explicit.md, sections 2 to 4):
ghost force and displacement error 1e-10; measured values are near 1e-14.
"""

import os
import random

from msh_writer import unit_box
from verification import MESHES, Study, write_parameters

LIMIT = 1e-10
MODELS = {"correspondence": 0.3, "bond based": None}
SIDES = {2: "x- x+ y- y+", 3: "x- x+ y- y+ z- z+"}


def material(model, dim, state):
    """Poisson's ratio of the bond-based model is a matter of dimension."""
    ratio = MODELS[model]
    if ratio is None:
        ratio = 1. / 3. if state == "plane stress" else 0.25
    return {
        "Dimension": dim,
        "Material/Young's modulus": 1,
        "Material/Poisson's ratio": "%.17g" % ratio,
        "Material/state": state,
        "Peridynamics/model": model,
        # Where the solver is iterative its tolerance (1e-10) would be judged.
        "Solver/linear tolerance": "1e-13"
    }, ratio


def linear(matrix):
    """Components of the displacement: matrix times position."""
    return ", ".join("%s = %s" % ("xyz"[i], " + ".join(
        "(%.17g)*%s" % (value, "xyz"[j]) for j, value in enumerate(line)))
                     for i, line in enumerate(matrix))


def random_matrix(dim, generator):
    """Strain and a larger rotation part."""
    matrix = [[generator.uniform(-.01, .01) for _ in range(dim)]
              for _ in range(dim)]
    for i in range(dim):
        for j in range(i):
            turn = generator.uniform(-.03, .03)
            matrix[i][j] += turn
            matrix[j][i] -= turn
    return matrix


def mesh_entries(folder, name):
    """Writes the mesh of this name; its entries, its dimension, its sides."""
    path = os.path.join(folder, "mesh.msh")
    if name == "unstructured":
        return {
            "Mesh/file": os.path.join(MESHES, "patch_test.geo"),
            "Mesh/geometry parameters": "n = 16"
        }, 2, "left right bottom top"
    counts = {"uniform": (16, 16), "distorted 25 %": (16, 16),
              "graded 8:1": (20, 20), "uniform hexes": (7, 7, 7),
              "distorted hexes": (7, 7, 7)}[name]
    if name == "graded 8:1":
        unit_box(path, counts, grading=8.)
    elif name == "distorted 25 %":
        unit_box(path, counts, distortion=.25, seed=3)
    elif name == "distorted hexes":
        unit_box(path, counts, distortion=.2, seed=5)
    else:
        unit_box(path, counts)
    return {"Mesh/file": path}, len(counts), SIDES[len(counts)]


def judge(study, what, solution, error="relative_displacement_error",
          condition=True):
    good = (solution["ghost_force"] < LIMIT and solution[error] < LIMIT and
            condition)
    study.row(what, solution["ghost_force"], solution[error], "< 1e-10", good)


def dirichlet(study):
    """The exact field on the whole boundary."""
    if not study.part("displacement prescribed all around", "ghost force",
                      "error"):
        return
    number = 0
    for mesh in ("uniform", "distorted 25 %", "unstructured", "graded 8:1",
                 "uniform hexes", "distorted hexes"):
        for model in MODELS:
            for ratio in (1.5, 2., 3.) if "hexes" not in mesh else (1.5, 2.):
                for blending in ("cubic", "splice"):
                    number += 1
                    one_field(study, mesh, model, ratio, blending, number)
    for seed in range(100, 103):
        for model in MODELS:
            for state in ("plane stress", "plane strain"):
                one_field(study, "unstructured", model, 2., "cubic", seed,
                          state)


def one_field(study, mesh, model, ratio, blending, seed, state=None,
              mode="coupled"):
    folder = study.folder()
    entries, dim, sides = mesh_entries(folder, mesh)
    state = state or ("plane stress" if dim == 2 else "automatic")
    entries.update(material(model, dim, state)[0])
    field = linear(random_matrix(dim, random.Random(seed)))
    entries.update({
        "Mode": mode,
        "Peridynamics/horizon ratio": ratio,
        "Peridynamics/blending function": blending,
        "Boundary conditions/displacement":
        "; ".join("%s: %s" % (side, field) for side in sides.split()),
        "Reference/displacement": field
    })
    if mode == "coupled":
        entries["Peridynamics/around"] = "ball %s 0.12" % " ".join(["0.5"] *
                                                                   dim)
        entries["Peridynamics/core size"] = "0.1"
    solution = study.solve(write_parameters(folder + "/case.prm", entries))
    words = [mesh, model, "m %g" % ratio, blending]
    if mode != "coupled":
        words[-1] = mode
    elif state == "plane strain":
        words.append(state)
    judge(study, ", ".join(words), solution)


def neumann_case(folder, mesh, model, ratio, loading, mode, seed):
    """Constant stress through boundary tractions. Returns entries and the
    error to look at."""
    entries, dim, sides = mesh_entries(folder, mesh)
    state = "plane stress" if dim == 2 else "automatic"
    constants, nu = material(model, dim, state)
    entries.update(constants)
    generator = random.Random(seed)
    stress = [[0.] * dim for _ in range(dim)]
    stress[0][0] = 0.01
    turn = [[0.] * dim for _ in range(dim)]
    if loading == "all sides":
        for i in range(dim):
            for j in range(i + 1):
                stress[i][j] = stress[j][i] = generator.uniform(-.01, .01)
                turn[i][j] = generator.uniform(-.01, .01) if i != j else 0.
                turn[j][i] = -turn[i][j]
    trace = sum(stress[i][i] for i in range(dim))
    gradient = [[
        (1. + nu) * stress[i][j] - (nu * trace if i == j else 0.) + turn[i][j]
        for j in range(dim)
    ] for i in range(dim)]
    tractions = []
    for number, side in enumerate(sides.split()):
        # Both namings list the lower side of an axis before the upper one.
        axis, sign = number // 2, 1. if number % 2 else -1.
        components = ", ".join("%s = %.17g" % ("xyz"[i], sign *
                                               stress[i][axis])
                               for i in range(dim) if stress[i][axis] != 0.)
        if components and not (loading == "symmetry" and sign < 0.):
            tractions.append("%s: %s" % (side, components))
    entries["Boundary conditions/traction"] = "; ".join(tractions)
    entries["Reference/displacement"] = linear(gradient)
    if loading == "symmetry":
        entries["Boundary conditions/symmetry"] = ", ".join(sides.split()[::2])
    elif loading == "all sides":
        # Supports against rigid motion only: they carry no force.
        points = [[1. if d == axis - 1 else 0. for d in range(dim)]
                  for axis in range(dim)]
        held = []
        for number, point in enumerate(points):
            values = [
                sum(g * x for g, x in zip(line, point)) for line in gradient
            ]
            held.append("%s: %s" % (" ".join("%g" % x for x in point),
                                    ", ".join("%s = %.17g" %
                                              ("xyz"[i], values[i])
                                              for i in range(number, dim))))
        entries["Boundary conditions/point displacement"] = "; ".join(held)
    entries["Peridynamics/horizon ratio"] = ratio
    entries["Mode"] = mode
    if mode == "coupled":
        # Touches the loaded end and free sides.
        entries["Peridynamics/around"] = ("box 0.7 0.4 1 1" if dim == 2 else
                                          "box 0.8 0.5 0.5 1 1 1")
        entries["Peridynamics/core size"] = "0.1"
    # What is left when the mean rigid motion is taken out depends on the mesh.
    free = loading == "rigid motion removed"
    return entries, ("relative_energy_error"
                     if free else "relative_displacement_error")


def neumann(study):
    """Constant stress through tractions on two or all sides."""
    if not study.part("tractions", "ghost force", "error"):
        return
    number = 0
    for mode, model in (("coupled", "correspondence"),
                        ("coupled", "bond based"), ("peridynamics",
                                                    "correspondence")):
        for mesh in ("uniform", "distorted 25 %", "unstructured", "graded 8:1",
                     "distorted hexes"):
            for loading in ("symmetry", "rigid motion removed", "all sides"):
                number += 1
                ratio = (1.5, 2., 3.)[number % (2 if "hex" in mesh else 3)]
                folder = study.folder()
                entries, error = neumann_case(folder, mesh, model, ratio,
                                              loading, mode, number)
                solution = study.solve(
                    write_parameters(folder + "/case.prm", entries))
                judge(study, "%s, %s, m %g, %s, %s" %
                      (mesh, model, ratio, loading, mode), solution, error)


def pure_peridynamics(study):
    if not study.part("peridynamics only, displacement all around",
                      "ghost force", "error"):
        return
    for number, mesh in enumerate(
        ("uniform", "distorted 25 %", "unstructured", "graded 8:1",
         "distorted hexes")):
        for ratio in (1.5, 2., 3.) if "hexes" not in mesh else (1.5, 2.):
            one_field(study, mesh, "correspondence", ratio, "cubic", number,
                      mode="peridynamics")


def layers(study):
    """Two materials that meet inside the peridynamic region, stiffness 1 to
    10. Pulled along the layers the strain is the same in both (equal Poisson's
    ratios), across them (and held sideways) the stress is: linear in each
    layer, exact in finite elements. Across is not asked of the bond-based
    model: a bond through a kink averages the two strains."""
    if not study.part("two materials in the region", "ghost force", "error"):
        return
    for mode, model, direction in (("coupled", "correspondence", "along"),
                                   ("coupled", "correspondence", "across"),
                                   ("peridynamics", "correspondence", "along"),
                                   ("peridynamics", "correspondence",
                                    "across"),
                                   ("coupled", "bond based", "along")):
        for distortion in (0., .2):
            for ratio in (1.5, 2., 3.):
                folder = study.folder()
                entries = layer_case(folder, model, distortion, direction)
                entries["Mode"] = mode
                entries["Peridynamics/horizon ratio"] = ratio
                if mode == "coupled":
                    entries["Peridynamics/around"] = "ball 0.5 0.5 0.12"
                    entries["Peridynamics/core size"] = "0.1"
                solution = study.solve(
                    write_parameters(folder + "/case.prm", entries))
                judge(study, "%s, %s, distortion %g, m %g, %s" %
                      (direction, model, distortion, ratio, mode), solution)


def refined(study):
    """The same on meshes that the program refines around the region: hanging
    nodes beside it, on the surface and at the supports."""
    if not study.part("refined locally", "ghost force", "error"):
        return
    number = 0
    for mesh, spacing in (("distorted 25 %", .03), ("unstructured", .03),
                          ("graded 8:1", .03), ("distorted hexes", .075)):
        for mode, model in (("coupled", "correspondence"),
                            ("coupled", "bond based"),
                            ("finite elements", "correspondence")):
            for loading in ("symmetry", "all sides"):
                number += 1
                ratio = (1.5, 2.)[number % 2]
                folder = study.folder()
                entries, error = neumann_case(folder, mesh, model, ratio,
                                              loading, mode, number)
                refine(entries, mesh, spacing)
                solution = study.solve(
                    write_parameters(folder + "/case.prm", entries))
                # No hanging node would prove nothing.
                judge(study, "%s, %s, m %g, %s, %s" %
                      (mesh, model, ratio, loading, mode), solution, error,
                      solution["hanging_nodes"] > 10)


def refine(entries, mesh, spacing):
    entries["Mesh/Refinement/target spacing"] = spacing
    if entries["Mode"] == "finite elements":
        entries["Mesh/Refinement/around"] = (
            "box 0.8 0.5 0.5 1 1 1" if "hexes" in mesh else "box 0.7 0.4 1 1")


def layer_case(folder, model, distortion, direction):
    """Soft below y = 1/2, stiff above."""
    path = os.path.join(folder, "mesh.msh")
    unit_box(path, (16, 16),
             distortion=distortion,
             seed=7,
             interface=.5,
             volume=lambda x: "stiff" if x[1] > .5 else "soft")
    entries, nu = material(model, 2, "plane stress")
    entries.update({
        "Mesh/file": path,
        "Material/by volume": "stiff: Young's modulus = 10",
        "Expressions/constants": "a = 0.01, nu = %.17g" % nu
    })
    if direction == "along":
        entries.update({
            "Boundary conditions/displacement": "x-: x = 0; x+: x = a",
            "Boundary conditions/point displacement": "0 0: y = 0",
            "Reference/displacement": "x = a*x, y = -nu*a*y"
        })
    else:
        entries.update({
            "Boundary conditions/symmetry": "x-, x+, y-",
            "Boundary conditions/traction": "y+: y = a",
            "Reference/displacement": "x = 0, y = a*(1 - nu*nu)*"
            "if(y < 0.5, y, 0.5 + (y - 0.5)/10)"
        })
    return entries


if __name__ == "__main__":
    STUDY = Study(__doc__)
    dirichlet(STUDY)
    pure_peridynamics(STUDY)
    neumann(STUDY)
    layers(STUDY)
    refined(STUDY)
    STUDY.finish()
