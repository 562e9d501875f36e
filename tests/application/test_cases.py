"""Every shipped parameter file gives its number; options of the program."""

import array
import base64
import csv
import math
import os
import re
import struct
import xml.etree.ElementTree as ElementTree
import zlib

from case_files import parameter_text
from harness import (PARAMETER_FILES, Failures, Runner, finish,
                     parse_arguments)

# file -> (overrides, {quantity: largest relative error against the Reference
# entry of the file}, {quantity: largest value}). The origin of each reference
# is in the file; tolerances are those stated there or tighter, about twice
# what was measured. Tables "_error" are relative L2 errors themselves.
CASES = {
    "cantilever_small_strain.prm":
    ([], {"tip_deflection": 6e-3}, {"relative_displacement_error": 8e-3,
                                    "relative_energy_error": 0.07}),
    "double_edge_notch_3d.prm":
    (["Peridynamics/gradient support=horizon"],
     {"midplane_stress_ratio": 0.015, "face_stress_ratio": 0.015},
     {"root_syy_error": 0.02, "ligament_syy_error": 0.02}),
    "elliptical_hole.prm":
    ([], {"stress_concentration": 0.03, "tip_displacement_x": 5e-3,
          "pole_displacement_y": 1e-3},
     {"ligament_displacement_ux_error": 5e-3,
      "ligament_stress_syy_error": 0.05}),
    "kirsch_infinite_plate.prm":
    ([], {"stress_concentration": 0.01},
     {"relative_displacement_error": 4e-4, "relative_energy_error": 6e-3,
      "ring_stt_error": 8e-3}),
    "patch_test.prm":
    ([], {}, {"relative_displacement_error": 1e-10,
              "relative_energy_error": 1e-10,
              "relative_maximum_error": 1e-10}),
    "penny_crack.prm":
    (["Mesh/geometry parameters=h = 0.25"], {"penny_front1_K_I": 0.04}, {}),
    "plate_with_hole.prm":
    ([], {"stress_concentration": 0.01, "equator_displacement_y": 1e-3,
          "pole_displacement_x": 5e-4},
     {"ring_stt_error": 5e-3, "ring_ux_error": 1e-3}),
    "plate_with_hole_refined.prm":
    ([], {"stress_concentration": 5e-3, "equator_displacement_y": 0.01,
          "pole_displacement_x": 5e-3},
     {"ring_stt_error": 3e-3, "ring_ux_error": 5e-3}),
    "plate_with_hole_bond_based.prm":
    ([], {"stress_concentration": 0.01, "equator_displacement_y": 4e-3,
          "pole_displacement_x": 2e-3},
     {"ring_stt_error": 5e-3, "ring_ux_error": 2e-3}),
    "spherical_cavity.prm":
    ([], {"stress_concentration": 0.02, "equator_stress_zz": 0.02},
     {"relative_displacement_error": 1e-3, "relative_energy_error": 8e-3,
      "equator_szz_error": 0.01}),
    # coarse: 729 nodes instead of 3906
    "spherical_cavity_bond_based.prm":
    (["Mesh/geometry parameters=n = 8, nr = 9"],
     {"stress_concentration": 0.06},
     {"relative_displacement_error": 4e-3, "relative_energy_error": 0.02}),
    "strip_with_hole.prm":
    ([], {"stress_concentration": 0.01, "equator_displacement_y": 3e-3,
          "pole_displacement_x": 1e-3},
     {"load_axis_ux_error": 5e-4, "equator_uy_error": 2e-3}),
    "uniaxial_plate.prm":
    ([], {"inside_displacement_x": 1e-9, "inside_displacement_y": 1e-9,
          "inside_stress_xx": 1e-9},
     {"relative_displacement_error": 1e-9, "relative_energy_error": 1e-9}),
}

# Large deformation: all steps are in tests/verification.
FINITE_STRAIN = {
    "cantilever_large_deflection.prm":
    ([], {"tip_displacement_y": 2.5e-3}, {}),
    "clamped_beam.prm": ([], {"middle_deflection": 5e-3}, {}),
    "hydrostatic_compression.prm": ([], {"center_stress_xx": 1e-9}, {}),
    "hydrostatic_extension.prm": ([], {"right_displacement_x": 1e-9}, {}),
    "pinned_beam.prm": ([], {"middle_deflection": 4e-3}, {}),
    # against beam theory
    "pinned_beam_movable.prm": ([], {"middle_deflection": 0.022}, {}),
    "prototype_microelastic_uniaxial.prm":
    ([], {"reaction_top_y": 1e-6}, {}),
    "simple_shear.prm": ([], {"center_stress_xy": 1e-9}, {}),
    "stretched_plate_with_hole.prm":
    ([], {"edge_first_piola_kirchhoff_yy": 0.02}, {}),
}
CASES.update(FINITE_STRAIN)

