"""Measures of pressure noise in a run's frames on lattices, and words for tables."""

import math

import vtu

KAPPA = {0: "0", 1 / 32: "1/32", 0.125: "1/8", 0.25: "1/4"}


def line_neighbours(points):
    """Of a lattice: (i, before, after) for every particle and axis on which it has a neighbour either side."""
    gaps = [min((abs(p[k] - points[0][k]) for p in points if abs(p[k] - points[0][k]) > 1e-9), default=None) for k in range(3)]
    spacing = min(gap for gap in gaps if gap)
    place = {tuple(round((p[k] - points[0][k]) / spacing) for k in range(3)): i for i, p in enumerate(points)}
    triples = []
    for cell, i in place.items():
        for k in range(3):
            sides = [place.get(tuple(c + step * (j == k) for j, c in enumerate(cell))) for step in (-1, 1)]
            if None not in sides:
                triples.append((i, *sides))
    return triples


def roughness(run, time, inside=None):
    """How much of a frame's pressure changes from particle to particle: the root mean square of second differences along
    the lattice's lines, p - (p_before + p_after)/2, over that of the pressure. Linear fields have 0, a checkerboard 2.
    `inside(X)` picks particles by their reference positions."""
    points = vtu.read_points(run.folder / "cloud.vtp")
    pressure = vtu.read_array(run.frame_near(time), "Pressure")
    inside = inside or (lambda X: True)
    triples = [(i, a, b) for i, a, b in line_neighbours(points) if inside(points[i])]
    second = sum((pressure[i] - 0.5 * (pressure[a] + pressure[b])) ** 2 for i, a, b in triples) / len(triples)
    chosen = [p for p, X in zip(pressure, points) if inside(X)]
    return math.sqrt(second / (sum(p * p for p in chosen) / len(chosen)))


def hourglass(run, time, axis=2, beginning=1.0):
    """The part of a frame's pressure that alternates from particle to particle along an axis of the lattice: the root mean
    square of (p_2 - 4 p_1 + 6 p - 4 p_-1 + p_-2)/16, which is 1 for (-1)^k and next to nothing for what is smooth, over that
    of the pressure. Up to `beginning` from the lattice's end, where a clamp makes layers, it is not taken."""
    points = vtu.read_points(run.folder / "cloud.vtp")
    pressure = vtu.read_array(run.frame_near(time), "Pressure")
    lines = {}
    for i, X in enumerate(points):
        lines.setdefault(tuple(round(x, 6) for k, x in enumerate(X) if k != axis), []).append((X[axis], i))
    alternating, count = 0.0, 0
    for line in lines.values():
        p = [pressure[i] for z, i in sorted(line) if z > beginning - 1e-6]
        for k in range(2, len(p) - 2):
            alternating += ((p[k - 2] - 4 * p[k - 1] + 6 * p[k] - 4 * p[k + 1] + p[k + 2]) / 16) ** 2
            count += 1
    return math.sqrt(alternating / count / (sum(p * p for p in pressure) / len(pressure)))


def tied(formulation, xi):
    """κ4 of J and the involution of the formulations that have a J of their own."""
    return {"solver__jst4_J": 0.125, "solver__involution": xi} if "J" in formulation else {}


def total_energy(run, i):
    return run.history["kinetic_J"][i] + run.history["internal_J"][i]


def outcome(run):
    return "to the end" if run.good else f"stops at {run.history['time_s'][-1]:.3g} s"


def percent(share):
    return "" if share is None else f"{100 * share:.3g} %"


def number_or_blank(value):
    return "" if value is None else f"{value:.2g}"


def component_sum(run):
    """L1 of the swinging cube's velocity with |ex| + |ey| + |ez| in place of the length of e."""
    points = vtu.read_points(run.folder / "cloud.vtp")
    volume = vtu.read_array(run.folder / "cloud.vtp", "volume")
    velocity = vtu.read_array(run.frames()[-1][1], "Velocity")
    frequency = 392.42437086993
    speed = -5e-4 * frequency * math.sin(frequency * run["time"])
    total = 0.0
    for a, X in enumerate(points):
        sine, cosine = [math.sin(math.pi * x / 2) for x in X], [math.cos(math.pi * x / 2) for x in X]
        for i in range(3):
            exact = speed * sine[i] * cosine[(i + 1) % 3] * cosine[(i + 2) % 3]
            total += volume[a] * abs(velocity[3 * a + i] - exact)
    return total


def tie_of_J(bench, name, run):
    """What becomes of {p,F,J} as its J is smoothed (κ4 of J) and tied to det F (ξ): run(folder, **keys)."""
    grid = bench.grid(name, "formulation", "κ4 of J", "involution ξ", "comes", "steps", "smallest J", "energy balance error",
                      "energy at the end over that at the start")
    for kappa in (0, 1 / 32, 0.125):
        for xi in (0, 0.1, 0.2, 0.3, 0.5, 1):
            one = run(f"pFJ-{kappa:g}-{xi}", solver__formulation="pFJ", solver__jst4_J=kappa, solver__involution=xi)
            grid.row("{p,F,J}", KAPPA[kappa], xi, outcome(one), int(one.history["step"][-1]),
                     f"{min(one.history['smallest_volume_ratio']):.3f}", f"{max(one.history['balance_error']):.1e}",
                     f"{total_energy(one, -1) / total_energy(one, 0):.3f}" if one.good else "")
