"""Cracks that are physical groups of the mesh file: the same results as with
their places typed into the parameter file."""

import os
import re

from harness import Failures, Runner, finish, parse_arguments

SQUARE = """SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Transfinite Curve{1:4} = 25; Transfinite Surface{1}; Recombine Surface{1};
Physical Surface("domain") = {1};
Physical Curve("bottom") = {1}; Physical Curve("top") = {3};
"""
# Through the cells, in pieces of which those of one line are joined.
DRAWN = SQUARE + """
Point(5) = {0, 0.51, 0}; Point(6) = {0.25, 0.51, 0}; Point(7) = {0.4, 0.56, 0};
Line(5) = {5, 6}; Line(6) = {6, 7};
Transfinite Curve{5} = 4; Transfinite Curve{6} = 2;
Physical Curve("crack line") = {5, 6};
"""
# On the edges of cells, without doubled nodes.
ON_EDGES = """SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {0.5, 0, 0}; Point(3) = {1, 0, 0};
Point(4) = {0, 0.5, 0}; Point(5) = {0.5, 0.5, 0}; Point(6) = {1, 0.5, 0};
Point(7) = {0, 1, 0}; Point(8) = {0.5, 1, 0}; Point(9) = {1, 1, 0};
For i In {0:2}
  Line(1 + 2*i) = {1 + 3*i, 2 + 3*i}; Line(2 + 2*i) = {2 + 3*i, 3 + 3*i};
EndFor
For i In {0:2}
  Line(11 + 2*i) = {1 + i, 4 + i}; Line(12 + 2*i) = {4 + i, 7 + i};
EndFor
Curve Loop(1) = {1, 13, -3, -11}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 15, -4, -13}; Plane Surface(2) = {2};
Curve Loop(3) = {3, 14, -5, -12}; Plane Surface(3) = {3};
Curve Loop(4) = {4, 16, -6, -14}; Plane Surface(4) = {4};
Transfinite Curve{1:6, 11:16} = 13;
Transfinite Surface{1:4}; Recombine Surface{1:4};
Physical Surface("domain") = {1:4};
Physical Curve("bottom") = {1, 2}; Physical Curve("top") = {5, 6};
Physical Curve("crack line") = {3};
"""
CUBE = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Point(11) = {-0.1, -0.1, 0.51}; Point(12) = {1.1, -0.1, 0.51};
Point(13) = {1.1, 0.4, 0.51}; Point(14) = {-0.1, 0.4, 0.51};
Line(21) = {11, 12}; Line(22) = {12, 13}; Line(23) = {13, 14};
Line(24) = {14, 11};
Curve Loop(21) = {21:24}; Plane Surface(21) = {21};
Transfinite Curve{1:12} = 9; Transfinite Surface{1:6};
Recombine Surface{1:6}; Transfinite Volume{1};
Transfinite Curve{21:24} = 2; Transfinite Surface{21};
Physical Volume("domain") = {1};
Physical Surface("bottom") = {5}; Physical Surface("top") = {6};
Physical Surface("crack line") = {21};
"""

PARAMETERS = """set Dimension = %(dim)d
subsection Mesh
  set file = mesh.geo
end
subsection Material
  set Young's modulus = 1
  set Poisson's ratio = 0.25
end
subsection Peridynamics
  set horizon ratio = 2
  set core size = 2 horizons
end
subsection Cracks
  set pre-cracks = edge: group crack line
end
subsection Boundary conditions
  set displacement = %(supports)s
end
subsection Output
  set fields = false
