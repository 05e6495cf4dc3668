"""What the scenes of the validation share: running a case, reading what it left, comparing figures, writing tables.

A scene is a function `scene(bench)`. It runs cases with `bench.run`, puts rows into tables with `bench.figures` (our figure
beside the document's) or `bench.grid` (any columns), and states what must hold with `bench.require`. In the short form
(`bench.short`) it runs little and asserts what it can. Lengths, times and so on are SI.
"""

import csv
import json
import math
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Run:
    """What one run of the program left behind. A run that failed has no summary, but its history up to there."""

    def __init__(self, folder, error):
        self.folder = folder
        self.error = error  # the program's one line, None if it came to its end
        summary = folder / "summary.json"
        self.summary = json.loads(summary.read_text()) if summary.exists() and not error else {}
        self.history = read_history(folder / "history.csv")

    @property
    def good(self):
        return self.error is None

    def __getitem__(self, path):
        """A number of summary.json: run["energy.kinetic"]."""
        value = self.summary
        for key in path.split("."):
            value = value[key]
        return value

    def at(self, time, column):
        """A column of the history at a time, linear between its rows."""
        times, values = self.history["time_s"], self.history[column]
        for i in range(1, len(times)):
            if times[i] >= time:
                share = (time - times[i - 1]) / (times[i] - times[i - 1])
                return values[i - 1] + share * (values[i] - values[i - 1])
        return values[-1]

    def first_maximum(self, column):
        """(time, value) of the first hump of a column that begins at zero, by a parabola through three rows."""
        times, values = self.history["time_s"], self.history[column]
        end = next((i for i in range(1, len(values)) if values[i] < 0), len(values))
        i = max(range(end), key=values.__getitem__)
        if i == 0 or i + 1 >= len(values):
            return times[i], values[i]
        a, b, c = values[i - 1 : i + 2]
        curvature = a - 2 * b + c
        shift = 0.5 * (a - c) / curvature if curvature else 0.0
        return times[i] + shift * 0.5 * (times[i + 1] - times[i - 1]), b - 0.25 * (a - c) * shift

    def zero_crossing(self, column):
        """The time at which a column that rose from zero falls below it; None if it does not."""
        times, values = self.history["time_s"], self.history[column]
        for i in range(2, len(values)):
            if values[i] < 0 <= values[i - 1]:
                return times[i - 1] + (times[i] - times[i - 1]) * values[i - 1] / (values[i - 1] - values[i])
        return None

    def frames(self):
        """(time, file) of the stored frames."""
        text = (self.folder / "fields.pvd").read_text()
        found = re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', text)
        return [(float(time), self.folder / name) for time, name in found]

    def frame_near(self, time):
        return min(self.frames(), key=lambda frame: abs(frame[0] - time))[1]


def read_history(path):
    """Columns by name; none if there is no file."""
    if not path.exists():
        return {}
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    if not rows:
        return {}
    columns = zip(*[[float(cell) for cell in row] for row in rows[1:]])
    return dict(zip(rows[0], map(list, columns)))


def number(value, digits=4):
    """For a table: four figures, an exponent only where it is shorter."""
    if value is None:
        return ""
    if isinstance(value, (str, int)):
        return str(value)
    if not math.isfinite(value):
        return "not finite"
    text = f"{value:.{digits}g}"
    mantissa, _, exponent = text.partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else text


class Table:
    def __init__(self, header):
        self.header = header
        self.rows = []

    def row(self, *cells):
        self.rows.append([number(cell) for cell in cells])

    def markdown(self):
        lines = ["| " + " | ".join(self.header) + " |", "|" + "|".join([":--"] + ["--:"] * (len(self.header) - 1)) + "|"]
        return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in self.rows])


class Figures(Table):
    """Figure, document, ours, difference, and what an independent program on the same lattice gave."""

    def __init__(self):
        super().__init__(["figure", "document", "ours", "difference", "reference program"])

    def compare(self, figure, ours, document=None, reference=None):
        difference = ""
        if isinstance(document, (int, float)) and isinstance(ours, (int, float)) and document:
            difference = f"{100 * (ours - document) / abs(document):+.1f} %"
        self.row(figure, document, ours, difference, reference)


