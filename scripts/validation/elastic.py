"""Scenes of the thesis' section 5.1: hyperelastic bodies. docs/validation.md says what the figures mean."""

import math

import vtu
from measures import (KAPPA, component_sum, hourglass, number_or_blank, outcome, percent, roughness, tie_of_J, tied,
                      total_energy)

FORMULATIONS = {"pF": "{p,F}", "pFJ": "{p,F,J}", "pFHJ": "{p,F,H,J}"}


# --- 5.1.1 --------------------------------------------------------------------------------------------------------------

TABLE_5_1 = {8: (0.0255, 0.0011, 999.938, 68.625), 12: (0.022, 4.442e-4, 769.522, 26.112),
             16: (0.019, 2.586e-4, 618.635, 13.928), 20: (0.018, 1.61e-4, 485.893, 8.197),
             24: (0.013, 8.789e-5, 441.25, 5.837)}  # L1(v), L2(v), L1(p), L2(p), L2 as the thesis takes it
REFERENCE_SWING = {("uniform", 9): 0.202, ("uniform", 13): 0.142, ("uniform", 17): 0.122,
                   ("voronoi", 9): 0.135, ("voronoi", 17): 0.078, ("voronoi", 25): 0.050}


def swing(bench, n, subvolumes="uniform", formulation="pF", name="", **keys):
    return bench.run("swinging_cube/case.toml", f"{n}-{subvolumes}-{formulation}{name}", particles__spacing=1 / (n - 1),
                     particles__subvolumes=subvolumes, solver__formulation=formulation, **keys)


def swinging_cube(bench):
    orders(bench)
    if bench.short:
        for formulation in FORMULATIONS:
            error = swing(bench, 8, formulation=formulation)
            bench.require_near(f"L2(v) as the thesis takes it, n = 8, {formulation}", error["error.l2_velocity_thesis"], 0.0011, 0.2)
            bench.require_near(f"L1(p), n = 8, {formulation}", error["error.l1_pressure"], 999.9, 0.1)
        return
    table_5_1(bench)
    parameters(bench)
    one_period(bench)


def orders(bench):
    sizes = (9, 17) if bench.short else (9, 13, 17, 25)
    table = bench.grid("swinging_cube.orders", "subvolumes", "n", "L2(v), relative", "reference program", "order",
                       "L1(v), m/s", "L1(p), Pa")
    for subvolumes in ("uniform", "voronoi"):
        last = None
        for n in sizes:
            run = swing(bench, n, subvolumes)
            error, reference = run["error.l2_velocity_relative"], REFERENCE_SWING.get((subvolumes, n))
            order = math.log(last[1] / error) / math.log((n - 1) / (last[0] - 1)) if last else None
            table.row(subvolumes, n, percent(error), percent(reference), number_or_blank(order), run["error.l1_velocity"],
                      run["error.l1_pressure"])
            if reference:
                bench.require_near(f"L2(v), {subvolumes}, n = {n}", error, reference, 0.05)
            last = (n, error)


def table_5_1(bench):
    table = bench.grid("swinging_cube.table_5_1", "n", "formulation", "L1(v): thesis", "ours", "ours, components summed", "√Σ(Ve)²(v): thesis", "ours",
                       "L2(v), ours", "L1(p): thesis", "ours", "√Σ(Ve)²(p): thesis", "ours", "L2(p), ours")
    for n, (l1v, l2v, l1p, l2p) in TABLE_5_1.items():
        for formulation, words in FORMULATIONS.items():
            run = swing(bench, n, formulation=formulation)
            first = formulation == "pF"
            table.row(n, words, l1v if first else "", run["error.l1_velocity"], component_sum(run), l2v if first else "",
                      run["error.l2_velocity_thesis"], run["error.l2_velocity"], l1p if first else "",
                      run["error.l1_pressure"], l2p if first else "", run["error.l2_pressure"] / math.sqrt(run["particles"]),
                      run["error.l2_pressure"])
            if first:
                basis = run
            else:
                bench.require_near(f"L2(v) of {formulation} against {{p,F}}, n = {n}", run["error.l2_velocity"],
                                   basis["error.l2_velocity"], 0.01)