end
"""
SUPPORTS = {2: "bottom: x = 0, y = -t; top: x = 0, y = t",
            3: "bottom: x = 0, y = 0, z = -t; top: x = 0, y = 0, z = t"}

# name, dimension, mesh, the same crack
CASES = [
    ("drawn", 2, DRAWN, "edge: 0 0.51 to 0.25 0.51 to 0.4 0.56"),
    ("on edges of cells", 2, ON_EDGES, "edge: 0 0.5 to 0.5 0.5"),
    ("drawn in 3D", 3, CUBE,
     "edge: -0.1 -0.1 0.51 to 1.1 -0.1 0.51 to 1.1 0.4 0.51 "
     "to -0.1 0.4 0.51"),
]


# gmsh doubles the nodes, at the mouth as well where it is told to.
PLUGIN = """Physical Point("mouth") = {4};
Mesh 2;
Plugin(Crack).Dimension = 1;
Plugin(Crack).PhysicalGroup = %d;
Plugin(Crack).OpenBoundaryPhysicalGroup = %d;
Plugin(Crack).Run;
"""


def check_plugin(runner, failures):
    """An edge crack of finite elements by gmsh's Plugin(Crack), as a group and
    typed; with a mouth that is held together."""
    text = ON_EDGES.replace('"crack line")', '"crack line", 7)')
    folder = runner.new_folder()
    for name, mouth in (("mesh.geo", 8), ("closed.geo", 0)):
        with open(os.path.join(folder, name), "w") as stream:
            stream.write(text + PLUGIN.replace('"mouth")', '"mouth", 8)') %
                         (7, mouth))
    with open(os.path.join(folder, "crack.prm"), "w") as stream:
        stream.write("set Mode = finite elements\n" + PARAMETERS %
                     {"dim": 2, "supports": SUPPORTS[2]})
    failures.begin("doubled by gmsh, in finite elements")
    group, typed, closed = [
        runner.run(["crack.prm", "--output", "out%d" % k] + words, 1, folder,
                   "out%d" % k)
        for k, words in enumerate(
            ([], ["--set", "Cracks/pre-cracks=edge: 0 0.5 to 0.5 0.5"],
             ["--set", "Mesh/file=closed.geo"]))
    ]
    for run in (group, typed):
        if failures.check(run.code == 0, "exit %d" % run.code):
            failures.check_close("cut families",
                                 run.results()["counts"]["broken_bonds"], 0, 0)
            for quantity, entry in typed.results()["quantities"].items():
                failures.check_close(quantity, run.value(quantity) + 1.,
                                     entry["value"] + 1., 1e-9)
    failures.check(closed.code == 2 and "'edge' at (0 0.5), where both sides "
                   "of the slit share a node" in closed.text,
                   "exit %d of a closed mouth" % closed.code)
    failures.end(group)


def main():
    arguments = parse_arguments(__doc__)
    runner = Runner(arguments)
    failures = Failures()
    for name, dim, mesh, typed in CASES:
        if arguments.only and not re.search(arguments.only, name):
            continue
        failures.begin(name)
        folder = runner.new_folder()
        for file, text in (("mesh.geo", mesh),
                           ("crack.prm", PARAMETERS %
                            {"dim": dim, "supports": SUPPORTS[dim]})):
            with open(os.path.join(folder, file), "w") as stream:
                stream.write(text)
        runs = [
            runner.run(["crack.prm", "--output", "out%d" % k] + words, 1,
                       folder, "out%d" % k)
            for k, words in enumerate(
                ([], ["--set", "Cracks/pre-cracks=" + typed]))
        ]
        wrong = runner.run(
            ["crack.prm", "--set", "Cracks/pre-cracks=edge: group crackline"],
            1, folder)
        failures.check(wrong.code == 2 and "did you mean 'crack line'" in
                       wrong.text, "exit %d of a wrong name" % wrong.code)
        if all([failures.check(run.code == 0, "exit %d" % run.code)
                for run in runs]):
            group, places = [run.results() for run in runs]
            failures.check(group["counts"]["broken_bonds"] > 50,
                           "%d broken bonds" % group["counts"]["broken_bonds"])
            for count in ("broken_bonds", "bonds"):
                failures.check(group["counts"][count] ==
                               places["counts"][count],
                               "%s: %d and %d" % (count,
                                                  group["counts"][count],
                                                  places["counts"][count]))
            for quantity, entry in places["quantities"].items():
                if entry["value"] is not None:
                    value = group["quantities"][quantity]["value"]
                    # Triangles share out the crack face otherwise.
                    failures.check_close(quantity, value + 1.,
                                         entry["value"] + 1.,
                                         1e-9 if dim == 2 else 1e-5)
        failures.end(runs[0])
    check_plugin(runner, failures)
    # To which face the side of the panel belongs is not clear.
    failures.begin("from a corner along a side")
    outcome = runner.run_case("l_shaped_panel.prm",
                              ["Cracks/pre-cracks=c: 250 250 to 230 250"])
    failures.check(outcome.code == 2 and "along a side of the body" in
                   outcome.text, "exit %d" % outcome.code)
    failures.end(outcome)
    finish(failures)


if __name__ == "__main__":
    main()
