"""Scenes of the thesis' sections 5.2 and 5.3: plastic bodies, and irregular clouds."""

import csv
import fractions
import math
import re

import common
import vtu
from measures import percent

# The extrusion's lattices: particles, spacing (m), and the largest plastic strain at 35 ms of the document's table 5.4.
LATTICES = [(88, 0.0026667, 1.410), (216, 0.0016, 2.028), (400, 0.00114286, 2.133), (640, 0.00088889, 2.197)]
# The case as it is, and as the document has it.
EXTRUSIONS = {"consistent, {p,F,J}": {},
              "consistent, {p,F}": {"solver__formulation": '"pF"'},
              "thesis": {"solver__formulation": '"pF"', "solver__scheme": '"thesis"', "solver__support": 2.2, "solver__cfl": 0.3,
                         "particles__subvolumes": '"uniform"',
                         "solver__jst4": "{elastic = 0.015625, plastic = 0.000244140625, strain = 0.5}"}}


def punch_force(run, time, window=5e-4):
    """N per metre of thickness: the work done on the billet, mean over a window; the punch goes with 1 m/s. Friction's
    work is part of it."""
    return (run.at(time, "external_J") - run.at(time - window, "external_J")) / window


def highest_punch_force(run, until, window=5e-4):
    return max(punch_force(run, 0.008 + window + i * window, window) for i in range(int((until - 0.0085) / window)))


def section(run, time, points, spacing):
    """Plastic strain at points of the deformed billet, a mean over the particles nearby (Wendland's kernel)."""
    frame = run.frame_near(time)
    places, strain = vtu.read_points(frame), vtu.read_array(frame, "PlasticStrain")
    support = 2.2 * spacing
    values = []
    for x, y in points:
        total = weights = 0.0
        for place, value in zip(places, strain):
            q = math.hypot(place[0] - x, place[1] - y) / support
            if q < 1:
                weight = (1 - q) ** 4 * (1 + 4 * q)
                total, weights = total + weight * value, weights + weight
        values.append(total / weights if weights else None)
    return values


def checkerboard(run, time):
    """Root mean square over the billet's rows of a particle's pressure less the mean of its neighbours' across, over that of
    the pressure: 2 where it alternates, next to nothing where it is smooth. None where the run did not come so far."""
    if run.history["time_s"][-1] < time:
        return None
    rows = {}
    pressure = vtu.read_array(run.frame_near(time), "Pressure")
    for (x, y, _), p in zip(vtu.read_points(run.folder / "cloud.vtp"), pressure):
        rows.setdefault(round(y, 7), []).append((x, p))
    rough, count = 0.0, 0
    for row in rows.values():
        p = [value for _, value in sorted(row)]
        for left, here, right in zip(p, p[1:], p[2:]):
            rough, count = rough + (here - 0.5 * (left + right)) ** 2, count + 1
    return math.sqrt(rough / count / (sum(p * p for p in pressure) / len(pressure)))


def percent_of(ours, document):
    return f"{100 * (ours / document - 1):+.1f} %" if ours else ""


def unfilled(run, time, spacing, corner, cells=80):
    """Area (m^2) of the second turn's square, 8 x 8 mm inside `corner`, that is farther than 0.75 spacings from any
    particle and above the line from corner to corner: the void on the outside of the turn."""
    places = vtu.read_points(run.frame_near(time))
    side = 0.008 / cells
    count = 0
    for i in range(cells):
        for j in range(cells):
            x, y = corner[0] - (i + 0.5) * side, corner[1] - (j + 0.5) * side
            if i + j < cells and all(math.hypot(p[0] - x, p[1] - y) > 0.75 * spacing for p in places):
                count += 1
    return count * side * side