def parameters(bench):
    table = bench.grid("swinging_cube.parameters", "n", "support", "κ4", "L1(v), m/s", "L2(v), relative", "L1(p), Pa",
                       "L2(p), Pa")
    for support, jst4 in ((1.2, 0.125), (2.2, 0.125), (3.2, 0.125), (2.2, 0), (2.2, 1 / 64), (2.2, 0.25)):
        for n in (8, 16, 24):
            run = swing(bench, n, name=f"-{support}-{jst4:g}", solver__support=support, solver__jst4=jst4)
            kappa = {0.125: "1/8", 0: "0", 1 / 64: "1/64", 0.25: "1/4"}[jst4]
            table.row(n, support, kappa, run["error.l1_velocity"], percent(run["error.l2_velocity_relative"]),
                      run["error.l1_pressure"], run["error.l2_pressure"])


def one_period(bench):
    table = bench.figures("swinging_cube.period")
    for subvolumes in ("uniform", "voronoi"):
        run = swing(bench, 8, subvolumes, name="-period", end_time=0.016011, rows=400)
        crossing = run.zero_crossing("corner_m")
        table.compare(f"first zero of the displacement, n = 8, {subvolumes} (closed form), s", crossing, math.pi / 2 / 392.42437)
        energy = total_energy(run, -1) / total_energy(run, 0)
        table.compare(f"energy left after one period, n = 8, {subvolumes} (closed form)", energy, 1.0)


# --- 5.1.2 --------------------------------------------------------------------------------------------------------------

EXACT_SPIN = 1100 * 105 / 6  # rho omega L^5 / 6, kg m^2/s


def spinning_cube(bench):
    end = 0.25 if bench.short else 1.0
    table = bench.figures("spinning_cube")
    spin = "spinning_cube/case.toml"
    with_both = bench.run(spin, "pF", end_time=end)
    unprojected = bench.run(spin, "unprojected", end_time=end, solver__momentum_projection=False)
    undamped = bench.run(spin, "undamped", end_time=end, solver__jst4=0)
    exact_volumes = bench.run(spin, "voronoi", end_time=0.01, particles__subvolumes="voronoi")

    def momentum(run, i):
        return run.history["angular_momentum_z_kgm2_s"][i]

    bench.require_near("angular momentum of uniform subvolumes", momentum(with_both, 0), 26950, 1e-4)
    bench.require_near("angular momentum of Voronoi subvolumes", momentum(exact_volumes, 0), 20790, 1e-4)
    bench.require_below("drift of the linear momentum", with_both["momentum.linear_drift"], 1e-12)
    bench.require_below("drift of the angular momentum", with_both["momentum.angular_drift"], 1e-12)
    bench.require_below("angular momentum without the projection, share left", momentum(unprojected, -1) / momentum(unprojected, 0),
                        0.9 if bench.short else 0.5)
    gain = total_energy(undamped, -1) / total_energy(undamped, 0)
    bench.require_above("energy without JST, over what it was", gain, 1.02 if bench.short else 1.5)
    energies = [total_energy(with_both, i) for i in range(len(with_both.history["time_s"]))]
    bench.require_below("energy with JST at its largest, over what it was", max(energies) / energies[0], 1 + 1e-6)
    if bench.short:
        return
    table.compare("angular momentum, V uniform, kg m²/s", momentum(with_both, 0), None, 26950)
    table.compare("angular momentum, V Voronoi", momentum(exact_volumes, 0), None, 20790)
    table.compare("angular momentum, closed form ρωL⁵/6", EXACT_SPIN)
    table.compare("the same at 1 s without the projection", momentum(unprojected, -1), None, 1.1e4)
    table.compare("kinetic energy at the start, J", undamped.history["kinetic_J"][0], None, 1.41e6)
    table.compare("kinetic energy at 1 s without JST, J", undamped.history["kinetic_J"][-1], None, 3.2e6)
    table.compare("kinetic energy at 1 s with JST, J", with_both.history["kinetic_J"][-1])
    for formulation, words in FORMULATIONS.items():
        run = bench.run(spin, f"{formulation}-5s", end_time=5, solver__formulation=formulation, **tied(formulation, 0.5))
        bench.require(run.good, f"5 s of {words} come to their end")
        if not run.good:
            table.compare(f"5 s of {words}", outcome(run))
            continue
        table.compare(f"drift of the linear momentum in 5 s, {words}", run["momentum.linear_drift"])
        table.compare(f"drift of the angular momentum in 5 s, {words}", run["momentum.angular_drift"])
        table.compare(f"kinetic / internal energy at 5 s, {words}, J",
                      f"{run['energy.kinetic']:.4g} / {run['energy.internal']:.4g}")
        bench.require_below(f"drift of the momenta in 5 s, {words}",
                            max(run["momentum.linear_drift"], run["momentum.angular_drift"]), 1e-11)
    run = bench.run(spin, "undamped-5s", end_time=5, solver__jst4=0)
    table.compare("5 s without JST, and their energy over what it was",
                  f"{outcome(run)}, {total_energy(run, -1) / total_energy(run, 0):.3g}")
    tie_of_J(bench, "spinning_cube.involution", lambda name, **keys: bench.run(spin, name, end_time=5, **keys))


