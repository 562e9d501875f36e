"""Plate in uniaxial tension (H2: 1 m x 0.5 m, p0 = 200 MPa, plane stress): the
answer is exact to round-off wherever the peridynamic region is.

Reference: ux = p0 x/E, uy = -nu p0 y/E. Limit: acceptance of the coupling,
1e-9; a coupling with ghost forces misses it by six orders of magnitude.
"""

from verification import Study

# x from -0.5 to 0.5 (both ends loaded), y from -0.25 to 0.25.
REGIONS = {
    "box in the middle": "box -0.1 -0.05 0.1 0.05",
    "ball off the centre": "ball -0.2 0.06 0.05",
    "plane across the plate": "plane 0.05 0 1 0",
    "plane along the plate": "plane 0 0.1 0 1",
    "oblique segment": "segment -0.3 -0.1 0.2 0.15",
    "touching the loaded end": "box 0.4 -0.05 0.5 0.05",
    "whole loaded end": "right",
    "touching the supports": "ball 0 0 0.04; ball 0.5 0 0.04",
    "loaded end and free side": "left; top",
    "corner": "point 0.5 0.25",
    "two corners and a point": "point -0.5 -0.25; point 0.5 0.25; point 0 0",
    "whole half": "box 0 -0.25 0.5 0.25",
    "all but a rest": "box -0.5 -0.25 0.2 0.25"
}
LIMIT = 1e-9


def main():
    study = Study(__doc__)
    for model, nu in (("correspondence", .33), ("bond based", 1. / 3.)):
        if not study.part("%s, interface anywhere" % model, "error in u",
                          "sxx(0.255 m)"):
            continue
        for number, (where, around) in enumerate(REGIONS.items()):
            ratio = (1.5, 2, 3)[number % 3]
            solution = study.solve(
                "uniaxial_plate.prm", {
                    "Peridynamics/model": model,
                    "Peridynamics/around": around,
                    "Peridynamics/core size": "0.06",
                    "Peridynamics/blending width": "0.06",
                    "Peridynamics/horizon ratio": ratio,
                    "Material/Poisson's ratio": "%.17g" % nu,
                    "Expressions/constants":
                    "p0 = 200e6, E = 200e9, nu = %.17g" % nu,
                    "Reference/values": "inside_stress_xx = 200e6"
                })
            stress = solution["inside_stress_xx"]
            good = (solution["relative_displacement_error"] < LIMIT
                    and abs(stress / 200e6 - 1.) < LIMIT
                    and solution["ghost_force"] < LIMIT)
            study.row("%s (m %g)" % (where, ratio),
                      solution["relative_displacement_error"], stress,
                      "< %g" % LIMIT, good)
    if study.part("finite elements", "error in u", "sxx(0.255 m)"):
        solution = study.solve("uniaxial_plate.prm",
                               {"Mode": "finite elements"})
        error = solution["relative_displacement_error"]
        study.row("no region", error, solution["inside_stress_xx"],
                  "< %g" % LIMIT, error < LIMIT)
    study.finish()


if __name__ == "__main__":
    main()
