"""Cracks of finite elements alone, slits of the mesh with double nodes: the
companion of cracks that cut bonds. K_I, J of a centre crack against Tada and
the coupled run, K_II of slant cracks, slits that bend in unstructured meshes.

References: see test_cracks.py. Four-node elements without any care for the tip
converge as its spacing; they are too stiff, so from below.
"""

import math

from crack_fields import hoop_angle
from verification import Study, write_parameters

CENTRE_CRACK_STRIP = 1.109384265
CASE = "centre_crack_meshed.prm"
GEOMETRY = "Mesh/geometry parameters"
BOTH_TIPS = (1, 2)


def percent(measured, reference):
    return 100. * (measured / reference - 1.)


def centre_crack(study):
    factor = CENTRE_CRACK_STRIP * math.sqrt(math.pi)
    errors = {"K_I": [], "J": []}
    for spacing, n_fine in ((.05, 6), (.025, 8), (.0125, 10)):
        solution = study.solve(CASE, {
            GEOMETRY: "a = 1, hx = 2.5, hy = 7.5, dx = %g, nf = %d, q = 1.15" %
            (spacing, n_fine)})
        for name, exact in (("K_I", factor), ("J", factor**2)):
            errors[name].append(percent(solution["crack_tip1_" + name], exact))
        study.note("h/a %g: K_I %+.2f %%, J %+.2f %%" %
                   (spacing, errors["K_I"][-1], errors["J"][-1]))
        study.below("h/a %g: domain dependence %%" % spacing,
                    100. * solution["crack_tip1_domain_dependence"], .1)
    for name, exact in (("K_I", factor), ("J", factor**2)):
        for coarse, fine in zip(errors[name], errors[name][1:]):
            study.between(name + ": error over that of twice the spacing",
                          fine / coarse, 0., .75)
        for tip in BOTH_TIPS:
            study.within_percent("tip %d: %s" % (tip, name),
                                 solution["crack_tip%d_%s" % (tip, name)],
                                 exact, 1.)
    for tip in BOTH_TIPS:
        study.within_percent("tip %d: opening" % tip,
                             solution["crack_tip%d_K_I_opening" % tip],
                             factor, 1.)
    coupled = study.solve("centre_crack_tada.prm")
    for name in ("K_I", "J", "T_stress"):
        study.within_percent("coupled over meshed: " + name,
                             coupled["crack_tip1_" + name],
                             solution["crack_tip1_" + name], 1.)


def slant_crack(study):
    """The plate 80 x 80 turned with its slit, all its sides under the tractions
    of tension along y."""
    root = math.sqrt(math.pi)
    for angle in (30., 45.):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        solution = study.solve(CASE, {
            GEOMETRY: "a = 1, hx = 40, hy = 40, dx = 0.0125, nf = 10, "
            "q = 1.15, angle = %g" % angle,
            "Cracks/pre-cracks": "crack: %.16g %.16g to %.16g %.16g" %
            (-c, -s, c, s),
            "Reference/values": "",
            "Reference/source": "",
            "Boundary conditions/traction":
            "top: y = %.16g; bottom: y = %.16g; right: y = %.16g; "
            "left: y = %.16g" % (c, -c, s, -s)})
        for tip in BOTH_TIPS:
            for name, exact in (("K_I", root * c * c), ("K_II", root * s * c),
                                ("J", math.pi * c * c)):
                study.within_percent("slant %g, tip %d: %s" %
                                     (angle, tip, name),
                                     solution["crack_tip%d_%s" % (tip, name)],
                                     exact, 1.)
            study.within("slant %g, tip %d: T-stress" % (angle, tip),
                         solution["crack_tip%d_T_stress" % tip],
                         s * s - c * c, .01)


