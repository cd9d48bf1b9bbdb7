"""`helixlock diagnose` against the same candidate fits with numpy and scipy.

    python3 -m pip install -r benches/candidate_fits/requirements.txt
    python3 benches/candidate_fits/run.py target/release/helixlock

Both work on the same machine and data, in the same run, by turns. Python does the search of
`diagnose` as a person would write it: in each round every effect of the catalogue that these data can
show, at every place of the same grid, under the same kind of noise (white and one slow part, by
restricted maximum likelihood, each pass with its own zero); the three best places of each effect
refined with `scipy.optimize.least_squares`, linear coefficients solved for; the noise fitted anew for
the four best effects; each of them held out pass by pass; the best one added, until none is better
than chance. Columns are vectorised, the covariance of each pass is factored once a noise (LAPACK).
Beyond some thousand samples both work on means of neighbours. Reading is not counted for Python.

`diagnose` is timed as a whole: start, reading, a second slow part of the noise, outliers, settings,
pairs of effects, rivals, experiments, structures left, and the fit to all samples. It does more; nothing
is taken off for that.
"""

import csv
import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import least_squares, minimize
from scipy.signal import lfilter

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
TAU = 2 * np.pi
# Points of a plain, a spatial, a temporal axis, and the most of a product: lab/src/candidates.rs.
PLAIN, PLACES, INSTANTS, MOST = 24, 48, 96, 3000
# Rows beyond which means of neighbours are searched: lab/src/diagnosis.rs.
MOST_ROWS = 3000


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
        starts = np.r_[True, self.passes[1:] != self.passes[:-1]]
        self.number = np.cumsum(starts) - 1
        self.shown = self.known(machine)
        self.error = column("error_um")[order] - self.shown
        self.thin()
        self.blocks = [np.flatnonzero(self.number == n) for n in range(self.number.max() + 1)]
        self.set_noise(fitted_noise(self, self.error))

    def thin(self):
        """Means of neighbours, at most about as many as `diagnose` searches on."""
        together = -(-len(self.t) // MOST_ROWS)
        if together < 2:
            return
        keep = np.concatenate(
            [np.flatnonzero(self.number == n)[: -together or None] for n in np.unique(self.number)]
        )
        group = np.cumsum(np.r_[0, np.diff(self.number[keep])]) * len(self.t) + np.arange(len(keep)) // together
        _, group = np.unique(group, return_inverse=True)
        counts = np.bincount(group)
        mean = lambda values: np.bincount(group, values[keep]) / counts
        self.number = np.rint(mean(self.number)).astype(int)
        self.x, self.t, self.error, self.shown = map(mean, (self.x, self.t, self.error, self.shown))
        self.turns = self.x / self.lead
        self.logs = {name: mean(values) for name, values in self.logs.items()}
        self.interval = np.median(np.diff(self.t)[np.diff(self.t) > 0])

    def set_noise(self, noise):
        """Factors of the covariance of each pass, and the whitened zeros of the passes."""
        self.noise = noise
        self.factors = [factor(self, rows, noise) for rows in self.blocks]
        self.zeros = [
            solve_triangular(lower, np.ones(len(lower)), lower=True, check_finite=False)
            for lower in self.factors
        ]
        self.target = self.whiten(self.error)

    def whiten(self, values):
        """Values under this noise, the zero of each pass projected out."""
        white = np.empty(values.shape)
        for rows, lower, zero in zip(self.blocks, self.factors, self.zeros):
            part = solve_triangular(lower, values[rows], lower=True, check_finite=False)
            white[rows] = part - np.multiply.outer(zero, zero @ part / (zero @ zero)).reshape(part.shape)
        return white

    def known(self, machine):
        """What the effects of the machine file show; only those these examples have."""
        shown = implied(machine) * self.x
        for effect in machine.get("effect", []):
            value = lambda key: float(str(effect.get(key, "0")).split()[0])
            if effect["kind"] == "screw-periodic":
                phase = TAU * self.x / self.screw + np.radians(value("phase"))
                shown -= value("amplitude") * np.sin(phase)
            elif effect["kind"] == "screw-progressive":
                metres = self.x / 1000
                shown -= value("linear") * metres + value("quadratic") * metres**2
        return shown


def factor(data, rows, noise):
    """Lower factor of the covariance of one pass: white, and one exponentially correlated part."""
    white, slow, length = noise
    apart = np.abs(np.subtract.outer(data.t[rows], data.t[rows]))
    covariance = slow**2 * np.exp(-apart / (length * data.interval))
    covariance[np.diag_indices_from(covariance)] += white**2
    return np.linalg.cholesky(covariance)


def fitted_noise(data, left):
    """Noise of a residual by restricted maximum likelihood."""
    size = np.std(left - (np.bincount(data.number, left) / np.bincount(data.number))[data.number])

    def loss(logarithms):
        total = 0.0
        for rows in data.blocks:
            try:
                lower = factor(data, rows, np.exp(logarithms))
            except np.linalg.LinAlgError:
                return 1e300
            both = np.column_stack([left[rows], np.ones(len(rows))])
            part, zero = solve_triangular(lower, both, lower=True, check_finite=False).T
            total += part @ part - (part @ zero) ** 2 / (zero @ zero)
            total += 2 * np.log(np.diag(lower)).sum() + np.log(zero @ zero)
        return total

    start = np.log([0.7 * size, 0.7 * size, 5.0])
    found = minimize(loss, start, method="Nelder-Mead", options={"maxfev": 60, "xatol": 0.02, "fatol": 0.1})
    return np.exp(found.x)


def implied(machine):
    """µm a mm that the dividers leave against the laser's own fringes."""
    lead = float(machine["workpiece"]["lead"].split()[0])
    dividers = machine["dividers"]
    wavelength = float(machine["laser"]["wavelength"].split()[0])
    fringes = machine["grating"]["lines"] * dividers["b"] / dividers["a"]
    return (fringes * wavelength / 2000 - lead) / lead * 1000


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
    """The sixteen strongest frequencies in time, by a Fourier transform of the nearest even grid."""
    cells = np.rint((data.t - data.t.min()) / data.interval).astype(int)
    even = np.bincount(cells, data.target)
    power = np.abs(np.fft.rfft(even, 4 * len(even)))
    frequencies = np.fft.rfftfreq(4 * len(even), data.interval)
    return np.sort(frequencies[2:][np.argsort(power[2:])[-16:]])


def whitened(data, model):
    """Columns that are in the model already, whitened once a round."""
    return data.whiten(np.column_stack(model)) if model else np.empty((len(data.t), 0))


def solved(data, columns, model):
    """Coefficients, the square they leave, and what is left; `model` is whitened already."""
    design = np.column_stack([data.whiten(columns), model])
    coefficients, *_ = np.linalg.lstsq(design, data.target, rcond=None)
    left = data.target - design @ coefficients
    return coefficients, left @ left, left


def fit(data, axes, columns, model):
    """Best square of one effect and its columns: its grid, then its three best places refined."""
    points = np.array(np.meshgrid(*axes, indexing="ij")).reshape(len(axes), -1).T if axes else [()]
    while MOST < len(points):
        points = points[::2]
    squares = [solved(data, columns(*point), model)[1] for point in points]
    best = (min(squares), points[int(np.argmin(squares))])
    if axes:
        scale = np.array([np.ptp(axis) / len(axis) + 1e-12 for axis in axes])
        bounds = [[axis.min() - 1e-9 for axis in axes], [axis.max() + 1e-9 for axis in axes]]
        for place in np.argsort(squares)[:3]:
            residual = lambda values: solved(data, columns(*values), model)[2]
            refined = least_squares(residual, points[place], bounds=bounds, x_scale=scale, max_nfev=40)
            best = min(best, (2 * refined.cost, refined.x), key=lambda pair: pair[0])
    return best[0], columns(*best[1]), len(points)


def refitted(data, columns, model):
    """Held-out rms of an effect with the noise fitted anew, and that noise."""
    old = data.noise
    coefficients, *_ = solved(data, columns, whitened(data, model))
    stacked = np.column_stack([columns, *model])
    left = data.error - stacked @ coefficients
    data.set_noise(fitted_noise(data, left))
    design = data.whiten(stacked)
    squares = []
    for held in data.blocks:
        seen = np.setdiff1d(np.arange(len(data.t)), held)
        kept, *_ = np.linalg.lstsq(design[seen], data.target[seen], rcond=None)
        apart = data.error[held] - stacked[held] @ kept
        squares.append(np.var(apart) * len(held))
    noise = data.noise
    data.set_noise(old)
    return np.sqrt(sum(squares) / len(data.t)), noise


def python(data):
    """Seconds of wall and processor time, what was found, effects and places tried a round."""
    wall, processor = time.perf_counter(), time.process_time()
    start = data.noise
    data.set_noise(fitted_noise(data, data.error))
    model, names, held_out = [], [], np.inf
    while len(names) < 5:
        ranked, places, white = [], 0, whitened(data, model)
        for name, axes, columns in catalogue(data):
            square, best, tried = fit(data, axes, columns, white)
            ranked.append((square, name, best))
            places += tried
        ranked.sort(key=lambda entry: entry[0])
        tried = [(*refitted(data, best, model), name, best) for _, name, best in ranked[:4]]
        rms, noise, name, best = min(tried, key=lambda entry: entry[0])
        without = solved(data, np.empty((len(data.t), 0)), white)[1]
        gain = without - ranked[0][0]
        # Twice the logarithm of the places tried, and what a coefficient costs.
        if gain < 2 * np.log(places) + 20 or not rms < 0.98 * held_out:
            break
        model.append(best)
        names.append(name)
        held_out = rms
        data.set_noise(noise)
    found = time.perf_counter() - wall, time.process_time() - processor, names, len(ranked), places
    data.set_noise(start)
    return found


def helixlock(command, folder):
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
            error = implied(machine) * x - 20 * metres + 15 * metres**2
            error -= 1.5 * np.sin(TAU * x / 12 + np.radians(30))
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
    print("example, samples; python: effects, places a round, wall s, cpu s, found; helixlock: wall s, cpu s, found; ratio wall, cpu")
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