def ecae(bench):
    """5.2.2: two turns of 90 degrees."""
    case = "ecae/case.toml"
    if bench.short:
        run = bench.run(case, "short", end_time=0.012, frames=2, rows=400, particles__spacing=LATTICES[0][1])
        bench.require(run.good, "88 particles enter the first turn")
        bench.require_near("largest plastic strain at 12 ms", run["probes.plastic_strain"], 0.8934, 0.02)
        bench.require_near("mean plastic strain at 12 ms", run["probes.mean_plastic_strain"], 0.1046, 0.02)
        bench.require_below("energy balance error", run["energy.balance_error"], 2e-5)
        return

    convergence = bench.grid("ecae_convergence", "particles", "scheme", "document: largest plastic strain at 35 ms", "ours",
                             "difference", "mean", "punch at 20 ms, MN/m", "balance error", "steps to 40 ms")
    pressures = bench.grid("ecae_pressures", "particles", "scheme", "at 9 ms", "at 20 ms", "at 30 ms")
    sections = bench.grid("ecae_sections", "across the channel, mm", *(f"{0.4 + 0.8 * i:.1f}" for i in range(10)))
    for particles, spacing, strain in LATTICES:
        for scheme, keys in EXTRUSIONS.items():
            run = bench.run(bench.copy(case, "involution") if keys else case, f"{re.sub('[^a-zF-J]+', '_', scheme)}_{particles}",
                            frames=40, rows=2000, particles__spacing=spacing, **keys)
            reached = run.history["time_s"][-1]
            ours = run.at(0.035, "plastic_strain") if reached >= 0.035 else None
            convergence.row(particles, scheme, strain, ours or run.error, percent_of(ours, strain),
                            run.at(0.035, "mean_plastic_strain"), 1e-6 * punch_force(run, 0.02),
                            run.at(0.035, "balance_error"), int(run.history["step"][-1]))
            pressures.row(particles, scheme, *(checkerboard(run, time) for time in (0.009, 0.02, 0.03)))
            if not run.good:
                continue
            middle = section(run, 0.04, [(0.016, -0.0076 + 0.0008 * i) for i in range(10)], spacing)
            outlet = section(run, 0.04, [(0.0244 + 0.0008 * i, -0.013) for i in range(10)], spacing)
            sections.row(f"{particles}, {scheme}: middle of the middle channel, upwards", *middle)
            sections.row(f"{particles}, {scheme}: 5 mm into the exit, outwards", *outlet)


def ecae_variants(bench):
    """5.2.2: other contact, and the channel of 16 mm."""
    case, short_channel = "ecae/case.toml", "ecae/short_channel.toml"
    if bench.short:
        return  # the contact is the first scene's
    variants = bench.grid("ecae_variants", "216 particles", "largest plastic strain at 35 ms", "punch at 20 ms, N/m",
                          "highest punch force, N/m")
    spacing = LATTICES[1][1]
    for name, keys in {"frictionless": {}, "friction 0.05": {"wall__0__friction": 0.05},
                       "penalty contact": {"wall__0__method": '"penalty"'}}.items():
        run = bench.run(case, name.replace(" ", "_"), frames=40, rows=2000, particles__spacing=spacing, **keys)
        if run.good:
            variants.row(name, run.at(0.035, "plastic_strain"), punch_force(run, 0.02), highest_punch_force(run, 0.04))
    void = bench.grid("ecae_void", "channel of 16 mm, particles", "unfilled outside of the second turn at 27 ms, mm²",
                      "largest plastic strain")
    for particles, spacing, *_ in LATTICES[:3]:
        run = bench.run(short_channel, f"short_channel_{particles}", frames=27, rows=2000, particles__spacing=spacing)
        if run.good:
            void.row(particles, 1e6 * unfilled(run, 0.027, spacing, (0.024, 0)), run["probes.plastic_strain"])


def thesis_bar(bench, run):
    """Table 5.3, beside the document and the converged bar."""
    table = bench.grid("taylor_bar", "figure", "document", "converged", "ours")
    _, radius, length = taylor_reference()[-1]
    outermost = 1e3 * run["probes.radius_m"]
    strain = vtu.read_array(run.frame_near(80e-6), "PlasticStrain")
    table.row("radius of the outermost particle at 80 µs, mm", 6.66, 1e3 * radius, outermost)
    table.row("the same and the particle's radius of 0.32, mm", 6.98, None, outermost + 0.32)
    table.row("radius of the foot itself (particles that began on it), mm", None, 1e3 * radius, 1e3 * run["probes.foot_radius_m"])
    table.row("shortening over length", None, percent(1 - 1e3 * length / 32.4), percent(1 - run["probes.length_m"] / 0.032))
    table.row("largest plastic strain", "about 3 (colour)", None, run["probes.plastic_strain"])
    table.row("particles above a strain of 4", None, None, sum(value > 4 for value in strain))
    for words in ("plastic", "dissipated", "balance_error"):
        table.row(f"energy: {words.replace('_', ' ')}" + (", J" if words != "balance_error" else ""), None, None, run[f"energy.{words}"])


def taylor_history(bench, run, name):
    table = bench.grid(name, "time, µs", "reference: radius, mm", "ours", "reference: shortening, mm", "ours")
    for time, radius, length in taylor_reference():
        if round(1e6 * time) % 10 == 0 and time > 0:
            table.row(round(1e6 * time), 1e3 * radius, 1e3 * run.at(time, "foot_radius_m"),
                      32.4 - 1e3 * length, 32 - 1e3 * run.at(time, "length_m"))


