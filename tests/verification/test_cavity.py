"""Stress concentrations in three dimensions, both models.

Spherical cavity: Goodier's K_t = (27 - 15 nu)/(2 (7 - 5 nu)), limit 2 % for
the horizon ratios of the shipped cases.
Double edge notch: 27-node finite elements on two meshes (3.183 and 2.601 for
nu = 0.32; 3.136 and 2.711 for nu = 1/4), limit 3 %.
Finite elements alone: second order in u.
"""

from verification import Study, rate


def concentration(nu):
    return (27. - 15. * nu) / (2. * (7. - 5. * nu))


def constants(nu):
    """Of the exact field in the parameter file."""
    return "S = 1, E = 1, nu = %.17g, q = %.17g" % (
        nu, (1. + nu) / (4. * (7. - 5. * nu)))


def cavity(study):
    if not study.part("spherical cavity, peridynamics around it"):
        return
    adjacent, wide = "adjacent cells", "horizon"
    for file, name, nu, ratio in (
            ("spherical_cavity.prm", adjacent, .25, 1.5),
            ("spherical_cavity.prm", adjacent, .3, 1.5),
            ("spherical_cavity.prm", adjacent, .3, 2.),
            ("spherical_cavity.prm", adjacent, .3, 3.),
            ("spherical_cavity.prm", wide, .25, 1.5),
            ("spherical_cavity.prm", wide, .3, 1.5),
            ("spherical_cavity.prm", wide, .3, 2.),
            ("spherical_cavity_bond_based.prm", "bond based", .25, 1.5),
            ("spherical_cavity_bond_based.prm", "bond based", .25, 2.)):
        solution = study.solve(
            file, {
                "Material/Poisson's ratio": nu,
                "Expressions/constants": constants(nu),
                "Peridynamics/horizon ratio": ratio,
                "Peridynamics/gradient support":
                    wide if name == wide else adjacent,
                "Reference/values": ""
            })
        what = "%s, nu %g, m %g: " % (name, nu, ratio)
        exact = concentration(nu)
        error = 100. * (solution["stress_concentration"] / exact - 1.)
        if name == wide and ratio == 2.:
            # Beyond the 2 % that m = 1.5 keeps: the study has +2.1 % as well
            # (section 4, n = 16; its tolerance in section 6 is 0.5 %).
            study.within(what + "K_t error %", error, 2.1, .5)
        else:
            study.within(what + "K_t error %", error, 0., 2.)
        # At a corner of the three mesh blocks, where finite elements have
        # -2.1 % (nu 0.25) and -1.8 % (nu 0.3) with the same recovery.
        study.note("szz at the equator point (1 0 0): %+.2f %%" % (100. * (
            solution["equator_stress_zz"] / exact - 1.)))
        study.below(what + "ghost force", solution["ghost_force"], 1e-10)
        # Level of finite elements on this mesh: 4.2e-4 (numerics-explicit.md,
        # section 4; the same mesh size, another grading).
        study.below(what + "error in u (L2)",
                    solution["relative_displacement_error"], 2. * 4.2e-4)


def cavity_with_elements(study):
    if not study.part("spherical cavity, finite elements"):
        return
    errors = []
    for n in (8, 16):
        solution = study.solve("spherical_cavity.prm", {
            "Mode": "finite elements",
            "Mesh/geometry parameters": "n = %d, nr = %d" % (n, n)
        })
        errors.append((solution["relative_displacement_error"],
                       solution["relative_energy_error"],
                       abs(solution["stress_concentration"] /
                           concentration(.3) - 1.)))
    study.above("rate of u (L2), n = 8, 16", rate(*(e[0] for e in errors)),
                1.8)
    study.above("rate of the energy error, n = 8, 16",
                rate(*(e[1] for e in errors)), .9)
    study.below("K_t error %, n = 16", 100. * errors[1][2], 2.)


def notch(study):
    if not study.part("double edge notch in three dimensions"):
        return
    for model, ratio, nu, midplane, face in (("correspondence", 1.5, .32,
                                              3.183, 2.601),
                                             ("bond based", 1.5, .25, 3.136,
                                              2.711)):
        solution = study.solve(
            "double_edge_notch_3d.prm", {
                "Peridynamics/model": model,
                "Peridynamics/horizon ratio": ratio,
                "Material/Poisson's ratio": nu,
                "Reference/values": "",
                "Reference/data": ""
            })
        what = "%s, nu %g, m %g: " % (model, nu, ratio)
        study.within_percent(what + "syy/S, root, mid-plane",
                             solution["midplane_stress_ratio"], midplane, 3.)
        study.within_percent(what + "syy/S, root, free face",
                             solution["face_stress_ratio"], face, 3.)
        study.below(what + "ghost force", solution["ghost_force"], 1e-10)
        study.note("%.0f s, %s" % (solution["seconds"],
                                   solution["linear_solver"]))


if __name__ == "__main__":
    STUDY = Study(__doc__)
    cavity(STUDY)
    cavity_with_elements(STUDY)
    notch(STUDY)
    STUDY.finish()
