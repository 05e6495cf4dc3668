"""A manufactured solution on a body that is not convex: every face loaded by formulas, displacement measured.

u = A sin(w t) (sin k(X+Y), sin k(Y+Z), sin k(Z+X)), whose stress P gives tractions P N on its faces and the body force
u'' - Div P / rho. With a = A k sin(w t) cos k(X+Y) and so b, c, the deformation gradient is

    F = [1+a  a  0;  0  1+b  b;  c  0  1+c],   Lap u = -2 k^2 u,   grad a = -k^2 u_x (1, 1, 0), and so b, c.
"""

import math
from statistics import geometric_mean

import vtu
from measures import number_or_blank, percent

DENSITY, YOUNG, POISSON = 1100, 17e6, 0.3
MU, LAMBDA = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
KAPPA = LAMBDA + 2 * MU / 3
WAVE, FREQUENCY, END = 50, 5000, 4e-4
PHASES = ("X+Y", "Y+Z", "Z+X")
FACES = {"x_min": (-1, 0, 0), "x_max": (1, 0, 0), "y_min": (0, -1, 0), "y_max": (0, 1, 0), "z_min": (0, 0, -1),
         "z_max": (0, 0, 1), "inner_x": (1, 0, 0), "inner_y": (0, 1, 0)}


def total(terms):
    return "+".join(f"({term})" for term in terms if term != "0") or "0"


def product(*factors):
    return "0" if "0" in factors else "*".join(f"({factor})" for factor in factors)


class Solution:
    """Formulas of a law, of displacements of `amplitude` m."""

    def __init__(self, law, amplitude):
        self.law, self.amplitude = law, amplitude
        self.u = [f"{amplitude:g}*sin({FREQUENCY}*t)*sin({WAVE}*({phase}))" for phase in PHASES]
        self.v = [f"{amplitude * FREQUENCY:g}*cos({FREQUENCY}*t)*sin({WAVE}*({phase}))" for phase in PHASES]
        a, b, c = self.slopes = [f"{amplitude * WAVE:g}*sin({FREQUENCY}*t)*cos({WAVE}*({phase}))" for phase in PHASES]
        self.F = [[f"1+{a}", a, "0"], ["0", f"1+{b}", b], [c, "0", f"1+{c}"]]
        self.P, divergence, self.p = self.linear() if law == "linear_elastic" else self.neo_hookean()
        self.force = [f"{-FREQUENCY**2}*({self.u[i]})-({divergence[i]})/{DENSITY}" for i in range(3)]

    def slope_gradients(self):
        """grad a, grad b, grad c."""
        x, y, z = (f"{-WAVE**2}*{u}" for u in self.u)
        return [[x, x, "0"], ["0", y, y], [z, "0", z]]

    def linear(self):
        a, b, c = self.slopes
        swell = total(self.slopes)
        strain = [[a, f"0.5*({a})", f"0.5*({c})"], [f"0.5*({a})", b, f"0.5*({b})"], [f"0.5*({c})", f"0.5*({b})", c]]
        P = [[total([product(str(2 * MU), strain[i][j]), product(str(LAMBDA), swell) if i == j else "0"])
              for j in range(3)] for i in range(3)]
        gradients = self.slope_gradients()
        divergence = [total([f"{-2 * WAVE**2 * MU}*{self.u[i]}"] + [product(str(LAMBDA + MU), g[i]) for g in gradients])
                      for i in range(3)]
        return P, divergence, product(str(KAPPA), swell)

    def neo_hookean(self):
        """P = mu J^(-2/3) F + q H, q = kappa (J-1) - mu/3 J^(-5/3) F:F; Div H = 0."""
        a, b, c = (f"({slope})" for slope in self.slopes)
        J = f"((1+{a})*(1+{b})*(1+{c})+{a}*{b}*{c})"
        J_by = [f"(1+{q})*(1+{r})+{q}*{r}" for q, r in ((b, c), (c, a), (a, b))]
        squares = "(" + "+".join(f"(1+{s})^2+{s}^2" for s in (a, b, c)) + ")"
        H = [[f"(1+{b})*(1+{c})", f"{b}*{c}", f"-(1+{b})*{c}"], [f"-{a}*(1+{c})", f"(1+{a})*(1+{c})", f"{a}*{c}"],
             [f"{a}*{b}", f"-{b}*(1+{a})", f"(1+{a})*(1+{b})"]]
        q = f"{KAPPA}*({J}-1)-{MU / 3}*{J}^(-5/3)*{squares}"
        P = [[total([product(f"{MU}*{J}^(-2/3)", self.F[i][j]), product(q, H[i][j])]) for j in range(3)] for i in range(3)]
        gradients = self.slope_gradients()
        grad_J = [total([product(J_by[s], gradients[s][j]) for s in range(3)]) for j in range(3)]
        grad_squares = [total([product(f"2+4*{(a, b, c)[s]}", gradients[s][j]) for s in range(3)]) for j in range(3)]
        grad_q = [total([product(f"{KAPPA}+{5 * MU / 9}*{J}^(-8/3)*{squares}", grad_J[j]),
                         product(f"{-MU / 3}*{J}^(-5/3)", grad_squares[j])]) for j in range(3)]
        divergence = [total([f"{-2 * WAVE**2 * MU}*{J}^(-2/3)*{self.u[i]}"] +
                            [product(f"{-2 * MU / 3}*{J}^(-5/3)", self.F[i][j], grad_J[j]) for j in range(3)] +
                            [product(H[i][j], grad_q[j]) for j in range(3)]) for i in range(3)]
        return P, divergence, f"{KAPPA}*({J}-1)"

    def keys(self):
        """What a case needs of it."""
        boundary = [dict(type="body_force", acceleration=self.force)]
        for face, normal in FACES.items():
            axis = next(i for i in range(3) if normal[i])
            traction = [product(str(normal[axis]), self.P[i][axis]) for i in range(3)]
            boundary.append(dict(on=face, type="traction", traction=traction))
        start = [v.replace(f"cos({FREQUENCY}*t)*", "") for v in self.v]
        return dict(material__law=self.law, initial=[dict(velocity=start)], boundary=boundary,
                    exact=dict(displacement=self.u, velocity=self.v, pressure=self.p))

    def stress_error(self, run):
        """Relative L2 error of Cauchy's stress in the last frame."""
        scope = {"sin": math.sin, "cos": math.cos}
        python = [[compile(term.replace("^", "**"), term[:20], "eval") for term in row] for row in self.P + self.F]
        stress = vtu.read_array(run.frames()[-1][1], "Stress")
        volume = vtu.read_array(run.folder / "cloud.vtp", "volume")
        error = size = 0.0
        for n, (X, Y, Z) in enumerate(vtu.read_points(run.folder / "cloud.vtp")):
            rows = [[eval(term, scope, {"X": X, "Y": Y, "Z": Z, "t": run["time"]}) for term in row] for row in python]
            P, F = rows[:3], rows[3:]
            J = determinant(F)
            for k, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))):
                exact = sum(P[i][m] * F[j][m] for m in range(3)) / J
                weight = volume[n] * (1 if i == j else 2)
                error += weight * (stress[6 * n + k] - exact) ** 2
                size += weight * exact**2
        return math.sqrt(error / size)