def taylor_reference():
    """(time, radius, length) of the converged bar, s and m."""
    with (common.ROOT / "docs/data/taylor_reference.csv").open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [(1e-6 * float(row["time_us"]), 1e-3 * float(row["radius_mm"]), 1e-3 * float(row["length_mm"])) for row in rows]


def converged_shortening(time):
    """Of the converged bar, over its length."""
    rows = taylor_reference()
    _, _, length = min(rows, key=lambda row: abs(row[0] - time))
    return 1 - length / rows[0][2]


TAYLOR_REFINED = (0.00106667, 0.0008, 0.00064, 0.00053333)


def taylor_bar(bench):
    """5.2.1: the lattice of the thesis, coarser and finer ones."""
    case = "taylor_bar/case.toml"
    if bench.short:
        run = bench.run(case, "short", end_time=30e-6, rows=200, particles__spacing=0.00106667)
        bench.require(run.good, "a coarse bar strikes the wall")
        bench.require_near("its shortening over its length at 30 us, by the converged bar's",
                           1 - run["probes.length_m"] / 0.032, converged_shortening(30e-6), 0.02)
        bench.require_near("radius of its foot, m", run["probes.foot_radius_m"], 5.85e-3, 0.01)
        return
    table = bench.grid("taylor_lattice", "spacing, mm", "particles", "radius of the outermost particle, mm",
                       "and half a spacing, mm", "length, mm", "largest plastic strain", "steps", "smallest step, s")
    for spacing in TAYLOR_REFINED:
        run = bench.run(case, f"lattice_{1e3 * spacing:.2f}", rows=400, particles__spacing=spacing)
        table.row(f"{1e3 * spacing:.2f}", run["particles"], 1e3 * run["probes.radius_m"],
                  1e3 * (run["probes.radius_m"] + 0.5 * spacing), 1e3 * run["probes.length_m"],
                  run["probes.plastic_strain"], run["steps"], run["dt_min"])
        if spacing == 0.00064:
            thesis_bar(bench, run)
            taylor_history(bench, run, "taylor_history")


def taylor_bar_unstructured(bench):
    """5.3.2: two-pass clouds, as they come with a κ4 that holds them together, and relaxed with the thesis' own."""
    case = "taylor_bar/voronoi.toml"
    if bench.short:
        run = bench.run(case, "short", end_time=20e-6, rows=100, particles__count=373)
        bench.require(run.good, "373 irregular particles strike the wall")
        bench.require_near("their shortening over their length at 20 us, by the converged bar's",
                           1 - run["probes.length_m"] / 0.032, converged_shortening(20e-6), 0.04)
        return
    table = bench.grid("taylor_unstructured", "particles", "cloud", "subvolumes", "κ4", "seed",
                       "radius of the outermost particle, mm", "length, mm", "largest plastic strain", "dissipated of 237 J")
    for count in (373, 721, 2077):
        for subvolumes in ("voronoi", "uniform"):
            for seed in (1, 2, 3):
                taylor_row(bench, table, count, "raw", subvolumes, "1", seed)
    for count in (373, 721, 2077):
        taylor_row(bench, table, count, "relaxed", "voronoi", "1/4096", 1)


def taylor_row(bench, table, count, cloud, subvolumes, jst4, seed):
    run = bench.run("taylor_bar/voronoi.toml", f"{count}_{cloud}_{subvolumes}_{seed}", rows=400, frames=5,
                    particles__count=count, particles__seed=seed,
                    particles__subvolumes=f'"{subvolumes}"', particles__relax=20 * (cloud == "relaxed"),
                    solver__scheme='"thesis"', solver__jst4=float(fractions.Fraction(jst4)))
    words = (count, cloud, subvolumes, jst4, seed)
    if run.good:
        table.row(*words, 1e3 * run["probes.radius_m"], 1e3 * run["probes.length_m"], run["probes.plastic_strain"],
                  run.history["dissipated_J"][-1])
    else:
        table.row(*words, run.error)


