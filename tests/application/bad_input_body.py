"""Bad input, second part: regions, supports, loads, quantities."""

import os

from bad_input_files import INNER, row
from case_files import (BOND_BASED, NO_SUPPORTS, QUARTER_PLATE, SOLID,
                        parameter_text, square)
from harness import MESHES

AROUND = "Peridynamics/around"
CORE = "Peridynamics/core size"
WIDTH = "Peridynamics/blending width"
RATIO = "Peridynamics/horizon ratio"
HORIZON = "Peridynamics/horizon"
SYMMETRY = "Boundary conditions/symmetry"
DISPLACEMENT = "Boundary conditions/displacement"
TRACTION = "Boundary conditions/traction"
PRESSURE = "Boundary conditions/pressure"
BODY = "Boundary conditions/body force"
POINT_DISPLACEMENT = "Boundary conditions/point displacement"
POINT_FORCE = "Boundary conditions/point force"
REMOVE = "Boundary conditions/remove rigid motion"
CONCENTRATION = "Quantities/stress concentration"
NOMINAL = "Quantities/nominal stress"

# The cells at the right are flat, so that a particle there has all its
# neighbours in one line. (With other cells a horizon of at least the spacing,
# which is checked, always holds enough of them.)
FLAT = {AROUND: "right", RATIO: "1", "Mesh/file": "flat.msh",
        "Mesh/geometry parameters": None}
FLAT_MESH = {"flat.msh": square(transform=lambda x, y: (
    x if x < 1. else 0.875 + 1e-8, y))}

# Finite elements with a slit from (-1, 0) to (1, 0).
SLIT = {"Mode": "finite elements",
        "Mesh/file": os.path.join(MESHES, "plate_slit.geo"),
        "Mesh/geometry parameters": "dx = 0.2, nf = 2, q = 1.5"}

SPACING = "Mesh/Refinement/target spacing"
REFINED = "Mesh/Refinement/around"
DISTANCE = "Mesh/Refinement/distance"

REFINEMENT = [
    row("negative target spacing", [
        "'Mesh / Refinement / target spacing'", "found '-1'", "a number >= 0"],
        {SPACING: "-1"}),
    row("target spacing that is far too small", [
        "'Mesh / Refinement / target spacing'", "found 1e-09", "16 halvings",
        "Is it in the unit of the mesh?"], {SPACING: "1e-9"}),
    row("refined places without target spacing", [
        "'Mesh / Refinement / target spacing'", "found 0 with", "> 0"],
        {REFINED: "right"}),
    row("refined around an unknown boundary", [
        "'Mesh / Refinement / around'", "'rigth'", "did you mean 'right'"],
        {SPACING: "0.05", REFINED: "rigth"}),
    row("refined around a negative ball", [
        "'Mesh / Refinement / around'", "radius"],
        {SPACING: "0.05", REFINED: "ball 0.5 0.5 -1"}),
    row("refinement of nothing in finite elements", [
        "'Mesh / Refinement / target spacing'", "found nothing",
        "bottom, left, right, top"],
        {SPACING: "0.05", AROUND: None, "Mode": "finite elements"}),
    row("refinement distance without number", [
        "'Mesh / Refinement / distance'", "'far'", "horizons"],
        {SPACING: "0.05", DISTANCE: "far"}),
    row("refinement grading 0", [
        "'Mesh / Refinement / grading'", "found '0'", "a number > 0"],
        {SPACING: "0.05", "Mesh/Refinement/grading": "0"}),
    row("negative number of error cycles", [
        "'Mesh / Refinement / error cycles'", "found '-1'"],
        {"Mesh/Refinement/error cycles": "-1"}),
    row("refined fraction above 1", [
        "'Mesh / Refinement / refined fraction'", "found '1.5'"],
        {"Mesh/Refinement/refined fraction": "1.5"}),
    row("error cycles that refine nothing", [
        "'Mesh / Refinement / refined fraction'", "found 0", "a number > 0"],
        {"Mesh/Refinement/error cycles": "2",
         "Mesh/Refinement/refined fraction": "0"}),
    row("unknown way with curved boundaries", [
        "'Mesh / Refinement / curved boundaries'", "'round'", "automatic, straight"],
        {"Mesh/Refinement/curved boundaries": "round"}),
]