# Cracks: loads, directions and K of many more are in tests/verification.
CASES.update({
    "centre_crack_square_plate.prm":
    ([], {"centre_tip1_K_I": 5e-3, "centre_tip2_K_I": 5e-3,
          "centre_tip1_J": 5e-3, "centre_tip1_K_I_opening": 0.03},
     {"centre_tip1_domain_dependence": 3e-3}),
    "centre_crack_refined.prm":
    ([], {"centre_tip1_K_I": 5e-3, "centre_tip2_K_I": 5e-3,
          "centre_tip1_J": 5e-3, "centre_tip1_K_I_opening": 0.01},
     {"centre_tip1_domain_dependence": 3e-3}),
    "centre_crack_tada.prm":
    ([], {"crack_tip1_K_I": 5e-3, "crack_tip2_K_I": 5e-3},
     {"crack_tip1_domain_dependence": 3e-3}),
    # 1 % is the limit of test_meshed_cracks.py
    "centre_crack_meshed.prm":
    ([], {"crack_tip1_K_I": 5e-3, "crack_tip2_K_I": 5e-3,
          "crack_tip1_J": 0.01, "crack_tip1_K_I_opening": 0.01},
     {"crack_tip1_domain_dependence": 1e-3, "crack_tip1_K_II": 1e-9}),
    # the handbooks differ by 0.6 %
    "edge_crack_tension.prm":
    ([], {"edge_tip1_K_I": 0.01}, {"edge_tip1_domain_dependence": 3e-3}),
    # 1 and 1.5 % of |K|
    "slant_crack.prm":
    ([], {"crack_tip1_K_I": 0.014, "crack_tip1_K_II": 0.021},
     {"crack_tip1_domain_dependence": 3e-3}),
})
# Growth stops after so many advances; here a few of those of the file.
GROWTH = {
    "edge_crack_growth.prm": 2,
    "inclined_edge_crack_growth.prm": 2,
    "two_cracks.prm": 2,
    "notched_beam.prm": 2,
    "l_shaped_panel.prm": 2,
}
CASES.update({
    name: (["Cracks/maximum advances=%d" % advances], {}, {})
    for name, advances in GROWTH.items()
})
# Bonds that break, and a crack that grows at large deflection: status of the
# run; numbers are in tests/verification/test_thesis_fracture.py.
BREAKING = {
    "off_axis_tension.prm": ("stopped", []),
    "centre_crack_fracture.prm": ("stopped", ["Cracks/maximum advances=2"]),
    "cracked_cantilever.prm":
    ("converged", ["Mesh/geometry parameters=h = 0.01875",
                   "Load steps/number of steps=2"]),
    # up to the first events
    "plate_with_hole_fracture.prm":
    ("converged", ["Load steps/end time=0.7", "Load steps/number of steps=2"]),
    "strip_with_hole_fracture.prm":
    ("converged", ["Load steps/end time=0.5", "Load steps/number of steps=2"]),
}
CASES.update({name: (words, {}, {}) for name, (_, words) in BREAKING.items()})
# Motion: numbers over time are in tests/verification/test_waves.py.
MOTION = {
    "bar_wave.prm": ([], {}, {}),
    # the start only, on a coarse mesh
    "dynamic_edge_crack.prm":
    (["Mesh/geometry parameters=L = 0.1, d = 0.1, nx = 40, ny = 40",
      "Load steps/end time=5e-6", "Load steps/number of steps=10"], {}, {}),
    "dynamic_branching.prm": (["Load steps/end time=2e-6"], {}, {}),
    "composite_centre_crack.prm":
    (["Mesh/geometry parameters=L = 0.125, d = 0.25, h = 0.0025",
      "Load steps/end time=20e-6", "Load steps/number of steps=4"], {}, {}),
    # the start only, on a coarse mesh
    "kalthoff_winkler.prm":
    (["Mesh/geometry parameters=h = 0.002", "Load steps/end time=20e-6"], {},
     {}),
    "delamination.prm":
    (["Mesh/geometry parameters=nx = 120, ny = 30",
      "Load steps/end time=3e-6"], {}, {}),
    "inclusion_and_hole.prm":
    (["Mesh/geometry parameters=dx = 0.0002, lc = 0.0008",
      "Load steps/end time=2e-6", "Load steps/number of steps=10"], {}, {}),
    "suddenly_loaded_crack.prm":
    ([], {"edge_tip1_K_I": 0.03}, {}),
}
CASES.update(MOTION)
NONLINEAR = set(FINITE_STRAIN) | {"cracked_cantilever.prm"}

