"""The studies of docs/accuracy.md: both schemes on lattices, jittered lattices and irregular clouds, in space and in the plane."""

import json
import math
import subprocess
import tempfile

from common import ROOT
from measures import percent
from swinging import Wave, errors

SEEDS = (1, 2, 3)


class Cloud:
    """A kind of cloud and the sizes it is refined by: points on an edge of lattices, particles of others."""

    def __init__(self, words, sizes, seeds=(1,), schemes=("consistent", "thesis"), solver=None, **particles):
        self.words, self.sizes, self.seeds, self.schemes = words, sizes, seeds, schemes
        self.solver = solver or {}
        self.particles = particles

    def keys(self, size, seed, dimension):
        count = size**dimension if self.particles["arrangement"] == "lattice" else size
        particles = {"count": count, "seed": seed, "relax_seeds": 0, **self.particles}
        return {**{f"solver__{key}": value for key, value in self.solver.items()},
                **{f"particles__{key}": value for key, value in particles.items()}}


RELAXED = dict(arrangement="voronoi", relax_seeds=20, relax=20)
IN_SPACE = (
    Cloud("lattice", (9, 17, 25), arrangement="lattice"),
    Cloud("jittered lattice", (9, 17, 25), arrangement="lattice", jitter=0.3),
    Cloud("jittered lattice, κ = 2", (9, 17, 25), schemes=("consistent",), solver={"residual": 2}, arrangement="lattice", jitter=0.3),
    Cloud("two-pass", (700, 2250, 7000), SEEDS, arrangement="voronoi"),
    Cloud("two-pass, seeds relaxed", (900, 2700, 8100), arrangement="voronoi", relax_seeds=20),
    Cloud("two-pass, relaxed", (900, 2700, 8100), **RELAXED),
    Cloud("two-pass, relaxed, 18 neighbours", (900, 2700, 8100), schemes=("consistent",), solver={"neighbours": 18}, **RELAXED),
    Cloud("Poisson, relaxed", (700, 2250, 7000), arrangement="poisson", relax=20))
IN_THE_PLANE = (
    Cloud("lattice", (9, 17, 33, 65), arrangement="lattice"),
    Cloud("jittered lattice", (9, 17, 33, 65), arrangement="lattice", jitter=0.3),
    Cloud("two-pass", (250, 1000, 4000, 16000), SEEDS, arrangement="voronoi"),
    Cloud("two-pass, relaxed", (250, 1000, 4000, 16000), **RELAXED),
    Cloud("Poisson, relaxed", (250, 1000, 4000, 16000), arrangement="poisson", relax=20))
FIELDS = {"velocity": "v", "displacement": "u", "pressure": "p", "stress": "stress"}


def mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def measure(bench, case, wave, quarter, cloud, scheme, size):
    """Particles and errors, geometric means over the seeds: velocity at a quarter of the period, the rest at an eighth."""
    particles, found = [], []
    for seed in cloud.seeds:
        name = f"{case[:-5]}-{cloud.words}-{scheme}-{size}-{seed}".replace(" ", "-").replace(",", "").replace("/", "-")
        run = bench.run(f"swinging_cube/{case}", name, end_time=quarter, frames=2, rows=2, solver__scheme=scheme,
                        **cloud.keys(size, seed, wave.dimension))
        bench.require(run.good, f"{name} comes to its end")
        half, end = errors(run, wave, quarter / 2), errors(run, wave, quarter)
        found.append({**half, "velocity": end["velocity"]})
        particles.append(run["particles"])
        bench.costs[case, cloud.words, scheme, size] = run
    return mean(particles), {field: mean([one[field] for one in found]) for field in FIELDS}


def order(coarse, fine, field, dimension):
    return dimension * math.log(coarse[1][field] / fine[1][field]) / math.log(fine[0] / coarse[0])


def study(bench, name, case, dimension, quarter, clouds):
    """Refines each cloud with each scheme; returns {(cloud, scheme): [(particles, errors)]}."""
    table = bench.grid(name, "cloud", "scheme", "particles", *[cell for words in FIELDS.values() for cell in (words, "order")])
    orders = bench.grid(name + ".orders", "cloud", "scheme", *FIELDS.values())
    results = {}
    for cloud in clouds:
        for scheme in cloud.schemes:
            line = []
            for size in cloud.sizes[:2] if bench.short else cloud.sizes:
                line.append(measure(bench, case, Wave(dimension), quarter, cloud, scheme, size))
                cells = [cell for field in FIELDS
                         for cell in (percent(line[-1][1][field]),
                                      f"{order(*line[-2:], field, dimension):.2f}" if len(line) > 1 else "")]
                table.row(cloud.words, scheme, round(line[-1][0]), *cells)
            orders.row(cloud.words, scheme, *[f"{order(line[0], line[-1], field, dimension):.2f}" for field in FIELDS])
            results[cloud.words, scheme] = line
    return results


