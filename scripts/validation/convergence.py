"""The studies of docs/accuracy.md: both schemes on lattices, jittered lattices and irregular clouds, in space and in the plane."""

import collections
import json
import math
import subprocess
import tempfile
from statistics import geometric_mean

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

    def spacing(self, size, particles, dimension):
        """m: between a lattice's points, elsewhere (volume / particles)^(1/d)."""
        return 1 / (size - 1) if self.particles["arrangement"] == "lattice" else particles ** (-1 / dimension)

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
    Cloud("two-pass", (700, 2250, 7000, 20000), SEEDS, arrangement="voronoi"),
    Cloud("two-pass, κ = 2", (700, 2250, 7000, 20000), SEEDS, ("consistent",), {"residual": 2}, arrangement="voronoi"),
    Cloud("two-pass, seeds relaxed", (900, 2700, 8100), arrangement="voronoi", relax_seeds=20),
    Cloud("two-pass, relaxed", (900, 2700, 8100), **RELAXED),
    Cloud("two-pass, relaxed, 18 neighbours", (900, 2700, 8100), schemes=("consistent",), solver={"neighbours": 18}, **RELAXED),
    Cloud("Poisson, relaxed", (700, 2250, 7000), arrangement="poisson", relax=20))
IN_THE_PLANE = (
    Cloud("lattice", (9, 17, 33, 65), arrangement="lattice"),
    Cloud("jittered lattice", (9, 17, 33, 65), arrangement="lattice", jitter=0.3),
    Cloud("two-pass", (250, 1000, 4000, 16000), SEEDS, arrangement="voronoi"),
    Cloud("two-pass, seeds relaxed", (250, 1000, 4000, 16000), arrangement="voronoi", relax_seeds=20),
    Cloud("two-pass, relaxed", (250, 1000, 4000, 16000), **RELAXED),
    Cloud("Poisson, relaxed", (250, 1000, 4000, 16000), arrangement="poisson", relax=20))
Refinement = collections.namedtuple("Refinement", "particles spacing errors")
FIELDS = {"velocity": "v", "displacement": "u", "pressure": "p", "stress": "stress"}


def measure(bench, case, wave, quarter, cloud, scheme, size):
    """A refinement, its errors geometric means over the seeds: velocity at a quarter of the period, the rest at an eighth."""
    particles, found = [], []
    for seed in cloud.seeds:
        name = "-".join([case[:-5], cloud.words, scheme, str(size), str(seed), *[f"{k}={v}" for k, v in cloud.solver.items()]])
        name = name.replace(" ", "-").replace(",", "")
        keys = cloud.keys(size, seed, wave.dimension)
        particles_asked = (case, *[(key, value) for key, value in keys.items() if key.startswith("particles")])
        run = bench.run(f"swinging_cube/{case}", name, end_time=quarter, frames=2, rows=2, solver__scheme=scheme,
                        cloud=bench.clouds.get(particles_asked), **keys)
        if not run.good:
            raise SystemExit(f"{name}: {run.error}")
        bench.clouds.setdefault(particles_asked, run.folder / "cloud.vtp")
        half, end = errors(run, wave, quarter / 2), errors(run, wave, quarter)
        found.append({**half, "velocity": end["velocity"]})
        particles.append(run["particles"])
        bench.costs[case, cloud.words, scheme, size] = run
    particles = geometric_mean(particles)
    return Refinement(particles, cloud.spacing(size, particles, wave.dimension),
                      {field: geometric_mean([one[field] for one in found]) for field in FIELDS})


def order(coarse, fine, field):
    return math.log(coarse.errors[field] / fine.errors[field]) / math.log(coarse.spacing / fine.spacing)


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
                         for cell in (percent(line[-1].errors[field]),
                                      f"{order(*line[-2:], field):.2f}" if len(line) > 1 else "")]
                table.row(cloud.words, scheme, round(line[-1].particles), *cells)
            orders.row(cloud.words, scheme, *[f"{order(line[0], line[-1], field):.2f}" for field in FIELDS])
            results[cloud.words, scheme] = line
    return results


def cube(bench):
    results = study(bench, "cube", "voronoi.toml", 3, 0.004, IN_SPACE)
    at = lambda words, k, field="velocity": results[words, "consistent"][k].errors[field]
    overall = lambda words, field: order(results[words, "consistent"][0], results[words, "consistent"][-1], field)
    for words, velocity, pressure in (("lattice", 1.9, 1), ("two-pass", 1.5, 1), ("two-pass, relaxed", 1.7, 1)):
        bench.require_above(f"order of velocity, {words}", overall(words, "velocity"), velocity)
        bench.require_above(f"order of pressure, {words}", overall(words, "pressure"), pressure)
    bench.require_below("velocity, two-pass of 2250", at("two-pass", 1), 0.06)
    bench.require_below("velocity, relaxed two-pass of 2700", at("two-pass, relaxed", 1), 0.012)
    if not bench.short:
        bench.require_below("velocity, lattice of 25", at("lattice", 2), 0.002)
        bench.require_below("velocity, jittered of 25, κ = 2", at("jittered lattice, κ = 2", 2), 0.003)
        time_to_one_percent(bench, results)
    draw(bench, "accuracy_cube", results)


def square(bench):
    results = study(bench, "square", "square.toml", 2, 0.0049, IN_THE_PLANE)
    for words in ("lattice", "two-pass, relaxed"):
        line = results[words, "consistent"]
        bench.require_above(f"order of velocity in the plane, {words}", order(line[0], line[-1], "velocity"), 1.7)
    draw(bench, "accuracy_square", results)