KEYS = {
    "": ["case", "mode", "status", "quantities", "counts", "checks",
         "timings", "peak_memory_mb"],
    "counts": ["nodes", "dofs", "cells", "active_cells", "particles", "bonds",
               "broken_bonds", "newton_iterations", "linear_iterations"],
    "checks": ["ghost_force", "imbalance", "energy_balance"],
    "timings": ["total", "setup", "assembly", "linear_solver", "damage",
                "output"],
}
FILES = ["results.json", "parameters.prm", "log.txt", "solution.pvd"]
STATIC_FILES = ["load_steps.csv", "newton.csv"]
MOTION_FILES = ["time_steps.csv"]
NODAL_FIELDS = {"displacement", "stress_xx", "stress_yy", "alpha", "horizon"}


def check_contract(failures, results, linear, growth=False, status=None,
                   motion=False):
    for section, names in KEYS.items():
        part = results[section] if section else results
        for name in names:
            # Along a curved path the work is not known exactly.
            if name == "energy_balance" and not linear:
                continue
            failures.check(name in part, "results.json lacks %s/%s" %
                           (section, name))
    for name, entry in results["quantities"].items():
        # K, J and T are symbols of fracture mechanics.
        failures.check(
            re.fullmatch(r"[a-z][a-z0-9_]*",
                         re.sub(r"_(K_II?|J|T_stress)(?=_|$)", "", name)),
            "%r is not in snake_case" % name)
        failures.check(
            {"value", "unit", "reference", "relative_error"} <= set(entry),
            "%s lacks a key" % name)
    failures.check(
        results["status"] == (status or
                              ("stopped" if growth else "converged")),
        "status " + results["status"])
    if linear and not growth and not motion:
        failures.check(results["counts"]["newton_iterations"] == 1,
                       "more than one Newton iteration for a linear problem")
    failures.check_below("ghost_force", results["checks"]["ghost_force"],
                         1e-10)
    if motion:
        # numerical damping included
        failures.check_below("energy_balance",
                             abs(results["checks"]["energy_balance"]), 0.02)
    else:
        failures.check_below("imbalance", results["checks"]["imbalance"],
                             1e-9)


def check_numbers(failures, results, errors, limits):
    quantities = results["quantities"]
    for name, limit in errors.items():
        entry = quantities[name]
        reference, value = entry["reference"], entry["value"]
        if failures.check(reference is not None, name + " has no reference"):
            failures.check_close(name, value, reference, limit)
            error = abs(value - reference) / abs(reference)
            failures.check(
                abs(error - entry["relative_error"]) <= 1e-12,
                name + ": relative_error is not that of its reference")
    for name, limit in limits.items():
        failures.check_below(name, quantities[name]["value"], limit)