# --- 5.1.3 --------------------------------------------------------------------------------------------------------------

def tensile_cube(bench):
    case = "tensile_cube/case.toml"
    end, frames = (0.004, 20) if bench.short else (0.05, 250)
    times = (0.0002, 0.002, 0.004) if bench.short else (0.0002, 0.002, 0.02, 0.05)
    variants = {"{p,F}": {}, "displacement, no JST": {"formulation": "displacement", "jst4": 0}}
    if not bench.short:
        variants |= {"{p,F,J}, κ4 of J 0": {"formulation": "pFJ", "jst4_J": 0},
                     "{p,F,H,J}, κ4 of J 0": {"formulation": "pFHJ", "jst4_J": 0},
                     "{p,F}, no JST": {"jst4": 0}, "displacement, κ4 = 1/8": {"formulation": "displacement", "jst4": 0.125}}
    table = bench.grid("tensile_cube", "formulation", "comes", "steps", "smallest J", "energy balance error", "tip, first peak, m",
                       "at, ms", *[f"roughness at {1e3 * t:g} ms" for t in times])
    rough = {}
    for words, keys in variants.items():
        name = "-".join(str(value) for value in keys.values()) or "pF"
        run = bench.run(case, name, end_time=end, frames=frames, rows=2000, **{f"solver__{k}": v for k, v in keys.items()})
        reached = run.history["time_s"][-1]
        rough[words] = [roughness(run, t) if t <= 1.01 * reached else None for t in times]
        time, peak = run.first_maximum("tip_m")
        table.row(words, outcome(run), int(run.history["step"][-1]), min(run.history["smallest_volume_ratio"]),
                  max(run.history["balance_error"]), peak, 1e3 * time, *[number_or_blank(r) for r in rough[words]])
        if "no JST" not in words:
            bench.require(run.good, f"{words} comes to its end")
    bench.require_below("pressure roughness with JST", max(rough["{p,F}"]), 0.4)
    worst = max(r for r in rough["displacement, no JST"][1:] if r is not None)
    bench.require_above("displacement without JST: roughness over that of {p,F}", worst / max(rough["{p,F}"][1:]), 2)
    if not bench.short:
        tie_of_J(bench, "tensile_cube.involution", lambda name, **keys: bench.run(case, name, frames=1, rows=2000, **keys))


# --- 5.1.4 --------------------------------------------------------------------------------------------------------------

def punch(bench):
    case = "punch/case.toml"
    variants = {"{p,F}": {}, "{p,F}, no JST": {"jst4": 0}}
    if not bench.short:
        variants |= {"{p,F,J}": {"formulation": "pFJ", "jst4_J": 0.125, "involution": 0.5},
                     "{p,F,H,J}": {"formulation": "pFHJ", "jst4_J": 0.125, "involution": 0.5}}
    times = (0.0001, 0.0002, 0.0003, 0.0004, 0.0005)
    table = bench.grid("punch", "formulation", "comes", "smallest J", "wobble of the jump",
                       *[f"jump at {1e3 * t:g} ms, MPa" for t in times], *[f"roughness at {t} ms" for t in (0.2, 0.4, 0.5)])
    rough, wobbles = {}, {}
    for words, keys in variants.items():
        name = "-".join(str(value) for value in keys.values()) or "pF"
        run = bench.run(case, name, frames=50, rows=500, **{f"solver__{k}": v for k, v in keys.items()})
        left, right = run.history["pressure_left_Pa"], run.history["pressure_right_Pa"]
        jump = [abs(r - l) for l, r in zip(left, right)]
        wobbles[words] = wobble(jump)
        rough[words] = [roughness(run, t) for t in (0.0002, 0.0004, 0.0005)]
        table.row(words, outcome(run), min(run.history["smallest_volume_ratio"]), f"{wobbles[words]:.3g}",
                  *[abs(run.at(t, "pressure_right_Pa") - run.at(t, "pressure_left_Pa")) / 1e6 for t in times],
                  *[f"{r:.2g}" for r in rough[words]])
        if words == "{p,F}":
            bench.require(run.good, "{p,F} with JST comes to its end")
            bench.require_near("the punch's way, m", run.history["punch_m"][-1], -0.005, 1e-6)
    bench.require_below("pressure roughness with JST at the end", rough["{p,F}"][-1], 0.5)
    bench.require_above("wobble of the jump without JST, over that with it", wobbles["{p,F}, no JST"] / wobbles["{p,F}"], 1.5)
    bench.require_above("roughness without JST, over that with it", max(rough["{p,F}, no JST"]) / max(rough["{p,F}"]), 1.5)