REGIONS = [
    row("no around", ["'Peridynamics / around'", "found nothing",
                      "bottom, left, right, top"], {AROUND: None}),
    row("around an unknown boundary", ["'Peridynamics / around'", "'rigth'",
                                       "did you mean 'right'"],
        {AROUND: "rigth"}),
    row("around an unknown volume", ["'Peridynamics / around'", "'domian'",
                                     "did you mean 'domain'"],
        {AROUND: "volume domian"}),
    row("around with too few numbers", ["'Peridynamics / around'", "point",
                                        "x y"], {AROUND: "point 0.5"}),
    row("around with a 3D point in 2D", ["'Peridynamics / around'", "x y"],
        {AROUND: "point 0.5 0.5 0.5"}),
    row("negative ball", ["'Peridynamics / around'", "radius"],
        {AROUND: "ball 0.5 0.5 -1"}),
    row("empty region", ["'Peridynamics / core size'",
                         "without any node", "contains nodes"],
        {AROUND: "point 7 7", CORE: "0", WIDTH: "0.1"}),
    row("region that swallows the body", [
        "'Peridynamics / core size'", "swallows the whole body",
        "leaves finite elements", "Mode = peridynamics"], {CORE: "3"}),
    row("region of the whole volume", ["swallows the whole body"],
        {AROUND: "volume domain"}),
    row("core size without number", ["'Peridynamics / core size'", "'big'",
                                     "horizons"], {CORE: "big"}),
    row("negative core size", ["'Peridynamics / core size'", "-1"],
        {CORE: "-1"}),
    row("crack outside of the body", ["'Cracks / pre-cracks'",
                                      "'c' outside of the body"],
        {"Cracks/pre-cracks": "c: 3 0.5 to 4 0.5"}),
    row("crack that ends where the body is held", [
        "'Cracks / pre-cracks'", "'c' ends on boundary 'left'",
        "held across the crack"],
        {"Cracks/pre-cracks": "c: 0 0.4 to 0.4 0.4",
         DISPLACEMENT: "left: x = 0, y = 0; right: x = 1e-3"}),
    row("crack through elements", [
        "'Cracks / pre-cracks'", "where elements carry a part",
        "in the peridynamic core", "larger 'Peridynamics / core size'"],
        {"Cracks/pre-cracks": "c: 0.4 0.4 to 0.5 0.4", CORE: "0.01"}),
    row("crack in finite elements", [
        "'Cracks / pre-cracks'", "Mode = finite elements",
        "coupled, peridynamics"],
        {"Cracks/pre-cracks": "c: 0.4 0.4 to 0.5 0.4",
         "Mode": "finite elements"}),
    row("crack beside its slit", [
        "'Cracks / pre-cracks'", "'c' at (", "the mesh has no slit",
        "double nodes; coupled, peridynamics", "Plugin(Crack)"], SLIT,
        {"Cracks/pre-cracks": "c: -1 0.1 to 1 0.1"}),
    row("crack longer than its slit", [
        "'Cracks / pre-cracks'", "'c' at (1.", "the mesh has no slit"], SLIT,
        {"Cracks/pre-cracks": "c: -1 0 to 1.5 0"}),
    row("crack shorter than its slit", [
        "'Cracks / pre-cracks'", "'c', which ends at (0 0) on a slit",
        "as long as their slit"], SLIT,
        {"Cracks/pre-cracks": "c: -1 0 to 0 0"}),
    row("crack that ends within a face of its slit", [
        "'Cracks / pre-cracks'", "'c' at (0.", "it covers in part",
        "at nodes of the slit"], SLIT,
        {"Cracks/pre-cracks": "c: -1 0 to 0.21 0"}),
    row("crack along a side of finite elements", [
        "'Cracks / pre-cracks'", "'c' along a side of the body"], SLIT,
        {"Cracks/pre-cracks": "c: -1 -7.5 to 1 -7.5"}),
    row("slit of which there is no crack in the mesh", [
        "'Cracks / pre-cracks'", "'slot'", "did you mean 'slit'"], SLIT,
        {"Cracks/pre-cracks": "c: group slot"}),
    row("growth in finite elements", [
        "'Cracks / growth'", "Mode = finite elements",
        "coupled, peridynamics"], SLIT,
        {"Cracks/pre-cracks": "c: -1 0 to 1 0", "Cracks/growth": "segments",
         "Cracks/fracture energy": "1"}),
    row("negative blending width", ["'Peridynamics / blending width'", "-1"],
        {WIDTH: "-1 horizons"}),
    row("horizon smaller than the spacing", [
        "'Peridynamics / horizon'", "0.05, smaller than the spacing 0.125",
        "at least"], {HORIZON: "0.05"}),
    row("horizon smaller than the spacing, bond based", [
        "'Peridynamics / horizon'", "0.05, smaller than the spacing 0.125",
        "at least"], BOND_BASED, {HORIZON: "0.05"}),
    row("too few neighbours", [
        "particle at (0.875 ", "neighbours, all in one line",
        "at least 2 independent bonds", "larger horizon ratio"], FLAT,
        late=True, files=FLAT_MESH),
    row("too few neighbours, classical", [
        "particle at (0.875 ", "neighbours, all in one line",
        "at least 2 independent bonds", "larger horizon ratio"], FLAT,
        {"Peridynamics/coupling": "force blending"},
        late=True, files=FLAT_MESH),
]