def cube(bench):
    results = study(bench, "cube", "voronoi.toml", 3, 0.004, IN_SPACE)
    at = lambda words, k, field="velocity": results[words, "consistent"][k][1][field]
    overall = lambda words, field: order(results[words, "consistent"][0], results[words, "consistent"][-1], field, 3)
    for words, velocity, pressure in (("lattice", 1.9, 1), ("two-pass", 1.5, 1), ("two-pass, relaxed", 1.7, 1)):
        bench.require_above(f"order of velocity, {words}", overall(words, "velocity"), velocity)
        bench.require_above(f"order of pressure, {words}", overall(words, "pressure"), pressure)
    bench.require_below("velocity, two-pass of 2250", at("two-pass", 1), 0.06)
    bench.require_below("velocity, relaxed two-pass of 2700", at("two-pass, relaxed", 1), 0.012)
    if not bench.short:
        bench.require_below("velocity, lattice of 25", at("lattice", 2), 0.002)
        bench.require_below("velocity, jittered of 25, κ = 2", at("jittered lattice, κ = 2", 2), 0.003)
        time_to_one_percent(bench, results)
    draw(bench, "accuracy_cube", results, 3)


def square(bench):
    results = study(bench, "square", "square.toml", 2, 0.0049, IN_THE_PLANE)
    for words in ("lattice", "two-pass, relaxed"):
        line = results[words, "consistent"]
        bench.require_above(f"order of velocity in the plane, {words}", order(line[0], line[-1], "velocity", 2), 1.7)
    draw(bench, "accuracy_square", results, 2)


def time_to_one_percent(bench, results):
    """Particles and seconds at which the velocity is off by 1 %: where power laws through the last two refinements pass it."""
    table = bench.grid("time", "cloud", "scheme", "particles", "steps", "µs a particle and step", "s")
    seconds = {}
    for cloud in IN_SPACE:
        if cloud.words not in ("lattice", "two-pass, relaxed"):
            continue
        for scheme in cloud.schemes:
            line = results[cloud.words, scheme]
            pair = min(zip(line, line[1:]), key=lambda two: abs(math.log(two[0][1]["velocity"] * two[1][1]["velocity"] / 1e-4)))
            rate = order(*pair, "velocity", 3)
            run = bench.costs["voronoi.toml", cloud.words, scheme, cloud.sizes[-1]]
            if rate < 0.3:
                table.row(cloud.words, scheme, "never")
                continue
            particles = pair[1][0] * (pair[1][1]["velocity"] / 0.01) ** (3 / rate)
            steps = max(1, round(run["steps"] * (particles / run["particles"]) ** (1 / 3)))
            cost = run["us_per_particle_step"]
            seconds[cloud.words, scheme] = particles * steps * cost * 1e-6
            table.row(cloud.words, scheme, f"{particles:.2g}", steps, f"{cost:.2f}", f"{seconds[cloud.words, scheme]:.2g}")
    ratio = seconds["lattice", "thesis"] / seconds["lattice", "consistent"]
    table.row("lattice: thesis over consistent", "", "", "", "", f"{ratio:.2g}")
    bench.require_above("time to 1 % on lattices, thesis over consistent", ratio, 1000)


def draw(bench, name, results, dimension):
    """docs/NAME.png by the program's own charts: spacing against error, both schemes, with slopes 1 and 2."""
    if not bench.pictures:
        return
    length = lambda particles: particles ** (-1 / dimension)
    charts = []
    for field, words in (("velocity", "velocity, a quarter of the period"), ("pressure", "pressure, an eighth")):
        curves = []
        for (cloud, scheme), line in results.items():
            if "κ" in cloud or "neighbours" in cloud or "seeds" in cloud:
                continue
            curves.append(dict(label=f"{cloud}, {scheme}", x=[length(n) for n, _ in line], y=[100 * e[field] for _, e in line],
                               dots=False, dashed=scheme == "thesis", bars=False))
        x = [min(c for curve in curves for c in curve["x"]), max(c for curve in curves for c in curve["x"])]
        for slope, start in ((1, 30), (2, 0.6 if field == "velocity" else 1)):
            curves.append(dict(label=f"slope {slope}", x=x, y=[start * (c / x[0 if slope == 2 else 1]) ** slope for c in x],
                               dots=False, dashed=True, bars=False))
        charts.append(dict(title=f"Relative L2 error of the {words}", x_title="spacing (volume / particles)^(1/d), m", y_title="error, %",
                           log_x=True, log_y=True, curves=curves))
    job = dict(drawings=[], plots=[dict(file=str(ROOT / f"docs/{name}.png"), charts=charts, beside=False)])
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(job, file)
        file.flush()
        said = subprocess.run(["xvfb-run", "-a", str(bench.program.parent / "tessera-render"), file.name], capture_output=True,
                              text=True).stdout
    bench.say("  " + said.strip())
    bench.require("file:" in said, f"docs/{name}.png is drawn")


STUDIES = {"cube": cube, "square": square}
