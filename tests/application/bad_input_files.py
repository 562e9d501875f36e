"""Bad input, first part: the command line, the parameter file, the mesh."""

import os

from case_files import (BOND_BASED, NAMES, SOLID, SQUARE_GEO, parameter_text,
                        split_quadrilaterals, square)
from harness import MESHES

GARBAGE = bytes(range(256)) * 8

with open(os.path.join(MESHES, "unit_cube.geo")) as cube:
    TETRAHEDRA_GEO = cube.read()
for hexahedra in ("Transfinite Surface{1};", "Recombine Surface{1};",
                  "Layers{n}; Recombine;"):
    TETRAHEDRA_GEO = TETRAHEDRA_GEO.replace(hexahedra, "")
OTHER = {"other.prm": parameter_text()}


def row(name, found, *changes, **more):
    """One bad input: the base case with changes, and fragments that the
    message must have. Further keys: text (the parameter file), files (name ->
    content), words (the command line instead of 'case.prm'), options (behind
    it), late (noticed when the output folder exists already), plain (no
    found/allowed needed), allow (forbidden words that may appear)."""
    return dict(more, name=name, found=found, changes=changes)


COMMAND_LINE = [
    row("no arguments", ["no parameter file", "FILE.prm"], words=[]),
    row("two files", ["two parameter files", "'case.prm'", "'other.prm'"],
        options=["other.prm"], files=OTHER),
    row("unknown option", ["'--validat'", "did you mean '--validate'"],
        options=["--validat"]),
    row("option without value", ["'--output'", "no value", "--output DIR"],
        options=["--output"]),
    row("switch with value", ["'--validate'", "'--validate=yes'"],
        options=["--validate=yes"]),
    row("set: unknown entry", ["--set", "'horizon rati'", "'Peridynamics'",
                               "did you mean 'horizon ratio'"],
        options=["--set", "Peridynamics/horizon rati=3"]),
    row("set: unknown section", ["--set", "'Peridynamic'",
                                 "did you mean 'Peridynamics'"],
        options=["--set", "Peridynamic/horizon ratio=3"]),
    row("set: bad value", ["'Peridynamics / horizon ratio' in --set",
                           "found 'three'", "allowed: a number"],
        options=["--set", "Peridynamics/horizon ratio=three"]),
    row("set: no '='", ["--set 'Mode coupled'", "found no '='",
                        "Section/entry=value"],
        options=["--set", "Mode coupled"]),
    row("set: empty value for a number", ["'Load steps / end time' in --set",
                                          "found nothing", "a number > 0"],
        options=["--set", "Load steps/end time="]),
    row("missing parameter file", ["cas.prm does not exist",
                                   "did you mean 'case.prm'"],
        words=["cas.prm"]),
    row("folder as parameter file", ["found a folder", "a text file"],
        words=["."]),
    row("empty file", ["no 'set'", "set NAME = VALUE"], text=""),
    row("comments only", ["no 'set'", "set NAME = VALUE"], text="# nothing\n"),
    row("binary garbage as parameter file", ["binary data", "a text file"],
        text=GARBAGE),
    row("mesh as parameter file", ["no 'set'", "set NAME = VALUE"],
        text=square()),
    row("print-parameters of a bad file", ["'Mod'", "did you mean 'Mode'"],
        {"Mod": "coupled"}, options=["--print-parameters"]),
    row("unwritable output folder", ["'Output folder'", "case.prm/out",
                                     "nothing can be written", "a folder"],
        options=["--output", "case.prm/out"]),
    row("unwritable output folder in the file", [
        "'Output folder'", "'other.prm'", "nothing can be written"],
        {"Output folder": "other.prm"}, files=OTHER),
]