def vtu_arrays(path):
    """Name -> numbers of the point data of a VTU file (binary, compressed)."""
    piece = ElementTree.parse(path).find(".//Piece")
    arrays = {}
    for entry in piece.find("PointData"):
        text = entry.text.strip()
        n_blocks = struct.unpack("<Q", base64.b64decode(text[:12])[:8])[0]
        words = 3 + n_blocks
        head = 4 * ((8 * words + 2) // 3)
        sizes = struct.unpack("<%dQ" % words, base64.b64decode(text[:head]))[3:]
        data = base64.b64decode(text[head:])
        raw, place = b"", 0
        for size in sizes:
            raw += zlib.decompress(data[place:place + size])
            place += size
        kind = {"Float64": "d", "Float32": "f", "Int32": "i",
                "UInt8": "B"}[entry.get("type")]
        numbers = array.array(kind, raw)
        n_components = int(entry.get("NumberOfComponents", 1))
        if len(numbers) != n_components * int(piece.get("NumberOfPoints")):
            raise ValueError("%s: %s has a wrong size" % (path,
                                                          entry.get("Name")))
        arrays[entry.get("Name")] = numbers
    return arrays


def check_collection(failures, outcome, name, fields, growth=False):
    """A .pvd and the .vtu files that it names; returns the last fields."""
    sets = ElementTree.parse(outcome.path(name)).findall(".//DataSet")
    times = [float(entry.get("timestep")) for entry in sets]
    # Of growth the series counts states: load factors go up and down.
    failures.check(times[0] == 0. and times == sorted(set(times)) and
                   (growth or times[-1] == 1.),
                   "%s has the times %s" % (name, times))
    for entry in sets:
        arrays = vtu_arrays(outcome.path(entry.get("file")))
        failures.check(fields <= set(arrays), "%s lacks %s" %
                       (entry.get("file"), fields - set(arrays)))
        for field, numbers in arrays.items():
            failures.check(all(math.isfinite(number) for number in numbers),
                           "%s: %s is not finite" % (entry.get("file"), field))
    return arrays


def check_largest_displacement(failures, outcome, arrays, steps):
    """The fields hold the numbers of the table."""
    numbers = arrays["displacement"]
    largest = max(
        math.sqrt(sum(u * u for u in numbers[k:k + 3]))
        for k in range(0, len(numbers), 3))
    with open(outcome.path(steps)) as file:
        row = list(csv.DictReader(file))[-1]
    failures.check_close("largest displacement in the fields", largest,
                         float(row["largest_displacement"]), 1e-5)


def check_growth(failures, outcome, advances):
    """Each advance takes its fracture energy."""
    with open(outcome.path("crack_growth.csv")) as file:
        rows = list(csv.DictReader(file))
    failures.check(len(rows) == advances, "%d advances" % len(rows))
    for row in rows:
        failures.check_close("released energy", float(row["released_energy"]),
                             float(row["dissipated_energy"]), 1e-9)
    results = outcome.results()
    failures.check_below("energy balance",
                         results["checks"]["energy_balance"], 1e-8)
    failures.check(
        results["growth"]["end"] == "largest number of advances" and
        results["growth"]["advances"] == advances, "growth: %s" %
        results["growth"])


def check_files(failures, outcome, growth=False, motion=False):
    """The .pvd series of growth and of motion do not end at 1."""
    step_files = MOTION_FILES if motion else STATIC_FILES
    growth = growth or motion
    particles = outcome.results()["mode"] != "finite elements"
    for name in FILES + step_files + (["particles.pvd"]
                                      if particles else []):
        failures.check(os.path.exists(outcome.path(name)),
                       name + " is missing")
    arrays = check_collection(failures, outcome, "solution.pvd", NODAL_FIELDS,
                              growth)
    check_largest_displacement(failures, outcome, arrays, step_files[0])
    if particles:
        check_collection(failures, outcome, "particles.pvd",
                         {"displacement", "alpha", "horizon"}, growth)
    for name in sorted(os.listdir(outcome.folder)):
        if name.endswith(".csv"):
            with open(outcome.path(name)) as file:
                rows = list(csv.reader(file))
            failures.check(len(rows) > 1, name + " is empty")
            for row in rows[1:]:
                failures.check(
                    len(row) == len(rows[0]) and
                    not any("nan" in cell for cell in row),
                    "%s: bad row %s" % (name, row))
    if not motion:
        with open(outcome.path("log.txt")) as file:
            failures.check("Newton iteration 1" in file.read(),
                           "log.txt lacks the Newton iterations")


def check_cases(failures, runner, selected):
    shipped = sorted(
        name for name in os.listdir(PARAMETER_FILES) if name.endswith(".prm"))
    if selected("table of cases"):
        failures.begin("table of cases")
        failures.check(shipped == sorted(CASES), "not the shipped files: %s" %
                       sorted(set(shipped) ^ set(CASES)))
        failures.end()
    for name in filter(selected, shipped):
        overrides, errors, limits = CASES[name]
        failures.begin(name)
        outcome = runner.run_case(name, overrides)
        if failures.check(outcome.code == 0,
                          "exit code %d" % outcome.code):
            failures.check(outcome.stderr == "", "something on stderr")
            failures.check_clean(outcome.text)
            results = outcome.results()
            growth = name in GROWTH or name in BREAKING
            motion = name in MOTION
            check_contract(failures, results, name not in NONLINEAR, growth,
                           BREAKING.get(name, (None,))[0], motion)
            check_numbers(failures, results, errors, limits)
            check_files(failures, outcome, growth, motion)
            if name in GROWTH:
                check_growth(failures, outcome, GROWTH[name])
        failures.end(outcome)
        # A file that has run as it is shipped is valid: one of them is enough.
        if selected(name + " --validate") and (overrides or
                                               name == "patch_test.prm"):
            failures.begin(name + " --validate")
            outcome = runner.run(
                [os.path.join(PARAMETER_FILES, name), "--validate"])
            failures.check(outcome.code == 0,
                           "exit code %d" % outcome.code)
            failures.check("The input is valid." in outcome.stdout,
                           "does not say that the input is valid")
            failures.check(
                os.listdir(os.path.dirname(outcome.folder)) == [],
                "something was written")
            failures.end(outcome)


def same_numbers(first, second):
    return first["quantities"] == second["quantities"]


def check_printed_parameters(failures, runner):
    """Parameters printed, read again and printed are the same, and so are the
    results of a run with them and with the copy that a run saves."""
    failures.begin("--print-parameters")
    folder = runner.new_folder()

    def write(name, text):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)

    write("case.prm", parameter_text())
    first = runner.run(["case.prm", "--print-parameters"], 1, folder)
    write("printed.prm", first.stdout)
    second = runner.run(["printed.prm", "--print-parameters"], 1, folder)
    failures.check(first.code == 0 and first.stdout == second.stdout,
                   "another text when read again")
    failures.check("# m = horizon / local spacing" in first.stdout,
                   "no comments")
    alone = runner.run(["--print-parameters"], 1, folder)
    failures.check(
        alone.code == 0 and "set Mode" in alone.stdout and
        alone.stdout != first.stdout, "no defaults without a file")
    runs = [
        runner.run([name, "--output", output], 1, folder, output)
        for name, output in (("case.prm", "one"), ("printed.prm", "two"),
                             ("one/parameters.prm", "three"))
    ]
    if failures.check(all(run.code == 0 for run in runs), "a run failed"):
        results = [run.results() for run in runs]
        failures.check(same_numbers(results[0], results[1]),
                       "other results with the printed parameters")
        failures.check(same_numbers(results[0], results[2]),
                       "other results with the saved parameters")
    failures.end(first)


