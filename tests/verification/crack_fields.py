"""Exact fields and meshes of the verification of cracks."""

import math
import random

from msh_writer import structured, write_msh


def infinite_plate_tractions(half, angle, sigma_xx=0., sigma_yy=1.,
                             sigma_xy=0., factor="1"):
    """Text of the entry 'traction' for a rectangle (boundaries x-, x+, y-, y+)
    cut out of an infinite plate with a crack of this half length around the
    origin, at this angle [degrees] from x, under remote stresses times a
    factor.

    Westergaard (1939), Sih (1966): with Z = z/sqrt(z^2 - a^2) in the axes of
    the crack, mode I: s11 = Re Z - y Im Z' (+ what is uniform), s22 = Re Z + y
    Im Z', s12 = -y Re Z'; mode II: s11 = 2 Im Z + y Re Z', s22 = -y Re Z',
    s12 = Re Z - y Im Z'.
    """
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    normal, along, shear = remote_stresses(angle, sigma_xx, sigma_yy,
                                           sigma_xy)
    X, Y = "(x*%.16g+y*%.16g)" % (c, s), "(y*%.16g-x*%.16g)" % (c, s)
    names = dict(X=X, Y=Y, a="%.16g" % half)
    names["w"] = "0.5*(atan2({Y},{X}-{a})+atan2({Y},{X}+{a}))".format(**names)
    names["m"] = "(((({X}-{a})^2+{Y}^2)*(({X}+{a})^2+{Y}^2))^0.25)".format(
        **names)

    def combination(real, imaginary, d_real, d_imaginary, constant):
        """Sum of Re Z, Im Z, y Re Z', y Im Z' with these factors."""
        numbers = dict(names, r=real, i=imaginary, dr=-half**2 * d_real,
                       di=half**2 * d_imaginary, k=constant)
        return ("((({r:.16g})*{X}+({i:.16g})*{Y})*cos({w})"
                "+(({r:.16g})*{Y}-({i:.16g})*{X})*sin({w}))/{m}"
                "+{Y}*(({dr:.16g})*cos(3*{w})+({di:.16g})*sin(3*{w}))/{m}^3"
                "+({k:.16g})").format(**numbers)

    # Factors of half the sum, half the difference (s22 - s11) and s12.
    mean = (normal, shear, 0., 0., 0.5 * (along - normal))
    half_difference = (0., -shear, -shear, normal, 0.5 * (normal - along))
    shearing = (shear, 0., -normal, -shear, 0.)
    c2, s2 = c * c - s * s, 2. * c * s
    yy = [p + c2 * d + s2 * q
          for p, d, q in zip(mean, half_difference, shearing)]
    xx = [p - c2 * d - s2 * q
          for p, d, q in zip(mean, half_difference, shearing)]
    xy = [c2 * q - s2 * d for d, q in zip(half_difference, shearing)]
    texts = []
    for side, first, second in (("x", xx, xy), ("y", xy, yy)):
        for end, sign in (("+", 1.), ("-", -1.)):
            texts.append("%s%s: x = %s*(%s), y = %s*(%s)" % (
                side, end, factor,
                combination(*(sign * value for value in first)), factor,
                combination(*(sign * value for value in second))))
    return "; ".join(texts)


def remote_stresses(angle, sigma_xx=0., sigma_yy=1., sigma_xy=0.):
    """Normal stress on the crack, stress along it, shear stress on it."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    normal = s * s * sigma_xx + c * c * sigma_yy - 2. * c * s * sigma_xy
    along = c * c * sigma_xx + s * s * sigma_yy + 2. * c * s * sigma_xy
    shear = c * s * (sigma_yy - sigma_xx) + (c * c - s * s) * sigma_xy
    return normal, along, shear


def hoop_angle(mode_1, mode_2):
    """Direction of the largest hoop stress from the crack [degrees]
    (Erdogan & Sih, 1963)."""
    if mode_2 == 0.:
        return 0.
    ratio = mode_1 / mode_2
    return math.degrees(2. * math.atan(
        0.25 * (ratio - math.copysign(math.sqrt(ratio**2 + 8.), mode_2))))


def rectangle(path, width, height, spacing, distortion=0., seed=1, low=None,
              graded_from=None, move=None):
    """Rectangle of quadrilaterals around the origin (or from the corner low),
    boundaries x-, x+, y-, y+. An even number of cells in x, an odd one in y:
    no grid line on y = 0. distortion: inner nodes are moved by up to this
    share of the spacing along each axis. graded_from: beyond |y| = this, rows
    are three times as high. move(x, y) maps the inner nodes."""
    x0, y0 = low or (-0.5 * width, -0.5 * height)
    n_x = max(2, round(width / spacing))
    rows = []
    if graded_from is None:
        n_y = 2 * round(0.5 * (height / spacing - 1.)) + 1
        rows = [y0 + height * j / n_y for j in range(n_y + 1)]
    else:
        inner = 2 * round(graded_from / spacing - 0.5) + 1
        edge = 0.5 * inner * spacing
        outer = max(1, round((0.5 * height - edge) / (3. * spacing)))
        upper = [edge + (0.5 * height - edge) * k / outer
                 for k in range(1, outer + 1)]
        rows = ([-y for y in reversed(upper)] +
                [spacing * (k - 0.5 * inner) for k in range(inner + 1)] +
                upper)
    n_y = len(rows) - 1
    generator = random.Random(seed)
    limit = None if graded_from is None else graded_from - spacing

    def position(i, j):
        x, y = x0 + width * i / n_x, rows[j]
        shift = [distortion * spacing * generator.uniform(-1., 1.)
                 for _ in range(2)]
        if i in (0, n_x) or j in (0, n_y) or (limit and abs(y) > limit):
            return x, y
        x, y = x + shift[0], y + shift[1]
        return move(x, y) if move else (x, y)

    points, cells, surfaces = structured((n_x, n_y), position)
    write_msh(path, 2, points, cells, surfaces)


UNSTRUCTURED = """SetFactory("OpenCASCADE");
Rectangle(1) = {{{x}, {y}, 0, {w}, {h}}};
Mesh.MeshSizeMin = {s}; Mesh.MeshSizeMax = {s};
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 3; Mesh.RecombineAll = 1;
Physical Surface("body") = {{1}};
Physical Curve("y-") = {{1}}; Physical Curve("x+") = {{2}};
Physical Curve("y+") = {{3}}; Physical Curve("x-") = {{4}};
"""


def unstructured(path, width, height, spacing, low=None):
    """The same as a geometry that gmsh fills with unstructured
    quadrilaterals."""
    x0, y0 = low or (-0.5 * width, -0.5 * height)
    with open(path, "w") as file:
        file.write(UNSTRUCTURED.format(x=x0, y=y0, w=width, h=height,
                                       s=spacing))


def twisted_strip(path, width, height, spacing, center, inner, outer, low):
    """The rectangle with its cells turned by 30 degrees within the inner
    radius around the center; the turn fades to none at the outer radius."""

    def move(x, y):
        radius = math.hypot(x - center[0], y - center[1])
        s = min(1., max(0., (outer - radius) / (outer - inner)))
        angle = math.radians(30.) * s * s * (3. - 2. * s)
        c, q = math.cos(angle), math.sin(angle)
        return (center[0] + c * (x - center[0]) - q * (y - center[1]),
                center[1] + q * (x - center[0]) + c * (y - center[1]))

    rectangle(path, width, height, spacing, low=low, move=move)
