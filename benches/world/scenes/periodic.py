"""One effect of the catalogue that repeats: screw, gears, disc, clamping, shaking, fringes."""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Case, Planted
from ..machine import rotary_table, telescope
from ..noise import Noise, workshop
from .nothing import know_screw, know_slope, plain


def phase(rng):
    return float(np.round(rng.uniform(-175, 175), 1))


def named(case, *planted):
    case.expect, case.planted = "named", list(planted)
    return case


def resolved(rng, order_max, **over):
    """A plain recorder whose rows resolve this many waves a turn."""
    case = plain(rng, **over)
    rows, turns = len(case.record), np.sum(np.abs(np.diff(case.record.turns)))
    if rows < 2.5 * order_max * turns:
        legs = records.there_and_back(case.machine, len(np.unique(case.record.passes)))
        case.record = records.sampled(rng, case.machine, legs, rows, even=False)
    return case


def plant_screw(case, rng, level, harmonic=1):
    degrees = phase(rng)
    return Planted("screw-periodic", "motion", shapes.screw(case.record, case.machine, harmonic, degrees), level,
                   scaled={"amplitude": 1.0}, shaped={"phase": degrees, "harmonic": harmonic})


def plant_gear(case, rng, level, order=None):
    order = float(rng.choice([order for _, order, _ in case.machine.gears])) if order is None else order
    degrees = phase(rng)
    return Planted("gear-error", "motion", shapes.gear(case.record, order, degrees), level, scaled={"amplitude": 1.0},
                   shaped={"phase": degrees, "order": order})


def screw_periodic(rng, level):
    case = resolved(rng, 3)
    return named(case, plant_screw(case, rng, level, int(rng.choice([1, 1, 2, 3]))))


def gear_error(rng, level):
    case = resolved(rng, 8)
    return named(case, plant_gear(case, rng, level))


def gear_beside_known_screw(rng, level):
    case = resolved(rng, 8)
    know_screw(case, rng)
    know_slope(case, rng)
    return named(case, plant_gear(case, rng, level))


def worm_on_the_sky(rng, level):
    """A worm of a telescope: drift of the pole's alignment stands in the file, seeing is the noise."""
    machine = telescope(rng)
    record = records.clocked(rng, machine, float(rng.uniform(2500, 5000)), float(rng.uniform(2, 5)))
    noise = Noise(float(rng.uniform(0.4, 0.9)), float(rng.uniform(0.2, 0.6)), float(rng.uniform(8, 30)))
    case = Case("", "named", machine, record, channels={"error_arcsec": noise}, columns=("time_s",))
    rate = float(np.round(rng.uniform(-40, 40), 1))
    case.known.append(Planted("phase-drift", "electronics", record.t / 3600, amplitude=rate))
    machine.effects.append({"kind": "phase-drift", "rate": f"{rate!r} arcsec/h"})
    return named(case, plant_gear(case, rng, level, machine.gears[0][1]))


def table_runs_out(rng, level):
    """The table's bearing runs out once a turn: so would an eccentric disc, and nothing tells them apart."""
    machine = rotary_table(rng)
    record = records.clocked(rng, machine, 180 / machine.speed_rpm, 0.15 / machine.speed_rpm)
    noise = Noise(float(rng.uniform(0.1, 0.4)), 0.1, float(rng.uniform(5, 20)))
    case = Case("", "named", machine, record, channels={"error_arcsec": noise}, columns=("time_s", "angle_rev"))
    case.decimals["angle_rev"] = 6
    return named(case, plant_gear(case, rng, level, 1.0))


def eccentric_disc(rng, level):
    case = resolved(rng, 2)
    degrees = phase(rng)
    shape = shapes.eccentric(case.record, case.machine, degrees)
    return named(case, Planted("grating-eccentricity", "angle-reference", shape, level, scaled={"eccentricity": 1.0},
                               shaped={"phase": degrees}))


def graduation(rng, level):
    case = resolved(rng, 8)
    degrees, harmonic = phase(rng), int(rng.integers(2, 8))
    shape = shapes.gear(case.record, harmonic, degrees)
    return named(case, Planted("grating-graduation", "angle-reference", shape, level, scaled={"amplitude": 1.0},
                               shaped={"phase": degrees, "harmonic": harmonic}))


def clamping(rng, level):
    """On the thread alone; the recorder runs beside it and shows nothing."""
    case = resolved(rng, 3)
    case.channels["lead_error_um"] = workshop(rng)
    one, two, share = phase(rng), phase(rng), float(rng.uniform(0.3, 0.8))
    turns = case.record.turns
    shape = shapes.sine(turns, one) + share * shapes.sine(2 * turns, two)
    return named(case, Planted("clamping-runout", "workpiece", shape, level, shaped={"phase1": one, "phase2": two},
                               scaled={"amplitude1": 1.0, "amplitude2": share}))


def shaking(rng, level):
    """A frequency below half the rate of comparisons; two speeds tell it from an order."""
    case = plain(rng, rows=1500)
    machine = case.machine
    speeds = [machine.speed_rpm, machine.speed_rpm * 1.6]
    case.record = records.sampled(rng, machine, records.there_and_back(machine, 2, speeds), 1800, even=False)
    hertz = float(np.round(rng.uniform(0.05, 0.3) * machine.per_turn * machine.speed_rpm / 60, 3))
    case.columns = ("time_s", "position_mm", "direction", "speed_rpm")
    shape = shapes.sine(hertz * case.record.t, phase(rng))
    case.decimals["time_s"] = 5
    return named(case, Planted("vibration", "motion", shape, level, scaled={"amplitude": 1.0},
                               shaped={"frequency": hertz}))


def ripple(rng, level):
    """Mixed polarisations, while the error runs through many fringes."""
    case = plain(rng, rows=2000)
    know_slope(case, rng, linear=float(np.round(rng.uniform(25, 60), 1)))
    machine, record = case.machine, case.record
    known = case.known[0].shape
    error = -known + machine.rational_um_m * record.metres
    starts = record.starts()
    error = error - np.repeat(error[starts], np.diff(np.append(starts, len(record))))
    mixing, degrees = float(rng.uniform(0.2, 0.8)), phase(rng)
    wave = np.sin(4 * np.pi * error / machine.wavelength_um + np.radians(degrees))
    shape = machine.wavelength_um / (4 * np.pi) * wave
    case.channels["error_um"] = Noise(0.02)
    return named(case, Planted("fringe-nonlinearity", "length-reference", shape, level, mixing, fixed=True,
                               scaled={"mixing": 1.0}, shaped={"phase": degrees}))


SCENES = [screw_periodic, gear_error, gear_beside_known_screw, worm_on_the_sky, table_runs_out, eccentric_disc,
          graduation, clamping, shaking, ripple]