def body_force(study):
    """Body forces under which the body without crack has the stresses
    s (1 + y / h) across and s (1 + x / w) along the crack, h and w half height
    and width: the crack feels s across, its factors are those of the tension
    s; along it s (1 + x / w) adds to T."""
    for case, crack, tip_place, half_width, half_height, stress in (
        (CASE, "crack", 1., 2.5, 7.5, 1.),
        ("centre_crack_square_plate.prm", "centre", 5., 25., 25., 10.)):
        pulled = study.solve(case)
        hung = study.solve(case, {
            "Boundary conditions/traction":
            "top: y = %g; right: x = %g" % (2. * stress, 2. * stress),
            "Boundary conditions/body force": "x = %.16g, y = %.16g" %
            (-stress / half_width, -stress / half_height)})
        for tip in BOTH_TIPS:
            name = crack + "_tip%d_" % tip
            what = "%s, tip %d: " % (case, tip)
            for quantity in ("K_I", "J"):
                study.within_percent(what + quantity + " over that of tension",
                                     hung[name + quantity],
                                     pulled[name + quantity], .1)
            along = stress * (1. + (-1)**tip * tip_place / half_width)
            study.within(what + "T-stress over s",
                         hung[name + "T_stress"] / stress,
                         (pulled[name + "T_stress"] + along) / stress, .005)
            study.below(what + "domain dependence %",
                        100. * hung[name + "domain_dependence"], .3)


def split_plate(path, spacing):
    """gmsh text: a square of half width 40 in two parts along y = 0 and a path
    through its middle, the lines of the path double."""
    half, n = 40., len(path)
    corners = [(-half, -half), (half, -half), (half, 0.), (half, half),
               (-half, half), (-half, 0.)]
    text = 'SetFactory("Built-in");\n'
    for k, point in enumerate(corners + path):
        text += "Point(%d) = {%.16g, %.16g, 0};\n" % ((k + 1, ) + point)
    for k in range(6):
        text += "Line(%d) = {%d, %d};\n" % (k + 1, k + 1, (k + 1) % 6 + 1)
    text += "Line(7) = {6, 7}; Line(8) = {%d, 3};\n" % (6 + n)
    upper = [7 + k for k in range(n)]
    for k in range(1, n - 1):
        upper[k] = 50 + k
        text += "Point(%d) = {%.16g, %.16g, 0};\n" % ((50 + k, ) + path[k])
    for k in range(n - 1):
        text += "Line(%d) = {%d, %d}; Line(%d) = {%d, %d};\n" % (
            11 + k, 7 + k, 8 + k, 31 + k, upper[k], upper[k + 1])
    text += "Curve Loop(1) = {6, 1, 2, -8, %s, -7};\n" % ", ".join(
        "-%d" % (11 + k) for k in reversed(range(n - 1)))
    text += "Curve Loop(2) = {7, %s, 8, 3, 4, 5};\n" % ", ".join(
        "%d" % (31 + k) for k in range(n - 1))
    return text + """Plane Surface(1) = {1}; Plane Surface(2) = {2};
Field[1] = Distance; Field[1].EdgesList = {11:%d};
Field[1].NNodesByEdge = 200;
Field[2] = MathEval; Field[2].F = "%g + 0.15*F1";
Background Field = 2;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.RecombinationAlgorithm = 3; Recombine Surface{1, 2};
Physical Surface("domain", 1) = {1, 2};
Physical Curve("bottom", 13) = {1}; Physical Curve("top", 14) = {4};
Physical Curve("slit", 20) = {11:%d, 31:%d};
""" % (9 + n, spacing, 9 + n, 29 + n)


def solve_path(study, path, spacing):
    folder = study.folder()
    with open(folder + "/plate.geo", "w") as file:
        file.write(split_plate(path, spacing))
    return study.solve(
        write_parameters(
            folder + "/case.prm", {
                "Mode": "finite elements",
                "Mesh/file": "plate.geo",
                "Material/Young's modulus": 1,
                "Material/Poisson's ratio": "%.17g" % (1. / 3.),
                "Material/state": "plane stress",
                "Cracks/pre-cracks": "crack: group slit",
                "Boundary conditions/traction": "top: y = 1; bottom: y = -1"
            }))