def wobble(values):
    """Way up and down over the range: 1 if monotone."""
    way = sum(abs(b - a) for a, b in zip(values, values[1:]))
    return way / (max(values) - min(values))


# --- 5.1.5 --------------------------------------------------------------------------------------------------------------

COLUMNS = {"3 x 3 x 13": 0.5, "6 x 6 x 31": 0.2, "12 x 12 x 67": 1 / 11}
REFERENCE_BENDING = {"3 x 3 x 13": 2.77, "6 x 6 x 31": 3.03}
PLAIN_BENDING = {"3 x 3 x 13": 2.480, "6 x 6 x 31": 2.559}  # of a second plain program


def bending_column(bench):
    lattices = ["3 x 3 x 13", "6 x 6 x 31"] if bench.short else list(COLUMNS)
    table = bench.figures("bending_column")
    peaks = {}
    for lattice in lattices:
        run = bench.run("bending_column/case.toml", lattice.replace(" ", ""), end_time=0.5 if bench.short else 1.5,
                        rows=1500, frames=75, particles__spacing=COLUMNS[lattice])
        if lattice in PLAIN_BENDING:
            bench.require_near(f"corner at 0.5 s, {lattice}, m", run.at(0.5, "corner_y_m"), PLAIN_BENDING[lattice], 0.005)
        sway = max(map(abs, run.history["sway_m"]))
        bench.require_below(f"sway, {lattice}, m", sway, 1e-9)
        if bench.short:
            continue
        peaks[lattice] = run.first_maximum("corner_y_m")
        table.compare(f"corner at 0.5 s, {lattice}, m", run.at(0.5, "corner_y_m"), None, REFERENCE_BENDING.get(lattice))
        table.compare(f"first peak, {lattice}, m at s", "{1:.4g} at {0:.4g}".format(*peaks[lattice]))
        table.compare(f"first return through upright, {lattice}, s", run.zero_crossing("corner_y_m"))
        table.compare(f"largest sway out of the plane, {lattice}, m", sway, 0)
    if bench.short:
        return
    gaps = []
    for lattice in COLUMNS:  # the same limit from the other side
        run = bench.run("bending_column/case.toml", "voronoi-" + lattice.replace(" ", ""), end_time=0.6, rows=600,
                        particles__spacing=COLUMNS[lattice], particles__subvolumes="voronoi")
        time, peak = run.first_maximum("corner_y_m")
        table.compare(f"first peak, {lattice}, Voronoi subvolumes, m at s", f"{peak:.4g} at {time:.4g}")
        gaps.append(abs(peak - peaks[lattice][1]))
    table.compare("first peaks of uniform and Voronoi subvolumes apart, coarse to fine, m", ", ".join(f"{gap:.2f}" for gap in gaps))
    bench.require(gaps[2] < gaps[1] < gaps[0], "tip curves of both subvolumes approach each other with N")
    hard = bench.figures("bending_column.hard")
    for lattice in COLUMNS:
        end = 0.6 if lattice.startswith("12") else None  # its first swing, for time's sake
        run = bench.run("bending_column/hard.toml", "hard-" + lattice.replace(" ", ""), end_time=end, frames=25, rows=2500,
                        particles__spacing=COLUMNS[lattice])
        bench.require(run.good, f"pushed over its whole height, {lattice}, comes to its end")
        if not run.good:
            hard.compare(f"{lattice}", outcome(run))
            continue
        sway = max(map(abs, run.history["sway_m"]))
        bench.require_below(f"sway, pushed over its whole height, {lattice}, m", sway, 1e-6)
        hard.compare(f"first peak, {lattice}, m at s", "{1:.4g} at {0:.4g}".format(*run.first_maximum("corner_y_m")))
        hard.compare(f"largest sway out of the plane, {lattice}, m", sway, 0)
        hard.compare(f"pressure roughness at 0.5 s, {lattice}", roughness(run, 0.5))


# --- 5.1.6 --------------------------------------------------------------------------------------------------------------

