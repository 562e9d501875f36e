"""The explicit loop: particle-steps per second of one core, and LAMMPS peri/pmb
(Parks et al., 2008) beside it where the program `lmp` is found."""

import json
import math
import re
import shutil
import statistics
import subprocess

from runs import ROOT, fail

# Cells along an axis, and about how many steps.
SIZES = {"small": {"plate": (100, 400), "block": (14, 100)},
         "medium": {"plate": (200, 800), "block": (26, 100)}}
SIZES["large"] = SIZES["medium"]
DIMENSION = {"plate": 2, "block": 3}
HORIZON_RATIO = 3

# A unit body with velocities small enough for both kinds of strain.
PARAMETERS = """
set Dimension = %(dimension)d
set Mode      = peridynamics
subsection Mesh
  set file                = %(mesh)s
  set geometry parameters = n = %(cells)d
end
subsection Material
  set law             = %(law)s
  set Young's modulus = 1
  set Poisson's ratio = %(ratio).17g
  set density         = 1
%(state)s
end
subsection Peridynamics
  set model         = %(model)s
  set coupling      = %(coupling)s
  set horizon ratio = %(horizon)d
end
subsection Boundary conditions
  set point displacement = %(point)s
end
subsection Time integration
  set scheme           = explicit
  set initial velocity = x = 1e-3*x*y, y = -1e-3*x*y
end
subsection Load steps
  set end time        = %(end).17g
  set number of steps = 2
end
subsection Output
  set fields     = false
  set checkpoint = false
end
"""

# model, coupling, law
CASES = {
    "bonds alone":
        ("bond based", "energy blending", "linear elastic"),
    "bonds alone, finite strain":
        ("bond based", "energy blending", "prototype microelastic"),
    "bonds, consistent coupling":
        ("bond based", "consistent", "linear elastic"),
    "correspondence": ("correspondence", "consistent", "linear elastic"),
}

# The same lattice; families of all particles within the cut-off.
LAMMPS = """
units        si
boundary     s s f
atom_style   peri
atom_modify  map array
neighbor     0.001 bin
lattice      sc %(spacing).17g
region       space block -1 %(beyond)d -1 %(beyond)d -5 %(high)d
region       body block -0.1 %(end).1f -0.1 %(end).1f -0.1 %(top).1f
create_box   1 space
create_atoms 1 region body
pair_style   peri/pmb
pair_coeff   * * %(modulus).17g %(cutoff).17g 1e9 0.0
set          group all density 1
set          group all volume %(volume).17g
velocity     all ramp vx 0 0.001 y 0 1
fix          1 all nve
timestep     %(step).17g
thermo       1000000
run          %(steps)d
"""


def rate_of_program(session, body, cells, steps, case):
    """Particle-steps per second between the first and the last state, families
    (neighbours per particle) and particles."""
    model, coupling, law = CASES[case]
    dimension = DIMENSION[body]
    file = session.folder / "explicit.prm"
    output = session.folder / "explicit"
    file.write_text(PARAMETERS % dict(
        dimension=dimension, cells=cells, model=model, coupling=coupling,
        law=law, horizon=HORIZON_RATIO, end=steps / cells,
        mesh=ROOT / "meshes" / ("unit_square.geo" if dimension == 2
                                else "unit_cube.geo"),
        ratio=1. / 3. if dimension == 2 else 1. / 4.,
        state="  set state = plane stress" if dimension == 2 else "",
        point="0 0: x = 0, y = 0" if dimension == 2
        else "0 0 0: x = 0, y = 0, z = 0"))
    process = subprocess.Popen(
        [session.program, file, "--output", output], stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True,
        env=session.environment, cwd=session.folder)
    times, lines = [], []
    for line in process.stdout:
        lines.append(line)
        if line.startswith("t = "):
            with open("/proc/%d/schedstat" % process.pid) as status:
                times.append(1e-9 * int(status.read().split()[0]))
    if process.wait() != 0 or len(times) < 2:
        fail("%s, %s:\n%s" % (body, case, "".join(lines)))
    counts = json.loads((output / "results.json").read_text())["counts"]
    # Families have both ends of each bond, pairs have it once.
    ends = 1. if model == "correspondence" else 2.
    return (counts["particles"] * counts["time_steps"] / (times[-1] - times[0]),
            ends * counts["bonds"] / counts["particles"], counts["particles"])