class Bench:
    """One scene's place to run and to report. `out` is the folder of its runs."""

    def __init__(self, program, out, short, reuse=False, say=print):
        self.program, self.out, self.short, self.reuse, self.say = program, pathlib.Path(out), short, reuse, say
        self.tables = {}   # name of the marker in docs/validation.md: Table
        self.failures = []

    def run(self, case, name, end_time=None, frames=1, rows=200, probes=None, cloud=None, **keys):
        """Runs geometries/`case` into the folder `name`. Keys override the case's: solver__jst4=0 is solver.jst4 = 0;
        probes (inline tables of TOML) take the place of the case's, the particles of the file `cloud` that of new ones."""
        keys = {**keys, "output__frames": frames, "output__history_rows": rows}
        if end_time is not None:
            keys["solver__end_time"] = end_time
        sets = [f"{key.replace('__', '.')}={toml(value)}" for key, value in keys.items()]
        if probes is not None:
            sets.append("output.probe=[" + ", ".join(probes) + "]")
        folder = self.out / name
        done = folder / "validation.json"  # what was asked, and how it went: --reuse goes by it
        case_file = ROOT / "geometries" / case
        asked = {"case": case_file.read_text(), "set": sets}
        if self.reuse and done.exists():
            last = json.loads(done.read_text())
            if last["asked"] == asked:
                return Run(folder, last["error"])
        folder.mkdir(parents=True, exist_ok=True)
        done.unlink(missing_ok=True)
        command = [str(self.program), "solve", str(case_file), "-o", str(folder), "--quiet", "--threads", "1"]
        if cloud:
            command += ["--cloud", str(cloud)]
        for item in sets:
            command += ["--set", item]
        result = subprocess.run(command, capture_output=True, text=True)
        error = None if result.returncode == 0 else (result.stderr.strip().splitlines() or ["no message"])[-1]
        if result.returncode not in (0, 1):  # a mistake in the case or in this script, not a finding
            raise SystemExit(f"{name}: {error}\n  {' '.join(command)}")
        done.write_text(json.dumps({"asked": asked, "error": error}))
        run = Run(folder, error)
        self.say(f"  {name}: " + (f"{run['steps']} steps, {run['wall_seconds']:.1f} s" if run.good else error))
        return run

    def copy(self, case, *dropped):
        """A copy of geometries/`case` without the lines of some keys: those that other choices would be refused beside."""
        file = ROOT / "geometries" / case
        lines = [line for line in file.read_text().splitlines() if line.split(" = ")[0] not in dropped]
        self.out.mkdir(parents=True, exist_ok=True)
        copy = (self.out / ("-".join(dropped) + "-" + case.replace("/", "-"))).resolve()
        copy.write_text("\n".join(lines).replace('file = "', f'file = "{file.parent}/') + "\n")
        return copy

    def figures(self, name):
        return self.tables.setdefault(name, Figures())

    def grid(self, name, *header):
        return self.tables.setdefault(name, Table(list(header)))

    def require(self, holds, what):
        """An asserted bound: the script's exit status is 1 if one does not hold."""
        self.say(f"  {'holds' if holds else 'FAILS'}: {what}")
        if not holds:
            self.failures.append(what)

    def require_near(self, what, ours, expected, share):
        self.require(abs(ours - expected) <= share * abs(expected),
                     f"{what}: {number(ours)} within {100 * share:g} % of {number(expected)}")

    def require_below(self, what, ours, bound):
        self.require(ours <= bound, f"{what}: {number(ours)} at most {number(bound)}")

    def require_above(self, what, ours, bound):
        self.require(ours >= bound, f"{what}: {number(ours)} at least {number(bound)}")


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {quoted(one)}" for key, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(quoted(one) for one in value) + "]"
    return str(value)


def quoted(value):
    return f'"{value}"' if isinstance(value, str) else toml(value)


def replace_tables(document, tables):
    """Puts each table between its markers, <!-- begin NAME --> and <!-- end -->; prose stays as it is. Returns the names
    of tables the document has no place for."""
    text = document.read_text()
    missing = []
    for name, table in tables.items():
        pattern = re.compile(rf"(<!-- begin {re.escape(name)} -->\n).*?(<!-- end -->)", re.DOTALL)
        if not pattern.search(text):
            missing.append(name)
        text = pattern.sub(lambda match: match.group(1) + table.markdown() + "\n" + match.group(2), text)
    document.write_text(text)
    return missing