CONDITIONS = [
    row("symmetry: unknown boundary", [
        "'Boundary conditions / symmetry'", "'lft'", "did you mean 'left'",
        "bottom, left, right, top"], {SYMMETRY: "lft, bottom"}),
    row("displacement: unknown boundary", [
        "'Boundary conditions / displacement'", "'topp'",
        "did you mean 'top'"], {DISPLACEMENT: "topp: y = 0"}),
    row("traction: unknown boundary", [
        "'Boundary conditions / traction'", "'rigth'",
        "did you mean 'right'"], {TRACTION: "rigth: x = 1"}),
    row("pressure: unknown boundary", [
        "'Boundary conditions / pressure'", "'hole'",
        "it has: bottom, left, right, top"], {PRESSURE: "hole: 5"}),
    row("body force: unknown volume", [
        "'Boundary conditions / body force'", "'domian'",
        "did you mean 'domain'"], {BODY: "volume domian: y = -1"}),
    row("body force without 'volume'", [
        "'Boundary conditions / body force'", "'domain: y = -1'",
        "Did you mean 'volume domain"], {BODY: "domain: y = -1"}),
    row("unknown component", [
        "'Boundary conditions / traction'", "component 'z'", "x, y"],
        {TRACTION: "right: z = 1"}),
    row("component without name", [
        "'Boundary conditions / traction'", "without a name",
        "NAME: component"], {TRACTION: "x = 1"}),
    row("no supports and no loads", [
        "'Boundary conditions'", "neither supports nor loads",
        "at least one"], NO_SUPPORTS, {TRACTION: None}),
    row("no supports and no loads, rigid motion kept", [
        "'Boundary conditions'", "no support against translation along",
        "'remove rigid motion = true'"], NO_SUPPORTS,
        {TRACTION: None, REMOVE: "false"}),
    row("pushed unsupported body", [
        "'Boundary conditions'", "loads that push the body",
        "translation along (1, 0)", "loads in balance"], NO_SUPPORTS),
    row("pushed unsupported body, rigid motion kept", [
        "'Boundary conditions'", "no support against translation along",
        "rotation", "'remove rigid motion = true'"], NO_SUPPORTS,
        {REMOVE: "false"}),
    row("turned unsupported body", [
        "'Boundary conditions'", "loads that push the body", "rotation"],
        NO_SUPPORTS, {TRACTION: "right: y = 1; left: y = -1"}),
    row("pushed along a free direction", [
        "'Boundary conditions'", "loads that push the body",
        "translation along (0, 1)"],
        {SYMMETRY: "left", TRACTION: "right: y = 1"}),
    row("one direction without support, rigid motion kept", [
        "'Boundary conditions'", "no support against",
        "translation along (0, 1)"], {SYMMETRY: "left", REMOVE: "false"}),
    row("pushed 3D body, rigid motion kept", [
        "'Boundary conditions'", "no support against translation along",
        "rotation", "'remove rigid motion = true'"], SOLID, NO_SUPPORTS,
        {REMOVE: "false"}),
    row("contradicting supports", [
        "contradicting supports", "x = 0 from the symmetry of 'left' but 0.1",
        "displacement of 'top'", "at the node (0 1)", "one value per node"],
        {DISPLACEMENT: "top: x = 0.1"}),
    row("contradicting displacements of one point", [
        "contradicting supports", "point displacement at (1, 1)",
        "one value per node"],
        {POINT_DISPLACEMENT: "1 1: x = 0.1; 1 1: x = 0.2"}),
    row("contradicting supports in time", [
        "contradicting supports", "t = 1"],
        {DISPLACEMENT: "top: x = 0.1*t*(t - 0.5)",
         "Load steps/number of steps": "2"}),
    row("symmetry on a curved boundary", [
        "'Boundary conditions / symmetry'", "'hole'", "mean normal",
        "a plane boundary"], QUARTER_PLATE, {SYMMETRY: "left, hole"}),
    row("symmetry on a slanted boundary", [
        "'Boundary conditions / symmetry'", "'right'", "mean normal",
        "normal to a coordinate axis"],
        {SYMMETRY: "right, bottom", "Mesh/file": "mesh.msh",
         "Mesh/geometry parameters": None},
        files={"mesh.msh": square(transform=lambda x, y: (
            x * (1. + 0.3 * y), y))}),
    row("not a number in a displacement", [
        "'Boundary conditions / displacement'", "'sqrt(x - 0.5)'",
        "not a number at (0, 1)", "a finite value everywhere"],
        {DISPLACEMENT: "top: y = sqrt(x - 0.5)"}),
    row("not a number in a constant expression", [
        "'Boundary conditions / traction'", "'0/0'", "not a number",
        "a finite value"], {TRACTION: "right: x = 0/0"}),
    row("infinite pressure", [
        "'Boundary conditions / pressure'", "'1/t^0/0'", "infinite"],
        {PRESSURE: "top: 1/t^0/0"}),
    row("not a number in a body force", [
        "'Boundary conditions / body force'", "'log(y - 2)'",
        "not a number"], {BODY: "y = log(y - 2)"}),
    row("not a number in a point force", [
        "'Boundary conditions / point force'", "'1/x'", "infinite"],
        {POINT_FORCE: "0 1: y = 1/x"}),
    row("not a number at a later time", [
        "'Boundary conditions / traction'", "not a number", "t = 1"],
        {TRACTION: "right: x = sqrt(0.75 - t)",
         "Load steps/number of steps": "2"}),
    row("unknown variable", [
        "'Boundary conditions / traction'", "the unknown name 'u'",
        "x, y, z, t", "Expressions / constants"],
        {TRACTION: "right: x = 2*u"}),
    row("unknown constant", [
        "'Boundary conditions / traction'", "'strech'",
        "Did you mean 'stretch'"],
        {TRACTION: "right: x = strech", "Expressions/constants":
         "stretch = 2"}),
    row("syntax error in an expression", [
        "'Boundary conditions / traction'", "'2*'", "one expression in"],
        {TRACTION: "right: x = 2*"}),
    row("parenthesis missing", [
        "'Boundary conditions / traction'", "'right: x = (2'",
        "as many ')' as '('"], {TRACTION: "right: x = (2"}),
    row("point displacement outside", [
        "'Boundary conditions / point displacement'", "(3 0)",
        "away from the body", "nearest node is at (1 0)"],
        {POINT_DISPLACEMENT: "3 0: y = 0"}),
    row("point force outside", [
        "'Boundary conditions / point force'", "(3 0)",
        "away from the body", "nearest node is at (1 0)"],
        {POINT_FORCE: "3 0: y = 1"}),
]