def rate_of_lammps(session, body, cells, steps, ratio):
    """The same of LAMMPS; the horizon is `ratio` times the spacing."""
    spacing = 1. / cells
    file = session.folder / "explicit.lmp"
    file.write_text(LAMMPS % dict(
        spacing=spacing, beyond=cells + 1, high=cells + 5, end=cells + .1,
        top=cells + .1 if DIMENSION[body] == 3 else .1,
        modulus=12. / (math.pi * (ratio * spacing)**4),
        cutoff=(ratio + 1e-3) * spacing, volume=spacing**3,
        step=0.2 * spacing, steps=max(20, steps // 4)))
    result = subprocess.run(
        ["lmp", "-in", file, "-log", "none"], stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        env=dict(session.environment, OMP_NUM_THREADS="1"), cwd=session.folder)
    found = re.search(r"Loop time of (\S+) on 1 procs for (\d+) steps with "
                      r"(\d+) atoms.*?(\S+)% CPU use", result.stdout, re.DOTALL)
    family = re.search(r"bonds/atom = (\S+)", result.stdout)
    if result.returncode != 0 or not found or not family:
        fail("lmp:\n" + result.stdout)
    seconds = float(found[1]) * float(found[4]) / 100.
    particles = int(found[3])
    return particles * int(found[2]) / seconds, float(family[1]), particles


def row_15(session, rows, at):
    """In turns: what else the machine does meets all of them."""
    has_lammps = shutil.which("lmp") is not None
    if not has_lammps:
        print("  there is no lmp (LAMMPS) here: no ratios", flush=True)
    for body, (cells, steps) in SIZES[rows.size].items():
        # Partial volumes make families of bonds reach half a spacing beyond the
        # horizon, others end there.
        runs = {"LAMMPS to 3.5 spacings": HORIZON_RATIO + .5,
                "LAMMPS to 3 spacings": HORIZON_RATIO} if has_lammps else {}
        samples = {name: [] for name in [*CASES, *runs]}
        for _ in range(session.repeat):
            for name, sample in samples.items():
                sample.append(
                    rate_of_lammps(session, body, cells, steps, runs[name])
                    if name in runs else
                    rate_of_program(session, body, cells, steps, name))
                print("  %s, %s: %.2f M particle-steps/s" % (
                    body, name, 1e-6 * sample[-1][0]), flush=True)
        rates = {name: statistics.median(rate for rate, _, _ in sample)
                 for name, sample in samples.items()}
        for name, sample in samples.items():
            _, family, particles = sample[0]
            rows.add("15", "%s, explicit, %s: million particle-steps/s" % (
                body, name), "", None, 1e-6 * rates[name],
                detail="%d particles, %.1f neighbours, %.0f M directed bonds/s; "
                "%.2f to %.2f" % (
                    particles, family, 1e-6 * family * rates[name],
                    1e-6 * min(rate for rate, _, _ in sample),
                    1e-6 * max(rate for rate, _, _ in sample)))
        for name in CASES if has_lammps else ():
            # The target is one of bonds.
            judged = name != "correspondence"
            other = "LAMMPS to 3.5 spacings" if judged else \
                "LAMMPS to 3 spacings"
            rows.add("15", "%s, explicit, %s over LAMMPS peri/pmb, equal "
                     "families" % (body, name), ">= 2" if judged else "",
                     2. if judged else None, rates[name] / rates[other],
                     least=True)