def taylor_bar_converged(bench):
    """The bar of 32.4 mm on relaxed two-pass clouds, its whole history against the converged one."""
    case = "taylor_bar/converged.toml"
    if bench.short:
        run = bench.run(case, "short", end_time=20e-6, rows=100, particles__count=1500)
        bench.require(run.good, "1500 relaxed particles strike the wall")
        wide, long = worst_differences(run, 20e-6)
        bench.require_below("radius, largest difference from the converged bar's up to 20 us", wide, 0.03)
        bench.require_below("length, the same", long, 0.01)
        return
    table = bench.grid("taylor_converged", "particles", "seed", "radius, mm (7.23)", "length, mm (21.43)", "radius: worst of its history",
                       "length: worst", "round", "largest plastic strain", "steps", "balance error")
    for count, seed in ((1000, 1), (2000, 1), (4000, 1), (4000, 2), (4000, 3), (8000, 1), (30000, 1)):
        run = bench.run(case, f"{count}_{seed}", rows=400, particles__count=count, particles__seed=seed)
        if not run.good:
            table.row(count, seed, run.error)
            continue
        wide, long = worst_differences(run, 80e-6)
        outline = unroundness(run.frame_near(80e-6))
        table.row(run["particles"], seed, 1e3 * run["probes.radius_m"], 1e3 * run["probes.length_m"], f"{100 * wide:.2f} %",
                  f"{100 * long:.2f} %", f"{outline:.4f}", run["probes.plastic_strain"], run["steps"], run["energy.balance_error"])
        if count == 4000:
            bench.require_below(f"radius over its history, seed {seed}", wide, 0.03)
            bench.require_below(f"length over its history, seed {seed}", long, 0.02)
            bench.require_below(f"largest over smallest radius in sixteen directions, seed {seed}", outline, 1.03)
        if count == 30000:
            bench.require_below("radius at the end", abs(run["probes.radius_m"] / 7.2326e-3 - 1), 0.015)
            bench.require_below("length at the end", abs(run["probes.length_m"] / 21.430e-3 - 1), 0.007)


def worst_differences(run, end):
    """Largest relative differences of radius and length from the converged bar's at its times up to `end`."""
    rows = [row for row in taylor_reference() if 0 < row[0] <= end * (1 + 1e-4)]
    return (max(abs(run.at(time, "radius_m") / radius - 1) for time, radius, _ in rows),
            max(abs(run.at(time, "length_m") / length - 1) for time, _, length in rows))


def unroundness(frame):
    """Largest over smallest radius of the particles in sixteen directions."""
    radius = [0.0] * 16
    for x, y, _ in vtu.read_points(frame):
        direction = int((math.atan2(y, x) / math.pi + 1) * 8) % 16
        radius[direction] = max(radius[direction], math.hypot(x, y))
    return max(radius) / min(radius)


def tensile_cube_unstructured(bench):
    """5.3.1: the cube torn upwards, lattice and two-pass clouds."""
    probes = ['{name = "corner_ux", quantity = "ux", reduce = "mean", on = "corner"}',
              '{name = "corner_uz", quantity = "uz", reduce = "mean", on = "corner"}']
    if bench.short:
        run = bench.run("tensile_cube/voronoi.toml", "short", end_time=0.01, rows=200, solver__scheme='"thesis"')
        bench.require(run.good, "irregular particles are torn upwards")
        bench.require_below("energy balance error", run["energy.balance_error"], 2e-3)
        return
    runs = {"lattice 8³": bench.run("tensile_cube/case.toml", "lattice", rows=500, probes=probes,
                                    set='[{name = "corner", nearest = [1, 1, 1]}]')}
    for seed in (1, 2, 3):
        for subvolumes in ("voronoi", "uniform"):
            runs[f"two-pass, {subvolumes}, seed {seed}"] = bench.run(
                "tensile_cube/voronoi.toml", f"{subvolumes}_{seed}", rows=500, probes=probes, particles__seed=seed,
                particles__subvolumes=f'"{subvolumes}"', solver__scheme='"thesis"')
    table = bench.grid("tensile_unstructured", "cloud", "particles", "corner's highest u_z, m", "at, ms", "u_z at 50 ms, m",
                       "largest \\|u_x\\|, m", "u_x at 50 ms, m")
    for name, run in runs.items():
        time, height = run.first_maximum("corner_uz_m")
        sideways = run.history["corner_ux_m"]
        table.row(name, run["particles"], height, 1e3 * time, run.history["corner_uz_m"][-1], max(map(abs, sideways)),
                  sideways[-1])


SCENES = {"ecae": ecae, "ecae_variants": ecae_variants, "taylor_bar_converged": taylor_bar_converged, "taylor_bar": taylor_bar,
          "taylor_bar_unstructured": taylor_bar_unstructured, "tensile_cube_unstructured": tensile_cube_unstructured}
