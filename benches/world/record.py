"""Where and when a machine is sampled: passes, turns about, targets, and what the sensors beside it say."""

from dataclasses import dataclass, field

import numpy as np


@dataclass
class Record:
    t: np.ndarray
    x: np.ndarray  # mm, travel
    passes: np.ndarray
    direction: np.ndarray
    speed: np.ndarray  # rpm
    way: np.ndarray  # mm since the last turn about, large before the first
    ground: np.ndarray  # mm ground in this pass
    lead: float
    logs: dict = field(default_factory=dict)  # what is written, by column
    true: dict = field(default_factory=dict)  # what was, by column

    @property
    def turns(self):
        return self.x / self.lead

    @property
    def metres(self):
        return self.x / 1e3

    def __len__(self):
        return len(self.t)

    def starts(self):
        return np.flatnonzero(np.diff(self.passes, prepend=self.passes[0] - 1))

    def offsets(self):
        return (self.passes[:, None] == np.unique(self.passes)).astype(float)


@dataclass
class Leg:
    """A stretch at constant speed. `joined` legs go on in the pass of the leg before."""

    start: float
    end: float
    rpm: float
    joined: bool = False
    pause_s: float = 0.0


def travel(machine, legs):
    """Instants of all comparisons of the grating: they come at fixed angles."""
    rows, clock, number, since = [], 0.0, 0, 1e9
    for leg in legs:
        number += not leg.joined
        since = 0.0 if leg.joined else 1e9
        span, way = abs(leg.end - leg.start), np.sign(leg.end - leg.start)
        pitch = machine.lead_mm / machine.per_turn
        done = np.arange(0, span, pitch)
        t = clock + leg.pause_s + done / (machine.lead_mm * leg.rpm / 60)
        rows.append(np.column_stack([
            t, leg.start + way * done, np.full(len(t), number), np.full(len(t), way), np.full(len(t), leg.rpm),
            since + done, done,
        ]))
        clock = t[-1]
    return np.vstack(rows)


def sampled(rng, machine, legs, rows=1000, even=None, drop=None):
    """Some of the comparisons, evenly or by chance, a few of them lost."""
    every = travel(machine, legs)
    rows = min(rows, len(every))
    even = bool(rng.random() < 0.4) if even is None else even
    if even:
        kept = np.arange(0, len(every), max(1, round(len(every) / rows)))
    else:
        kept = np.sort(rng.choice(len(every), rows, replace=False))
    drop = float(rng.choice([0, 0.01, 0.05])) if drop is None else drop
    kept = kept[rng.random(len(kept)) >= drop]
    return from_rows(machine, every[kept])


def from_rows(machine, rows):
    columns = [np.ascontiguousarray(column) for column in rows.T]
    t, x, number, way, rpm, since, ground = columns
    return Record(t, x, number.astype(int), way, rpm, since, ground, machine.lead_mm)


def one_pass(machine, start=None, end=None):
    start, end = 20.0 if start is None else start, machine.length_mm if end is None else end
    return [Leg(start, end, machine.speed_rpm)]


def there_and_back(machine, times=2, speeds=None):
    """Passes forward and in reverse, each with its own zero."""
    speeds = speeds or [machine.speed_rpm]
    legs = []
    for number in range(times):
        ends = (20.0, machine.length_mm) if number % 2 == 0 else (machine.length_mm, 20.0)
        legs.append(Leg(*ends, speeds[number % len(speeds)], pause_s=0 if number == 0 else 90.0))
    return legs


def turned_about(machine, passes=2, turns=2):
    """Passes that turn about inside."""
    legs = []
    for number in range(passes):
        for turn in range(turns):
            ends = (20.0, machine.length_mm) if turn % 2 == 0 else (machine.length_mm, 20.0)
            pause = 2.0 if turn else (60.0 if number else 0.0)
            legs.append(Leg(*ends, machine.speed_rpm, joined=turn > 0, pause_s=pause))
    return legs


def targets(rng, machine, runs=5, pitch_mm=25.0, count=21):
    """ISO 230-2: each run goes to all targets and back, with a dwell at each."""
    rows, clock = [], 0.0
    for run in range(1, runs + 1):
        for way in (1, -1):
            order = np.arange(count) if way > 0 else np.arange(count)[::-1]
            for nth, target in enumerate(order):
                clock += 5.0 + pitch_mm / (machine.lead_mm * machine.speed_rpm / 60)
                since = nth * pitch_mm + 4.0 if way < 0 else 1e9
                rows.append((clock, target * pitch_mm, run, way, machine.speed_rpm, since, nth * pitch_mm))
    return from_rows(machine, np.array(rows))


def clocked(rng, machine, seconds, every_s, jitter=0.1):
    """A rotary chain, read by the clock."""
    t = np.arange(0, seconds, every_s) + every_s
    t = t + rng.uniform(-jitter, jitter, len(t)) * every_s
    t = t[rng.random(len(t)) >= 0.02]
    turns = t * machine.speed_rpm / 60
    ones = np.ones(len(t))
    return Record(t, turns * machine.lead_mm, ones.astype(int), ones, ones * machine.speed_rpm, 1e9 * ones,
                  turns * machine.lead_mm, machine.lead_mm)


def course(rng, t, swing, kind=None):
    """A slow course of unit size in time: ramp, wave, warming up, or weather; times `swing`."""
    span = t[-1] - t[0] + 1e-9
    s = (t - t[0]) / span
    kind = kind or str(rng.choice(["wave", "weather", "warming"]))
    if kind == "wave":
        shape = np.sin(2 * np.pi * rng.uniform(1.2, 2.6) * s + rng.uniform(0, 6.28))
    elif kind == "weather":
        shape = sum(np.sin(2 * np.pi * f * s + rng.uniform(0, 6.28)) / f for f in (0.7, 1.6, 2.9))
    else:
        shape = 1.6 * (1 - np.exp(-s / 0.35)) + 0.35 * np.sin(2 * np.pi * 1.9 * s + rng.uniform(0, 6.28))
    return swing * shape


# Readings a record of a sensor that is held between them, so that the log can follow what it logs.
READINGS, INTERVALS_S = 60, (60.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0)


def log(rng, record, name, true, resolution, noise=0.0, every_s=60.0):
    """A sensor read every minute (a short record: more often), held until the next reading, rounded; 0: every row."""
    record.true[name] = true
    if every_s:
        span = np.ptp(record.t)
        every_s = next((one for one in INTERVALS_S if one <= span / READINGS), INTERVALS_S[-1])
        ticks = np.floor(record.t / every_s) * every_s
        held = np.interp(ticks, record.t, true)
        jitter = noise * rng.standard_normal(int(ticks.max() / every_s) + 1)
        read = held + jitter[(ticks / every_s).astype(int)]
    else:
        read = true + noise * rng.standard_normal(len(true))
    record.logs[name] = np.round(read / resolution) * resolution
    return true