TABLE_5_2 = {("pF", 0.45): 1331, ("pFJ", 0.45): 1358, ("pFHJ", 0.45): 1365, ("pF", 0.495): 4005, ("pFJ", 0.495): 4038,
             ("pFHJ", 0.495): 4075, ("pF", 0.4995): 12540, ("pFJ", 0.4995): 12890, ("pFHJ", 0.4995): 13047}
TIMES_5_2 = {("pF", 0.45): 1.0, ("pFJ", 0.45): 1.029, ("pFHJ", 0.45): 1.051, ("pF", 0.495): 2.920, ("pFJ", 0.495): 2.961,
             ("pFHJ", 0.495): 3.022, ("pF", 0.4995): 9.380, ("pFJ", 0.4995): 9.388, ("pFHJ", 0.4995): 9.481}
STEPS_WITHIN = {0.45: 0.02, 0.495: 0.02, 0.4995: 0.02}
REFERENCE_STEPS = {("pF", 0.45): 1332, ("pF", 0.495): 3956, ("pF", 0.4995): 12477}
TORSION = {0.45: (342.8, 0.0895, 0.179), 0.495: (348.1, 0.0909, 0.1818)}  # amplitude in degrees, when, zero crossing in s


def twist(bench, name, formulation="pF", poisson=0.45, **keys):
    return bench.run("twisting_column/case.toml", name, solver__formulation=formulation, material__poisson=poisson,
                     **{"frames": 50, "rows": 500, **keys})


def twisting_column(bench):
    if bench.short:
        run = twist(bench, "pF-0.45")
        bench.require_near("steps to 0.25 s, {p,F}, nu 0.45", run["steps"], 1331, STEPS_WITHIN[0.45])
        time, angle = run.first_maximum("tip_deg")
        bench.require_near("the tip's largest angle, degrees", angle, 371.5, 0.01)
        bench.require_near("and when, s", time, 0.1002, 0.01)
        softer = twist(bench, "pFJ-0.45", "pFJ", solver__jst4_J=0.125, solver__involution=0.2)
        bench.require_above("hourglass at 0.1 s, {p,F} over {p,F,J}", hourglass(run, 0.1) / hourglass(softer, 0.1), 3)
        failing = twist(bench, "displacement", "displacement", solver__jst4=0)
        bench.require_below("smallest J of displacement without JST", min(failing.history["smallest_volume_ratio"]), 0.5)
        return
    table_5_2(bench)
    refinement(bench)
    displacement(bench)
    involution(bench)


def table_5_2(bench):
    table = bench.grid("twisting_column.table_5_2", "ν", "formulation", "steps: thesis", "ours", "difference", "reference program",
                       "time: thesis", "ours", "smallest J", "energy balance error", "hourglass at 0.1 s", "at 0.17 s")
    noise, first = {}, None
    for poisson in (0.45, 0.495, 0.4995):
        for formulation, words in FORMULATIONS.items():
            key = (formulation, poisson)
            tie = tied(formulation, 0.1)
            run = twist(bench, f"{formulation}-{poisson}" + ("-tied" if tie else ""), formulation, poisson, **tie)
            if not run.good:
                table.row(poisson, words, TABLE_5_2[key], outcome(run))
                bench.require(False, f"{words} at nu {poisson} comes to its end")
                continue
            first = first or run["wall_seconds"]
            noise[key] = hourglass(run, 0.1)
            difference = run["steps"] / TABLE_5_2[key] - 1
            table.row(poisson, words, TABLE_5_2[key], run["steps"], f"{100 * difference:+.1f} %", REFERENCE_STEPS.get(key),
                      TIMES_5_2[key], f"{run['wall_seconds'] / first:.2f}", f"{run['min.jacobian']:.3f}",
                      f"{run['energy.balance_error']:.1e}", f"{noise[key]:.4f}", f"{hourglass(run, 0.17):.4f}")
            if formulation == "pF":
                bench.require_near(f"steps to 0.25 s, {words}, nu {poisson}", run["steps"], TABLE_5_2[key], STEPS_WITHIN[poisson])
    for formulation in ("pFJ", "pFHJ"):
        bench.require_above(f"hourglass at nu = 0.4995, {{p,F}} over {FORMULATIONS[formulation]}",
                            noise["pF", 0.4995] / noise[formulation, 0.4995], 3)


