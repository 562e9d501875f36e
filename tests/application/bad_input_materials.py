"""Bad input, third part: laws with material axes, density."""

from bad_input_files import row
from case_files import BOND_BASED, SOLID

ORTHOTROPIC = {
    "Material/law": "orthotropic",
    "Material/Young's modulus": None,
    "Material/Poisson's ratio": None,
    "Material/constants": "E1 = 10, E2 = 1, nu12 = 0.2, G12 = 1",
}

MATERIALS = [
    row("orthotropic without constants", [
        "'Material / constants'", "found no E1, E2, nu12, G12",
        "E1, E2, nu12, G12 with law 'orthotropic'"], ORTHOTROPIC,
        {"Material/constants": None}),
    row("orthotropic without a shear modulus in plane strain", [
        "'Material / constants'", "found no E3, nu13, nu23",
        "E1, E2, nu12, G12, E3, nu13, nu23"], ORTHOTROPIC,
        {"Material/state": "plane strain"}),
    row("unknown stiffness constant", ["'Material / constants'", "component 'nu_12'",
                             "Did you mean 'nu12'?"], ORTHOTROPIC,
        {"Material/constants": "E1 = 10, E2 = 1, nu_12 = 0.2, G12 = 1"}),
    row("stiffness constant that is no number", ["'Material / constants'", "E_1"],
        ORTHOTROPIC,
        {"Material/constants": "E1 = E_1, E2 = 1, nu12 = 0.2, G12 = 1"}),
    row("constant that varies", ["'Material / constants'", "'x' for 'E1'",
                                 "an expression of constants"], ORTHOTROPIC,
        {"Material/constants": "E1 = x, E2 = 1, nu12 = 0.2, G12 = 1"}),
    row("negative shear modulus", ["'Material / constants'", "G12 = -1",
                                   "a number > 0"], ORTHOTROPIC,
        {"Material/constants": "E1 = 10, E2 = 1, nu12 = 0.2, G12 = -1"}),
    row("contraction beyond the limit", [
        "'Material / constants'", "nu12 = 3.2", "3.16228, sqrt(E1 / E2)"],
        ORTHOTROPIC,
        {"Material/constants": "E1 = 10, E2 = 1, nu12 = 3.2, G12 = 1"}),
    row("stiffness that is not positive definite", [
        "'Material / constants'", "eigenvalue -1", "all eigenvalues > 0"],
        ORTHOTROPIC, {"Material/law": "anisotropic", "Material/constants":
                      "C11 = 1, C22 = 1, C12 = 2, C66 = 1"}),
    row("stiffness without its diagonal", [
        "'Material / constants'", "found no C66", "C11, C22, C66"],
        ORTHOTROPIC, {"Material/law": "anisotropic", "Material/constants":
                      "C11 = 1, C22 = 1"}),
    row("constants of an isotropic law", [
        "'Material / constants'", "with law 'linear elastic'"],
        {"Material/constants": "E1 = 1"}),
    row("Young's modulus of an orthotropic law", [
        "'Material / Young's modulus'", "found 3 with law 'orthotropic'"],
        ORTHOTROPIC, {"Material/Young's modulus": "3"}),
    row("orthotropic bonds", ["'Material / law'",
                              "with bond-based peridynamics",
                              "model = correspondence"], ORTHOTROPIC,
        {"Peridynamics/model": "bond based"}),
    row("orthotropic bonds in a volume", ["'Material / law'",
                                          "with bond-based peridynamics"],
        BOND_BASED, {"Material/by volume":
                     "domain: E1 = 10, E2 = 1, nu12 = 0.2, G12 = 1"}),
    row("constants of two laws in a volume", [
        "'Material / by volume'", "of domain", "constants of one law"],
        {"Material/by volume": "domain: E1 = 10, Poisson's ratio = 0.2"}),
    row("orthotropic volume in a body of finite strain", [
        "'Material / by volume'", "with law 'hencky'", "do not mix"],
        {"Material/law": "hencky", "Material/by volume":
         "domain: E1 = 10, E2 = 1, nu12 = 0.2, G12 = 1"}),
    row("orthotropic volume without a constant", [
        "'Material / by volume'", "found no G12 of domain"],
        {"Material/by volume": "domain: E1 = 10, E2 = 1, nu12 = 0.2"}),
    row("orientation of a finite strain law", [
        "'Material / orientation'", "found '30' with law 'hencky'"],
        {"Material/law": "hencky", "Material/orientation": "30"}),
    row("orientation in time", ["'Material / orientation'", "'30*t'",
                                "do not turn in time"], ORTHOTROPIC,
        {"Material/orientation": "30*t"}),
    row("orientation that is no expression", [
        "'Material / orientation'", "steep"], ORTHOTROPIC,
        {"Material/orientation": "steep"}),
    row("orientation that is no number somewhere", [
        "'Material / orientation'", "log(x - 2)"], ORTHOTROPIC,
        {"Material/orientation": "log(x - 2)"}),
    row("turn about an unknown axis", ["'Material / orientation'", "'w'"],
        SOLID, {"Material/orientation": "x = 30, w = 3"}),
    row("negative density", ["'Material / density'", "found '-1'",
                             "a number >= 0"], {"Material/density": "-1"}),
    row("by volume: negative density", ["density of domain", "found -1",
                                        "a number >= 0"],
        {"Material/by volume": "domain: density = -1"}),
]

