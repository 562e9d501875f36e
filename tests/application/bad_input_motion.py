"""Bad input, fourth part: motion and relaxation."""

from bad_input_files import row
from case_files import NO_SUPPORTS

MOVES = {"Time integration/scheme": "explicit", "Material/density": "1"}
IMPLICIT = {"Time integration/scheme": "implicit", "Material/density": "1"}

MOTION = [
    row("time step above the limit", [
        "'Time integration / time step'", "found 100", "allowed: at most",
        "stability limit of this mesh"], MOVES,
        {"Time integration/time step": "100"}),
    row("motion without density", [
        "'Material / density'", "nothing or 0", "scheme = explicit"],
        {"Time integration/scheme": "explicit"}),
    row("implicit motion without density", [
        "'Material / density'", "nothing or 0", "scheme = implicit"],
        {"Time integration/scheme": "implicit"}),
    row("unknown scheme", ["'Time integration / scheme'", "explcit",
                           "Did you mean 'explicit'?"],
        {"Time integration/scheme": "explcit"}),
    row("start of a body at rest", [
        "'Time integration / initial velocity'", "with scheme 'static'"],
        {"Time integration/initial velocity": "x = 1"}),
    row("initial velocity without an end", [
        "'Time integration / initial velocity'"], MOVES,
        {"Time integration/initial velocity": "x = 1/(x-x)"}),
    row("initial velocity in no direction", [
        "'Time integration / initial velocity'", "'w'"], MOVES,
        {"Time integration/initial velocity": "w = 1"}),
    row("motion of a rigid plate", [
        "'Boundary conditions / rigid plate'", "with scheme 'implicit'",
        "displacement, symmetry"], IMPLICIT, NO_SUPPORTS,
        {"Boundary conditions/rigid plate": "left: x = 0, y = 0"}),
    row("relaxation with a mean displacement", [
        "'Boundary conditions / mean displacement'",
        "with scheme 'relaxation'"],
        {"Time integration/scheme": "relaxation"}, NO_SUPPORTS,
        {"Boundary conditions/mean displacement":
         "left: x = 0, y = 0, rotation = 0"}),
    row("motion with blended forces", [
        "'Peridynamics / coupling'", "'force blending' with scheme"], MOVES,
        {"Peridynamics/coupling": "force blending"}),
    row("motion along an arc", ["'Load steps / control'", "'arc length'"],
        MOVES, {"Load steps/control": "arc length"}),
    row("segments that grow in motion", [
        "'Cracks / growth'", "'segments' with scheme 'explicit'",
        "none, bonds"], MOVES,
        {"Cracks/growth": "segments", "Cracks/fracture energy": "1",
         "Cracks/pre-cracks": "edge: 0 0.51 to 0.4 0.51"}),
    row("energy of bonds in motion", [
        "'Cracks / criterion'", "'critical energy' with scheme"], MOVES,
        {"Cracks/growth": "bonds", "Cracks/fracture energy": "1"}),
    row("output after the end", [
        "'Time integration / output interval'", "at most the end time"],
        MOVES, {"Time integration/output interval": "2"}),
]