def determinant(F):
    return (F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
            F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]))


STUDIES = (("linear_elastic", 1e-6, (1500, 4500, 12000, 30000)), ("neo_hookean", 1e-3, (1500, 4500, 12000)))
SEEDS = (1, 2, 3)


def manufactured(bench):
    table = bench.grid("manufactured", "law", "cloud", "particles", "u", "order", "v", "order", "p", "order", "stress", "order")
    for law, amplitude, counts in STUDIES[:1] if bench.short else STUDIES:
        for relax_seeds in (0, 20):
            refine(bench, table, Solution(law, amplitude), (500, 1500) if bench.short else counts, relax_seeds)


def refine(bench, table, solution, counts, relax_seeds):
    """Rows of geometric means over the seeds: a cloud's own luck changes its error by a tenth, which between clouds of a
    third more particles along an edge is 0.3 of the order."""
    rows = []
    for count in counts:
        clouds = [errors_of_cloud(bench, solution, count, relax_seeds, seed) for seed in (SEEDS[:1] if bench.short else SEEDS)]
        rows.append([geometric_mean(values) for values in zip(*clouds)])
        orders = [None] * 4
        if len(rows) > 1:
            orders = orders_between(*rows[-2:])
            bench.require_above(f"order of the displacement, {solution.law}, {count}", orders[0], 1.7)
        cells = [cell for pair in zip(map(percent, rows[-1][1:]), map(number_or_blank, orders)) for cell in pair]
        table.row(solution.law, "relaxed" if relax_seeds else "two-pass", round(rows[-1][0]), *cells)
    bench.require_above(f"order of the displacement, {solution.law}, {'relaxed' if relax_seeds else 'raw'}",
                        orders_between(rows[0], rows[-1])[0], 1.7)


def orders_between(coarse, fine):
    """Of errors behind the number of particles, by (volume / particles)^(1/3)."""
    refined = math.log(fine[0] / coarse[0]) / 3
    return [math.log(before / now) / refined for before, now in zip(coarse[1:], fine[1:])]


def errors_of_cloud(bench, solution, count, relax_seeds, seed):
    run = bench.run("l_part/manufactured.toml", f"{solution.law}-{relax_seeds}-{count}-{seed}", particles__count=count,
                    particles__relax_seeds=relax_seeds, particles__seed=seed, **solution.keys())
    norms = [run[f"error.l2_{field}_relative"] for field in ("displacement", "velocity", "pressure")]
    return run["particles"], *norms, solution.stress_error(run)


SCENES = {"manufactured": manufactured}
