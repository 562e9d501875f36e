"""The cases of the study of errors: meshes of growing size, and the methods."""

from dataclasses import dataclass

from runs import Run

# name: entries. The ratios of horizons are those of the small size first.
MODELS = {"correspondence": "NOSB", "bond based": "bonds"}
THIRD = "0.3333333333333333"


@dataclass(frozen=True)
class Case:
    """errors: (what, quantity); bonds: parameter file and entries with which
    the bond-based model has a reference, or None."""
    title: str
    file: str
    errors: tuple
    meshes: tuple
    bonds: tuple = None
    finite_elements: bool = True
    entries: tuple = ()
    note: str = ""


def hole(nt, ratio=1.8):
    return (("nt", nt), ("nr", round(ratio * nt)))


def crack(cells):
    """Cells of 16/cells around the crack, the same shape of the plate."""
    rows = cells // 2 + 1
    return (("nx", cells), ("ny", rows), ("fy", rows * 8. / cells),
            ("q", 1.1**(64. / cells)))


def notch(nn):
    return (("nn", nn), ("nr", round(1.6 * nn)), ("nl", nn // 2),
            ("nz", round(1.8 * nn)))


# Small takes the first two meshes, medium three, large all.
CASES = {
    "plate_with_hole": Case(
        "plate with hole", "plate_with_hole",
        (("K_t", "stress_concentration"),
         ("hoop stress on r = 1.4 a", "ring_stt_error")),
        tuple(hole(nt) for nt in (20, 40, 80, 160)),
        ("plate_with_hole", ())),
    "kirsch": Case(
        "hole in an infinite plate", "kirsch_infinite_plate",
        (("L2 of displacement", "relative_displacement_error"),
         ("K_t", "stress_concentration")),
        tuple(hole(nt, 2.) for nt in (8, 16, 32, 64)),
        ("kirsch_infinite_plate", ())),
    "ellipse": Case(
        "elliptical hole", "elliptical_hole",
        (("K_t", "stress_concentration"),
         ("stress ahead of the tip", "ligament_stress_syy_error")),
        tuple((("dx", 4. / nt), ("nt", nt), ("nr", round(1.8 * nt)))
              for nt in (20, 40, 80, 160)),
        ("elliptical_hole", (("Material/Poisson's ratio", THIRD),))),
    "centre_crack": Case(
        "centre crack", "centre_crack_square_plate",
        (("K_I", "centre_tip1_K_I"),
         ("K_I by opening", "centre_tip1_K_I_opening")),
        tuple(crack(n) for n in (32, 64, 128, 256)),
        ("centre_crack_square_plate", ()), finite_elements=False,
        note="elements alone know no crack that is not meshed"),
    "cavity": Case(
        "spherical cavity, 3D", "spherical_cavity",
        (("L2 of displacement", "relative_displacement_error"),
         ("K_t", "stress_concentration")),
        tuple((("n", n), ("nr", round(17. * n / 16.)))
              for n in (8, 16, 24, 36)),
        ("spherical_cavity_bond_based", ()),
        note="bonds: Poisson's ratio 1/4"),
    "notch": Case(
        "notched bar, 3D", "double_edge_notch_3d",
        (("stress in the mid-plane", "midplane_stress_ratio"),
         ("stress along the root", "root_syy_error")),
        tuple(notch(nn) for nn in (6, 10, 16, 24)),
        note="no bonds: the reference has Poisson's ratio 0.32"),
    "cantilever": Case(
        "cantilever, large deflection", "cantilever_large_deflection",
        (("deflection", "tip_displacement_y"),
         ("axial displacement", "tip_displacement_x")),
        tuple((("nx", 10 * ny), ("ny", ny)) for ny in (4, 6, 12, 24)),
        note="no bonds: the reference is of the Hencky law; it has four digits"),
}


def methods(case, size):
    """Label, file and entries of all ways to compute a case."""
    chosen = CASES[case]
    ratios = (2,) if size == "small" and case != "plate_with_hole" else (
        1.5, 2, 3)
    found = []
    if chosen.finite_elements:
        found.append(("elements", chosen.file, (("Mode", "finite elements"),)))
    for mode in ("coupled", "peridynamics"):
        for model, name in MODELS.items():
            if model == "bond based" and chosen.bonds is None:
                continue
            file, entries = (chosen.file, ()) if name == "NOSB" else chosen.bonds
            for ratio in ratios:
                if size == "small" and mode == "peridynamics" and ratio != 2:
                    continue
                found.append((
                    "%s %s, m = %g" % ("coupled" if mode == "coupled" else "PD",
                                       name, ratio), file,
                    (("Mode", mode), ("Peridynamics/model", model),
                     ("Peridynamics/horizon ratio", ratio)) + entries))
    return found


def error_study(session, case, size):
    """Rows of runs.csv: every method on every mesh."""
    chosen = CASES[case]
    meshes = chosen.meshes[:{"small": 2, "medium": 3, "large": 4}[size]]
    rows = []
    for mesh in meshes:
        found = methods(case, size)
        runs = [Run(file, mesh, entries + chosen.entries)
                for _, file, entries in found]
        for (label, _, _), result in zip(found, session.measure(runs)):
            row = {"case": case, "size": size, "method": label,
                   "mesh": " ".join("%s=%g" % word for word in mesh)}
            rows.append(dict(row, **record(result)))
            for k, (_, quantity) in enumerate(chosen.errors):
                if not result.failed:
                    rows[-1]["error %d" % (k + 1)] = error(result, quantity)
    return rows


def error(result, quantity):
    entry = result.quantities[quantity]
    value = entry["relative_error"]
    return abs(entry["value"] if value is None else value)


def record(result):
    """The numbers of a measurement as columns."""
    if result.failed:
        return {"failed": result.failed}
    columns = dict(failed="", repetitions=result.repetitions,
                   wall="%.4g" % result.wall,
                   processor="%.4g" % result.processor,
                   memory="%.5g" % result.memory, solver=result.solver)
    columns.update(result.counts)
    columns.update(("stage " + name, "%.4g" % seconds)
                   for name, seconds in result.stages.items())
    return columns
