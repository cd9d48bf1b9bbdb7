"""The generator against itself: planted curves rebuilt from the files by the documents' formulas, and fitted."""

import csv
import json
import tempfile
import tomllib
from pathlib import Path

import numpy as np

from .build import build
from .documented import File, delta, number, seen
from .synth import write

CHANNELS = ("error_um", "error_arcsec", "lead_error_um")
# Rows further from the fit than this many robust deviations are outliers of the instrument.
OUTLIER = 6.0


def read(folder):
    with open(folder / "data.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    machine = tomllib.loads((folder / "machine.toml").read_text())
    return File(machine, columns), json.loads((folder / "truth.json").read_text())


def left_of(file, channel):
    """The channel less what the machine file says."""
    out = file.columns[channel].copy()
    if channel == "lead_error_um":
        told = 0.0
    else:
        told = file.rational() * file.metres
        if "steps" in file.columns:
            out += number(file.machine["drive"]["step"]) * file.columns["steps"]
    for effect in file.machine.get("effect", []):
        values = {key: number(value) for key, value in effect.items() if key != "kind"}
        told = told + seen(effect["kind"], delta(effect["kind"], values, file), channel)
    return out - told


def fitted(folder):
    """Factor on each planted curve that the data ask for, or None where the documents give no curve."""
    file, truth = read(folder)
    channels = [name for name in CHANNELS if name in file.columns]
    curves = [delta(one["effect"], one["parameters"], file) for one in truth["planted"]]
    if not curves or any(curve is None for curve in curves):
        return truth, None
    stacks = [
        np.concatenate([seen(one["effect"], curve, channel) for channel in channels])
        for one, curve in zip(truth["planted"], curves)
    ]
    passes = (file.columns["pass"][:, None] == np.unique(file.columns["pass"])).astype(float)
    design = np.column_stack(stacks + [np.kron(np.eye(len(channels)), passes)])
    return truth, robust(design, np.concatenate([left_of(file, channel) for channel in channels]))[:len(stacks)]


def robust(design, data):
    kept = np.ones(len(data), bool)
    for _ in range(3):
        found = np.linalg.lstsq(design[kept], data[kept], rcond=None)[0]
        rest = data - design @ found
        kept = np.abs(rest) < OUTLIER * 1.4826 * np.median(np.abs(rest)) + 1e-12
    return found


def check(seeds):
    """One line a planted effect: its factor, and how many of the level's errors that is from 1."""
    for seed in seeds:
        with tempfile.TemporaryDirectory() as folder:
            case, rng = build(seed)
            if case.expect != "named" or any(one.name == "cosine" for one in case.planted):
                continue
            write(case, rng, Path(folder))
            truth, factors = fitted(Path(folder))
        for one, factor in zip(truth["planted"], [] if factors is None else factors):
            off = (factor - 1) * one["level"]
            yield f"{seed} {case.kind} {one['effect']} factor {factor:.3f}, {off:+.1f} errors from 1", off