def data(text):
    """A reference file beside the parameter file, or none."""
    return dict(files={"data.csv": text})


RING = {"Reference/data": "ring: data.csv"}
LARGE = {"Material/law": "hencky", "Material/state": "plane strain"}
FOLLOWER = "Boundary conditions/follower pressure"
PLATE = "Boundary conditions/rigid plate"
MEAN = "Boundary conditions/mean displacement"

LARGE_DEFORMATION = [
    row("unknown law", ["'Material / law'", "'henki'", "hencky"],
        {"Material/law": "henki"}),
    row("follower pressure at small strain", [
        "'Boundary conditions / follower pressure'", "linear elastic",
        "a law of finite strain"], {FOLLOWER: "top: 1"}),
    row("follower pressure on an unknown boundary", [
        "'Boundary conditions / follower pressure'", "'topp'",
        "did you mean 'top'"], {FOLLOWER: "topp: 1"}, LARGE),
    row("follower pressure on an inner boundary", [
        "'Boundary conditions / follower pressure'", "'crack'",
        "no face on the surface of the body"],
        {FOLLOWER: "crack: 1", "Mesh/file": "inner.msh",
         "Mesh/geometry parameters": None}, LARGE,
        files={"inner.msh": INNER}),
    row("follower pressure that is not finite", [
        "'Boundary conditions / follower pressure'", "finite"],
        {FOLLOWER: "top: 1/(y - y)"}, LARGE),
    row("law that bonds do not have", [
        "'Material / law'", "'hencky' with bond-based", "prototype microelastic"],
        BOND_BASED, {"Material/law": "hencky"}),
    row("wrong Poisson's ratio of the microelastic law", [
        "'Material / Poisson's ratio'", "0.3", "1/4"],
        {"Material/law": "prototype microelastic",
         "Material/state": "plane strain"}),
    row("rigid plate on a supported boundary", [
        "'Boundary conditions / rigid plate'", "'left'",
        "held by the symmetry of"], {PLATE: "left: x = 0"}, LARGE),
    row("rigid plate and mean of one boundary", [
        "'Boundary conditions / rigid plate'", "as a whole"],
        {PLATE: "right: x = 0", MEAN: "right: y = 0"}, LARGE, NO_SUPPORTS),
    row("unknown motion of a plate", [
        "'Boundary conditions / rigid plate'", "'rotatoin'", "rotation"],
        {PLATE: "right: rotatoin = 0"}, LARGE),
    row("mean of what is held already", [
        "'Boundary conditions / mean displacement'",
        "all held by other supports"], {MEAN: "left: x = 0"}, LARGE),
    row("mean of an unknown boundary", [
        "'Boundary conditions / mean displacement'", "'rigth'",
        "did you mean 'right'"], {MEAN: "rigth: y = 0"}),
    row("rotation of a plate in 3D", [
        "'Boundary conditions / rigid plate'", "rotation = 1",
        "rotation = 0 in 3D"], SOLID, {PLATE: "right: rotation = 1"}),
    row("unknown control", ["'Load steps / control'", "'arc'"],
        {"Load steps/control": "arc"}),
]
CONDITIONS += LARGE_DEFORMATION

