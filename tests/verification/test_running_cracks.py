"""Cracks that run while waves do: the direction that they take under impact (Kalthoff
and Winkler) and their speed. --extent long adds the crack in glass.

References: experiments and published peridynamics, 62 to 70 degrees from the notch;
the speed of Rayleigh waves, which no crack in mode I reaches.
"""

import math

from verification import Study

KALTHOFF, BRANCHING = "kalthoff_winkler.prm", "dynamic_branching.prm"
TIP = (.05, .025)
# Which way bonds break on one mesh is a matter of chance within some degrees: the
# mean of these counts.
SPACINGS = (.0013, .0014, .0015, .0016, .0017)
ANGLE, REACH = 67., .04


def rayleigh_speed(young, poisson, density, plane_strain):
    """Root of the equation of Rayleigh waves in a plane body, by bisection."""
    shear = math.sqrt(young / (2. * (1. + poisson)) / density)
    modulus = (young * (1. - poisson) / ((1. + poisson) * (1. - 2. * poisson))
               if plane_strain else young / (1. - poisson**2))
    pressure = math.sqrt(modulus / density)

    def equation(speed):
        s, p = (speed / shear)**2, (speed / pressure)**2
        return (2. - s)**2 - 4. * math.sqrt((1. - s) * (1. - p))

    low, high = .1 * shear, shear
    for _ in range(60):
        middle = .5 * (low + high)
        low, high = ((middle, high) if equation(middle) < 0. else
                     (low, middle))
    return low


def path_angle(table):
    """Of the line of least squared distances from the middles of the broken bonds
    within reach of the tip, from the line of the notch [degrees]."""
    places = []
    for row in zip(*(table.get(name, []) for name in ("x1", "y1", "x2", "y2",
                                                      "share_left"))):
        place = ((row[0] + row[2]) / 2 - TIP[0], (row[1] + row[3]) / 2 - TIP[1])
        if row[4] == 0. and math.hypot(*place) < REACH:
            places.append(place)
    if not places:
        return math.nan
    x, y = (sum(values) / len(places) for values in zip(*places))
    xx = sum((place[0] - x)**2 for place in places)
    yy = sum((place[1] - y)**2 for place in places)
    xy = sum((place[0] - x) * (place[1] - y) for place in places)
    return math.degrees(.5 * math.atan2(2. * xy, xx - yy)) % 180.


def speed_rows(study, name, solution, tip, limit):
    """Of a crack that runs: beyond ten millimetres, before the last tenth."""
    table = solution.table("quantities")
    end = .9 * solution[tip + "_advance"]
    found = [speed for speed, advance in zip(table.get(tip + "_speed", []),
                                             table.get(tip + "_advance", []))
             if .01 < advance < end] or [math.nan]
    study.below(name + "largest speed over Rayleigh waves", max(found) / limit,
                1.)
    study.above(name + "smallest speed over Rayleigh waves",
                min(found) / limit, 0.)


def impact(study):
    if not study.part("impact between two notches"):
        return
    limit = rayleigh_speed(190e9, .3, 8000., True)
    angles = []
    for spacing in SPACINGS:
        solution = study.solve(KALTHOFF, {
            "Mesh/geometry parameters": "h = %g" % spacing,
            "Load steps/end time": 65e-6, "Load steps/number of steps": 65})
        name = "h = %g mm: " % (1e3 * spacing)
        angles.append(path_angle(solution.table("broken_bonds")))
        study.note("%sangle of the path %.1f" % (name, angles[-1]))
        study.above(name + "advance", solution["notch_tip1_advance"], REACH)
        speed_rows(study, name, solution, "notch_tip1", limit)
        study.below(name + "energy drift", solution["energy_drift"], .05)
    study.within("angle of the path, mean", sum(angles) / len(angles), ANGLE,
                 5.)


def branching(study):
    if not study.part("crack in glass"):
        return
    limit = rayleigh_speed(72e9, 1. / 3., 2440., False)
    solution = study.solve(BRANCHING)
    speed_rows(study, "", solution, "edge_tip1", limit)
    study.above("advance", solution["edge_tip1_advance"], .04)


def main():
    study = Study(__doc__, extent=["short", "long"])
    impact(study)
    if study.arguments.extent == "long":
        branching(study)
    study.finish()


if __name__ == "__main__":
    main()