def time_to_one_percent(bench, results):
    """Particles and seconds at which the velocity is off by 1 %: where power laws through the last two refinements pass it."""
    table = bench.grid("time", "cloud", "scheme", "particles", "steps", "µs a particle and step", "s")
    seconds = {}
    for cloud in IN_SPACE:
        if cloud.words not in ("lattice", "two-pass, relaxed"):
            continue
        for scheme in cloud.schemes:
            line = results[cloud.words, scheme]
            pair = min(zip(line, line[1:]), key=lambda two: abs(math.log(two[0].errors["velocity"] * two[1].errors["velocity"] / 1e-4)))
            rate = order(*pair, "velocity")
            run = bench.costs["voronoi.toml", cloud.words, scheme, cloud.sizes[-1]]
            if rate < 0.3:
                table.row(cloud.words, scheme, "never")
                continue
            particles = pair[1].particles * (pair[1].errors["velocity"] / 0.01) ** (3 / rate)
            steps = max(1, round(run["steps"] * (particles / run["particles"]) ** (1 / 3)))
            cost = run["us_per_particle_step"]
            seconds[cloud.words, scheme] = particles * steps * cost * 1e-6
            table.row(cloud.words, scheme, f"{particles:.2g}", steps, f"{cost:.2f}", f"{seconds[cloud.words, scheme]:.2g}")
    ratio = seconds["lattice", "thesis"] / seconds["lattice", "consistent"]
    table.row("lattice: thesis over consistent", "", "", "", "", f"{ratio:.2g}")
    bench.require_above("time to 1 % on lattices, thesis over consistent", ratio, 1000)


def draw(bench, name, results):
    """docs/NAME.png by the program's own charts: spacing against error, both schemes, with slopes 1 and 2."""
    if not bench.pictures:
        return
    charts = []
    for field, words in (("velocity", "velocity, a quarter of the period"), ("pressure", "pressure, an eighth")):
        drawn = {key: line for key, line in results.items() if (key[0], "thesis") in results}
        x = [one.spacing for line in drawn.values() for one in line]
        curves = {key: dict(label=key[0] if key[1] == "consistent" else f"{key[0]}, thesis", x=[one.spacing for one in line],
                            y=[100 * one.errors[field] for one in line], dots=False, dashed=key[1] == "thesis", bars=False)
                  for key, line in drawn.items()}
        slopes = [dict(label=f"slope {slope}", x=[min(x), max(x)], y=[error * (c / max(x)) ** slope for c in (min(x), max(x))],
                       dots=False, dashed=True, bars=False) for slope, error in ((1, 30), (2, 8))]
        # Six clouds and two slopes are as many curves as there are colours: a cloud has the same with either scheme.
        curves = [[curves[key] for key in drawn if key[1] == scheme] for scheme in ("consistent", "thesis")]
        curves = curves[0] + slopes + curves[1]
        charts.append(dict(title=f"Relative L2 error of the {words}", x_title="spacing, m", y_title="error, %",
                           log_x=True, log_y=True, curves=curves))
    job = dict(drawings=[], plots=[dict(file=str(ROOT / f"docs/{name}.png"), charts=charts, beside=False)])
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(job, file)
        file.flush()
        said = subprocess.run(["xvfb-run", "-a", str(bench.program.parent / "tessera-render"), file.name], capture_output=True,
                              text=True).stdout
    bench.say("  " + said.strip())
    bench.require("file:" in said, f"docs/{name}.png is drawn")


def choices(bench):
    """What neighbours, strength and kind of dissipation, and the length of the step do to the velocity's error."""
    at = lambda cloud, size, **solver: measure(bench, case, wave, quarter, Cloud(cloud.words, (size,), cloud.seeds, **cloud.particles,
                                                                                 solver=solver), "consistent", size)
    for case, wave, quarter, clouds, counts in (("voronoi.toml", Wave(3), 0.004, IN_SPACE, (18, 24, 30)),
                                                ("square.toml", Wave(2), 0.0049, IN_THE_PLANE, (10, 12, 14, 18))):
        table = bench.grid(f"neighbours.{wave.dimension}", "cloud", "κ", *[f"{n} neighbours" for n in counts])
        for cloud in clouds:
            if cloud.words in ("jittered lattice", "two-pass", "two-pass, relaxed", "Poisson, relaxed"):
                for kappa in (1, 2):
                    row = [at(cloud, cloud.sizes[1], neighbours=n, residual=kappa) for n in counts]
                    table.row(cloud.words, kappa, *[f"{percent(one.errors['velocity'])}, {percent(one.errors['pressure'])}" for one in row])
    case, wave, quarter = "voronoi.toml", Wave(3), 0.004
    lattice, jittered, two_pass, relaxed = (next(cloud for cloud in IN_SPACE if cloud.words == words) for words in
                                            ("lattice", "jittered lattice", "two-pass", "two-pass, relaxed"))
    table = bench.grid("dissipations", "cloud", "linear residual, κ = 1", "symmetric JST, κ4 = 1/8", "JST, κ4 = 1/8")
    for cloud in (lattice, jittered, two_pass, relaxed):
        row = [[at(cloud, size, dissipation=kind).errors["velocity"] for size in cloud.sizes[:2]]
               for kind in ("linear_residual", "jst_symmetric", "jst")]
        table.row(cloud.words + ", {}; {}".format(*cloud.sizes[:2]), *["; ".join(map(percent, errors)) for errors in row])
    table = bench.grid("step", "cloud", *[f"cfl = {cfl}" for cfl in (0.3, 0.5, 0.8)])
    for cloud in (lattice, jittered, two_pass, relaxed):
        table.row(f"{cloud.words}, {cloud.sizes[1]}",
                  *[percent(at(cloud, cloud.sizes[1], cfl=cfl).errors["velocity"]) for cfl in (0.3, 0.5, 0.8)])


STUDIES = {"cube": cube, "square": square, "choices": choices}