def bent_slits(study):
    """A slant crack whose ends have kinked, as in test_cracks.py: terms on the
    faces of the slit; a line of three pieces is the line."""
    half = math.radians(45.)
    end = (math.cos(half), math.sin(half))
    cases = [("45 degrees in pieces", [(-.3, -.3), (.1, .1), end],
              (.5 * math.sqrt(math.pi), .5 * math.sqrt(math.pi)), (-end[0],
                                                                   -end[1]))]
    turned = half - math.radians(53.1301)
    for length, exact in ((.2, (1.7980, .0182)), (.4, (1.9558, -.0259))):
        kink = (end[0] + length * math.cos(turned),
                end[1] + length * math.sin(turned))
        cases.append(("45 degrees, kinks of %g" % length,
                      [(-end[0], -end[1]), end, kink], exact,
                      (-kink[0], -kink[1])))
    for what, path, exact, first in cases:
        solution = solve_path(study, [first] + path, .025)
        size = math.hypot(*exact)
        for tip in BOTH_TIPS:
            found = [solution["crack_tip%d_%s" % (tip, name)]
                     for name in ("K_I", "K_II")]
            for name, value, reference in zip(("K_I", "K_II"), found, exact):
                study.within("%s, tip %d: %s over |K|" % (what, tip, name),
                             value / size, reference / size, .01)
            study.within("%s, tip %d: hoop stress, degrees" % (what, tip),
                         hoop_angle(*found), hoop_angle(*exact), .5)
        # Either tip sees the same.
        study.within_percent(what + ": J of both tips",
                             solution["crack_tip2_J"],
                             solution["crack_tip1_J"], 1.)


BEAM = """SetFactory("Built-in");
Point(1) = {0, -0.5, 0}; Point(2) = {1, -0.5, 0}; Point(3) = {10, -0.5, 0};
Point(4) = {10, 0.5, 0}; Point(5) = {1, 0.5, 0}; Point(6) = {0, 0.5, 0};
Point(7) = {1, 0.35, 0}; Point(8) = {1, 0.5, 0};
Point(9) = {0, 0, 0}; Point(10) = {10, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 7}; Line(3) = {7, 5}; Line(4) = {5, 6};
Line(5) = {6, 9}; Line(6) = {9, 1}; Line(7) = {2, 3}; Line(8) = {3, 10};
Line(9) = {10, 4}; Line(10) = {4, 8}; Line(11) = {8, 7};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
Curve Loop(2) = {7:11, -2}; Plane Surface(2) = {2};
Field[1] = Distance; Field[1].NodesList = {7};
Field[2] = MathEval; Field[2].F = "%g + 0.12*F1";
Field[3] = MathEval; Field[3].F = "0.15";
Field[4] = Min; Field[4].FieldsList = {2, 3};
Background Field = 4;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.RecombinationAlgorithm = 3; Recombine Surface{1, 2};
Physical Surface("domain", 1) = {1, 2};
Physical Curve("left", 11) = {5, 6}; Physical Curve("right", 12) = {8, 9};
"""


def bent_beam(study):
    """cracked_cantilever.prm at 4.2 kN, a displacement of 1.4 m: an edge crack
    at finite strain. References: elastica with Tada's crack hinge."""
    release, deflection = 2002.8, -1.3915
    found = []
    for spacing in (.01, .005):
        folder = study.folder()
        with open(folder + "/beam.geo", "w") as file:
            file.write(BEAM % spacing)
        solution = study.solve(
            write_parameters(
                folder + "/case.prm", {
                    "Mode": "finite elements",
                    "Mesh/file": "beam.geo",
                    "Material/law": "hencky",
                    "Material/Young's modulus": 12e6,
                    "Material/Poisson's ratio": .2,
                    "Material/state": "plane strain",
                    "Cracks/pre-cracks": "notch: 1 0.5 to 1 0.35",
                    "Boundary conditions/displacement": "left: x = 0",
                    "Boundary conditions/point displacement": "0 0: y = 0",
                    "Boundary conditions/traction":
                    "left: y = 4200*t; right: y = -4200*t",
                    "Load steps/number of steps": 4,
                    "Quantities/point": "tip: 10 0"
                }))
        found.append(solution["notch_tip1_J"])
        study.note("h %g: J %+.2f %%" % (spacing, percent(found[-1], release)))
        study.below("h %g: domain dependence %%" % spacing,
                    100. * solution["notch_tip1_domain_dependence"], .1)
    study.between("J rises with finer meshes", found[1] / found[0], 1., 1.05)
    study.within_percent("J", found[1], release, 2.)
    study.within_percent("deflection", solution["tip_displacement_y"],
                         deflection, 1.)


def main():
    study = Study(__doc__)
    for name, part in (("centre crack in a strip (Tada), a/b = 0.4",
                        centre_crack),
                       ("slant slit, infinite plate", slant_crack),
                       ("centre cracks under a body force", body_force),
                       ("slits that bend, unstructured", bent_slits),
                       ("edge crack at finite strain", bent_beam)):
        if study.part(name):
            part(study)
    study.finish()


if __name__ == "__main__":
    main()