STRENGTHS = dict(ORTHOTROPIC, **{
    "Cracks/growth": "bonds",
    "Cracks/criterion": "tsai-hill",
    "Cracks/strengths": "X = 10, Y = 3, S = 2",
    "Material/by volume": "domain: density = 2",
})

MATERIALS += [
    row("no strengths", ["'Cracks / strengths'", "no X (or 0)", "no Y", "no S",
                         "The criterion is 'tsai-hill'"], STRENGTHS,
        {"Cracks/strengths": None}, n_errors=3),
    row("one strength missing", ["'Cracks / strengths'", "no S",
                                 "a number > 0",
                                 "The criterion is 'maximum stress'"],
        STRENGTHS, {"Cracks/strengths": "X = 10, Y = 3",
                    "Cracks/criterion": "maximum stress"}),
    row("negative strength", ["'Cracks / strengths'", "Y = -3",
                              "a number > 0"], STRENGTHS,
        {"Cracks/strengths": "X = 10, Y = -3, S = 2"}),
    row("unknown strength", ["'Cracks / strengths'", "component 'Z'",
                             "X, Y, S"], STRENGTHS,
        {"Cracks/strengths": "X = 10, Z = 3, S = 2"}),
    row("stronger across the fibres than Hill allows", [
        "'Cracks / strengths'", "Y = 20 with X = 10", "Y less than 2 X"],
        STRENGTHS, {"Cracks/strengths": "X = 10, Y = 20, S = 2"}),
    row("strengths of a criterion without them", [
        "'Cracks / strengths'", "with criterion 'critical energy'",
        "tsai-hill, maximum stress"], STRENGTHS,
        {"Cracks/criterion": "critical energy", "Cracks/fracture energy": "1"}),
    row("strengths of an unknown volume", [
        "'Cracks / strengths by volume'", "'domian'", "did you mean 'domain'",
        "'Material / by volume'"], STRENGTHS,
        {"Cracks/strengths by volume": "domian: X = 10"}),
    row("negative strength of a volume", [
        "'Cracks / strengths by volume'", "X = -10 of domain"], STRENGTHS,
        {"Cracks/strengths by volume": "domain: X = -10"}),
    row("interface of one volume", [
        "'Cracks / interface strengths'", "'domain'", "two volumes"],
        STRENGTHS,
        {"Cracks/interface strengths": "domain: X = 10, Y = 3, S = 2"}),
    row("interface with an unknown volume", [
        "'Cracks / interface strengths'", "'resin'", "rest, domain"],
        STRENGTHS,
        {"Cracks/interface strengths": "resin, domain: X = 10, Y = 3, S = 2"}),
    row("interface with a strength missing", [
        "'Cracks / interface strengths'", "no S (or 0) of rest, domain"],
        STRENGTHS,
        {"Cracks/interface strengths": "rest, domain: X = 10, Y = 3"}),
    row("interface given twice", [
        "'Cracks / interface strengths'", "'rest, domain' again",
        "in either order"], STRENGTHS, {"Cracks/interface strengths":
        "domain, rest: X = 10, Y = 3, S = 2; rest, domain: X = 9, Y = 3, S = 2"}),
    row("volume with the name of the rest", [
        "'Material / by volume'", "a volume named 'rest'"],
        {"Material/by volume": "rest: density = 2"}),
    row("fracture energy of bonds of an orthotropic law", [
        "'Cracks / critical stretch'", "a law that is not isotropic"],
        STRENGTHS, {"Cracks/criterion": "critical stretch",
                    "Cracks/fracture energy": "1", "Cracks/strengths": None}),
    row("strain criterion without strain of the thickness", [
        "'Cracks / criterion'", "'equivalent strain' in plane stress",
        "nu13 and nu23"], STRENGTHS,
        {"Cracks/criterion": "equivalent strain", "Cracks/strengths": None,
         "Cracks/critical equivalent strain": "0.1"}),
]