PARAMETERS = [
    row("unknown entry", ["'horizon rato' in case.prm:", "'Peridynamics'",
                          "did you mean 'horizon ratio'"],
        {"Peridynamics/horizon rato": "2"}),
    row("unknown section", ["'Peridynamic' in case.prm:",
                            "did you mean 'Peridynamics'"],
        text=parameter_text().replace("Peridynamics", "Peridynamic")),
    row("entry in the wrong section", ["'horizon ratio'", "'Material'",
                                       "belongs in section 'Peridynamics'"],
        {"Material/horizon ratio": "2"}),
    row("wrong type", ["'Peridynamics / horizon ratio' in case.prm:",
                       "found 'two'", "a number"],
        {"Peridynamics/horizon ratio": "two"}),
    row("not a whole number", ["'Load steps / number of steps'", "found '1.5'",
                               "a whole number"],
        {"Load steps/number of steps": "1.5"}),
    row("value out of range", ["'Peridynamics / horizon ratio'", "found '0.5'",
                               "a number >= 1"],
        {"Peridynamics/horizon ratio": "0.5"}),
    row("negative end time", ["'Load steps / end time'", "found '-1'",
                              "a number > 0"], {"Load steps/end time": "-1"}),
    row("not a number as value", ["'Peridynamics / horizon ratio'",
                                  "found 'nan'", "a number"],
        {"Peridynamics/horizon ratio": "nan"}, allow=["'nan'"]),
    row("infinite value", ["'Load steps / end time'", "found 'inf'"],
        {"Load steps/end time": "inf"}),
    row("wrong selection word", ["'Mode' in case.prm:", "found 'couplet'",
                                 "coupled, finite elements, peridynamics",
                                 "Did you mean 'coupled'"],
        {"Mode": "couplet"}),
    row("wrong truth value", ["'Output / fields'", "found 'yse'",
                              "true, false"], {"Output/fields": "yse"}),
    row("wrong dimension", ["'Dimension'", "found '4'",
                            "a whole number from 2 to 3"], {"Dimension": "4"}),
    row("missing end", ["section 'Output' opened in case.prm:", "no 'end'"],
        text=parameter_text()[:-len("end\n")], plain=True),
    row("missing end between sections", [
        "section 'Mesh' opened in case.prm:", "no 'end'",
        "before 'subsection Material'"],
        text=parameter_text().replace("end\nsubsection Material",
                                      "subsection Material"), plain=True),
    row("an end too many", ["found 'end'", "no subsection is open"],
        text=parameter_text() + "end\n"),
    row("duplicate entry", ["'Mode' in case.prm:", "a second time",
                            "first in line 2"],
        text=parameter_text() + "set Mode = peridynamics\n"),
    row("line without set", ["line case.prm:", "'Mode = coupled'",
                             "Is 'set' missing"],
        text="Mode = coupled\n" + parameter_text({"Mode": None})),
    row("two entries in one line", ["'Mode'", "'set Dimension'",
                                    "one 'set' per line"],
        {"Mode": "coupled set Dimension = 2", "Dimension": None}),
    row("Young's modulus missing", ["'Material / Young's modulus'",
                                    "found nothing or 0", "a number > 0"],
        {"Material/Young's modulus": None}),
    row("Young's modulus negative", ["'Material / Young's modulus'",
                                     "found -1", "a number > 0"],
        {"Material/Young's modulus": "-1"}),
    row("Poisson's ratio 0.5", ["'Material / Poisson's ratio'", "found 0.5",
                                "more than -1 and less than 0.5"],
        {"Material/Poisson's ratio": "0.5"}),
    row("Poisson's ratio -1", ["'Material / Poisson's ratio'", "found -1",
                               "more than -1 and less than 0.5"],
        {"Material/Poisson's ratio": "-1"}),
    row("bond based, plane stress", ["'Material / Poisson's ratio'",
                                     "found 0.3;", "1/3", "plane stress"],
        {"Peridynamics/model": "bond based"}),
    row("bond based, plane strain", ["'Material / Poisson's ratio'",
                                     "found 0.3;", "1/4", "plane strain"],
        {"Peridynamics/model": "bond based", "Material/state": "plane strain"}),
    row("bond based, 3D", ["'Material / Poisson's ratio'", "found 0.333333",
                           "1/4", "in 3D"], SOLID, BOND_BASED),
    row("bond based, Poisson's ratio of a volume", [
        "Poisson's ratio of domain", "found 0.2", "1/3"], BOND_BASED,
        {"Material/by volume": "domain: Poisson's ratio = 0.2"}),
    row("crack without a name", ["'Cracks / pre-cracks'", "without a name",
                                 "NAME: x y to x y"],
        {"Cracks/pre-cracks": "0.1 0.5 to 0.3 0.5"}),
    row("crack of one point", ["'Cracks / pre-cracks'", "1 point",
                               "at least 2 points"],
        {"Cracks/pre-cracks": "c: 0.1 0.5"}),
    row("crack of zero length", ["'Cracks / pre-cracks'",
                                 "points that differ"],
        {"Cracks/pre-cracks": "c: 0.1 0.5 to 0.1 0.5"}),
    row("crack named twice", ["'Cracks / pre-cracks'", "'c' twice"],
        {"Cracks/pre-cracks": "c: .1 .5 to .2 .5; c: .3 .5 to .4 .5"}),
    row("growth without fracture energy", [
        "'Cracks / fracture energy'", "a number > 0"],
        {"Cracks/pre-cracks": "c: 0.4 0.5 to 0.6 0.5",
         "Cracks/growth": "segments"}),
    row("growth without a crack", ["'Cracks / growth'", "without a crack"],
        {"Cracks/growth": "segments", "Cracks/fracture energy": "1"}),
    row("advance of no length", ["'Cracks / advance length'"],
        {"Cracks/pre-cracks": "c: 0.4 0.5 to 0.6 0.5",
         "Cracks/growth": "segments", "Cracks/fracture energy": "1",
         "Cracks/advance length": "0"}),
    row("virial stress of families", [
        "'Output / virial stress'", "model = correspondence"],
        {"Output/virial stress": "true"}),
    row("2D with a 3D state", ["'Material / state'", "'three-dimensional'",
                               "Dimension = 2", "plane stress, plane strain"],
        {"Material/state": "three-dimensional"}),
    row("3D with plane stress", ["'Material / state'", "'plane stress'",
                                 "Dimension = 3", "allowed: three-dimensional"],
        SOLID, {"Material/state": "plane stress"}),
    row("by volume: unknown component", ["'Material / by volume'",
                                         "'Young modulus'",
                                         "Did you mean 'Young's modulus'"],
        {"Material/by volume": "domain: Young modulus = 3"}),
    row("by volume: negative", ["Young's modulus of domain", "found -3",
                                "a number > 0"],
        {"Material/by volume": "domain: Young's modulus = -3"}),
    row("by volume: unknown volume", ["'Material / by volume'", "'domian'",
                                      "did you mean 'domain'"],
        {"Material/by volume": "domian: Young's modulus = 3"}),
    row("constant with a known name", ["'Expressions / constants'", "'sin'",
                                       "names that expressions do not know"],
        {"Expressions/constants": "sin = 3"}),
    row("constant that is no number", ["'Expressions / constants'", "'2*3'",
                                       "a number"],
        {"Expressions/constants": "a = 2*3"}),
]


