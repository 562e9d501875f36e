"""Small valid cases as tables of entries, and small gmsh meshes as text."""

import os

from harness import MESHES

# A coupled run that takes no time: 8 x 8 cells, a disc of peridynamics.
BASE = {
    "Title": "Base case",
    "Mode": "coupled",
    "Dimension": "2",
    "Mesh/file": os.path.join(MESHES, "unit_square.geo"),
    "Mesh/geometry parameters": "n = 8",
    "Material/Young's modulus": "1000",
    "Material/Poisson's ratio": "0.3",
    "Material/state": "plane stress",
    "Peridynamics/around": "point 0.5 0.5",
    "Peridynamics/core size": "0.2",
    "Peridynamics/blending width": "0.15",
    "Boundary conditions/symmetry": "left, bottom",
    "Boundary conditions/traction": "right: x = 1",
    "Output/fields": "false",
}

# What makes it three-dimensional, and what makes it bond based.
SOLID = {
    "Dimension": "3",
    "Mesh/file": os.path.join(MESHES, "unit_cube.geo"),
    "Mesh/geometry parameters": "n = 4",
    "Material/state": None,
    "Peridynamics/around": "point 0.5 0.5 0.5",
    "Boundary conditions/symmetry": "left, bottom, back",
}
BOND_BASED = {
    "Peridynamics/model": "bond based",
    "Material/Poisson's ratio": "0.3333333333333333",
}
NO_SUPPORTS = {"Boundary conditions/symmetry": None}


def parameter_text(*changes):
    """The base case with changed entries; None takes one out."""
    entries = dict(BASE)
    for change in changes:
        entries.update(change)
    sections = {}
    for path, value in entries.items():
        if value is not None:
            section, _, name = path.rpartition("/")
            sections.setdefault(section, []).append((name, value))
    text = ""
    for section, lines in sections.items():
        names = section.split("/") if section else []
        for name in names:
            text += "subsection %s\n" % name
        for name, value in lines:
            text += "  set %s = %s\n" % (name, value)
        text += "end\n" * len(names)
    return text


def msh(nodes, elements, names):
    """gmsh 2.2 text; nodes: (x, y, z), elements: (type, group, nodes counted
    from 1), names: (dimension, group, name)."""
    text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
    text += "%d\n" % len(names)
    for name in names:
        text += '%d %d "%s"\n' % name
    text += "$EndPhysicalNames\n$Nodes\n%d\n" % len(nodes)
    for k, node in enumerate(nodes):
        text += "%d %.17g %.17g %.17g\n" % ((k + 1,) + tuple(node))
    text += "$EndNodes\n$Elements\n%d\n" % len(elements)
    for k, (kind, group, corners) in enumerate(elements):
        text += "%d %d 2 %d %d %s\n" % (k + 1, kind, group, group, " ".join(
            str(corner) for corner in corners))
    return text + "$EndElements\n"


NAMES = [(2, 1, "domain"), (1, 11, "left"), (1, 12, "right"),
         (1, 13, "bottom"), (1, 14, "top")]


def square_parts(n=8):
    """Nodes and elements of the unit square with n x n quadrilaterals."""

    def at(i, j):
        return 1 + i + (n + 1) * j

    nodes = [(i / n, j / n, 0.) for j in range(n + 1) for i in range(n + 1)]
    elements = [(3, 1, (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                for j in range(n) for i in range(n)]
    for k in range(n):
        elements += [(1, 11, (at(0, k), at(0, k + 1))),
                     (1, 12, (at(n, k), at(n, k + 1))),
                     (1, 13, (at(k, 0), at(k + 1, 0))),
                     (1, 14, (at(k, n), at(k + 1, n)))]
    return nodes, elements


def square(moved=None, names=NAMES, more=(), transform=None):
    """The unit square as text; moved: node number from 1 -> new place,
    transform: x, y -> new place."""
    nodes, elements = square_parts()
    for number, place in (moved or {}).items():
        nodes[number - 1] = place
    if transform:
        nodes = [transform(x, y) + (z,) for x, y, z in nodes]
    return msh(nodes, elements + list(more), names)


def split_quadrilaterals(first):
    """The square with its first cells cut into two triangles each."""
    nodes, elements = square_parts()
    cut = []
    for k, (kind, group, corners) in enumerate(elements):
        if kind == 3 and k < first:
            a, b, c, d = corners
            cut += [(2, group, (a, b, c)), (2, group, (a, c, d))]
        else:
            cut.append((kind, group, corners))
    return msh(nodes, cut, NAMES)


SQUARE_GEO = """SetFactory("Built-in");
DefineConstant[ n = {8, Name "n"} ];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1:4} = n + 1;
Transfinite Surface{1};
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("left", 11) = {4}; Physical Curve("right", 12) = {2};
Physical Curve("bottom", 13) = {1}; Physical Curve("top", 14) = {3};
"""

# The hole of a quarter plate: a curved boundary.
QUARTER_PLATE = {
    "Mesh/file": os.path.join(MESHES, "plate_hole_quarter.geo"),
    "Mesh/geometry parameters": "nt = 6, nr = 10",
    "Peridynamics/around": "hole",
    "Peridynamics/core size": "1.25",
    "Peridynamics/blending width": "2",
}
