"""Meshes that a formula gives, written as gmsh 2.2 text."""

import itertools
import random


def write_msh(path, dim, points, cells, surfaces, volumes=None):
    """points: tuples; cells: corner lists in gmsh order; surfaces: name ->
    list of corner lists; volumes: name of each cell's volume (else "body")."""
    volumes = volumes or ["body"] * len(cells)
    names = list(surfaces) + sorted(set(volumes))
    tags = {name: tag for tag, name in enumerate(names, 1)}
    elements = [(1 if dim == 2 else 3, tags[name], corners)
                for name in surfaces for corners in surfaces[name]]
    elements += [(3 if dim == 2 else 5, tags[name], corners)
                 for name, corners in zip(volumes, cells)]
    with open(path, "w") as file:
        file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        file.write("$PhysicalNames\n%d\n" % len(names))
        for name in names:
            file.write('%d %d "%s"\n' %
                       (dim - (name in surfaces), tags[name], name))
        file.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(points))
        for count, point in enumerate(points, 1):
            x = list(point) + [0.] * (3 - len(point))
            file.write("%d %.17g %.17g %.17g\n" % (count, *x))
        file.write("$EndNodes\n$Elements\n%d\n" % len(elements))
        for count, (kind, tag, corners) in enumerate(elements, 1):
            file.write("%d %d 2 %d %d %s\n" % (count, kind, tag, tag, " ".join(
                str(corner + 1) for corner in corners)))
        file.write("$EndElements\n")


def structured(counts, position):
    """Box of cells; position(i, j[, k]) gives each node. Returns points, cells
    and surfaces named x-, x+, y-, ..."""
    dim = len(counts)

    def number(index):
        value = 0
        for count, i in zip(reversed(counts), reversed(index)):
            value = value * (count + 1) + i
        return value

    # Fastest index first, so that number() and this order agree.
    points = [
        position(*reversed(index)) for index in itertools.product(
            *(range(count + 1) for count in reversed(counts)))
    ]
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = square if dim == 2 else [c + (0, ) for c in square
                                       ] + [c + (1, ) for c in square]
    cells = []
    surfaces = {
        "xyz"[d] + side: []
        for d in range(dim) for side in "-+"
    }
    for index in itertools.product(*(range(count) for count in counts)):
        cells.append([
            number([i + o for i, o in zip(index, corner)])
            for corner in corners
        ])
        for d in range(dim):
            for side, at in (("-", 0), ("+", counts[d] - 1)):
                if index[d] != at:
                    continue
                others = [k for k in range(dim) if k != d]
                face = []
                for steps in ([(0, ), (1, )] if dim == 2 else square):
                    corner = list(index)
                    corner[d] += side == "+"
                    for k, step in zip(others, steps):
                        corner[k] += step
                    face.append(number(corner))
                surfaces["xyz"[d] + side].append(face)
    return points, cells, surfaces


def unit_box(path,
             counts,
             grading=1.,
             distortion=0.,
             seed=0,
             volume=None,
             interface=None):
    """Unit square or cube of cells. grading: last cell over first along every
    axis; distortion: every node moved by up to this times the cell size on
    each axis that does not leave its side, nor the plane y = interface;
    volume(center) names cells."""
    generator = random.Random(seed)

    def coordinate(i, n):
        q = grading**(1. / (n - 1)) if n > 1 else 1.
        return i / n if grading == 1. else (q**i - 1.) / (q**n - 1.)

    def position(*index):
        point = []
        for d, (i, n) in enumerate(zip(index, counts)):
            x = coordinate(i, n)
            step = min(coordinate(i + 1, n) - x, x - coordinate(i - 1, n))
            shift = distortion * step * generator.uniform(-1., 1.)
            fixed = i in (0, n) or (d == 1 and x == interface)
            point.append(x if fixed else x + shift)
        return tuple(point)

    points, cells, surfaces = structured(counts, position)
    volumes = None
    if volume:
        centers = [[sum(points[n][d] for n in cell) / len(cell)
                    for d in range(len(counts))] for cell in cells]
        volumes = [volume(center) for center in centers]
    write_msh(path, len(counts), points, cells, surfaces, volumes)