def in_file(name, content):
    """Changes and files for a mesh of our own beside the parameter file."""
    return {"Mesh/file": name, "Mesh/geometry parameters": None}, {
        name: content
    }


def mesh_row(name, found, file, content, *changes, **more):
    change, files = in_file(file, content)
    return row(name, found, change, *changes, files=files, **more)


TRIANGLES = "'mesh.geo'", "triangles", "first-order quadrilaterals only"
INNER = square(names=NAMES + [(1, 15, "crack")],
               more=[(1, 15, (37, 38)), (1, 15, (38, 39))])
INNER_GROUP = ["'crack'", "no face on the surface of the body"]
# node 41 is the one in the middle
FOLDED = square(moved={41: (0.9, 0.5, 0.)})
NOT_CONVEX = square(moved={41: (0.57, 0.57, 0.), 42: (0.57, 0.57, 0.)})

MESH = [
    row("no mesh file given", ["'Mesh / file'", "found nothing", ".msh",
                               ".geo"],
        {"Mesh/file": None, "Mesh/geometry parameters": None}),
    row("missing mesh file", ["no such file", "mising.msh", "path of a gmsh"],
        {"Mesh/file": "mising.msh", "Mesh/geometry parameters": None}),
    mesh_row("wrong ending", ["'mesh.inp'", "'.inp'", "'.msh' or '.geo'"],
             "mesh.inp", square()),
    mesh_row("no ending", ["'mesh'", "'.msh' or '.geo'"], "mesh", square()),
    row("folder as mesh", ["no such file", "case.msh"],
        {"Mesh/file": "case.msh", "Mesh/geometry parameters": None},
        folders=["case.msh"]),
    mesh_row("binary garbage as mesh", ["'mesh.msh'", "not a gmsh mesh",
                                        "$MeshFormat"], "mesh.msh", GARBAGE),
    mesh_row("garbage behind a header", ["'mesh.msh'", "no cells"], "mesh.msh",
             b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + GARBAGE),
    mesh_row("binary garbage as geometry", ["'mesh.geo'", "gmsh"], "mesh.geo",
             GARBAGE, plain=True),
    mesh_row("empty mesh", ["'mesh.msh'", "an empty file", "$MeshFormat"],
             "mesh.msh", ""),
    mesh_row("empty geometry", ["'mesh.geo'", "no cells of dimension 2",
                                "quadrilaterals"], "mesh.geo", ""),
    mesh_row("truncated in the nodes", ["'mesh.msh'"], "mesh.msh",
             square()[:900], plain=True),
    mesh_row("truncated in the cells", ["'mesh.msh'"], "mesh.msh",
             square()[:-900], plain=True),
    mesh_row("header only", ["'mesh.msh'", "no cells of dimension 2"],
             "mesh.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"),
    mesh_row("unknown version", ["'mesh.msh'", "gmsh"], "mesh.msh",
             square().replace("2.2 0 8", "9.9 0 8"), plain=True),
    mesh_row("triangles", TRIANGLES, "mesh.geo",
             SQUARE_GEO.replace("Recombine Surface{1};", "")),
    mesh_row("triangles and quadrilaterals", [
        "'mesh.msh'", "6 triangles", "first-order quadrilaterals only",
        "Recombine"], "mesh.msh", split_quadrilaterals(3)),
    row("tetrahedra", ["'cube.geo'", "tetrahedra", "hexahedra only"], SOLID,
        {"Mesh/file": "cube.geo"}, files={"cube.geo": TETRAHEDRA_GEO}),
    mesh_row("second-order cells", ["'mesh.geo'", "second-order",
                                    "first-order quadrilaterals only"],
             "mesh.geo", SQUARE_GEO + "Mesh.ElementOrder = 2;\n"),
    mesh_row("inverted cell", ["'mesh.msh'", "inverted or non-convex",
                               "positive Jacobian", "centre at"], "mesh.msh",
             FOLDED),
    mesh_row("cell without area", ["'mesh.msh'", "inverted or non-convex",
                                   "positive Jacobian"], "mesh.msh",
             NOT_CONVEX),
    row("2D mesh with Dimension 3", ["unit_square.geo", "no cells of dimension "
                                     "3", "hexahedra", "'Dimension'"], SOLID,
        {"Mesh/file": os.path.join(MESHES, "unit_square.geo")}),
    row("3D mesh with Dimension 2", ["unit_cube.geo", "z = 0", "Dimension"],
        {"Mesh/file": os.path.join(MESHES, "unit_cube.geo")}),
    mesh_row("node off the plane z = 0", ["'mesh.msh'", "(0.5, 0.5, 0.01)",
                                          "z = 0"], "mesh.msh",
             square(moved={41: (0.5, 0.5, 0.01)})),
    mesh_row("node that is no number", ["'mesh.msh'", "node 41", "finite"],
             "mesh.msh", square(moved={41: (float("nan"), 0.5, 0.)})),
    row("unknown geometry parameter", ["'Mesh / geometry parameters'", "'m'",
                                       "unit_square.geo", "DefineConstant"],
        {"Mesh/geometry parameters": "n = 8, m = 3"}),
    row("geometry parameter that is no number", [
        "'Mesh / geometry parameters'", "'many'", "a number"],
        {"Mesh/geometry parameters": "n = many"}),
    row("geometry parameters of a mesh", ["'Mesh / geometry parameters'",
                                          "'n'", "only a .geo has"],
        {"Mesh/file": "mesh.msh"}, files={"mesh.msh": square()}),
    mesh_row("syntax error in a geometry", ["'mesh.geo'", "gmsh", "line 10"],
             "mesh.geo", SQUARE_GEO.replace("Recombine Surface{1};",
                                            "Recombine Surfce{1};"),
             plain=True),
    mesh_row("inner group: support", INNER_GROUP, "mesh.msh", INNER,
             {"Boundary conditions/displacement": "crack: x = 0"}),
    mesh_row("inner group: load", INNER_GROUP, "mesh.msh", INNER,
             {"Boundary conditions/traction": "crack: x = 1"}),
    mesh_row("inner group: stress concentration", INNER_GROUP, "mesh.msh",
             INNER, {"Quantities/stress concentration": "crack"}),
]