def refinement(bench):
    table = bench.grid("twisting_column.tip", "ν", "spacing, m", "subvolumes", "support", "largest angle, °", "off by", "at, s", "off by",
                       "back at zero, s", "off by")
    variants = [(0.45, 0.2, "uniform", 2.2), (0.45, 0.2, "uniform", 3.2), (0.45, 0.1, "uniform", 2.2),
                (0.45, 0.2, "voronoi", 2.2), (0.45, 0.1, "voronoi", 2.2), (0.45, 1 / 15, "voronoi", 2.2),
                (0.495, 0.2, "uniform", 2.2), (0.495, 0.2, "voronoi", 2.2), (0.495, 0.1, "voronoi", 2.2)]
    poisson_before, error = None, {}
    for poisson, spacing, subvolumes, support in variants:
        amplitude, when, back = TORSION[poisson]
        if poisson != poisson_before:
            table.row(poisson, "linear torsion", "", "", amplitude, "", when, "", back, "")
            poisson_before = poisson
        run = twist(bench, f"tip-{poisson}-{subvolumes}-{spacing:.3f}-{support}", poisson=poisson, end_time=0.21,
                    particles__spacing=spacing, particles__subvolumes=subvolumes, solver__support=support, frames=2)
        time, angle = run.first_maximum("tip_deg")
        crossing = run.zero_crossing("tip_deg")
        error[poisson, spacing, subvolumes, support] = abs(time / when - 1)
        table.row(poisson, f"{spacing:.4g}", subvolumes, support, f"{angle:.1f}", percent(angle / amplitude - 1), f"{time:.4f}",
                  percent(time / when - 1), crossing and f"{crossing:.4f}", crossing and percent(crossing / back - 1))
    for finer, coarser in ((0.1, 0.2), (1 / 15, 0.1)):
        bench.require_below(f"lateness of the tip at spacing {finer:.4g} over that at {coarser:g}",
                            error[0.45, finer, "voronoi", 2.2] / error[0.45, coarser, "voronoi", 2.2], 0.85)


def displacement(bench):
    table = bench.grid("twisting_column.displacement", "lattice", "κ4", "comes", "smallest J", "energy balance error",
                       "hourglass of its last frame")
    for lattice in ("6 x 6 x 31", "12 x 12 x 67"):
        for jst4 in (0, 0.125):
            run = twist(bench, f"displacement-{lattice.replace(' ', '')}-{jst4}", "displacement", solver__jst4=jst4,
                        end_time=0.5 if lattice[0] == "6" else 0.25, particles__spacing=COLUMNS[lattice])
            smallest = min(run.history["smallest_volume_ratio"])
            table.row(lattice, "1/8" if jst4 else 0, outcome(run), smallest, max(run.history["balance_error"]),
                      hourglass(run, 1e9))
            if not jst4:
                bench.require(not run.good or smallest < 0.5, f"displacement without JST fails, {lattice}")


def involution(bench):
    table = bench.grid("twisting_column.involution", "ν", "formulation", "κ4 of J", "involution ξ", "comes", "steps", "smallest J",
                       "energy balance error", "largest angle, °", "hourglass at 0.1 s")
    # The nearly incompressible ones to 0.1 s only.
    every = [(kappa, xi) for kappa in (1 / 32, 0.125) for xi in (0, 0.05, 0.1, 0.2, 0.3, 0.5, 1)] + [(0, 0), (0, 0.2)]
    few = [(0.125, 0.1), (0.125, 0.2), (0.125, 0.5), (1 / 32, 0.2)]
    for poisson, formulation, pairs in ((0.45, "pFJ", every), (0.45, "pFHJ", few),
                                        (0.4995, "pFJ", few + [(0, 0.2), (0.25, 0.2), (0.25, 0.5)])):
        for kappa, xi in sorted(pairs):
            run = twist(bench, f"{formulation}-{poisson}-{kappa:g}-{xi}", formulation, poisson, solver__jst4_J=kappa,
                        solver__involution=xi, end_time=None if poisson == 0.45 else 0.1)
            reached = run.history["time_s"][-1]
            table.row(poisson, FORMULATIONS[formulation], KAPPA[kappa], xi, outcome(run), int(run.history["step"][-1]),
                      f"{min(run.history['smallest_volume_ratio']):.3f}", f"{max(run.history['balance_error']):.1e}",
                      f"{run.first_maximum('tip_deg')[1]:.1f}", f"{hourglass(run, 0.1):.4f}" if reached >= 0.099 else "")


SCENES = {scene.__name__: scene for scene in (swinging_cube, spinning_cube, tensile_cube, punch, bending_column, twisting_column)}
