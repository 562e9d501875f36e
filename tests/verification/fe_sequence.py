"""Finite elements on a sequence of meshes against references that other
programs or closed forms gave."""

from verification import rate


def converges(study, name, file, levels, quantities, overrides=None, order=1.8):
    """Runs file in the mode 'finite elements' on three meshes, each twice as
    fine as the one before. levels: geometry parameters; quantities: name ->
    reference, or (reference, factor on the measured value).

    Displacements and reactions must converge with at least this order from the
    first mesh to the last; stresses, which are recovered, must be within mesh
    error: the change from the middle to the finest mesh."""
    if not study.part(name + ", finite elements"):
        return
    runs = []
    for level in levels:
        entries = {
            "Mode": "finite elements",
            "Mesh/geometry parameters": level,
            "Reference/values": "",
            "Reference/data": "",
            "Quantities/compare with finite elements": "false",
            "Quantities/line": "",
            "Quantities/circle": ""
        }
        entries.update(overrides or {})
        runs.append(study.solve(file, entries))
    for quantity, reference in quantities.items():
        factor = 1.
        if isinstance(reference, tuple):
            reference, factor = reference
        values = [factor * run[quantity] for run in runs]
        errors = [abs(value - reference) for value in values]
        change = abs(values[2] - values[1])
        study.row("%s: %s" % (name, words(quantity)), values[2], reference,
                  "%.2g < %.2g" % (errors[2], change), errors[2] <= change)
        if "stress" not in quantity:
            study.above("%s: %s, order" % (name, words(quantity)),
                        rate(errors[0], errors[2], 4.), order)
        else:
            study.note("stress: order %.2f" % rate(errors[0], errors[2], 4.))


def words(quantity):
    """tip_displacement_x is "tip ux" in the table."""
    return quantity.replace("_displacement_", " u").replace("_", " ")


def fields_converge(study, name, file, levels, overrides=None):
    """The same for a case with an exact displacement field: order of the
    error in u, and of the energy norm of the nodal error."""
    if not study.part(name + ", finite elements"):
        return
    runs = []
    for level in levels:
        entries = {"Mode": "finite elements", "Reference/data": ""}
        if level:
            entries["Mesh/geometry parameters"] = level
        entries.update(overrides or {})
        runs.append(study.solve(file, entries))
    for what, quantity, least in (("u", "relative_displacement_error", 1.8),
                                  ("energy", "relative_energy_error", 1.)):
        errors = [run[quantity] for run in runs]
        study.above("%s: %s %.2e, %.2e, %.2e: order" % (name, what, *errors),
                    rate(errors[0], errors[2], 4.), least)