PLACE = ["reference file", "data.csv"]

QUANTITIES = [
    row("stress concentration: unknown boundary", [
        "'Quantities / stress concentration'", "'rihgt'",
        "did you mean 'right'"], {CONCENTRATION: "rihgt"}),
    row("reaction: unknown boundary", [
        "'Quantities / reaction'", "'lef'", "did you mean 'left'"],
        {"Quantities/reaction": "lef"}),
    row("nominal stress: unknown boundary", [
        "'Quantities / nominal stress'", "'lef'", "did you mean 'left'"],
        {CONCENTRATION: "right", NOMINAL: "reaction of lef"}),
    row("nominal stress missing", [
        "'Quantities / nominal stress'", "found nothing",
        "'reaction of NAME'"], {CONCENTRATION: "top", TRACTION: None,
                                DISPLACEMENT: "right: x = 0.1"}),
    row("nominal stress of a traction that varies", [
        "'Quantities / nominal stress'", "found nothing"],
        {CONCENTRATION: "left", NOMINAL: None,
         TRACTION: "right: x = 10*y, y = 0.001"}),
    row("nominal stress of a boundary without support", [
        "'Quantities / nominal stress'", "'right'",
        "which no condition supports"],
        {CONCENTRATION: "left", NOMINAL: "reaction of right"}),
    row("one name for two probes", [
        "'Quantities / circle'", "the name 'a' again", "probe_a.csv"],
        {"Quantities/line": "a: 0.1 0.5 to 0.9 0.5, 5 points",
         "Quantities/circle": "a: center 0.5 0.5, radius 0.2, 5 points"}),
    row("nominal stress zero", [
        "'Quantities / nominal stress'", "found '0'", "other than 0"],
        {CONCENTRATION: "top", NOMINAL: "0"}),
    row("nominal stress a word", [
        "'Quantities / nominal stress'", "found 'high'", "a number"],
        {CONCENTRATION: "top", NOMINAL: "high"}),
    row("point outside", [
        "'Quantities / point'", "outside the mesh", "nearest node"],
        {"Quantities/point": "far: 3 0"}),
    row("line outside", [
        "'Quantities / line'", "outside the mesh", "nearest node"],
        {"Quantities/line": "far: 0 0 to 3 0, 11 points"}),
    row("circle outside", [
        "'Quantities / circle'", "outside the mesh", "nearest node"],
        {"Quantities/circle": "ring: center 0 0, radius 0.5, from 0 to 180, "
         "11 points"}),
    row("deflection outside", [
        "'Quantities / deflection'", "outside the mesh"],
        {"Quantities/deflection": "tip: 3 0, y"}),
    row("deflection without component", [
        "'Quantities / deflection'", "without a component", "x, y"],
        {"Quantities/deflection": "tip: 1 0"}),
    row("stress ratio with a wrong component", [
        "'Quantities / stress ratio'", "xx, yy, zz, xy"],
        {"Quantities/stress ratio": "root: 1 0, xz"}),
    row("line with a slip", [
        "'Quantities / line'", "'pints'", "Did you mean 'points'"],
        {"Quantities/line": "l: 0 0 to 1 0, 11 pints"}),
    row("circle without radius", [
        "'Quantities / circle'", "without 'radius'"],
        {"Quantities/circle": "ring: center 0.5 0.5, 11 points"}),
    row("name that is no word", [
        "'Quantities / point'", "letters, digits"],
        {"Quantities/point": "a b: 0 0"}),
    row("reference for an unknown quantity", [
        "'Reference / values'", "'stress_concentraton'",
        "did you mean 'stress_concentration'"],
        {CONCENTRATION: "top", NOMINAL: "1",
         "Reference/values": "stress_concentraton = 3"}),
    row("reference that is no number", [
        "'Reference / values'", "'three'", "a number"],
        {"Reference/values": "strain_energy = three"}),
    row("exact displacement not a number", [
        "'Reference / displacement'", "'1/x'", "infinite at (0,"],
        {"Reference/displacement": "x = 1/x, y = 0"}),
    row("reference data file missing", PLACE + ["no readable file"], RING),
    row("reference data with a bad column", PLACE + [
        "'szx'", "Did you mean 'sxx'"], RING, **data("x,y,szx\n0,0,1\n")),
    row("reference data without coordinates", PLACE + [
        "the columns", "x, y"], RING, **data("r,sxx\n0,1\n")),
    row("reference data that is no number", PLACE + [
        "data.csv:2", "'one' in column 'sxx'", "a number"], RING,
        **data("x,y,sxx\n0,0,one\n")),
    row("reference data with a short row", PLACE + [
        "data.csv:3", "2 cells", "3 cells"], RING,
        **data("x,y,sxx\n0,0,1\n0,1\n")),
    row("reference data empty", PLACE, RING, **data("")),
    row("reference data outside", [
        "'Reference / data'", "(3", "outside the mesh"], RING,
        **data("x,y,sxx\n3,0,1\n")),
    row("folder as reference data", PLACE, RING, folders=["data.csv"]),
]

