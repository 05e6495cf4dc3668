"""Elastic scenes of the thesis at large strains, with the consistent scheme beside the thesis'."""

from measures import hourglass, outcome, percent, roughness

# Free-warping linear torsion by Poisson's ratio: amplitude in degrees, when, and the zero after it in s.
TORSION = {0.45: (342.8, 0.0895, 0.179), 0.495: (348.1, 0.0909, 0.1818), 0.4995: (348.6, 0.0910, 0.1820)}


def both(bench, case):
    """What a case runs as it stands, with the thesis' scheme, and with the consistent one, its defaults and exact cells."""
    return {"thesis": (case, {}),
            "consistent": (bench.copy(case, "scheme", "support", "jst4", "cfl"), {"particles__subvolumes": '"voronoi"'})}


def large_strain(bench):
    case = "twisting_column/consistent.toml"
    if bench.short:
        run = bench.run(case, "twist", end_time=0.2, rows=400)
        time, angle = run.first_maximum("tip_deg")
        amplitude, when, back = TORSION[0.45]
        bench.require_near("the tip's largest angle, degrees, by linear torsion", angle, amplitude, 0.03)
        bench.require_near("when, s", time, when, 0.03)
        bench.require_near("and when it is back, s", run.zero_crossing("tip_deg"), back, 0.03)
        return
    twisting(bench, case)
    bending(bench)
    tensile(bench)
    punch(bench)


def twisting(bench, case):
    table = bench.grid("large_strain.twisting", "ν", "formulation", "spacing, m", "support", "largest angle, °", "off by", "at, s",
                       "off by", "back at zero, s", "off by", "smallest J", "hourglass at 0.1 s", "at 0.17 s", "balance error", "steps")
    variants = [(nu, formulation, 0.2, 1.5) for nu in TORSION for formulation in ("pF", "pFJ")]
    variants += [(0.45, "pF", 0.1, 1.5), (0.45, "pF", 0.2, 1.6), (0.45, "pF", 0.1, 1.6)]
    for nu, formulation, spacing, support in variants:
        run = bench.run(case, f"twist-{nu}-{formulation}-{spacing}-{support}", frames=50, rows=500, material__poisson=nu,
                        solver__formulation=f'"{formulation}"', particles__spacing=spacing, solver__support=support)
        amplitude, when, back = TORSION[nu]
        time, angle = run.first_maximum("tip_deg")
        zero = run.zero_crossing("tip_deg")
        bench.require(run.good, f"{formulation} at nu {nu} comes to its end")
        table.row(nu, formulation, spacing, support, f"{angle:.1f}", percent(angle / amplitude - 1), f"{time:.4f}",
                  percent(time / when - 1), f"{zero:.4f}", percent(zero / back - 1), f"{min(run.history['smallest_volume_ratio']):.3f}",
                  f"{hourglass(run, 0.1):.4f}", f"{hourglass(run, 0.17):.4f}", f"{run['energy.balance_error']:.1e}", run["steps"])


def bending(bench):
    table = bench.grid("large_strain.bending", "case", "scheme", "spacing, m", "first peak of the tip, m", "at, s", "balance error", "steps")
    for name in ("case", "hard"):
        for scheme, (case, keys) in both(bench, f"bending_column/{name}.toml").items():
            for spacing in (0.5, 0.2, 0.1):
                run = bench.run(case, f"bend-{name}-{scheme}-{spacing}", end_time=0.6, rows=600, particles__spacing=spacing, **keys)
                time, peak = run.first_maximum("corner_y_m")
                table.row(name, scheme, spacing, peak, time, run["energy.balance_error"], int(run.history["step"][-1]))


def tensile(bench):
    table = bench.grid("large_strain.tensile", "cloud", "scheme", "particles", "comes", "first peak, m", "at, ms", "smallest J",
                       "balance error", "steps")
    probes = ['{name = "tip", quantity = "uz", reduce = "mean", on = "z_max"}',
              '{name = "smallest_volume_ratio", quantity = "J", reduce = "min"}']
    for name, finer in (("case", {"particles__spacing": 1 / 15}), ("voronoi", {"particles__count": 2800})):
        for scheme, (case, exact) in both(bench, f"tensile_cube/{name}.toml").items():
            for size, keys in {"": {}, "-fine": {**finer, "solver__end_time": 0.01}}.items():
                run = bench.run(case, f"tensile-{name}-{scheme}{size}", rows=2000, probes=probes, **exact, **keys)
                time, peak = run.first_maximum("tip_m")
                table.row(name, scheme, run.summary.get("particles", ""), outcome(run), peak, 1e3 * time,
                          min(run.history["smallest_volume_ratio"]), run["energy.balance_error"], int(run.history["step"][-1]))


def punch(bench):
    table = bench.grid("large_strain.punch", "scheme", "spacing, mm", "comes", "smallest J", "roughness of the pressure at 0.2 ms",
                       "at 0.4 ms", "balance error", "steps")
    for scheme, (case, keys) in both(bench, "punch/case.toml").items():
        for factor in (1, 0.5):
            spacing = PUNCH_SPACING * factor
            run = bench.run(case, f"punch-{scheme}-{factor}", frames=25, rows=500, particles__spacing=spacing, **keys)
            table.row(scheme, 1e3 * spacing, outcome(run), run.summary.get("min", {}).get("jacobian"), roughness(run, 0.0002),
                      roughness(run, 0.0004), run["energy.balance_error"], int(run.history["step"][-1]))


PUNCH_SPACING = 0.00125  # m, 25 x 9 particles
SCENES = {"large_strain": large_strain}
