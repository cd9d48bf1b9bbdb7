"""From a case to the files: curves, noise, zeros of the passes, rounding, lost cells, shuffled columns."""

import json

import numpy as np

from . import noise as noises
from .case import GAINS
from .evidence import weigh
from .loop import run


def curve(case, channel):
    """What the sensor would show without noise, each pass from its own zero."""
    machine, record = case.machine, case.record
    total = np.zeros(len(record))
    for one in case.planted + case.known:
        if case.loop is not None and one.entry == "actuator":
            continue  # the loop itself makes it
        total += GAINS[channel][one.entry] * one.amplitude * one.shape
    if channel == "error_um":
        total += machine.rational_um_m * record.metres
    starts = record.starts()
    return total - np.repeat(total[starts], np.diff(np.append(starts, len(record))))


def step_of(noise):
    """Resolution of the instrument: a third of the noise or finer, a power of ten."""
    return 10.0 ** np.floor(np.log10(max(noise.white, 1e-4) / 2))


def table(rng, case):
    record, columns = case.record, {}
    for channel, noise in case.channels.items():
        clean = curve(case, channel)
        drawn = noises.draw(rng, noise, record.t)
        if case.loop is not None:
            clean, columns["steps"] = run(case.loop, case.machine, record.t, clean, drawn)
            drawn = 0.0
        step = step_of(noise)
        columns[channel] = np.round((clean + drawn) / step) * step
        case.decimals[channel] = max(0, round(-np.log10(step)))
    columns |= places(case)
    return columns | record.logs


def places(case):
    record, out = case.record, {}
    every = {"time_s": record.t, "position_mm": record.x, "angle_rev": record.turns, "direction": record.direction,
             "speed_rpm": record.speed}
    for name in case.columns:
        out[name] = every[name]
    out["pass"] = record.passes.astype(float)
    return out


def text(rng, case, columns):
    names = list(columns)
    rng.shuffle(names)
    rows = []
    for row in range(0, len(case.record), case.thin):
        rows.append(",".join(cell(case, name, columns[name][row]) for name in names))
    return "\n".join([",".join(names)] + rows) + "\n"


def cell(case, name, value):
    if name in ("pass", "direction", "steps"):
        return f"{value:.0f}"
    return f"{value:.{case.decimals.get(name, 4)}f}"


def write(case, rng, folder):
    columns = table(rng, case)
    weigh(case, columns)
    if case.mend:
        case.mend(columns, case)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "machine.toml").write_text(case.machine.toml())
    (folder / "data.csv").write_text(text(rng, case, columns))
    (folder / "truth.json").write_text(json.dumps(truth(case), indent=1) + "\n")


def truth(case):
    planted = [
        {"effect": one.name, "level": round(one.reached, 2), "evidence": round(one.evidence, 1),
         "nearest": round(one.nearest, 1), "alike": one.alike, "parameters": one.parameters()}
        for one in case.planted
    ]
    return {"kind": case.kind, "expect": case.expect, "level": case.level, "rows": len(case.record) // case.thin,
            "planted": planted, "allowed": sorted(case.allowed), "doubts": list(case.doubts), "formula": case.formula,
            "noise": {name: round(noise.white, 5) for name, noise in case.channels.items()}, "notes": case.notes}