# Several errors of one file are reported together.
BONDS = {"Cracks/growth": "bonds", "Cracks/fracture energy": "1"}
BREAKING = [
    row("bonds without a fracture energy", [
        "'Cracks / fracture energy'", "a number > 0"],
        {"Cracks/growth": "bonds"}),
    row("negative fracture energy", ["'Cracks / fracture energy'", "-1"],
        BONDS, {"Cracks/fracture energy": "-1"}, n_errors=2),
    row("energy criterion of bond-based bonds", [
        "'Cracks / criterion'", "'critical energy' with model 'bond based'",
        "critical stretch"], BONDS, BOND_BASED,
        {"Cracks/criterion": "critical energy"}),
    row("bonds without teeth", ["'Cracks / softening teeth'"], BONDS,
        BOND_BASED, {"Cracks/softening teeth": "0"}),
    row("breaking bonds at finite strain", [
        "'Cracks / growth'", "'bonds' in a nonlinear problem"], BONDS,
        {"Material/law": "hencky"}),
    row("breaking bonds of blended forces", [
        "'Cracks / growth'", "'bonds' with coupling 'force blending'",
        "energy blending"], BONDS,
        {"Peridynamics/coupling": "force blending"}),
    row("stretch and fracture energy", [
        "'Cracks / fracture energy'", "1 with criterion 'critical stretch' and "
        "a 'critical stretch'"], BONDS,
        {"Cracks/criterion": "critical stretch",
         "Cracks/critical stretch": "0.01"}),
    row("hand-over of cracks that grow by segments", [
        "'Cracks / hand over length'", "'2 horizons' with growth 'segments'",
        "growth = bonds"], {"Cracks/pre-cracks": "edge: 0 0.5 to 0.5 0.5",
                            "Cracks/growth": "segments",
                            "Cracks/fracture energy": "1",
                            "Cracks/hand over length": "2 horizons"}),
    row("hand-over without growth", [
        "'Cracks / hand over length'", "with growth 'none'"],
        {"Cracks/hand over length": "2 horizons"}),
    row("hand-over of single bonds", [
        "'Cracks / hand over length'", "'0.5 horizons'", "'1 horizons'"],
        BONDS, {"Cracks/hand over length": "0.5 horizons"}),
    row("hand-over at no length", [
        "'Cracks / hand over length'", "'0'", "never"],
        BONDS, {"Cracks/hand over length": "0"}),
    row("hand-over that is no length", [
        "'Cracks / hand over length'", "'later'", "2 horizons"],
        BONDS, {"Cracks/hand over length": "later"}),
    row("hand-over in 3D", [
        "'Cracks / hand over length'", "in 3D", "never"], SOLID,
        BONDS, {"Cracks/hand over length": "2 horizons"}),
    row("hand-over with blended energies", [
        "'Cracks / hand over length'", "with coupling 'energy blending'",
        "coupling = consistent"], BONDS,
        {"Peridynamics/coupling": "energy blending",
         "Cracks/hand over length": "2 horizons"}),
    row("hand-over without a fracture energy", [
        "'Cracks / fracture energy'", "nothing or 0", "hand over length"],
        {"Cracks/growth": "bonds", "Cracks/criterion": "critical stretch",
         "Cracks/critical stretch": "0.01",
         "Cracks/hand over length": "2 horizons"}),
    row("neither stretch nor fracture energy", [
        "'Cracks / fracture energy'", "nothing or 0", "give a 'critical "
        "stretch'"], {"Cracks/growth": "bonds",
                      "Cracks/criterion": "critical stretch"}),
    row("threshold of another criterion", [
        "'Cracks / critical stretch'", "0.01 with criterion 'critical energy'"],
        BONDS, {"Cracks/critical stretch": "0.01"}),
    row("principal stress without a strength", [
        "'Cracks / tensile strength'", "nothing or 0"],
        {"Cracks/growth": "bonds",
         "Cracks/criterion": "maximum principal stress"}),
    row("strain without a threshold", [
        "'Cracks / critical equivalent strain'", "a number > 0"],
        {"Cracks/growth": "bonds", "Cracks/criterion": "equivalent strain"}),
    row("friction without cohesion", [
        "'Cracks / friction angle'", "The criterion does not ask for it"],
        {"Cracks/growth": "bonds", "Cracks/tensile strength": "1",
         "Cracks/criterion": "maximum principal stress",
         "Cracks/friction angle": "30"}),
    row("strain criterion of bond-based bonds", [
        "'Cracks / criterion'", "'bond strain' with model 'bond based'",
        "critical stretch"], {"Cracks/growth": "bonds"}, BOND_BASED,
        {"Cracks/criterion": "bond strain",
         "Cracks/critical bond strain": "0.01"}),
    row("softening that starts at the critical stretch", [
        "'Cracks / softening stretch'", "found 0.02",
        "less than the critical stretch, 0.02"],
        {"Cracks/growth": "bonds", "Cracks/criterion": "critical stretch",
         "Cracks/critical stretch": "0.02",
         "Cracks/softening stretch": "0.02"}),
    row("softening without a stretch", [
        "'Cracks / softening stretch'", "The criterion does not ask for it"],
        BONDS, {"Cracks/softening stretch": "0.015"}),
    row("protected boundary that is not there", [
        "'Cracks / protected boundaries'", "'rigth'", "did you mean 'right'"],
        BONDS, {"Cracks/protected boundaries": "left, rigth"}),
    row("protected volume that is not there", [
        "'Cracks / protected materials'", "'domian'", "did you mean 'domain'"],
        BONDS, {"Cracks/protected materials": "domian"}),
    row("name as protected region", [
        "'Cracks / protected regions'", "'right'", "protected boundaries"],
        BONDS, {"Cracks/protected regions": "right"}),
    row("bad protected box", ["'Cracks / protected regions'"],
        BONDS, {"Cracks/protected regions": "box 0 0 1"}),
    row("protection without bonds that break", [
        "'Cracks / protected boundaries'", "growth = bonds"],
        {"Cracks/protected boundaries": "right"}),
    row("unknown criterion", ["'Cracks / criterion'", "'critical force'"],
        BONDS, {"Cracks/criterion": "critical force"}),
]

