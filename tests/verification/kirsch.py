"""Full plate with a unit hole, half width 4, rays at equal angles, and the
exact infinite-plate displacement on its outer edges (numerics.md, section 6).
"""
import math

from msh_writer import write_msh

HALF_WIDTH = 4.
# Kirsch (1898), tension S = 1 along x, E = 1, nu = 1/3, plane stress.
EXACT = (
    "x = S/(8*G)*((k + 1)*x + 2*(1 + k)*x/(x^2 + y^2)"
    " + 2*(x^3 - 3*x*y^2)*(1/(x^2 + y^2)^2 - 1/(x^2 + y^2)^3)),"
    "y = S/(8*G)*((k - 3)*y + 2*(1 - k)*y/(x^2 + y^2)"
    " + 2*(3*x^2*y - y^3)*(1/(x^2 + y^2)^2 - 1/(x^2 + y^2)^3))")
PARAMETERS = """
set Mode = {mode}
subsection Mesh
  set file = kirsch.msh
end
subsection Material
  set Young's modulus = 1
  set Poisson's ratio = 0.333333333333333333
  set state           = plane stress
end
subsection Peridynamics
  set model              = {model}
  set around             = ball 0 0 1
  set core size          = 0.5
  set blending width     = 0.8
  set horizon ratio      = {ratio}
  set influence function = {influence}
  set gradient support    = {support}
  # what the table was measured with
  set stabilization scale = shear modulus
end
subsection Boundary conditions
  set displacement = outer: {exact}
end
subsection Expressions
  set constants = S = 1, G = 0.375, k = 2
end
subsection Quantities
  set stress concentration = hole
  set nominal stress       = 1
end
subsection Reference
  set displacement = {exact}
end
subsection Output
  set fields = false
end
"""


def write_case(folder, nt, mode, model="correspondence", ratio=2,
               support="horizon"):
    """Writes kirsch.prm and its mesh into a folder."""
    mesh(folder + "/kirsch.msh", nt)
    with open(folder + "/kirsch.prm", "w") as file:
        file.write(
            PARAMETERS.format(
                mode=mode,
                model=model,
                ratio=ratio,
                support=support,
                influence="cubic spline" if ratio == 3 else "gaussian",
                exact=EXACT))


def mesh(path, nt):
    """nt cells around, at equal angles on the hole and equal steps on the
    square, nt/4 along each ray, the last four times as long as the first: the
    mesh of the tables, found by matching their finite-element rows."""
    nr = nt // 4
    growth = 4.**(nr / (nr - 1))
    points, cells = [], []
    for k in range(nr + 1):
        s = (growth**(k / nr) - 1.) / (growth - 1.)
        for j in range(nt):
            angle = 2. * math.pi * j / nt
            side, step = divmod(j + nt // 8, nt // 4)
            t = HALF_WIDTH * (8. * step / nt - 1.)
            outer = [(HALF_WIDTH, t), (-t, HALF_WIDTH), (-HALF_WIDTH, -t),
                     (t, -HALF_WIDTH)][side % 4]
            points.append(((1. - s) * math.cos(angle) + s * outer[0],
                           (1. - s) * math.sin(angle) + s * outer[1]))
    for k in range(nr):
        for j in range(nt):
            n = (j + 1) % nt
            cells.append([
                k * nt + j, (k + 1) * nt + j, (k + 1) * nt + n, k * nt + n
            ])
    ring = lambda k: [[k * nt + j, k * nt + (j + 1) % nt] for j in range(nt)]
    write_msh(path, 2, points, cells, {"hole": ring(0), "outer": ring(nr)})