def check_options(failures, runner):
    for words, expected in ((["--help"], "Usage: perimorph FILE.prm"),
                            (["-h"], "Exit codes: 0 done, 2 bad input"),
                            (["--version"], "Perimorph 0.")):
        for ranks in (1, 2):
            failures.begin("%s on %d" % (words[0], ranks))
            outcome = runner.run(words, ranks)
            failures.check(outcome.code == 0, "exit code %d" % outcome.code)
            failures.check(outcome.stdout.count(expected) == 1,
                           "%r is not there once" % expected)
            failures.check(outcome.stderr == "", "something on stderr")
            failures.end(outcome)


def check_failed_solve(failures, runner):
    """A solve that cannot reach its tolerance: exit code 3, the reason, the
    history, and the state said in results.json."""
    for ranks in (1, 3):
        failures.begin("failed solve on %d" % ranks)
        outcome = runner.run_case("plate_with_hole.prm", [
            "Mesh/geometry parameters=nt = 20, nr = 36",
            "Solver/linear solver=iterative",
            "Solver/linear tolerance=1e-2",
            "Solver/maximum Newton iterations=1"], ranks)
        failures.check(outcome.code == 3, "exit code %d" % outcome.code)
        for fragment in ("Error: the solve failed: load step 1 (t = 1)",
                         "relative residuals 1 ", "'out'"):
            failures.check(outcome.stderr.count(fragment) == 1,
                           "the message lacks %r" % fragment)
        failures.check_clean(outcome.text)
        failures.check(outcome.results()["status"] == "failed",
                       "results.json does not say it")
        failures.end(outcome)


def main():
    arguments = parse_arguments(__doc__)
    runner = Runner(arguments)
    failures = Failures()

    def selected(name):
        return not arguments.only or re.search(arguments.only, name)

    check_cases(failures, runner, selected)
    for name, check in (("options", check_options),
                        ("--print-parameters", check_printed_parameters),
                        ("failed solve", check_failed_solve)):
        if selected(name):
            check(failures, runner)
    finish(failures)


if __name__ == "__main__":
    main()