PARAMETER_ERRORS = {
    "Mode": "couplet", "Material/Young's modulus": "-1",
    "Peridynamics/horizon ratio": "two", "Load steps/end time": "0",
    "Quantities/nominal stress": "high", "Boundary conditions/tracton": "x",
    "Boundary conditions/traction": "right: x = 2*u"}
MESH_ERRORS = {
    AROUND: "hol", SYMMETRY: "lft, bottom", DISPLACEMENT: "topp: x = 0",
    TRACTION: "rigth: x = 1", PRESSURE: "hole: 1",
    POINT_FORCE: "3 0: x = 1", "Quantities/reaction": "lef",
    "Quantities/point": "far: 3 0", "Material/by volume":
    "domian: Young's modulus = 3"}
TOGETHER = [
    row("many errors in the parameters", [
        "'couplet'", "found -1", "'two'", "'Load steps / end time'", "'high'",
        "'tracton'", "'u'"], PARAMETER_ERRORS, n_errors=7),
    row("many errors in mesh names", [
        "'hol'", "'lft'", "'topp'", "'rigth'", "'hole'", "'domian'"],
        MESH_ERRORS, n_errors=6),
    row("many errors in file and command line", [
        "'couplet'", "'horizon rati'", "'Dimensio'", "'three'"],
        {"Mode": "couplet", "Dimensio": "2"}, n_errors=4,
        options=["--set", "Peridynamics/horizon rati=3", "--set",
                 "Peridynamics/horizon=three"]),
]
QUANTITIES += TOGETHER
