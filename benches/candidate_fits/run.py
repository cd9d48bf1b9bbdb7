"""`helixlock diagnose` against the same candidate fits with numpy and scipy.

    python3 -m pip install -r benches/candidate_fits/requirements.txt
    python3 benches/candidate_fits/run.py target/release/helixlock

Both read the same machine and data, in the same run, by turns. What Python does here is one round of
the search: every effect of the catalogue that these data can show, at every place of the same grid,
each pass with its own zero, the noise as a first-order process whose correlation is estimated from
the data; then the three best places of each effect are refined with `scipy.optimize.least_squares`.
Columns are vectorised in numpy, linear coefficients are solved for and not searched (which is quicker
than `curve_fit` on everything), and reading the file is not counted.

`diagnose` is timed as a whole: start, reading, every round of the search, noise fits, hold-out, rivals
and experiments. It does more; nothing is taken off for that.
"""

import csv
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import lfilter, lombscargle

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
TAU = 2 * np.pi
# Points of a plain, a spatial, a temporal axis, and the most of a product: lab/src/candidates.rs.
PLAIN, PLACES, INSTANTS, MOST = 24, 48, 96, 3000


class Data:
    """The samples of one example, whitened, each pass about its own zero."""

    def __init__(self, folder):
        machine = tomllib.loads((folder / "machine.toml").read_text())
        self.lead = float(machine["workpiece"]["lead"].split()[0])
        self.screw = float(machine["lead_screw"]["lead"].split()[0])
        self.speed = float(machine["spindle"]["speed"].split()[0])
        self.orders = [float(gear["order"]) for gear in machine.get("gear", [])]
        self.orders += [
            float(gear["order"]) * gear["teeth"] for gear in machine.get("gear", []) if "teeth" in gear
        ]
        self.logs = {}
        with open(folder / "data.csv", newline="") as file:
            lines = [line for line in file if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
        column = lambda name: np.array([float(row[name] or "nan") for row in rows])
        kept = np.isfinite(column("position_mm")) & np.isfinite(column("error_um"))
        order = np.lexsort((column("time_s"), column("pass")))
        order = order[kept[order]]
        self.x, self.t = column("position_mm")[order], column("time_s")[order]
        self.passes = column("pass")[order]
        self.turns = self.x / self.lead
        self.time_spread = np.ptp(self.t)
        self.interval = np.median(np.diff(self.t)[np.diff(self.t) > 0])
        for name in ("air_temperature_c", "air_pressure_hpa", "humidity_pct"):
            if name in rows[0]:
                self.logs[name] = column(name)[order]
        self.starts = np.r_[True, self.passes[1:] != self.passes[:-1]]
        self.number = np.cumsum(self.starts) - 1
        self.shown = self.known(machine)
        residual = self.zeroed(column("error_um")[order] - self.shown)
        self.correlation = self.lag_one(residual)
        self.target = self.whiten(residual)
        self.sigma = self.target.std()

    def known(self, machine):
        """What the effects of the machine file show; only those these examples have."""
        shown = np.zeros_like(self.x)
        for effect in machine.get("effect", []):
            value = lambda key: float(str(effect.get(key, "0")).split()[0])
            if effect["kind"] == "screw-periodic":
                phase = TAU * self.x / self.screw + np.radians(value("phase"))
                shown -= value("amplitude") * np.sin(phase)
            elif effect["kind"] == "screw-progressive":
                metres = self.x / 1000
                shown -= value("linear") * metres + value("quadratic") * metres**2
        return shown

    def zeroed(self, values):
        """Values about the mean of their pass."""
        counts = np.bincount(self.number)
        if values.ndim == 1:
            return values - (np.bincount(self.number, values) / counts)[self.number]
        return np.column_stack([self.zeroed(column) for column in values.T])

    def lag_one(self, residual):
        inside = ~self.starts[1:]
        before, after = residual[:-1][inside], residual[1:][inside]
        return float(np.clip(before @ after / (before @ before), 0.0, 0.95))

    def whiten(self, values):
        """Innovations of a first-order process, pass by pass."""
        rho = self.correlation
        white = values.astype(float).copy()
        white[1:] -= rho * values[:-1]
        white[self.starts] = values[self.starts] * np.sqrt(1 - rho**2)
        return white

    def column(self, values):
        return self.whiten(self.zeroed(values))


def evenly(low, high, points):
    return low + (high - low) * (np.arange(points) + 0.5) / points


def logarithmic(data, scale, low=1e-3, high=1e6):
    low, high = max(low, scale / 200), min(high, 2 * scale)
    return np.exp(evenly(np.log(low), np.log(high), PLAIN))


def sine(argument):
    return np.column_stack([np.sin(argument), np.cos(argument)])


def catalogue(data):
    """Name, axes of the nonlinear values, and columns of the linear ones."""
    metres, x, t = data.x / 1000, data.x, data.t
    places = evenly(x.min(), x.max(), PLACES)
    sorted_t = np.unique(t)
    between = (sorted_t[1:] + sorted_t[:-1]) / 2
    instants = between[np.linspace(0, len(between) - 1, INSTANTS).astype(int)]
    widths, times = logarithmic(data, np.ptp(x)), logarithmic(data, data.time_spread)
    angle = TAU * data.turns
    one = np.column_stack
    yield "screw-periodic", [np.arange(1.0, 9)], lambda k: sine(TAU * k * x / data.screw)
    yield "screw-progressive", [], lambda: one([metres, metres**2, metres**3])
    yield "screw-wear", [places, widths], lambda p, w: one([np.exp(-((x - p) ** 2) / (2 * w**2))])
    if data.orders:
        yield "gear-error", [np.array(data.orders)], lambda o: sine(o * angle)
    yield "laser-drift", [], lambda: one([metres * t])
    yield "cosine", [], lambda: one([metres])
    yield "compensator-staircase", [evenly(0.5, 60, PLAIN)], lambda r: one(
        [np.floor(metres * r / 0.31641) * 0.31641]
    )
    yield "fringe-slip", [instants], lambda at: one([0.31641 * (at < t)])
    yield "grating-slip", [instants], lambda at: one([0.43147 * (at < t)])
    yield "grating-eccentricity", [], lambda: sine(angle)
    yield "grating-graduation", [np.arange(2.0, 13)], lambda k: sine(k * angle)
    yield "headstock-growth", [times], lambda tau: one([1 - np.exp(-t / tau)])
    yield "phase-drift", [], lambda: one([t])
    yield "recorder-lag", [times], lambda tau: one([lagged(data, tau) - data.shown])
    yield "vibration", [strongest(data)], lambda f: sine(TAU * f * t)
    if {"air_temperature_c", "air_pressure_hpa"} <= data.logs.keys():
        warm, high = data.logs["air_temperature_c"] - 20, data.logs["air_pressure_hpa"] - 1013.25
        yield "air-temperature", [], lambda: one([0.93 * metres * warm])
        yield "air-pressure", [], lambda: one([-0.268 * metres * high])
        yield "air-humidity", [], lambda: one([0.0085 * metres * (data.logs["humidity_pct"] - 50)])
        yield "dead-path", [], lambda: one([0.93 * warm - 0.268 * high])


def lagged(data, tau):
    """What the file's model shows behind a first-order lag, at the usual interval of the samples."""
    keep = np.exp(-data.interval / tau)
    return lfilter([1 - keep], [1, -keep], data.shown)


def strongest(data):
    """The sixteen strongest frequencies in time, by the periodogram of uneven samples."""
    frequencies = np.arange(1.5 / data.time_spread, 0.5 / data.interval, 0.3 / data.time_spread)
    power = lombscargle(data.t, data.target, TAU * frequencies)
    return np.sort(frequencies[np.argsort(power)[-16:]])


def solved(data, columns):
    """Whitened columns, coefficients, and the square they leave."""
    design = np.column_stack([data.column(column.astype(float)) for column in columns.T])
    coefficients, *_ = np.linalg.lstsq(design, data.target, rcond=None)
    left = data.target - design @ coefficients
    return coefficients, left @ left, left


def fit(data, axes, columns):
    """Best square of one effect: its grid, then its three best places refined."""
    points = np.array(np.meshgrid(*axes, indexing="ij")).reshape(len(axes), -1).T if axes else [()]
    while MOST < len(points):
        points = points[::2]
    squares = [solved(data, columns(*point))[1] for point in points]
    best = min(squares)
    if not axes:
        return best, len(points)
    scale = np.array([np.ptp(axis) / len(axis) + 1e-12 for axis in axes])
    bounds = [[axis.min() - 1e-9 for axis in axes], [axis.max() + 1e-9 for axis in axes]]
    for place in np.argsort(squares)[:3]:
        residual = lambda values: solved(data, columns(*values))[2]
        refined = least_squares(residual, points[place], bounds=bounds, x_scale=scale, max_nfev=40)
        best = min(best, 2 * refined.cost)
    return best, len(points)


def python(data):
    """Seconds of wall and processor time for one round, and what it found best."""
    wall, processor = time.perf_counter(), time.process_time()
    found, points = [], 0
    for name, axes, columns in catalogue(data):
        square, tried = fit(data, axes, columns)
        found.append((square, name))
        points += tried
    best = min(found)[1]
    return time.perf_counter() - wall, time.process_time() - processor, best, len(found), points


def helixlock(command, folder):
    import json
    import resource

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    wall = time.perf_counter()
    words = [command, "diagnose", str(folder / "machine.toml"), str(folder / "data.csv"), "--json"]
    answer = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    wall = time.perf_counter() - wall
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, processor, [round["added"] for round in answer["rounds"][1:]]


def many_samples(folder, rows):
    """The machine of hidden-gear with four passes of more samples; noise of 0.05 µm, half of it slow."""
    source = EXAMPLES / "hidden-gear"
    (folder / "machine.toml").write_text((source / "machine.toml").read_text())
    random = np.random.default_rng(1977)
    machine = tomllib.loads((source / "machine.toml").read_text())
    gear = float(machine["gear"][0]["order"])
    with open(folder / "data.csv", "w") as file:
        file.write("position_mm,time_s,error_um,pass\n")
        for number in range(1, 5):
            x = np.linspace(5.0, 595.0, rows // 4)
            metres = x / 1000
            error = -1.5 * np.sin(TAU * x / 12 + np.radians(30)) - 20 * metres + 15 * metres**2
            error -= 0.4 * np.sin(TAU * gear * x / 8 + 1.0)
            slow = lfilter([0.035 * np.sqrt(1 - 0.9**2)], [1, -0.9], random.normal(size=len(x)))
            error += slow + random.normal(0, 0.035, len(x))
            t = 1000 * (number - 1) + x / 0.8
            rows_of_pass = np.column_stack([x, t, error, np.full(len(x), number)])
            np.savetxt(file, rows_of_pass, delimiter=",", fmt=["%.5f", "%.5f", "%.6f", "%d"])
    return folder


def main():
    command = str(Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as scratch:
        measure(command, many_samples(Path(scratch), 100_000))


def measure(command, many):
    print("example, samples, python: effects, places, wall s, cpu s, best; helixlock: wall s, cpu s, found; ratio wall, cpu")
    folders = {name: EXAMPLES / name for name in ("hidden-gear", "thermal-day")} | {"10^5 samples": many}
    for example, folder in folders.items():
        data = Data(folder)
        turns = [(python(data), helixlock(command, folder)) for _ in range(3)]
        ours = [min(turn[1][i] for turn in turns) for i in (0, 1)]
        theirs = [min(turn[0][i] for turn in turns) for i in (0, 1)]
        _, _, best, effects, places = turns[0][0]
        ratio = [statistics.median(turn[0][i] / turn[1][i] for turn in turns) for i in (0, 1)]
        print(
            f"{example}, {len(data.t)}, python: {effects}, {places}, {theirs[0]:.2f}, {theirs[1]:.2f}, {best}; "
            f"helixlock: {ours[0]:.2f}, {ours[1]:.2f}, {turns[0][1][2]}; {ratio[0]:.1f}, {ratio[1]:.1f}"
        )


if __name__ == "__main__":
    main()
