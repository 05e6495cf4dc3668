"""The Taylor bar for CalculiX (ccx): mesh, input deck, run and result.

Explicit dynamics, finite strains, linear bricks of one integration point (C3D8R). Of the bricks it is the only one to use
here: C3D8 locks when metal flows (a radius of 5.4 mm), C3D8I is reported to have a sixth of its mass in explicit steps.
The time step stays as it begins and knows nothing of elements pressed flat, so it is asked for, as `Mesh.step`; a step
the mesh does not bear ends with numbers that are none. No masses are scaled: the least step is left at its default, which is
below the one asked for.
"""

import dataclasses
import math
import os
import pathlib
import resource
import subprocess

RADIUS, LENGTH, SPEED = 3.2e-3, 32.4e-3, 227.0
END_TIME = 80e-6
CORE = 0.55  # of the radius: corners of the block of bricks inside the rings
BULGE = 0.2  # of that block's outline from a square (0) to a circle (1)


@dataclasses.dataclass
class Mesh:
    """A bar of `layers` of bricks: side x side in the middle and `rings` rings around them."""

    side: int
    rings: int
    layers: int
    step: float  # s

    @property
    def nodes(self):
        return ((self.side + 1) ** 2 + 4 * self.side * self.rings) * (self.layers + 1)

    @property
    def steps(self):
        return math.ceil(END_TIME / self.step * (1 - 1e-9))


def section(mesh):
    """Nodes (x, y) and quadrilaterals of a cross section."""
    nodes, quads, block = [], [], {}
    n = mesh.side
    for j in range(n + 1):
        for i in range(n + 1):
            u, v = 2 * i / n - 1, 2 * j / n - 1
            square = (u / math.sqrt(2), v / math.sqrt(2))
            disc = (u * math.sqrt(1 - v * v / 2), v * math.sqrt(1 - u * u / 2))
            block[i, j] = len(nodes)
            nodes.append(tuple(CORE * RADIUS * (s + BULGE * (d - s)) for s, d in zip(square, disc)))
    quads += [(block[i, j], block[i + 1, j], block[i + 1, j + 1], block[i, j + 1]) for j in range(n) for i in range(n)]

    rim = ([block[i, 0] for i in range(n)] + [block[n, j] for j in range(n)] +
           [block[i, n] for i in range(n, 0, -1)] + [block[0, j] for j in range(n, 0, -1)])
    inner = rim
    for ring in range(1, mesh.rings + 1):
        share = ring / mesh.rings
        outer = []
        for k, start in enumerate(rim):
            angle = (k / (2 * n) - 0.75) * math.pi
            x, y = nodes[start]
            outer.append(len(nodes))
            nodes.append((x + share * (RADIUS * math.cos(angle) - x), y + share * (RADIUS * math.sin(angle) - y)))
        quads += [(inner[k], outer[k], outer[(k + 1) % len(rim)], inner[(k + 1) % len(rim)]) for k in range(len(rim))]
        inner = outer
    return nodes, quads


def bar(mesh):
    """Nodes (x, y, z) and bricks of the bar, both counted from 0; the foot's nodes come first."""
    flat, quads = section(mesh)
    nodes = [(x, y, LENGTH * layer / mesh.layers) for layer in range(mesh.layers + 1) for x, y in flat]
    bricks = [tuple(len(flat) * level + i for level in (layer, layer + 1) for i in quad)
              for layer in range(mesh.layers) for quad in quads]
    return nodes, bricks, len(flat)


def deck(mesh):
    """The input: copper as in geometries/taylor_bar/converged.toml; the foot can slide but not leave the wall."""
    nodes, bricks, foot = bar(mesh)
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i}, {x:.12e}, {y:.12e}, {z:.12e}" for i, (x, y, z) in enumerate(nodes, 1)]
    lines += ["*ELEMENT, TYPE=C3D8R, ELSET=BAR"]
    lines += [", ".join(str(i) for i in (number, *(node + 1 for node in brick))) for number, brick in enumerate(bricks, 1)]
    lines += ["*NSET, NSET=FOOT, GENERATE", f"1, {foot}"]
    lines += ["*MATERIAL, NAME=COPPER", "*DENSITY", "8930", "*ELASTIC", "117e9, 0.35",
              "*PLASTIC", "0.4e9, 0", "1.4e9, 10"]  # stress, plastic strain: 0.1 GPa of hardening
    lines += ["*SOLID SECTION, ELSET=BAR, MATERIAL=COPPER"]
    lines += ["*INITIAL CONDITIONS, TYPE=VELOCITY", f"ALL, 3, {-SPEED}", "*BOUNDARY", "FOOT, 3, 3"]
    lines += ["*STEP, NLGEOM, INC=100000000", "*DYNAMIC, EXPLICIT", f"{mesh.step:g}, {END_TIME:g}, , {mesh.step:g}"]
    lines += ["*NODE PRINT, NSET=ALL, FREQUENCY=100000000", "U", "*END STEP"]  # the last increment is always printed
    return "\n".join(lines) + "\n"


def displaced(mesh, printed):
    """Points of the bar at the end, from the text of the .dat file."""
    nodes = bar(mesh)[0]
    points = {}
    for line in printed.splitlines():
        cells = line.split()
        if len(cells) == 4 and cells[0].isdigit():
            X = nodes[int(cells[0]) - 1]
            points[int(cells[0])] = tuple(x + float(u) for x, u in zip(X, cells[1:]))
    if len(points) != len(nodes):
        raise SystemExit(f"ccx printed {len(points)} of {len(nodes)} displacements")
    if not all(math.isfinite(x) for point in points.values() for x in point):
        raise SystemExit(f"ccx did not bear steps of {mesh.step:g} s with {len(nodes)} nodes, give it shorter ones")
    return list(points.values())


def run(mesh, folder):
    """Runs ccx on one core in `folder`. Returns its processor time (s, all of it) and the points at the end."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "bar.inp").write_text(deck(mesh))
    one_core = {key: value for key, value in os.environ.items() if not key.startswith("CCX_NPROC")}
    one_core["OMP_NUM_THREADS"] = "1"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with (folder / "bar.log").open("w") as log:
        status = subprocess.run(["ccx", "bar"], cwd=folder, env=one_core, stdout=log, stderr=log).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if status != 0 or "Job finished" not in (folder / "bar.log").read_text():
        raise SystemExit(f"ccx did not come to its end, see {folder / 'bar.log'}")
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, displaced(mesh, (folder / "bar.dat").read_text())
